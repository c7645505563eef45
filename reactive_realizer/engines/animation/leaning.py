"""The trunk of a figure leans for hands whose arms do not reach their goals, and its head keeps its direction."""

from collections.abc import Callable, Collection, Sequence
from typing import Final

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import HEAD
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, difference, multiply, power
from reactive_realizer.engines.animation.spine_ik import SPINE_RANGES, HandGoal, leant

_JUMP: Final = 0.02
"""Difference between the turns of a joint in two frames from which on the trunk goes over to its lean, rad."""

_GOING_OVER: Final = 1.0
"""Time in which the trunk goes over to another lean, s."""


class Leaning:
    """Lets the trunk of a figure lean for its hands."""

    def __init__(self, skeleton: Skeleton, release: Callable[[Collection[str], GlobalTime], None]) -> None:
        """Let a figure lean.

        Args:
            skeleton: of the figure.
            release: is called with joints that go over to another motion, and when they have done so.
        """
        self._joints = frozenset(joint for joint in (*SPINE_RANGES, *HEAD) if joint in skeleton)
        self._release = release
        self._upright = dict.fromkeys(self._joints, IDENTITY)
        self._turns = self._before = self._upright

    @property
    def rests(self) -> bool:
        """Whether the trunk does not lean."""
        return self._turns is self._upright

    def layers(self, now: GlobalTime, goals: Sequence[HandGoal], body: Body) -> tuple[Layer, ...]:
        """Return the additive layer of a frame; none if all arms reach their goals.

        Args:
            now: s.
            goals: of the hands.
            body: the figure of this frame without this layer.
        """
        turns = self._upright
        if (leaning := leant(body, goals)) is not body:
            kept = _with_head_kept(leaning, body)
            turns = {joint: difference(body.rotation(joint), kept.rotation(joint)) for joint in self._joints}
        if any(_jumps(self._before[joint], self._turns[joint], turn) for joint, turn in turns.items()):
            self._release(self._joints, GlobalTime(now + _GOING_OVER))
            self._turns = turns
        self._before, self._turns = self._turns, turns
        return () if turns is self._upright else (Layer(LayerKind.ADDITIVE, turns),)


def _jumps(former: Quat, last: Quat, turn: Quat) -> bool:
    """Return whether a turn differs from the last one by much more than that did from the one before."""
    return angle(difference(difference(former, last), difference(last, turn))) > _JUMP


def _with_head_kept(leant: Body, upright: Body) -> Body:
    """Return a body whose head has the direction of another one; neck and head share the turn back."""
    neck, head = HEAD
    if neck not in leant.skeleton or head not in leant.skeleton:
        return leant
    wanted = upright.transform(neck).rotation
    back = power(difference(leant.transform(neck).rotation, wanted), 0.5)
    bent = leant.posed({neck: multiply(leant.rotation(neck), back)})
    left = difference(bent.transform(head).rotation, upright.transform(head).rotation)
    return bent.posed({head: multiply(bent.rotation(head), left)})
