"""The command ``conformance``: tests whether a realizer conforms to BML, over its socket."""

import argparse
import asyncio
import json
from collections import Counter
from collections.abc import AsyncIterator, Mapping

from reactive_realizer.cli.realize import seconds
from reactive_realizer.client.broker_options import USER_OF_BROKER, add_broker, broker_of
from reactive_realizer.conformance.broker_connection import BrokerConnection
from reactive_realizer.conformance.case import PROFILES, Profile, read_suite
from reactive_realizer.conformance.connection import START, Connection, ProgramConnection, SocketConnection
from reactive_realizer.conformance.suite import PATIENCE, TOLERANCE, Outcome, Verdict, run_suite

_ALL = "all"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``conformance``."""
    names = [case.name for case in read_suite()]
    parser.description = (
        "Runs a suite of BML scripts against a server and reports every failed assertion. Everything that plays on the "
        "server is stopped."
    )
    parser.epilog = (
        f"example: reactive-realizer conformance http://127.0.0.1:8088 --case append --case replace; {USER_OF_BROKER}"
    )
    realizer = parser.add_mutually_exclusive_group(required=True)
    realizer.add_argument("url", metavar="URL", nargs="?", help="the address of the server, http://127.0.0.1:8088")
    realizer.add_argument(
        "--program", metavar="COMMAND", help="a program that reads BML and writes feedback, instead of a server"
    )
    realizer.add_argument(
        "--agent",
        metavar="NAME",
        help="an agent of the Virtual Human Toolkit, behind a broker, instead of a server",
    )
    add_broker(parser)
    parser.add_argument(
        "--profile",
        action="append",
        choices=[*(profile.value for profile in Profile), _ALL],
        metavar="NAME",
        help=f"also assert, besides {PROFILES[Profile.BML]}: "
        + "; ".join(f"{profile}: {text}" for profile, text in PROFILES.items() if profile is not Profile.BML)
        + f"; {_ALL} of these",
    )
    parser.add_argument(
        "--tolerance",
        type=seconds,
        default=TOLERANCE,
        metavar="S",
        help=f"tolerance of times; {TOLERANCE:g} by default",
    )
    parser.add_argument(
        "--start",
        type=seconds,
        default=START,
        metavar="S",
        help=f"how long the realizer may need to its first feedback; {START:g} by default",
    )
    parser.add_argument("--json", action="store_true", help="print a JSON object instead of a table")
    parser.add_argument(
        "--case", action="append", choices=names, metavar="NAME", help=f"run only this case: {', '.join(names)}"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 1 if a case failed. If no realizer is reached, an error is raised."""
    return asyncio.run(_run(options))


async def _run(options: argparse.Namespace) -> int:
    asked = options.profile or ()
    profiles = {*Profile} if _ALL in asked else {Profile.BML, *map(Profile, asked)}
    wanted = options.case or [case.name for case in read_suite() if case.profile in profiles]
    cases = [case for case in read_suite() if case.name in wanted]
    outcomes = run_suite(_connection(options), cases, profiles, options.tolerance)
    realizer = options.program or options.agent or options.url
    verdicts = await (_print_json(realizer, outcomes) if options.json else _print_table(outcomes))
    return 1 if verdicts[Verdict.FAILED] else 0


def _connection(options: argparse.Namespace) -> Connection:
    if options.program is not None:
        return ProgramConnection(options.program, PATIENCE, options.start)
    if options.agent is not None:
        return BrokerConnection(broker_of(options), options.scope, options.agent, PATIENCE, options.start)
    return SocketConnection(options.url, PATIENCE, options.start)


async def _print_table(outcomes: AsyncIterator[Outcome]) -> Counter[Verdict]:
    """Print a row for each case as it completes, followed by its failed assertions."""
    verdicts: Counter[Verdict] = Counter()
    async for outcome in outcomes:
        verdicts[outcome.verdict] += 1
        print(f"{outcome.verdict:<12}{outcome.case.name:<22}{outcome.case.title}", flush=True)
        for problem in outcome.problems:
            print(f"{'':<12}  {problem}")
    print(", ".join(f"{verdicts[verdict]} {verdict}" for verdict in Verdict))
    return verdicts


async def _print_json(realizer: str, outcomes: AsyncIterator[Outcome]) -> Counter[Verdict]:
    all_ = [outcome async for outcome in outcomes]
    verdicts = Counter(outcome.verdict for outcome in all_)
    numbers = {str(verdict): verdicts[verdict] for verdict in Verdict}
    print(json.dumps({"realizer": realizer, **numbers, "cases": list(map(_as_json, all_))}, indent=1))
    return verdicts


def _as_json(outcome: Outcome) -> Mapping[str, object]:
    return {
        "name": outcome.case.name,
        "title": outcome.case.title,
        "verdict": outcome.verdict,
        "checks": outcome.checks,
        "problems": outcome.problems,
    }
