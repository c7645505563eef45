"""Runs cases against a realizer, one after the other."""

from collections.abc import AsyncIterator, Collection, Iterable
from dataclasses import dataclass
from enum import StrEnum
from itertools import count
from typing import Final

from reactive_realizer.bml.names import BML
from reactive_realizer.conformance.case import Check, ConformanceCase, Profile
from reactive_realizer.conformance.connection import Connection
from reactive_realizer.conformance.derive import checks_of

PATIENCE: Final = 20.0
"""Time limit for every answer, s; no case takes half of it."""

TOLERANCE: Final = 0.01
"""Tolerance of times, s: one tick at 100 Hz."""

_UNSUPPORTED: Final = (
    "BEHAVIOR_TYPE_NOT_SUPPORTED",
    "CUSTOM_BEHAVIOUR_NOT_SUPPORTED",
    "CUSTOM_ATTRIBUTE_NOT_SUPPORTED",
)

_UNANSWERED: Final = "a message with a ref was not answered"


class Verdict(StrEnum):
    """The result of a case.

    It is UNSUPPORTED if the realizer warned that it does not support part of it, or if it cannot be tried over the
    connection.
    """

    PASSED = "passed"
    FAILED = "failed"
    UNSUPPORTED = "unsupported"


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of a case.

    Attributes:
        checks: number of assertions.
        problems: assertions that do not hold, or unsupported parts.
    """

    case: ConformanceCase
    verdict: Verdict
    checks: int
    problems: tuple[str, ...]


async def run_suite(
    connection: Connection,
    cases: Iterable[ConformanceCase],
    profiles: Collection[Profile] = tuple(Profile),
    tolerance: float = TOLERANCE,
) -> AsyncIterator[Outcome]:
    """Runs cases, and ends all blocks after each.

    Args:
        connection: to the realizer, not yet entered.
        cases: to run.
        profiles: which assertions count, besides those of BML 1.0.
        tolerance: of times, s.

    Raises:
        RealizerError: the realizer is not reached or stops responding, or the connection is lost.
    """
    async with connection as client:
        runner = _Runner(client, {*profiles, Profile.BML}, tolerance)
        await runner.stop()
        for case in cases:
            yield await runner.run(case)


class _Runner:
    def __init__(self, client: Connection, profiles: Collection[Profile], tolerance: float) -> None:
        self._client = client
        self._profiles = profiles
        self._tolerance = tolerance
        self._stops = count(1)

    async def run(self, case: ConformanceCase) -> Outcome:
        if (reason := self._client.unfit.get(case.name)) is not None:
            return Outcome(case, Verdict.UNSUPPORTED, 0, (reason,))
        checks, problems = 0, []
        for part in case.parts:
            self._client.forget()
            waited = await self._play(part)
            if part.then is None or waited:
                waited += await self.stop()
            unknown = self._unsupported(part)
            if unknown:
                return Outcome(case, Verdict.UNSUPPORTED, 0, unknown)
            asserted = [check for check in checks_of(part) if check.profile in self._profiles]
            checks += len(asserted)
            problems += [*self._client.mistakes, *waited, *self._failed(asserted)]
            if waited:
                break
        return Outcome(case, Verdict.FAILED if problems else Verdict.PASSED, checks, tuple(problems))

    def _unsupported(self, case: ConformanceCase) -> tuple[str, ...]:
        """What the realizer warned that it does not support, if the case does not expect that."""
        warnings = self._client.feedback.warnings
        if {(warning.id, warning.type) for warning in case.warnings}.intersection(warnings):
            return ()
        return tuple(f"{id_}: {type_}" for id_, type_ in warnings if type_ in _UNSUPPORTED)

    def _failed(self, checks: Iterable[Check]) -> list[str]:
        found = (check.problem(self._client.feedback, self._tolerance) for check in checks)
        return [problem for problem in found if problem is not None]

    async def stop(self) -> list[str]:
        """Ends all blocks; returns the problems."""
        id_ = f"conformance-stop-{next(self._stops)}"
        if not await self._client.send(f'<bml xmlns="{BML}" id="{id_}" composition="REPLACE"/>'):
            self._client.check_alive()
            return [_UNANSWERED]
        missed = await self._wait([f"{id_}:end"])
        if missed:
            self._client.check_alive()
        return missed

    async def _play(self, case: ConformanceCase) -> list[str]:
        """Sends the documents of a case and waits for its end; returns the messages that did not arrive in time."""
        for send in case.sends:
            missed = await self._wait([send.after] if send.after else [])
            if missed:
                return missed
            if not await self._client.send(send.xml):
                return [_UNANSWERED]
        ending = [block.id for block in case.blocks if case.starts(block) or Profile.STATUS in self._profiles]
        return await self._wait([f"{id_}:end" for id_ in ending], len(case.warnings))

    async def _wait(self, points: list[str], warnings: int = 0) -> list[str]:
        client = self._client

        def missing() -> list[str]:
            return [point for point in points if not client.feedback.reached(point)]

        if await client.until(lambda: not missing() and len(client.feedback.warnings) >= warnings):
            return []
        return [f"{point} was not reported in time" for point in missing()]
