"""One foot of a walking figure: where it stands, and how it swings from print to print."""

import math
from typing import NamedTuple, Self

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Transform
from reactive_realizer.embodiment.feet import reach
from reactive_realizer.embodiment.place import Place, between_headings
from reactive_realizer.embodiment.quaternion import Quat, from_axis_angle, multiply, rotate
from reactive_realizer.embodiment.vector import Vec3, add, distance, length, scale, subtract
from reactive_realizer.engines.animation.easing import minimum_jerk, share, smoothstep

_ACROSS: Vec3 = (1.0, 0.0, 0.0)
"""A foot pitches about this axis; positive turns lift the heel."""

_HEEL = 0.045
"""How far the heel is behind the ankle, m."""

_FLAT_AFTER = 0.14
"""Time in which the sole comes down after the heel, s."""

_HEEL_OFF = (0.08, 0.42)
"""Distances of a foot behind the hips at which its heel leaves the ground and at which it is highest, m."""

_HIGHEST_HEEL = 0.9
"""Pitch of a foot that is about to leave the ground, rad."""

_STEEPEST = 1.25
"""Limit of that pitch for a leg that would be too short, rad."""

_EXTENDED = 0.985
"""Share of the reach of a leg to which it is extended in walking; only in the air it comes nearer to the whole."""

_LEAVING, _COMING = 0.3, 0.5
"""Shares of a step until which the pelvis goes down for the foot that leaves, and from which for where it comes."""

_CLEARANCE = (0.035, 0.045)
"""Height of the foot in the middle of a short step, and how much more it is for each meter of its length, m."""


class FootShape(NamedTuple):
    """A foot, in a frame on the ground below its ankle that faces where the foot points at rest.

    Attributes:
        place: where that frame is in the figure's, at rest.
        ankle: height of the ankle, m.
        ball: position of its ball, about which it rolls off, m.
        rotation: of the ankle at rest, in the figure's frame.
        hip: how far its hip is to the left of the middle, m.
        leg: the reach of its leg, m.
    """

    place: Vec3
    ankle: float
    ball: Vec3
    rotation: Quat
    hip: float
    leg: float

    @classmethod
    def of(cls, body: Body, side: str) -> Self:
        """Return a foot ("l" or "r") of a figure that stands."""
        ankle, ball = body.transform(f"{side}_ankle"), f"{side}_midtarsal"
        x, y, z = ankle.position
        tip = body.transform(ball).position if ball in body.skeleton else (x, 0.5 * y, z + 0.12)
        hip, _, _ = body.transform(f"{side}_hip").position
        return cls((x, 0.0, z), y, subtract(tip, (x, 0.0, z)), ankle.rotation, hip, reach(body.skeleton, side))

    def posed(self, print_: Place, pitch: float, lift: float = 0.0) -> Transform:
        """Return the transform of the ankle in the world: the foot rolls over its ball or its heel.

        Args:
            print_: the place of its frame.
            pitch: turn that lifts the heel, or the toes if it is negative, rad.
            lift: of the whole foot, m.
        """
        turn = from_axis_angle(_ACROSS, pitch)
        pivot = self.ball if pitch > 0.0 else (0.0, 0.0, -_HEEL)
        x, y, z = add(pivot, rotate(turn, subtract((0.0, self.ankle, 0.0), pivot)))
        rotation = multiply(print_.turn, multiply(turn, self.rotation))
        return Transform(print_.to_world((x, y + lift, z)), rotation)

    def rolled_to(self, point: Vec3, far: float) -> float:
        """Return the pitch with which its ankle, rolled over its ball, is at a distance from a point, or nearest to it.

        Args:
            point: above its ball, in its frame, m.
            far: the distance, m.
        """
        x, y, z = subtract(point, self.ball)
        across, up, ahead = subtract((0.0, self.ankle, 0.0), self.ball)
        # The square of the distance is that of both ways less twice their product, which a turn makes a cosine.
        level, upright = y * up + z * ahead, z * up - y * ahead
        product = 0.5 * (x * x + y * y + z * z + across * across + up * up + ahead * ahead - far * far) - x * across
        most = math.hypot(level, upright)
        return math.atan2(upright, level) - math.acos(max(-1.0, min(1.0, product / most)))


class Swing(NamedTuple):
    """A foot in its swing phase.

    Attributes:
        goal: the print that it makes.
        since: when it leaves the ground, s.
        until: when it touches the ground, s.
        start: the print that it leaves.
        pitch: when it leaves the ground, rad.
        strike: when it touches the ground, rad.
    """

    goal: Place
    since: GlobalTime
    until: GlobalTime
    start: Place
    pitch: float
    strike: float

    def at(self, now: GlobalTime) -> tuple[Place, float, float]:
        """Return the place of the foot, its pitch and its lift at a time."""
        done = share(now, self.since, self.until)
        gone = smoothstep(done)
        way = distance(self.start.position, self.goal.position)
        turn = between_headings(self.start.heading, self.goal.heading)
        place = Place(
            add(self.start.position, scale(subtract(self.goal.position, self.start.position), gone)),
            self.start.heading + gone * turn,
        )
        least, more = _CLEARANCE
        high = (least + more * min(way, 1.0)) * (4.0 * done * (1.0 - done)) ** 1.25
        pitch = self.pitch * (1.0 - minimum_jerk(done / 0.7)) + self.strike * minimum_jerk((done - 0.4) / 0.6)
        return place, pitch, high


class WalkingFoot:
    """A foot that stands or steps.

    Attributes:
        shape: of it.
        print: where it stands, or stood last.
        swing: None while it stands.
        landed: when it touched the ground last, s.
        pitch: turn that lifts its heel, as shown last, rad.
    """

    def __init__(self, shape: FootShape, place: Place) -> None:
        self.shape = shape
        self.print = Place(place.to_world(shape.place), place.heading)
        self.swing: Swing | None = None
        self.landed = GlobalTime(-math.inf)
        self.pitch = 0.0
        self._strike = 0.0

    @property
    def goal(self) -> Place:
        """The print that it makes next, or in which it stands."""
        return self.print if self.swing is None else self.swing.goal

    def lift_off(self, goal: Place, now: GlobalTime, until: GlobalTime, strike: float) -> None:
        """Begin a step to a print."""
        self.swing = Swing(goal, now, until, self.print, self.pitch, strike)

    def touch_down(self) -> None:
        """End the present step."""
        if self.swing is not None:
            self.print, self.landed, self._strike = self.swing.goal, self.swing.until, self.swing.strike
            self.swing = None

    def flat(self) -> bool:
        """Return whether it stands on its whole sole."""
        return self.swing is None and abs(self.pitch) < 1e-4

    def over_ground(self, now: GlobalTime) -> Place:
        """Return its place at a time."""
        return self.print if self.swing is None else self.swing.at(now)[0]

    def bears(self, now: GlobalTime) -> float:
        """Return how much the pelvis goes down for it to reach its place, 0 to 1: in the air, it need not do that."""
        if self.swing is None:
            return 1.0
        done = share(now, self.swing.since, self.swing.until)
        return max(1.0 - smoothstep(share(done, 0.0, _LEAVING)), smoothstep(share(done, _COMING, 1.0)))

    def at(self, now: GlobalTime, place: Place, hip: Vec3, reach: float, rolls: float) -> Transform:
        """Return the transform of the ankle in the world at a time.

        A foot that the leg would not reach rolls further over its ball, or comes nearer while it is in the air.

        Args:
            now: s.
            place: of the figure.
            hip: in the world, m.
            reach: of the leg, m.
            rolls: how far its heel leaves the ground when the figure leaves it behind, 0 to 1.
        """
        if self.swing is None:
            self.pitch = self._rolled(now, place, rolls)
            return self._reached(place, hip, reach)
        ground, self.pitch, lift = self.swing.at(now)
        ankle = self.shape.posed(ground, self.pitch, lift)
        way = subtract(ankle.position, hip)
        far = length(way)
        nearer = (far - reach * _soft(far / reach)) * (1.0 - self.bears(now))
        return Transform(add(hip, scale(way, 1.0 - nearer / far)), ankle.rotation)

    def _reached(self, place: Place, hip: Vec3, reach: float) -> Transform:
        ankle = self.shape.posed(self.print, self.pitch)
        behind = self._behind(place)
        longest = reach * (1.0 - (1.0 - _EXTENDED) * share(behind, 0.0, _HEEL_OFF[0]))
        if behind <= 0.0 or distance(ankle.position, hip) <= longest:
            return ankle
        self.pitch = min(_STEEPEST, max(self.pitch, self.shape.rolled_to(self.print.to_own(hip), longest)))
        return self.shape.posed(self.print, self.pitch)

    def _rolled(self, now: GlobalTime, place: Place, rolls: float) -> float:
        """Return the pitch of a standing foot: it rolls from its heel, and off over its ball as the hips leave it."""
        touching = self._strike * (1.0 - minimum_jerk((now - self.landed) / _FLAT_AFTER)) if self._strike else 0.0
        return touching + rolls * _HIGHEST_HEEL * minimum_jerk(share(self._behind(place), *_HEEL_OFF))

    def _behind(self, place: Place) -> float:
        """Return how far the figure has left it behind, m."""
        return self.shape.place[2] - place.to_own(self.print.position)[2]


def _soft(far: float) -> float:
    """Return a distance relative to the reach of a leg, softly limited."""
    rest = 1.0 - _EXTENDED
    return far if far < _EXTENDED else _EXTENDED + rest * (1.0 - math.exp((_EXTENDED - far) / rest))
