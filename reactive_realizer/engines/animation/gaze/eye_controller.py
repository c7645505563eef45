"""Controls the eyes of a figure from frame to frame: saccades between targets, and fixation."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, between, conjugate, multiply, rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3
from reactive_realizer.engines.animation.gaze.eyes import EyeSockets, direction_between, listing, turned
from reactive_realizer.engines.animation.gaze.viewer import toward_viewer
from reactive_realizer.engines.animation.motion_unit import GazeGoal

PEAK_VELOCITY = 8.7
"""Limit of the velocity of saccades, rad/s (thesis 4.2.2)."""


def saccade_duration(amplitude: float) -> float:
    """Return the duration of a saccade, s, from its amplitude, rad: 21 ms and 2.2 ms per degree.

    R. H. S. Carpenter, "Movements of the Eyes" (1988).
    """
    return 0.021 + 0.0022 * math.degrees(amplitude)


def saccade_progress(amplitude: float, passed: float) -> float:
    """Return the completed share of a saccade, 0 to 1, from its amplitude, rad, and the time since its start, s.

    Its velocity rises and falls symmetrically as a cosine, to at most `PEAK_VELOCITY`. Small saccades reach twice their
    mean velocity, which grows with the amplitude; saccades over 12 degrees stay at the peak for a while.
    """
    duration = saccade_duration(amplitude)
    if passed >= duration:
        return 1.0
    if passed > 0.5 * duration:
        return 1.0 - saccade_progress(amplitude, duration - passed)
    # The amplitude is what the peak velocity covers in the whole duration, less one of the two rises.
    rise = min(0.5 * duration, duration - amplitude / PEAK_VELOCITY)
    peak = 1.0 / (duration - rise)
    if passed >= rise:
        return peak * (passed - 0.5 * rise)
    return 0.5 * peak * (passed - rise / math.pi * math.sin(math.pi * passed / rise))


EyeDirections = Mapping[str, Vec3]
"""Eye joint -> direction, a unit vector in the figure's frame."""

_FOLLOWED = 1.75
"""The eyes fall behind faster targets and catch up by saccades, rad/s: C.

H. Meyer, A. G. Lasker and D. A. Robinson, "The upper limit of human smooth pursuit velocity" (Vision Research 25,
1985). A running saccade follows targets that are no faster than itself.
"""

_LARGE = math.radians(33.0)
"""97 % of larger gaze turns come with a blink, rad: C.

Evinger and others, "Not looking while leaping: the linkage of blinking and saccadic gaze shifts" (Experimental Brain
Research 100, 1994).
"""


@dataclass(frozen=True, slots=True)
class _Saccade:
    begin: GlobalTime
    amplitude: float
    directions: EyeDirections


class EyeController:
    """The eyes of one figure.

    They stay on their target while the head moves. When the target changes, because a gaze starts, ends or gives way,
    or because a target jumps, they move there by a saccade.

    Args:
        large: called with the time of each large turn of gaze.
    """

    def __init__(self, large: Callable[[GlobalTime], None] = lambda _: None) -> None:
        self._large = large
        self._time = GlobalTime(0.0)
        self._changed = GlobalTime(0.0)
        self._points: dict[GazeGoal, Vec3] = {}
        self._head = IDENTITY
        self._aside = IDENTITY
        self._goal: EyeDirections = {}
        self._saccade: _Saccade | None = None

    def note_change(self, time: GlobalTime) -> None:
        """Note that the set of gazes changed at a time, which need not be the time of a frame."""
        self._changed = max(self._changed, time)

    def eyes(
        self,
        now: GlobalTime,
        gazes: Sequence[GazeGoal],
        body: Body,
        resting: Mapping[str, Quat],
        viewer: Vec3 | None = None,
        aside: Quat = IDENTITY,
    ) -> Mapping[str, Quat]:
        """Return the rotations of the eyes in a frame.

        Args:
            now: time of the frame, s; frames come in order.
            gazes: active gaze goals; the last one has priority.
            body: with the head as shown, and the eyes as other motions turn them.
            resting: additional rotations of the eyes when there is nothing to look at.
            viewer: whom they look at then, in the figure's frame, m; None if there is nobody.
            aside: turn from where they look, in the axes of the head, while they glance aside.
        """
        sockets = EyeSockets.of(body)
        resting = {eye: multiply(body.rotation(eye), resting.get(eye, IDENTITY)) for eye in sockets.places}
        if viewer is not None:
            places = sockets.places
            views = {eye: toward_viewer(sockets.rotation, place, viewer) for eye, place in places.items()}
            resting = {eye: multiply(views[eye], turn) for eye, turn in resting.items()}
        points = {gaze: gaze.point(sockets.middle) for gaze in gazes if gaze.eyes > 0.0}
        goal = {
            eye: _glanced(_eye_direction(eye, sockets, points, resting), sockets.rotation, aside)
            for eye in sockets.places
        }
        if not self._goal:  # before the first frame, the eyes rest
            self._head = sockets.rotation
            self._goal = {eye: _eye_direction(eye, sockets, {}, resting) for eye in sockets.places}
        since = self._changed_since(points, aside, sockets.middle, now) if self._goal else None
        if since is not None:
            self._saccade = self._new_saccade(goal, since)
        self._time, self._points, self._head, self._goal = now, points, sockets.rotation, goal
        self._aside = aside
        return {
            eye: listing(sockets.rotation, direction) for eye, direction in self._current_directions(goal, now).items()
        }

    def _changed_since(
        self, points: Mapping[GazeGoal, Vec3], aside: Quat, eyes: Vec3, now: GlobalTime
    ) -> GlobalTime | None:
        """Return since when the target differs from that of the last frame; None if it does not."""
        if list(points) != list(self._points) or aside != self._aside:
            return self._changed if self._changed > self._time else now
        if points == self._points:
            return None
        pairs = (
            (direction_between(eyes, self._points[gaze]), direction_between(eyes, point))
            for gaze, point in points.items()
        )
        ways = [angle(between(before, after)) for before, after in pairs if before and after]
        fastest = _FOLLOWED if self._saccade is None else PEAK_VELOCITY
        return now if max(ways, default=0.0) > fastest * (now - self._time) else None

    def _new_saccade(self, goal: EyeDirections, since: GlobalTime) -> _Saccade:
        """Return a saccade from the current directions of the eyes."""
        there = self._current_directions(self._goal, since)
        directions = {
            eye: _ahead(multiply(self._head, listing(self._head, direction))) for eye, direction in there.items()
        }
        amplitude = max(angle(between(direction, goal[eye])) for eye, direction in directions.items())
        if amplitude > _LARGE:
            self._large(since)
        return _Saccade(since, amplitude, directions)

    def _current_directions(self, goal: EyeDirections, now: GlobalTime) -> EyeDirections:
        """Return the current directions of the eyes."""
        saccade = self._saccade
        if saccade is None:
            return goal
        done = saccade_progress(saccade.amplitude, now - saccade.begin)
        if done >= 1.0:
            self._saccade = None
        return {eye: turned(saccade.directions[eye], direction, done) for eye, direction in goal.items()}


def _eye_direction(eye: str, sockets: EyeSockets, points: Mapping[GazeGoal, Vec3], resting: Mapping[str, Quat]) -> Vec3:
    """Return the goal direction of an eye: each gaze turns it by its weight, starting from the goal of those before."""
    direction = _ahead(multiply(sockets.rotation, resting.get(eye, IDENTITY)))
    for gaze, point in points.items():
        toward = direction_between(sockets.places[eye], point) if eye in gaze.directed else None
        if toward is not None:
            direction = turned(direction, toward, gaze.eyes)
    return direction


def _glanced(direction: Vec3, head: Quat, aside: Quat) -> Vec3:
    """Return a direction, turned aside in the axes of the head."""
    return direction if aside == IDENTITY else rotate(multiply(multiply(head, aside), conjugate(head)), direction)


def _ahead(rotation: Quat) -> Vec3:
    return rotate(rotation, FORWARD)
