"""One foot carries while the other is in the air, whatever moves them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.skeleton import Place
from reactive_realizer.engines.animation.easing import share, smoothstep
from reactive_realizer.engines.animation.posture.steps import Foot, swung

_STANDS = 0.002
"""m; a foot that is lifted less stands."""

_DURATION = 0.5
"""s of a step that makes up for one that was not made: a little longer than a foot is in the air of who walks."""

_TAKEN = 0.2
"""s until one has got used to it that a foot has to wait."""

_GAP = 0.1
"""s; what was shown longer ago is of no consequence."""


@dataclass(frozen=True, slots=True)
class _Late:
    """A foot that could not leave when it was wanted to.

    Attributes:
        foot: as it stands.
        held: when it was to leave, s.
        since: when it left, s; None as long as it waits for the other one.
    """

    foot: Foot
    held: GlobalTime
    since: GlobalTime | None = None

    @property
    def waits(self) -> bool:
        return self.since is None

    def over(self, now: GlobalTime) -> bool:
        return self.since is not None and now >= self.since + _DURATION

    def at(self, wanted: Foot, now: GlobalTime) -> Foot:
        if self.since is None:
            return self.foot
        return swung(self.foot, wanted, share(now, self.since, self.since + _DURATION))

    def care(self, now: GlobalTime) -> float:
        taken = smoothstep(share(now, self.held, self.held + _TAKEN))
        done = 0.0 if self.since is None else share(now, self.since, self.since + _DURATION)
        return taken * (1.0 - smoothstep(done))


class Carrying:
    """Feet that do what they are wanted to do, but not both at once.

    Changes of stance that overlap may want both feet in the air. Then the one that stands still stays until the other
    has come down, and makes up for its way by a step of its own. It is our choice.
    """

    def __init__(self) -> None:
        self._time = GlobalTime(0.0)
        self._shown: tuple[Foot, ...] = ()
        self._late: dict[int, _Late] = {}

    @property
    def settled(self) -> bool:
        """Whether both feet are where they were wanted."""
        return not self._late

    @property
    def care(self) -> float:
        """How careful one is for a foot that is late, 0 to 1; less and less while that makes up for its way."""
        return max((late.care(self._time) for late in self._late.values()), default=0.0)

    def __call__(self, wanted: Sequence[Foot], now: GlobalTime) -> tuple[Place, ...]:
        """Where ankles are to be in the frame of a time, the left one first.

        Args:
            wanted: what motions make of the feet, the left one first.
            now: time of the frame, s; frames come in order.
        """
        if now - self._time > _GAP:
            self._shown, self._late = tuple(wanted), {}
        self._late = {number: late for number, late in self._late.items() if not late.over(now)}
        shown = [self._foot(number, foot, now) for number, foot in enumerate(wanted)]
        stands = [foot.lift <= _STANDS for foot in shown]
        if not any(stands):
            self._stay(shown, now)
        elif all(stands):
            self._late |= {number: replace(late, since=now) for number, late in self._late.items() if late.waits}
        self._time, self._shown = now, tuple(shown)
        return tuple(foot.place for foot in shown)

    def _foot(self, number: int, wanted: Foot, now: GlobalTime) -> Foot:
        late = self._late.get(number)
        return wanted if late is None else late.at(wanted, now)

    def _stay(self, shown: list[Foot], now: GlobalTime) -> None:
        """The foot that stood last stays; of two that stood, the one that has not waited before."""
        stood = [number for number, foot in enumerate(self._shown) if foot.lift <= _STANDS]
        for number in sorted(stood, key=self._late.__contains__)[:1]:
            shown[number] = self._shown[number]
            held = self._late[number].held if number in self._late else now
            self._late[number] = _Late(shown[number], held)
