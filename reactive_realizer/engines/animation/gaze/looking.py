"""Where the eyes of one figure are, from frame to frame: they jump from sight to sight, and hold what they have."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, angle, between, multiply, rotate
from reactive_realizer.embodiment.vector import FORWARD, Vec3
from reactive_realizer.engines.animation.gaze.eyes import Sockets, direction, listing, turned
from reactive_realizer.engines.animation.gaze.saccade import PEAK_VELOCITY, saccade_progress
from reactive_realizer.engines.animation.motion_unit import Gazing

Sights = Mapping[str, Vec3]
"""Eye joint -> where it looks, a unit vector of the figure's frame."""

_FOLLOWED = 1.75
"""rad/s; of what moves faster the eyes fall behind and catch up by a saccade: C. H. Meyer, A. G. Lasker and D. A.
Robinson, "The upper limit of human smooth pursuit velocity" (Vision Research 25, 1985). A saccade on its way follows
what is no faster than itself."""

_LARGE = math.radians(33.0)
"""Of larger turns of gaze 97 % come with a blink: C. Evinger and others, "Not looking while leaping: the linkage of
blinking and saccadic gaze shifts" (Experimental Brain Research 100, 1994)."""


@dataclass(frozen=True, slots=True)
class _Saccade:
    begin: GlobalTime
    amplitude: float
    sights: Sights


class Looking:
    """The eyes of one figure.

    They lie on what is looked at, wherever the head goes meanwhile. Whenever that is something else, because a gaze
    begins, ends or gives way, or a target was moved elsewhere, they go there by a saccade.
    """

    def __init__(self, large: Callable[[GlobalTime], None] = lambda _: None) -> None:
        self._large = large
        self._time = GlobalTime(0.0)
        self._noticed = GlobalTime(0.0)
        self._points: dict[Gazing, Vec3] = {}
        self._head = IDENTITY
        self._goal: Sights = {}
        self._saccade: _Saccade | None = None

    def notice(self, time: GlobalTime) -> None:
        """At a time, which need not be that of a frame, something leads the eyes that did not before, or no more."""
        self._noticed = max(self._noticed, time)

    def eyes(
        self, now: GlobalTime, gazes: Sequence[Gazing], body: Body, resting: Mapping[str, Quat]
    ) -> Mapping[str, Quat]:
        """Rotations of the eyes in the frame of a time.

        Args:
            now: of the frame; frames come in order.
            gazes: what looks now, the last one before all others.
            body: with its head as it is shown, and its eyes as other motions turn them.
            resting: what the eyes do besides when nobody looks anywhere.
        """
        sockets = Sockets.of(body)
        resting = {eye: multiply(body.rotation(eye), resting.get(eye, IDENTITY)) for eye in sockets.places}
        points = {gaze: gaze.point(sockets.middle) for gaze in gazes if gaze.eyes > 0.0}
        goal = {eye: _sight(eye, sockets, points, resting) for eye in sockets.places}
        since = self._elsewhere(points, sockets.middle, now) if self._goal else None
        if since is not None:
            self._saccade = self._from_here(goal, since)
        self._time, self._points, self._head, self._goal = now, points, sockets.rotation, goal
        return {eye: listing(sockets.rotation, sight) for eye, sight in self._moved(goal, now).items()}

    def _elsewhere(self, points: Mapping[Gazing, Vec3], eyes: Vec3, now: GlobalTime) -> GlobalTime | None:
        """Since when there is something else to look at than in the last frame; None: there is not."""
        if list(points) != list(self._points):
            return self._noticed if self._noticed > self._time else now
        if points == self._points:
            return None
        pairs = ((direction(eyes, self._points[gaze]), direction(eyes, point)) for gaze, point in points.items())
        ways = [angle(between(before, after)) for before, after in pairs if before and after]
        fastest = _FOLLOWED if self._saccade is None else PEAK_VELOCITY
        return now if max(ways, default=0.0) > fastest * (now - self._time) else None

    def _from_here(self, goal: Sights, since: GlobalTime) -> _Saccade:
        """The eyes leave from where they had come to."""
        there = self._moved(self._goal, since)
        sights = {eye: _ahead(multiply(self._head, listing(self._head, sight))) for eye, sight in there.items()}
        amplitude = max(angle(between(sight, goal[eye])) for eye, sight in sights.items())
        if amplitude > _LARGE:
            self._large(since)
        return _Saccade(since, amplitude, sights)

    def _moved(self, goal: Sights, now: GlobalTime) -> Sights:
        """Where the eyes are on their way."""
        saccade = self._saccade
        if saccade is None:
            return goal
        done = saccade_progress(saccade.amplitude, now - saccade.begin)
        if done >= 1.0:
            self._saccade = None
        return {eye: turned(saccade.sights[eye], sight, done) for eye, sight in goal.items()}


def _sight(eye: str, sockets: Sockets, points: Mapping[Gazing, Vec3], resting: Mapping[str, Quat]) -> Vec3:
    """Where an eye is to look: each gaze goes as far as its weight from what those before it look at."""
    sight = _ahead(multiply(sockets.rotation, resting.get(eye, IDENTITY)))
    for gaze, point in points.items():
        toward = direction(sockets.places[eye], point)
        if toward is not None:
            sight = turned(sight, toward, gaze.eyes)
    return sight


def _ahead(rotation: Quat) -> Vec3:
    return rotate(rotation, FORWARD)
