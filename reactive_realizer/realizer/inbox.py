"""The inbox: inputs wait for their tick; predictions, events and targets are applied from here."""

import logging
from collections.abc import Callable, Sequence

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.world import World
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.peg_key import anticipator_key
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.realizer.inputs import BmlText, Event, Input, Prediction, TargetMoved

logger = logging.getLogger(__name__)


class TooManyNames(Fault):
    """More names than the limit allows."""

    code = "too-many-names"
    template = "the limit of {limit} {things} has been reached"
    limit: int
    things: str


class Inbox:
    """The inputs that wait for their tick.

    Args:
        board: of the anticipators.
        anticipators: by id; the first prediction for an unknown id adds one.
        world: of the targets.
        limits: for the numbers of predicted points and anticipators.
    """

    def __init__(self, board: PegBoard, anticipators: dict[str, Anticipator], world: World, limits: Limits) -> None:
        self._board = board
        self._anticipators = anticipators
        self._world = world
        self._limits = limits
        self._waiting: list[tuple[GlobalTime, int, Input]] = []
        self._put = 0

    def __bool__(self) -> bool:
        return bool(self._waiting)

    def put(self, entry: Input, at: GlobalTime) -> None:
        """Add an input, which enters at a time, after all earlier inputs."""
        self._put += 1
        self._waiting.append((at, self._put, entry))

    @property
    def waiting(self) -> list[Input]:
        """The inputs that have not entered yet, in the order in which they were put."""
        return [entry for _, _, entry in self._waiting]

    def check_prediction(self, anticipator: str, sync: str, now: GlobalTime) -> None:
        """Check whether a prediction of a point can enter after all waiting inputs.

        Raises:
            RealizerError: "predicts-itself", or "too-many-names" if there would be too many points or anticipators.
        """
        if anticipator in self._anticipators:
            self._anticipators[anticipator].check_prediction()
        key, limit = anticipator_key(anticipator, sync), self._limits.predicted_points
        if self._board.get(key) is not None:
            return
        waiting = {
            anticipator_key(each.anticipator, each.sync) for each in self.waiting if isinstance(each, Prediction)
        }
        new = {each for each in (key, *waiting) if self._board.get(each) is None}
        points = len(self._board.predicted_points) + len(new)
        if points > limit and points - len(set(self._board.spent_points(now)) - waiting) > limit:
            raise RealizerError(TooManyNames(limit=limit, things="predicted points"))
        if len(self._anticipators.keys() | {each.behavior for each in new}) > max(limit, len(self._anticipators)):
            raise RealizerError(TooManyNames(limit=limit, things="anticipators"))

    def take(self, now: GlobalTime) -> tuple[Input, ...]:
        """Remove and return the inputs whose time has come, in order."""
        due = [entry for at, _, entry in sorted(self._waiting, key=lambda each: each[:2]) if is_due(at, now)]
        self._waiting = [waiting for waiting in self._waiting if not is_due(waiting[0], now)]
        return tuple(due)

    def apply(self, entries: Sequence[Input], now: GlobalTime) -> None:
        """Advance the anticipators, give them predictions and events, and move targets; BML is ignored here."""
        with self._board.graph.transaction("inputs"):
            for anticipator in self._anticipators.values():
                _try(anticipator.id, anticipator.advance, now)
            for entry in entries:
                _try(entry, self._apply, entry, now)

    def _apply(self, entry: Input, now: GlobalTime) -> None:
        match entry:
            case Prediction(anticipator, sync, time):
                self._anticipator(anticipator).check_prediction()
                self._make_room(anticipator, sync, now)
                self._anticipator(anticipator).predict(sync, time, now)
            case Event(anticipator):
                _deliver_event(self._anticipator(anticipator), entry, now)
            case TargetMoved(target, position):
                self._world.move(target, position)
            case BmlText():
                pass

    def _make_room(self, anticipator: str, sync: str, now: GlobalTime) -> None:
        """Make the board forget spent points, if a new one would exceed the limit."""
        if self._board.get(anticipator_key(anticipator, sync)) is not None:
            return
        excess = len(self._board.predicted_points) + 1 - self._limits.predicted_points
        if excess > 0:
            for key in self._board.spent_points(now)[:excess]:
                self._board.forget_point(key)

    def _anticipator(self, name: str) -> Anticipator:
        if name not in self._anticipators:
            self._anticipators[name] = Anticipator(name, self._board)
        return self._anticipators[name]


def _try(what: object, act: Callable[..., None], *arguments: object) -> None:
    """Apply an input, or skip it with a log message if it fails."""
    try:
        act(*arguments)
    except RealizerError as problem:
        logger.warning("%s is skipped: %s", what, problem)
    except Exception:
        logger.exception("%s is skipped", what)


def _deliver_event(anticipator: Anticipator, event: Event, now: GlobalTime) -> None:
    if event.text is None:
        anticipator.check(event.name, event.value)
        anticipator.event(event.name, event.value, now)
    else:
        anticipator.check_heard(event.name)
        anticipator.hear(event.name, event.text, now)
