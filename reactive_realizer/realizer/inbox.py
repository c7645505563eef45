"""What is still to enter, and what comes of that which says when things are to be, and where."""

import logging
from collections.abc import Callable, Sequence

from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.world import World
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.realizer.inputs import BmlText, Event, Input, Prediction, TargetMoved

logger = logging.getLogger(__name__)


class Inbox:
    """Inputs wait here for their tick.

    Args:
        board: which anticipators write.
        anticipators: by id; the first prediction of one that is not there makes it.
        world: which targets move in.
    """

    def __init__(self, board: PegBoard, anticipators: dict[str, Anticipator], world: World) -> None:
        self._board = board
        self._anticipators = anticipators
        self._world = world
        self._waiting: list[tuple[GlobalTime, int, Input]] = []
        self._put = 0

    def __bool__(self) -> bool:
        return bool(self._waiting)

    def put(self, entry: Input, at: GlobalTime) -> None:
        """Have an input wait for a time, after all that was put before."""
        self._put += 1
        self._waiting.append((at, self._put, entry))

    def take(self, now: GlobalTime) -> tuple[Input, ...]:
        """Those whose time has come, in order."""
        due = [entry for at, _, entry in sorted(self._waiting, key=lambda each: each[:2]) if is_due(at, now)]
        self._waiting = [waiting for waiting in self._waiting if not is_due(waiting[0], now)]
        return tuple(due)

    def apply(self, entries: Sequence[Input], now: GlobalTime) -> None:
        """Let anticipators know the time, and what was said to them; move targets. BML is not read here."""
        with self._board.graph.transaction("inputs"):
            for anticipator in self._anticipators.values():
                _try(anticipator.id, anticipator.advance, now)
            for entry in entries:
                _try(entry, self._apply, entry, now)

    def _apply(self, entry: Input, now: GlobalTime) -> None:
        match entry:
            case Prediction(anticipator, sync, time):
                self._anticipator(anticipator).check_prediction()
                self._anticipator(anticipator).predict(sync, time, now)
            case Event(anticipator):
                _tell(self._anticipator(anticipator), entry, now)
            case TargetMoved(target, position):
                self._world.move(target, position)
            case BmlText():
                pass

    def _anticipator(self, name: str) -> Anticipator:
        if name not in self._anticipators:
            self._anticipators[name] = Anticipator(name, self._board)
        return self._anticipators[name]


def _try(what: object, act: Callable[..., None], *arguments: object) -> None:
    """Whoever brings an input may check it first; one that cannot be is left out, and all else goes on."""
    try:
        act(*arguments)
    except RealizerError as problem:
        logger.warning("%s is left out: %s", what, problem)
    except Exception:
        logger.exception("%s is left out", what)


def _tell(anticipator: Anticipator, event: Event, now: GlobalTime) -> None:
    if event.text is None:
        anticipator.check(event.name, event.value)
        anticipator.event(event.name, event.value, now)
    else:
        anticipator.check_heard(event.name)
        anticipator.hear(event.name, event.text, now)
