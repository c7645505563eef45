"""Autonomous behaviors of a character of one's own: what it does by itself, periodically, at random, or at an event.

After the character files of EMBR: A. Heloir and M. Kipp, "Real-time animation of interactive agents: specification and
realization" (Applied Artificial Intelligence 24, 2010).
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from random import Random
from typing import Final
from xml.sax.saxutils import quoteattr

from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import ANTICIPATORS, BML, BMLT, OWN
from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.scheduler.bml_block import BMLBlock
from reactive_realizer.scheduler.bml_scheduler import BMLScheduler

_SPREAD: Final = 0.5
"""By which share of their mean the times of random behaviors are shorter or longer at most."""

_PAUSE: Final = 1.0
"""Time after which a behavior that waits for an event is sent again at the earliest, s: its block may fail."""


class Trigger(StrEnum):
    """What triggers an autonomous behavior."""

    PERIODIC = "periodic"
    RANDOM = "random"
    EVENT = "event"


@dataclass(frozen=True, slots=True)
class AutonomousBehavior:
    """``[character.ID.autonomous.NAME]``.

    Attributes:
        behavior: one or more behaviors of BML 1.0, as XML.
        trigger: a word of `Trigger`.
        every: time from one to the next, s; the mean, if it is random; without effect, if it waits for an event.
        event: anticipator and point, such as ``partner:nod``; empty without an event.
    """

    behavior: str
    trigger: str = Trigger.RANDOM
    every: float = 20.0
    event: str = ""

    def document(self, character: str, id_: str) -> str:
        """A block with the behavior; without a character, to see whether it can be read."""
        start = f" start={quoteattr(f'{ANTICIPATORS}:{self.event}')}" if self.trigger == Trigger.EVENT else ""
        whose = f" characterId={quoteattr(character)}" if character else ""
        names = f"id={quoteattr(id_)}{whose}{start}"
        return f'<bml xmlns="{BML}" xmlns:bmlt="{BMLT}" xmlns:rr="{OWN}" {names}>{self.behavior}</bml>'


class AutonomousBehaviors:
    """Sends the autonomous behaviors of all characters. They give way to everything that clients ask for.

    Args:
        scheduler: of the blocks.
        limits: on the blocks.
        behaviors: by character and name.
    """

    def __init__(
        self, scheduler: BMLScheduler, limits: Limits, behaviors: Mapping[str, Mapping[str, AutonomousBehavior]]
    ) -> None:
        self._habits = [
            _Habit(scheduler, limits, character, name, behavior)
            for character, own in behaviors.items()
            for name, behavior in own.items()
        ]

    def advance(self, now: GlobalTime) -> None:
        """Begin a tick: send what is due."""
        for habit in self._habits:
            habit.advance(now)


class _Habit:
    """One autonomous behavior of a character."""

    def __init__(
        self, scheduler: BMLScheduler, limits: Limits, character: str, name: str, behavior: AutonomousBehavior
    ) -> None:
        self._scheduler, self._limits = scheduler, limits
        self._character, self._name, self._behavior = character, name, behavior
        self._times = _times(behavior, f"{character}/{name}")
        self._due = next(self._times)
        self._sent = 0

    def advance(self, now: GlobalTime) -> None:
        """Send the behavior if it is due, and the one before has ended or, if it waited for an event, begun."""
        if not is_due(self._due, now):
            return
        waits = self._behavior.trigger == Trigger.EVENT
        if waits and self._is_ahead():
            return
        while is_due(self._due, now):
            self._due = GlobalTime(now + _PAUSE) if waits else next(self._times)
        if waits or not self._is_alive():
            self._send()

    @property
    def _id(self) -> str:
        return f"{self._name}.autonomous.{self._sent}"

    def _is_alive(self) -> bool:
        """Whether the last block has not ended."""
        return self._scheduler.is_expected(self._id) or self._block() is not None

    def _is_ahead(self) -> bool:
        """Whether the last block has not begun."""
        block = self._block()
        return self._scheduler.is_expected(self._id) or (block is not None and not block.state.plays)

    def _block(self) -> BMLBlock | None:
        return self._scheduler.blocks.get(BlockKey(self._character, self._id))

    def _send(self) -> None:
        self._sent += 1
        for parsed in parse(self._behavior.document(self._character, self._id), self._limits):
            if parsed.block is not None:
                self._scheduler.accompany(parsed.block)


def _times(behavior: AutonomousBehavior, seed: str) -> Iterator[GlobalTime]:
    """Yield when a behavior is due, s."""
    if behavior.trigger == Trigger.EVENT:
        yield GlobalTime(0.0)
        return
    random, time = Random(seed), 0.0
    while True:
        spread = _SPREAD if behavior.trigger == Trigger.RANDOM else 0.0
        time += behavior.every * random.uniform(1.0 - spread, 1.0 + spread)
        yield GlobalTime(time)
