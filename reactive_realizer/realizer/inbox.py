"""The inbox: inputs wait for their tick, where events go to anticipators, and targets are moved."""

import logging
from collections.abc import Callable, Collection, Sequence
from math import hypot, isclose, isfinite
from typing import Final, ParamSpec, TypeVar

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.audio import AudioHeard, StreamedAudio
from reactive_realizer.embodiment.world import World
from reactive_realizer.engine.guarded_engine import FAILURES
from reactive_realizer.errors import Fault, NotANumber, RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorEvent, Remote
from reactive_realizer.pegboard.peg_key import PegKey, anticipator_key
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.realizer.anticipator_streams import AnticipatorStreams
from reactive_realizer.realizer.inputs import BmlText, Event, Input, Prediction, Push, TargetMoved
from reactive_realizer.realizer.prediction_turns import PredictionTurns, Waiting

P = ParamSpec("P")
T = TypeVar("T")

_UNIT: Final = 1e-6
"""Difference of the length of an orientation from 1."""

logger = logging.getLogger(__name__)


class TooManyNames(Fault):
    """More names than the limit allows."""

    code = "too-many-names"
    template = "the limit of {limit} {things} has been reached"
    limit: int
    things: str


class NotAnOrientation(Fault):
    """A quaternion that is not of length 1."""

    code = "not-an-orientation"
    template = "an orientation is a quaternion of length 1, not {length:g}"
    length: float


class Inbox:
    """The inputs that wait for their tick.

    Args:
        board: of the anticipators.
        streams: of the anticipators; the first prediction for an unknown id adds one.
        world: of the targets.
        limits: for the numbers of predicted points and anticipators.
    """

    def __init__(self, board: PegBoard, streams: AnticipatorStreams, world: World, limits: Limits) -> None:
        self._board = board
        self._streams = streams
        self._world = world
        self._limits = limits
        self._waiting: list[Waiting] = []
        self._put = 0
        self._turns = PredictionTurns(board.followers)
        self._waiting_points: set[PegKey] = set()
        """Points of the predictions that wait."""
        self._new_points: set[PegKey] = set()
        """Those of them that are not on the board."""
        self._remotes: set[str] = set()
        """The anticipators that clients have named."""
        self._unneeded: tuple[GlobalTime, frozenset[PegKey]] = (GlobalTime(-1.0), frozenset())

    def __bool__(self) -> bool:
        return bool(self._waiting)

    def put(self, entry: Input, at: GlobalTime) -> None:
        """Add an input, which enters at a time, after all earlier inputs."""
        self._put += 1
        self._waiting.append((at, self._put, entry))
        if isinstance(entry, Prediction):
            self._note(entry)

    @property
    def waiting(self) -> list[Input]:
        """The inputs that have not entered yet, in the order in which they were put."""
        return [entry for _, _, entry in self._waiting]

    def check_prediction(self, anticipator: str, sync: str, now: GlobalTime) -> None:
        """Check whether a prediction of a point can enter after all waiting inputs.

        Raises:
            RealizerError: "predicts-itself", "unknown-point", or "too-many-names" if there would be too many points
                that are needed.
        """
        if anticipator in self._board.anticipators:
            self._board.anticipators[anticipator].check_prediction(sync)
        key, limit = anticipator_key(anticipator, sync), self._limits.predicted_points
        if self._board.get(key) is not None or key in self._new_points:
            return
        points = len(self._board.predicted_points) + len(self._new_points) + 1
        if points <= limit:
            return
        unneeded = self._unneeded_points(now)
        if points - len(unneeded) + len(unneeded & self._waiting_points) > limit:
            raise RealizerError(TooManyNames(limit=limit, things="predicted points"))

    def take(self, now: GlobalTime) -> tuple[Input, ...]:
        """Remove and return the inputs whose time has come, in order, without predictions that wait for their turn."""
        due = sorted((each for each in self._waiting if is_due(each[0], now)), key=lambda each: each[:2])
        entering, held = self._turns.choose(due, now)
        self._waiting = [*held, *(each for each in self._waiting if not is_due(each[0], now))]
        self._waiting_points, self._new_points = set(), set()
        for entry in self.waiting:
            if isinstance(entry, Prediction):
                self._note(entry)
        return tuple(entering)

    def deliver(self, entries: Sequence[Input], now: GlobalTime) -> list[tuple[str, AnticipatorEvent]]:
        """The events and predictions of clients as events for anticipators, by id; invalid ones are skipped."""
        if len(self._remotes) >= self._limits.predicted_points:
            self._give_back({each.anticipator for each in entries if isinstance(each, Prediction)})
        events = (_try(entry, self._event, entry, now) for entry in entries)
        return [event for event in events if event is not None]

    def apply(self, entries: Sequence[Input]) -> None:
        """Move targets; invalid places are skipped."""
        for entry in entries:
            if isinstance(entry, TargetMoved):
                _try(entry, self._move, entry)

    def _move(self, moved: TargetMoved) -> None:
        numbers = (*(moved.position or ()), *(moved.orientation or ()))
        if not all(map(isfinite, numbers)):
            raise RealizerError(NotANumber())
        if moved.orientation is not None and not isclose(hypot(*moved.orientation), 1.0, abs_tol=_UNIT):
            raise RealizerError(NotAnOrientation(length=hypot(*moved.orientation)))
        self._world.move(moved.target, moved.position, moved.orientation)

    def _event(self, entry: Input, now: GlobalTime) -> tuple[str, AnticipatorEvent] | None:
        match entry:
            case Prediction(id_, sync, time):
                if time is not None and not isfinite(time):
                    raise RealizerError(NotANumber())
                self._anticipator(id_).check_prediction(sync)
                return id_, AnticipatorEvent(sync, time, None, now)
            case Event(id_, name, value, None):
                self._anticipator(id_).check(name, value)
                return id_, AnticipatorEvent(name, value, None, now)
            case Event(id_, name, value, text):
                self._anticipator(id_).check_heard(name)
                return id_, AnticipatorEvent(name, value, text, now)
            case BmlText() | TargetMoved() | AudioHeard() | Push() | StreamedAudio():
                return None

    def _anticipator(self, id_: str) -> Anticipator:
        if id_ not in self._board.anticipators:
            self._remotes.add(id_)
            self._streams.add(Remote(self._streams.context(id_)))
        return self._board.anticipators[id_]

    def _note(self, prediction: Prediction) -> None:
        """Note the point of a prediction that waits."""
        key = anticipator_key(prediction.anticipator, prediction.sync)
        self._waiting_points.add(key)
        if self._board.get(key) is None:
            self._new_points.add(key)

    def _unneeded_points(self, now: GlobalTime) -> frozenset[PegKey]:
        """The points that may be forgotten; there are many to look at, and they change only in ticks."""
        if self._unneeded[0] != now:
            self._unneeded = (now, frozenset(self._board.unneeded_points(now)))
        return self._unneeded[1]

    def _give_back(self, predicted: Collection[str]) -> None:
        """Remove the anticipators of clients that have no points any more, except those that are predicted now."""
        kept = {*predicted, *(key.behavior for key in self._board.predicted_points)}
        for id_ in self._remotes - kept:
            self._streams.remove(id_)
        self._remotes &= kept


def _try(what: object, act: Callable[P, T], *arguments: P.args, **named: P.kwargs) -> T | None:
    """The result for an input; None, with a log message, if it fails."""
    try:
        return act(*arguments, **named)
    except RealizerError as problem:
        logger.warning("%s is skipped: %s", what, problem)
    except FAILURES:
        logger.exception("%s is skipped", what)
    return None
