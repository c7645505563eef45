"""A visible character: its avatar, its position in the world, and its current pose."""

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.clearance import ALL_THE_WAY, Clearance
from reactive_realizer.embodiment.face_map import NO_STAND_INS, FaceMap, StandIns
from reactive_realizer.embodiment.frame import Frame, rotation_array
from reactive_realizer.embodiment.free_arms import FreeArms
from reactive_realizer.embodiment.inertialization import Inertialization
from reactive_realizer.embodiment.joints import CARRYING, EYES, LEFT_ARM, RIGHT_ARM, ROOT, SIDES
from reactive_realizer.embodiment.lids import with_lids
from reactive_realizer.embodiment.place import Place, PlannedSteps
from reactive_realizer.embodiment.pose import Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, conjugate, difference, multiply, power, rotate
from reactive_realizer.embodiment.speed_limit import SpeedLimit, slowed
from reactive_realizer.embodiment.turn_weights import turns
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, distance, scale, subtract

_AIMING = 0.4
"""Time in which an arm that begins or ends to point ceases or begins to keep clear of the body, s."""


class EyePose(NamedTuple):
    """The eyes in a frame.

    Attributes:
        turns: eye joint -> rotation in the head.
        lids: morph weights by which the lids follow the eyes, which are added to the face.
        blink: weights of eyeBlinkLeft and eyeBlinkRight of a blink, 0 to 1.
    """

    turns: Mapping[str, Quat]
    lids: Mapping[str, float]
    blink: Mapping[str, float] = MappingProxyType({})


Eyes = Callable[[Body], EyePose]
"""Returns the eye pose for a body with its head as shown. Eyes are posed last, after all figures have moved."""


Dynamics = Callable[[Body, float], Body]
"""Moves joints by forces: from a body at the end of a frame, and the duration of the frame, s, to the body to show.

It is called once for every frame, in any thread, while nothing else uses the figure.
"""


class Humanoid:
    """A figure in the world.

    Args:
        avatar: its body.
        position: of the point on the ground where it stands, m.
        heading: turn to its left, rad; 0 faces +z.
        weight: kg; None for the usual one of its stature.
        simulation_steps: in which it is simulated in each tick; None for steps of the usual time.
        stand_ins: what its face shows instead of blend shapes that it lacks.
    """

    def __init__(
        self,
        avatar: Avatar,
        position: Vec3 = ZERO,
        heading: float = 0.0,
        weight: float | None = None,
        simulation_steps: int | None = None,
        stand_ins: StandIns = NO_STAND_INS,
    ) -> None:
        self.avatar = avatar
        self.face = FaceMap(avatar, stand_ins)
        self.weight, self.simulation_steps = weight, simulation_steps
        self.place = Place(position, heading)
        """Where it stands; the next move takes place there."""
        self.planned_steps: Callable[[], PlannedSteps] = PlannedSteps
        """Returns where it walks from there, and on which footprints."""
        self._shown_place = self._place_before = self.place
        self._morphs = {morph: i for i, morph in enumerate(avatar.morphs)}
        self._faced = frozenset(avatar.skeleton.joints).difference(EYES)
        self._carrying = [joint for joint in CARRYING if joint in avatar.skeleton]
        self._arms = [joint for joint in avatar.skeleton.joints if joint in LEFT_ARM | RIGHT_ARM]
        self._inertialization = Inertialization(avatar.skeleton)
        self.clearance = Clearance.of(avatar)
        """Returns a body with its arms out of its flesh."""
        self._free_arms = FreeArms(self.clearance, avatar.skeleton)
        self._aiming: frozenset[str] = frozenset()
        self._aimed = dict.fromkeys(SIDES, 0.0)
        self._limit: SpeedLimit | None = None
        self._shown = Body(avatar.skeleton)
        self._time = GlobalTime(0.0)
        self._passed = 0.0
        # The bodies shown in the two frames before, the last one first.
        self._before: Body | None = None
        self._sooner: Body | None = None
        self._wanted = self._limited = self._smooth = self._clear = self._shown
        # Joints that forces moved in the last frame, so that speed limits do not hold back their animation.
        self._forced: frozenset[str] = frozenset()
        self.body = Body(avatar.skeleton)
        """The figure without additive motion, its arms as shown, in its own frame; motions start from here."""

    def rest(self, body: Body) -> None:
        """Set the body until the first frame."""
        self.body = self._shown = body

    def switch(self, joints: Iterable[str], until: GlobalTime) -> None:
        """Expect another motion of some joints in the next frame (`Inertialization.switch`)."""
        self._inertialization.switch(joints, until)

    def aim(self, sides: Iterable[str]) -> None:
        """Let arms ("l", "r") be where their motions want them from now on, even in flesh: their fingers point."""
        self._aiming = frozenset(sides)

    def move(self, time: GlobalTime, layers: Iterable[Layer], faces: Iterable[Mapping[str, float]] = ()) -> None:
        """Move to the pose that layers compose for a time, turned further by the weights of faces, without a jump.

        Then come `simulate`, if forces move the figure, and `look`: figures look at each other, so all of them move
        first.
        """
        turned = turns(self.face(_sum(faces)), self._faced)
        added = (Layer(LayerKind.ADDITIVE, turned),) if turned else ()
        composed = compose(self.avatar.skeleton, (*layers, *added))
        smooth = self._inertialization(composed.shown, time)
        shares = self._ways_out(time - self._time)
        # A figure that stands still is where it was.
        still = smooth is self._smooth and shares is ALL_THE_WAY
        clear = self._clear if still else self._free_arms(smooth, shares)
        self._passed, self._time, self._wanted = time - self._time, time, composed.shown
        if self._limit is None:
            # Nothing was shown before: the figure does not come from elsewhere, however far its body at rest is away.
            self._limit, self._shown, self._passed = SpeedLimit(clear), clear, 0.0
        else:
            self._before, self._sooner, self._place_before = self._shown, self._before, self._shown_place
            if self._forced:
                self._limit.release(composed.shown, self._forced)
            self._shown = self._limit(clear, self._passed)
        self._smooth, self._clear = smooth, clear
        self._inertialization.note_shown(self._without_clearance(), time)
        self._limited, self._forced, self._shown_place = self._shown, frozenset(), self.place
        self.body = self._steady(self._inertialization.offset(composed.steady), clear)

    def simulate(self, dynamics: Dynamics) -> None:
        """Let forces move the figure from the pose of the last move; it may run in any thread."""
        body = dynamics(self._limited, self._passed)
        kinematic = self._limited.pose
        moved = {joint: turn for joint, turn in body.pose.items() if turn is not kinematic[joint]}
        self._shown, self.body, self._forced = body, self.body.posed(moved, body.root), frozenset(moved)

    def _ways_out(self, passed: float) -> Mapping[str, float]:
        """Return how much of its way out of flesh each arm goes, 0 to 1, some time after the last frame, s."""
        if not self._aiming and not any(self._aimed.values()):
            return ALL_THE_WAY
        for side, aimed in self._aimed.items():
            step = passed / _AIMING
            self._aimed[side] = min(1.0, aimed + step) if side in self._aiming else max(0.0, aimed - step)
        return {side: 1.0 - aimed * aimed * (3.0 - 2.0 * aimed) for side, aimed in self._aimed.items()}

    def _without_clearance(self) -> Body:
        """Return the body as shown, with its arms where they would be if they need not keep clear of it.

        Offsets that decay belong to motions, which do not know of the way out: it is added to each pose anew.
        """
        if self._clear is self._smooth:
            return self._shown
        shown, smooth, clear = self._shown.pose, self._smooth.pose, self._clear.pose
        moved = (joint for joint in self._arms if clear[joint] is not smooth[joint] and shown[joint] is clear[joint])
        return self._shown.posed({joint: smooth[joint] for joint in moved})

    def _steady(self, steady: Body, wanted: Body) -> Body:
        """Return the body without additive motion, with arms that are slowed where they are shown."""
        if self._shown is wanted:
            return steady
        shown = self._shown.pose
        slower = {joint: shown[joint] for joint in self._arms if shown[joint] is not wanted.pose[joint]}
        return steady.posed(slower) if slower else steady

    def look(self, eyes: Eyes | None, faces: Iterable[Mapping[str, float]]) -> Frame:
        """Return the frame at the time of the last move. The eyes look from the head as shown.

        Args:
            eyes: None leaves the eyes as the layers pose them.
            faces: weights of morphs and of turns of the eyes, which add up.
        """
        body = self._shown
        face = _sum(faces)
        looks, lids, blink = EyePose({}, {}) if eyes is None else eyes(body)
        looking = {**{eye: body.rotation(eye) for eye in EYES if eye in body.skeleton}, **looks}
        looking |= {eye: multiply(looking[eye], turn) for eye, turn in turns(face, looking).items()}
        if self._before is not None:
            looking = slowed(self._before.pose, looking, self._passed)
        self._shown = body.posed(looking)
        weights = self._weights(self.face(with_lids(face, lids, blink)))
        return Frame(self._time, self._root(self._shown.root), self._rotations(self._shown.pose), weights)

    @property
    def shown(self) -> Body:
        """The figure as shown last, additive motion included, in its own frame."""
        return self._shown

    @property
    def time(self) -> GlobalTime:
        """The time of the last move, s."""
        return self._time

    def expected(self, time: GlobalTime) -> Body:
        """Return the figure as shown last, with what carries its arms going on as in the last frames.

        Args:
            time: of a future frame, s. The motion is extrapolated by one frame at most, with its acceleration.
        """
        before, shown, ahead = self._before, self._shown, time - self._time
        if before is None or ahead <= 0.0 or before is shown:
            return shown
        share, sooner = min(1.0, ahead / self._passed), self._sooner or before
        turned = {
            joint: multiply(shown.rotation(joint), power(_next(joint, sooner, before, shown), share))
            for joint in self._carrying
        }
        way, last = subtract(shown.root, before.root), subtract(before.root, sooner.root)
        further = way if sooner is before else subtract(scale(way, 2.0), last)
        return shown.posed(turned, add(shown.root, scale(further, share)))

    def gap(self, joint: str) -> float:
        """Return the distance between the positions of a joint as composed and as moved, m.

        Speed limits cause it, and offsets that still decay, such as those of a trunk that the joint hangs on; the way
        out of the figure's own body does not count.
        """
        bodies = (self._wanted, self._limited, self._smooth, self._clear)
        wanted, limited, smooth, clear = (body.transform(joint).position for body in bodies)
        return distance(add(wanted, subtract(clear, smooth)), limited)

    def to_own_frame(self, point: Vec3) -> Vec3:
        """Convert a point of the world to the figure's frame, m."""
        return self.place.to_own(point)

    def to_own_axes(self, vector: Vec3) -> Vec3:
        """Convert a direction or a force in the axes of the world to the figure's."""
        return rotate(conjugate(self.place.turn), vector)

    def locate(self, joint: str | None, time: GlobalTime | None = None) -> Vec3 | None:
        """Return the position of a joint in the world, m; None if there is no such joint.

        Args:
            joint: its name; None for the midpoint between the eyes.
            time: of a future frame, for which the position is extrapolated; None for the current position.
        """
        name = joint or "skullbase"
        if name not in self.avatar.skeleton.joints:
            return None
        point = self._shown_place.to_world(_point(self._shown, joint))
        ahead = 0.0 if time is None else time - self._time
        if self._before is not None and ahead > 0.0:
            # Extrapolate by one frame at most: after a gap the motion is unknown.
            way = subtract(point, self._place_before.to_world(_point(self._before, joint)))
            point = add(point, scale(way, min(1.0, ahead / self._passed)))
        return point

    def _root(self, moved: Vec3) -> NDArray[np.float64]:
        place = add(self.avatar.skeleton.offset(ROOT), moved)
        return np.array(self._shown_place.to_world(place))

    def _rotations(self, pose: Mapping[str, Quat]) -> NDArray[np.float64]:
        root = multiply(self._shown_place.turn, pose.get(ROOT, IDENTITY))
        return rotation_array(self.avatar.skeleton, {**pose, ROOT: root})

    def _weights(self, face: Mapping[str, float]) -> NDArray[np.float64]:
        weights = np.zeros(len(self._morphs))
        for morph in face.keys() & self._morphs.keys():
            weights[self._morphs[morph]] = min(max(face[morph], 0.0), 1.0)
        return weights


def _next(joint: str, sooner: Body, before: Body, shown: Body) -> Quat:
    """Return the turn of a joint in the next frame: that of the last one, and as much more as it has grown."""
    first, second, third = (body.rotation(joint) for body in (sooner, before, shown))
    step = difference(second, third)
    return step if sooner is before else multiply(step, difference(difference(first, second), step))


def _sum(faces: Iterable[Mapping[str, float]]) -> dict[str, float]:
    total: dict[str, float] = {}
    for face in faces:
        for morph, weight in face.items():
            total[morph] = total.get(morph, 0.0) + weight
    return total


def _point(body: Body, joint: str | None) -> Vec3:
    return body.transform(joint).position if joint else between_eyes(body)


def between_eyes(body: Body) -> Vec3:
    """Return the midpoint between the eyes in the body's frame, m; the top of the neck if an eye is missing."""
    left, right = EYES
    if left not in body.skeleton or right not in body.skeleton:
        return body.transform("skullbase").position
    return scale(add(body.transform(left).position, body.transform(right).position), 0.5)
