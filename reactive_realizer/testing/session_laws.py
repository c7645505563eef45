"""What holds in any session, whatever is sent: laws of its feedback, of its log, and of the blocks left at its end."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.clock.ticker import RATE
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import BlockProgress, PredictionFeedback, SyncPointProgress, WarningFeedback
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.timing import OPEN
from reactive_realizer.realizer import verifier
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
        self._predicted: dict[BlockKey, list[tuple[GlobalTime, PredictionFeedback]]] = {}
        """The last prediction of each block, and those before it in the same tick: an id may be used again in it."""

    def __call__(self, report: Report) -> None:
        """Check a report."""
        message, now = report.message, report.time
        if isinstance(message, PredictionFeedback):
            for each in message.behaviors:
                if early := [sync for sync, time in each.times.items() if time < 0.0]:
                    self.note("before_block", now, f"{message.block}:{each.behavior.id}:{early[0]} is predicted")
            key = BlockKey(message.character, message.block)
            self._predicted[key] = [*(each for each in self._predicted.get(key, ()) if each[0] == now), (now, message)]
        elif isinstance(message, BlockProgress):
            self._check_time(now, message, f"{message.block}:{message.sync}")
            self._check_block(now, message)
        elif isinstance(message, SyncPointProgress):
            self._check_time(now, message, f"{message.block}:{message.behavior}:{message.sync}")
            self._check_point(now, message)
        elif isinstance(message, WarningFeedback) and "; thesis " in message.text:
            self.note("equation", now, f"{message.id}: {message.text}")

    def note(self, law: str, time: float, text: str) -> None:
        """Note a breach."""
        self.breaches.append(Breach(law, time, text))

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
            self.ended += 1

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
        may_be_cut = progress.sync in OPEN
        if not times and not may_be_cut:
            self.note("prediction", now, f"{name} was not predicted")
        elif times and not any(
            abs(progress.time - time) <= _TICK + _ROUNDING or (may_be_cut and progress.time < time) for time in times
        ):
            self.note("prediction", now, f"{name} at {progress.time:g} was predicted at {times[-1]:g}")


def _predicted_time(prediction: PredictionFeedback, progress: BlockProgress | SyncPointProgress) -> float | None:
    """The global time (s) that a prediction has for a point; None if it has none, or for a block's own points."""
    if isinstance(progress, BlockProgress):
        return {"start": prediction.start, "end": prediction.end}.get(progress.sync)
    behaviors = (each for each in prediction.behaviors if each.behavior.id == progress.behavior)
    local = next((each.times.get(progress.sync) for each in behaviors), None)
    return None if local is None else prediction.start + local


async def examine(session: Session, strategy: str) -> SessionLaws:
    """Play a session without frames, until nothing can happen any more, and check the laws."""
    laws = SessionLaws()
    with _human_file() as human, _logged_errors(laws):
        async with open_pilot(SceneOptions(human, "text", strategy=strategy, verify=True)) as pilot:
            pilot.realizer.feedback.listen(laws)
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
    await pilot.advance(0.02)
    for each in scheduler.blocks.alive:
        laws.note("endless", pilot.now, f"{each.key.block} outlives a REPLACE")


@contextmanager
def _human_file() -> Iterator[Path]:
    with TemporaryDirectory() as folder:
        human = Path(folder, "three.toml")
        human.write_text(HUMAN, encoding="utf-8")
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
