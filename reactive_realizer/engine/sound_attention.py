"""Finds the sounds that an engine has to attend to, so that those that only wait take no time."""

from reactive_realizer.engine.player import Player
from reactive_realizer.engine.sound_unit import SoundUnit
from reactive_realizer.pegboard.peg_follower import PegFollower
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.reactive.graph import Change


class SoundAttention:
    """The planned sounds that play, are due or have changed, or of which a peg has moved.

    Args:
        player: of the engine.

    Attributes:
        units: those that were attended to last, in the order of planning.
    """

    def __init__(self, player: Player) -> None:
        self.units: tuple[SoundUnit, ...] = ()
        self._player = player
        self._waiting: dict[PlanUnit, _Waiting] = {}
        self._changed: dict[_Waiting, None] = {}
        self._count = 0
        player.watch(self._note)

    def add(self, unit: SoundUnit) -> None:
        """Attend to a sound from now on."""
        self._count += 1
        self._waiting[unit] = _Waiting(unit, self._count, self._changed)

    def take(self) -> None:
        """Have `units` be those that need attention since the last call; sounds that have ended come once more."""
        for waiting in self._changed:
            unit = waiting.unit
            waiting.follow(unit.heard_by if unit.live else ())
            if not unit.live:
                self._waiting.pop(unit, None)
        for playing in self._player.playing:
            self._note(playing)
        self.units = tuple(each.unit for each in sorted(self._changed, key=lambda each: each.number))
        self._changed.clear()

    def _note(self, unit: PlanUnit) -> None:
        if (waiting := self._waiting.get(unit)) is not None:
            self._changed[waiting] = None


class _Waiting(PegFollower):
    """Notes a sound that waits if one of its pegs moves.

    Attributes:
        unit: the sound.
        number: its place in the order of planning.
    """

    __slots__ = ("_changed", "number", "unit")

    def __init__(self, unit: SoundUnit, number: int, changed: "dict[_Waiting, None]") -> None:
        super().__init__()
        self.unit = unit
        self.number = number
        self._changed = changed

    def notify(self, change: Change) -> None:
        """Note the sound, because a peg has moved."""
        self._changed[self] = None
