"""MURML's gestures as key poses: where hands are along a stroke, or rotations in key frames."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import reduce
from itertools import accumulate, pairwise

from reactive_realizer.binding.gesture_binding import MURML_TEXT
from reactive_realizer.bml.murml.behaviors import MurmlGesture
from reactive_realizer.bml.murml.description import (
    GesturePlace,
    HandShape,
    Heading,
    Keyframing,
    Mark,
    MurmlDescription,
    Point,
    Scope,
    Shift,
    Slot,
    Track,
    signed,
)
from reactive_realizer.bml.vocabulary import BodyAxis, BodyGroup, Mode
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import Quat, from_euler, multiply
from reactive_realizer.embodiment.spine import folded_spine
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, unit
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.faults import NoGoals, NoJoints
from reactive_realizer.engines.animation.key_poses.arm_pose import hand_axes
from reactive_realizer.engines.animation.key_poses.gesture_space import arm_length, gesture_place
from reactive_realizer.engines.animation.key_poses.solved_pose import JointPose, SeveralPoses, SolvedPose
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_unit import FILE_PARAMETERS
from reactive_realizer.engines.animation.motions.hand_tracks import (
    Course,
    HandTracks,
    direction_course,
    place_course,
    shape_course,
)
from reactive_realizer.engines.animation.motions.key_pose_gesture import KeyPoseGesture, posed
from reactive_realizer.engines.animation.motions.key_poses import Key
from reactive_realizer.engines.animation.motions.murml_files import read_murml_file, read_murml_text
from reactive_realizer.engines.animation.motions.pose_goals import stored_pose
from reactive_realizer.engines.animation.motions.reaching import reach
from reactive_realizer.engines.animation.motions.superposed_frames import SuperposedFrames, TurnFrame
from reactive_realizer.errors import Fault, RealizerError

_KEPT = 0.4
"""Duration of a stroke in which the hands only keep a pose, s."""

_WORK = 30
"""Work of finding the duration of a movement, as the limit `planning_per_tick` counts."""

_SIDES = {Scope.LEFT: "l", Scope.RIGHT: "r"}
_HANDS = {Scope.LEFT: BodyGroup.LEFT_HAND, Scope.RIGHT: BodyGroup.RIGHT_HAND}
_AXES = {Slot.EXT_FINGER_ORIENTATION: BodyAxis.FINGERS, Slot.PALM_ORIENTATION: BodyAxis.PALM}


class MurmlMotionUnit(KeyPoseGesture):
    """A gesture of MURML."""

    fixed = FILE_PARAMETERS | {MURML_TEXT}


class MurmlMaker:
    """Makes gestures of MURML. Parts that the figure cannot play are left out with a note each."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> MurmlMotionUnit | SuperposedFrames:
        """Make a gesture.

        Raises:
            RealizerError: nothing of it can be played.
        """
        behavior = request.behavior
        if isinstance(behavior, MurmlGesture):
            return self._motion(behavior.id, behavior.description)
        text = request.parameters.get(MURML_TEXT)
        scope = Scope.LEFT if getattr(behavior, "mode", None) is Mode.LEFT_HAND else Scope.RIGHT
        if text is not None and request.file is None:
            found = read_murml_text(text, "the description in the gesture binding", scope)
        else:
            found = read_murml_file(self._context.file_of(request, "xml"), scope)
        motion = self._motion(behavior.id, found.description)
        motion.notes = (*found.notes, *motion.notes)
        return motion

    def _motion(self, name: str, description: MurmlDescription) -> MurmlMotionUnit | SuperposedFrames:
        rest = self._context.rest.body
        if description.keyframing is not None:
            return self._animation(name, description.keyframing, rest)
        stroke = _Stroke(description.tracks, self._context)
        if not stroke.hands:
            reasons = tuple(fault.sentence for fault in stroke.notes)
            raise RealizerError(stroke.notes[0] if len(stroke.notes) == 1 else NoGoals(reasons=reasons))
        motion = stroke.motion(name, rest)
        motion.notes = tuple(stroke.notes)
        return motion

    def _animation(self, name: str, keyframing: Keyframing, rest: Body) -> MurmlMotionUnit | SuperposedFrames:
        """Return the motion of key frames.

        Raises:
            RealizerError: the figure has none of their joints.
        """
        known = rest.skeleton.joints
        keys: list[Key] = []
        added: list[TurnFrame] = []
        rotations: dict[str, Quat] = {}
        named: set[str] = set()
        for frame in keyframing.frames:
            turns = {joint: _turn(values) for joint, values in frame.values.items()}
            named |= turns.keys()
            groups = folded_spine(turns, known)
            rotations |= {joint: turn for joint, turn in turns.items() if joint in known and joint not in groups}
            rotations |= {joint: reduce(multiply, (turns[each] for each in own)) for joint, own in groups.items()}
            before = keys[-1].left if keys else 0.0
            reached = frame.time if keys or keyframing.from_current else 0.0
            pose = SolvedPose(dict(rotations))
            keys.append(Key(before, reached, frame.time, keyframing.progress, pose, frame.location))
            added.append(TurnFrame(reached, dict(rotations)))
        lacking = {joint for joint in named if joint not in known and not folded_spine([joint], known)}
        if not rotations:
            raise RealizerError(NoJoints(joints=tuple(sorted(lacking)), element="murmlgesture"))
        last = posed(rest, keys[-1].pose)
        joints = frozenset(rotations)
        fade_out = reach(last, rest, joints).preferred
        motion = (
            SuperposedFrames(added, keyframing.progress, fade_out, MurmlMotionUnit.fixed)
            if keyframing.added
            else MurmlMotionUnit(name, keys, rest, {}, fade_out)
        )
        motion.lacking = frozenset(lacking)
        return motion


class _Stroke:
    """The hands of a gesture along its stroke.

    Attributes:
        hands: that move.
        notes: faults of what the figure cannot do.
    """

    def __init__(self, tracks: Iterable[Track], context: MakerContext) -> None:
        self.notes: list[Fault] = []
        self._context = context
        self._skeleton = context.humanoid.avatar.skeleton
        self._marks = [mark for track in tracks for mark in track.marks]
        by_hand = {scope: [track for track in tracks if track.scope is scope] for scope in Scope}
        self.hands = [self._hand(scope, own) for scope, own in by_hand.items() if own]
        self.hands = [hand for hand in self.hands if hand.courses]

    def motion(self, name: str, rest: Body) -> MurmlMotionUnit:
        """Return the motion of the hands; its preferred durations follow from their ways."""
        courses = [positions for hand in self.hands for positions in hand.courses]
        positions = sorted({position for course in courses for position in course})
        first = {course[0] for course in courses}
        poses = [self._at(position) for position in positions]
        joints = frozenset(joint for pose in poses for joint in pose.joints)
        bodies = [rest, *(posed(rest, pose) for pose in poses), rest]
        ways = [reach(before, after, joints).preferred for before, after in pairwise(bodies)]
        times = list(accumulate(ways[:-1]))
        locations = {mark.position: mark.location for mark in reversed(self._marks)}
        keys = [
            Key(
                begins=times[number] - ways[number],
                reached=times[number],
                left=times[number] + (_KEPT if len(positions) == 1 else 0.0),
                profile=minimum_jerk,
                pose=poses[number],
                location=locations[position],
                way=None if position in first else self._way(positions[number - 1], position),
            )
            for number, position in enumerate(positions)
        ]
        named = {mark.id: times[positions.index(mark.position)] for mark in self._marks if mark.id}
        motion = MurmlMotionUnit(name, keys, rest, named, ways[-1])
        motion.planning_work += _WORK * len(keys)
        return motion

    def _at(self, position: float) -> JointPose:
        return SeveralPoses(tuple(hand.at(position) for hand in self.hands))

    def _way(self, begin: float, end: float) -> Callable[[float], JointPose]:
        return lambda done: self._at(begin + done * (end - begin))

    def _hand(self, scope: Scope, tracks: Iterable[Track]) -> HandTracks:
        """Return the courses of one hand; of a track that the figure cannot play, a note is kept."""
        by_slot = {track.slot: track for track in tracks}
        side = _SIDES[scope]
        place = shape = None
        if Slot.HAND_LOCATION in by_slot:
            marks = by_slot[Slot.HAND_LOCATION].marks
            bends = [mark.bend for mark in marks]
            place = place_course([mark.position for mark in marks], self._places(marks), bends)
        if Slot.HAND_SHAPE in by_slot:
            shapes = list(self._shapes(scope, by_slot[Slot.HAND_SHAPE].marks))
            shape = shape_course([position for position, _ in shapes], [pose for _, pose in shapes]) if shapes else None
        axes = hand_axes(side, self._skeleton)
        headings = [(axes[_AXES[slot]], _heading_course(by_slot[slot].marks)) for slot in _AXES if slot in by_slot]
        return HandTracks(side, place, headings, shape)

    def _places(self, marks: Sequence[Mark]) -> list[Vec3]:
        """Return the places of a hand, from the pelvis, m."""
        places: list[Vec3] = []
        for mark in marks:
            match mark.value:
                case GesturePlace() as place:
                    found = gesture_place(place.height, place.angle, place.distance, self._skeleton)
                    places.append(signed(found, place.signs))
                case Point() as point:
                    places.append(point.target)
                case Shift() as shift:
                    way = scale(unit(shift.direction), shift.distance * arm_length(self._skeleton))
                    places.append(add(places[-1] if places else ZERO, way))
                case Heading() | HandShape():
                    raise TypeError(mark)
        return places

    def _shapes(self, scope: Scope, marks: Iterable[Mark]) -> Iterable[tuple[float, Mapping[str, Quat]]]:
        for mark in marks:
            if isinstance(mark.value, HandShape):
                try:
                    yield mark.position, stored_pose(mark.value.pose, _HANDS[scope], self._context)
                except RealizerError as refused:
                    fault = refused.fault.located(mark.location.line, mark.location.column)
                    if fault not in self.notes:
                        self.notes.append(fault)


def _heading_course(marks: Sequence[Mark]) -> Course[Vec3]:
    directions = [unit(mark.value.direction) for mark in marks if isinstance(mark.value, Heading)]
    return direction_course([mark.position for mark in marks], directions)


def _turn(values: Sequence[float]) -> Quat:
    """Return the rotation of roll, pitch and yaw, degrees: about the axes ahead, to the left and up, in this order.

    As in AsapRealizer. The axes are those of the joint's parent; one number is a roll.
    """
    roll, pitch, yaw = (math.radians(angle) for angle in (*values, 0.0, 0.0)[:3])
    return from_euler(pitch, yaw, roll)
