"""What holds in any session, whatever is sent: laws of its feedback, of its log, and of the blocks left at its end."""

import logging
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.clock.ticker import RATE
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import BlockProgress, PredictionFeedback, SyncPointProgress, WarningFeedback
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.timing import OPEN, SHORTEST, PhaseKind
from reactive_realizer.realizer import verifier
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot
from reactive_realizer.testing.random_session import HUMAN, Session

LAWS = {
    "order": "a block reports its start, its sync points, each once and in order, and its end",
    "before_block": "no sync point comes before its block, nor is it predicted to",
    "past": "nothing is reported more than a tick late, or early",
    "prediction": "each point comes where it was last predicted; a behavior or block that is cut ends earlier",
    "equation": "the equations of the thesis hold",
    "unnamed": "a block that cannot progress names what it waits for",
    "endless": "a session comes to rest",
    "escape": "no exception, and no error in the log",
}
"""The laws by name."""

_TICK, _ROUNDING = 1.0 / RATE, 2e-6
_LONGEST = 120.0
"""Time after the last input in which a session comes to rest, s."""

_SLOWEST_TICKS = 200
"""Ticks in which a REPLACE of each character is planned, however little is planned in each."""


class Breach(NamedTuple):
    """A law that was broken, at a time of the realizer, s."""

    law: str
    time: float
    text: str


class _Told(NamedTuple):
    """What a block has told since it started: its points, and the last time of each behavior."""

    start: float
    points: set[tuple[str, str]]
    last: dict[str, float]


class SessionLaws:
    """Checks the laws of feedback as it comes.

    Attributes:
        breaches: in order.
        ended: number of blocks that ended.
        tick: time that the present tick covers, s.
    """

    def __init__(self) -> None:
        self.breaches: list[Breach] = []
        self.ended = 0
        self.tick = _TICK
        self._playing: dict[BlockKey, _Told] = {}
        self._early: defaultdict[BlockKey, dict[tuple[str, str], str]] = defaultdict(dict)
        """What came earlier than predicted, or without a prediction, and is allowed if it was cut."""
        self._whole: defaultdict[BlockKey, list[set[tuple[str, str]]]] = defaultdict(list)
        """The points that were not cut, of blocks that have ended and have not told it: an id may be used again."""
        self._predicted: dict[BlockKey, list[tuple[GlobalTime, PredictionFeedback]]] = {}
        """The last prediction of each block, and those before it in the same tick: an id may be used again in it.

        While a block plays, the first one is the last of this block; others may be of the next block with its id.
        """

    def __call__(self, report: Report) -> None:
        """Check a report."""
        message, now = report.message, report.time
        if isinstance(message, PredictionFeedback):
            for each in message.behaviors:
                if early := [sync for sync, time in each.times.items() if time < 0.0]:
                    self.note("before_block", now, f"{message.block}:{each.behavior.id}:{early[0]} is predicted")
            self._note_prediction(now, message)
        elif isinstance(message, BlockProgress):
            self._check_time(now, message, f"{message.block}:{message.sync}")
            self._check_block(now, message)
        elif isinstance(message, SyncPointProgress):
            self._check_time(now, message, f"{message.block}:{message.behavior}:{message.sync}")
            self._check_point(now, message)
        elif isinstance(message, WarningFeedback) and "; thesis " in message.text:
            self.note("equation", now, f"{message.id}: {message.text}")

    def check_units(self, block: BMLBlock) -> None:
        """Check the durations of the behaviors of a block that ended, and which of its points were cut."""
        now = GlobalTime(0.0) if block.end.value is None else block.end.value
        points = ((unit.behavior.id, point) for unit in block.units for point in unit.points)
        self._whole[block.key].append({(id_, point.id) for id_, point in points if not point.cut})
        for unit in block.units:
            if all(point.fired and not point.cut for point in unit.points):
                for text in _wrong_durations(unit):
                    self.note("equation", now, f"{block.key.block}: {text}")

    def note(self, law: str, time: float, text: str) -> None:
        """Note a breach."""
        self.breaches.append(Breach(law, time, text))

    def _note_prediction(self, now: GlobalTime, message: PredictionFeedback) -> None:
        key = BlockKey(message.character, message.block)
        playing = self._playing.get(key)
        of_next = playing is not None and abs(message.start - playing.start) > _ROUNDING
        kept = (each for each in self._predicted.get(key, ()) if of_next or each[0] == now)
        self._predicted[key] = [*kept, (now, message)]

    def _check_time(self, now: GlobalTime, progress: BlockProgress | SyncPointProgress, name: str) -> None:
        if not now - self.tick - _ROUNDING <= progress.time <= now + _ROUNDING:
            self.note("past", now, f"{name} is told at {now:g} to have come at {progress.time:g}")

    def _check_block(self, now: GlobalTime, progress: BlockProgress) -> None:
        key = BlockKey(progress.character, progress.block)
        told = self._playing.get(key)
        name = f"{progress.block}:{progress.sync}"
        never = progress.sync == "end" and progress.status in ("REVOKED", "FAILED")
        if (told is None) is not (progress.sync == "start") and not (told is None and never):
            self.note("order", now, f"{name} of a block that plays, or does not")
        if progress.sync == "start":
            told = self._playing[key] = _Told(progress.time, set(), {})
        if told is not None:
            self._check_once(now, told, "", progress.sync, name)
            if progress.sync == "start" or (progress.sync == "end" and progress.status == "DONE"):
                self._check_prediction(now, progress, name)
        if progress.sync == "end":
            self._playing.pop(key, None)
            self._check_early(now, key)
            self.ended += 1

    def _check_early(self, now: GlobalTime, key: BlockKey) -> None:
        """Only what was cut may have come early."""
        early, whole = self._early.pop(key, {}), self._whole[key]
        for point in sorted(early.keys() & (whole.pop(0) if whole else set[tuple[str, str]]())):
            self.note("prediction", now, early[point])

    def _check_point(self, now: GlobalTime, progress: SyncPointProgress) -> None:
        key = BlockKey(progress.character, progress.block)
        name = f"{progress.block}:{progress.behavior}:{progress.sync}"
        told = self._playing.get(key)
        if told is None:
            self.note("order", now, f"{name} outside of its block")
            return
        self._check_once(now, told, progress.behavior, progress.sync, name)
        if progress.time < told.last.get(progress.behavior, progress.time) - _ROUNDING:
            self.note("order", now, f"{name} at {progress.time:g} before the point that was reported before it")
        told.last[progress.behavior] = progress.time
        if progress.time < told.start - _ROUNDING:
            self.note("before_block", now, f"{name} at {progress.time:g} before {told.start:g}")
        self._check_prediction(now, progress, name)

    def _check_once(self, now: GlobalTime, told: _Told, behavior: str, sync: str, name: str) -> None:
        if (behavior, sync) in told.points:
            self.note("order", now, f"{name} twice")
        told.points.add((behavior, sync))

    def _check_prediction(self, now: GlobalTime, progress: BlockProgress | SyncPointProgress, name: str) -> None:
        predictions = self._predicted.get(BlockKey(progress.character, progress.block), ())
        times = [time for _, each in predictions if (time := _predicted_time(each, progress)) is not None]
        if any(abs(progress.time - time) <= _TICK + _ROUNDING for time in times):
            return
        text = f"{name} at {progress.time:g} was predicted at {times[-1]:g}" if times else f"{name} was not predicted"
        if progress.sync not in OPEN or any(progress.time > time for time in times):
            self.note("prediction", now, text)
        elif isinstance(progress, SyncPointProgress):
            self._early[BlockKey(progress.character, progress.block)][progress.behavior, progress.sync] = text


def _predicted_time(prediction: PredictionFeedback, progress: BlockProgress | SyncPointProgress) -> float | None:
    """The global time (s) that a prediction has for a point; None if it has none, or for a block's own points."""
    if isinstance(progress, BlockProgress):
        return {"start": prediction.start, "end": prediction.end}.get(progress.sync)
    behaviors = (each for each in prediction.behaviors if each.behavior.id == progress.behavior)
    local = next((each.times.get(progress.sync) for each in behaviors), None)
    return None if local is None else prediction.start + local


def _wrong_durations(unit: PlanUnit) -> Iterator[str]:
    """The durations of a behavior that has ended which break the equations 7.14, 7.15 or 7.1.4 of the thesis."""
    if unit.timing.waits:
        return
    timing, id_ = unit.timing.closed, unit.behavior.id
    times = [point.peg.value or GlobalTime(0.0) for point in unit.points]
    # A wait that has begun ends at once if the time that ends it moves to its start.
    timed = not timing.instant and not isinstance(unit.behavior, Wait)
    if timed and times[-1] - times[0] < SHORTEST - _ROUNDING:
        yield f"{id_} took no time"
    for point, phase, (time, after) in zip(unit.points, timing.phases, pairwise(times), strict=False):
        took = after - time
        if took < -_ROUNDING:
            yield f"{id_}:{point.id} came at {time:g}, after the next point at {after:g}"
        if phase.kind is PhaseKind.RIGID and abs(took - phase.duration) > _ROUNDING:
            yield f"{id_} took {took:g} s from {point.id}, not {phase.duration:g} s, although it is rigid"


async def examine(session: Session, strategy: str) -> SessionLaws:
    """Play a session without frames, until nothing can happen any more, and check the laws."""
    laws = SessionLaws()
    with _human_file(session) as human, _logged_errors(laws):
        async with open_pilot(SceneOptions(human, "text", strategy=strategy, verify=True)) as pilot:
            pilot.realizer.feedback.listen(laws)
            pilot.realizer.scheduler.listen(laws.check_units)
            try:
                for step in session.steps:
                    await pilot.advance(step.pause)
                    step.input.send(pilot)
                    if step.left_out:
                        laws.tick = (step.left_out + 1) * _TICK
                        pilot.skip(step.left_out)
                        await pilot.tick()
                        laws.tick = _TICK
                await _rest(pilot, laws)
            except Exception as escaped:
                logging.getLogger(__name__).exception("escaped")
                laws.note("escape", pilot.now, repr(escaped))
    return laws


async def _rest(pilot: RealizerPilot, laws: SessionLaws) -> None:
    """Play until nothing can happen any more, then end what is left."""
    scheduler = pilot.realizer.scheduler
    last = pilot.now + _LONGEST
    await pilot.tick()
    while not scheduler.stuck(pilot.realizer.time):
        if pilot.now > last:
            laws.note("endless", pilot.now, ", ".join(each.key.block for each in scheduler.blocks.alive))
            break
        await pilot.tick()
    else:
        for each in scheduler.blocks.alive:
            if not each.awaited:
                laws.note("unnamed", pilot.now, f"{each.key.block} is {each.state.value}")
    for character in pilot.realizer.characters:
        pilot.block("last", characterId=character, composition="REPLACE")
    await pilot.tick()
    for _ in range(_SLOWEST_TICKS):
        if scheduler.blocks.alive or scheduler.entering:
            await pilot.tick()
    for each in scheduler.blocks.alive:
        laws.note("endless", pilot.now, f"{each.key.block} outlives a REPLACE")


@contextmanager
def _human_file(session: Session) -> Iterator[Path]:
    with TemporaryDirectory() as folder:
        human = Path(folder, "three.toml")
        human.write_text(f"{HUMAN}[limits]\nplanning_per_tick = {session.planning}\n", encoding="utf-8")
        yield human


@contextmanager
def _logged_errors(laws: SessionLaws) -> Iterator[None]:
    """Note errors in the log, except for those that the verifier reports as warnings too; nothing else is logged."""

    class Handler(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            if record.name not in (verifier.__name__, __name__):
                laws.note("escape", 0.0, record.getMessage())

    handler, root = Handler(logging.ERROR), logging.getLogger("reactive_realizer")
    propagate, root.propagate = root.propagate, False
    root.addHandler(handler)
    try:
        yield
    finally:
        root.removeHandler(handler)
        root.propagate = propagate
