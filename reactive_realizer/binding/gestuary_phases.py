"""Phases of gestures as in Greta's gestuaries: places of the hands in lengths of the arm, and trajectories."""

import math
from collections.abc import Iterable
from typing import NamedTuple

from reactive_realizer.embodiment.joints import other_side
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3


class Wave(NamedTuple):
    """The part of a trajectory along one axis.

    Attributes:
        amplitude: lengths of the arm.
        frequency: turns on the way.
        shift: turns at the start.
        growth: 1 if its extent grows from nothing, -1 if it shrinks to nothing.
        haste: 1 if it gets faster, -1 if it gets slower.
    """

    amplitude: float
    frequency: float = 1.0
    shift: float = 0.0
    growth: int = 0
    haste: int = 0

    def off(self, done: float) -> float:
        """Return the distance from the straight way after a share of it, lengths of the arm; 0 at both ends."""
        return self._value(done) - (1.0 - done) * self._value(0.0) - done * self._value(1.0)

    def _value(self, done: float) -> float:
        extent = {-1: 1.0 - done, 0: 1.0, 1: done}[self.growth]
        time = {-1: math.sqrt(done), 0: done, 1: 1.0 - math.sqrt(max(0.0, 1.0 - done))}[self.haste]
        return self.amplitude * extent * math.sin(2.0 * math.pi * (self.frequency * time + self.shift))


class HandPhase(NamedTuple):
    """A hand in a phase of a gesture. What is None is as in the phase before.

    Attributes:
        side: "l" or "r".
        row: line of the file.
        place: of the wrist, in lengths of the arm: outward from the middle of the body, up from the elbow of a hanging
            arm, and ahead of the shoulder.
        touch: the name of a place on the body instead.
        shape: its name.
        turn: rotation of the hand from where a hanging one is, relative to the forearm or to the figure.
        of_figure: whether it is relative to the figure.
        openness: how far the elbow is lifted to the side; usually from 0 to 1.
        waves: of the trajectory to the next phase, along the three axes of `place`; empty for a straight one.
    """

    side: str
    row: int | None = None
    place: Vec3 | None = None
    touch: str | None = None
    shape: str | None = None
    turn: Quat | None = None
    of_figure: bool = False
    openness: float = 0.0
    waves: tuple[Wave, ...] = ()

    def mirrored(self) -> "HandPhase":
        """Return the same for the other hand."""
        turn = self.turn and (self.turn[0], self.turn[1], -self.turn[2], -self.turn[3])
        touch = self.touch
        if touch is not None and touch[-2:] in ("_L", "_R"):
            touch = touch[:-1] + {"L": "R", "R": "L"}[touch[-1]]
        return self._replace(side=other_side(self.side), turn=turn, touch=touch)


Phase = tuple[HandPhase, ...]
"""One hand or both."""


def filled(phases: Iterable[Phase], side: str) -> dict[int, HandPhase]:
    """Return one hand by the number of the phase, from the first one that it has; it keeps what a phase leaves open."""
    states: dict[int, HandPhase] = {}
    for phase_number, phase in enumerate(phases):
        before = states.get(phase_number - 1)
        here = next((hand for hand in phase if hand.side == side), None)
        if here is None and before is not None:
            here = before._replace(waves=())
        elif here is not None and before is not None:
            here = _after(before, here)
        if here is not None:
            states[phase_number] = here
    return states


def _after(before: HandPhase, hand: HandPhase) -> HandPhase:
    if hand.place is None and hand.touch is None:
        hand = hand._replace(place=before.place, touch=before.touch)
    if hand.turn is None:
        hand = hand._replace(turn=before.turn, of_figure=before.of_figure)
    return hand if hand.shape is not None else hand._replace(shape=before.shape)
