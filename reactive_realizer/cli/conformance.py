"""The command ``conformance``: tests whether a realizer conforms to BML, over its socket."""

import argparse
import asyncio
import json
from collections import Counter
from collections.abc import AsyncIterator, Mapping

from reactive_realizer.conformance.case import read_suite
from reactive_realizer.conformance.suite import Outcome, Verdict, run_suite


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``conformance``."""
    names = [case.name for case in read_suite()]
    parser.description = (
        "Runs a suite of BML scripts against a server and reports every failed assertion. Everything that plays on the "
        "server is stopped."
    )
    parser.epilog = "example: reactive-realizer conformance http://127.0.0.1:8088 --case append --case replace"
    parser.add_argument("url", metavar="URL", help="the address of the server, http://127.0.0.1:8088")
    parser.add_argument("--json", action="store_true", help="print a JSON object instead of a table")
    parser.add_argument(
        "--case", action="append", choices=names, metavar="NAME", help=f"run only this case: {', '.join(names)}"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 1 if a case failed. If no realizer is reached, an error is raised."""
    return asyncio.run(_run(options))


async def _run(options: argparse.Namespace) -> int:
    cases = [case for case in read_suite() if not options.case or case.name in options.case]
    outcomes = run_suite(options.url, cases)
    verdicts = await (_print_json(options.url, outcomes) if options.json else _print_table(outcomes))
    return 1 if verdicts[Verdict.FAILED] else 0


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


async def _print_json(url: str, outcomes: AsyncIterator[Outcome]) -> Counter[Verdict]:
    all_ = [outcome async for outcome in outcomes]
    verdicts = Counter(outcome.verdict for outcome in all_)
    numbers = {str(verdict): verdicts[verdict] for verdict in Verdict}
    print(json.dumps({"url": url, **numbers, "cases": list(map(_as_json, all_))}, indent=1))
    return verdicts


def _as_json(outcome: Outcome) -> Mapping[str, object]:
    return {
        "name": outcome.case.name,
        "title": outcome.case.title,
        "verdict": outcome.verdict,
        "checks": outcome.checks,
        "problems": outcome.problems,
    }
