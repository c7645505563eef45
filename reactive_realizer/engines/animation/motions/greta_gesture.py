"""Gestures of Greta's gestuaries as key poses: hands go from phase to phase, straight or on trajectories."""

from collections.abc import Callable, Sequence
from itertools import accumulate, pairwise
from typing import Final

from reactive_realizer.binding.gestuary import Gestuary
from reactive_realizer.binding.gestuary_phases import Phase, Wave, filled
from reactive_realizer.bml.behaviors import Gesture
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.vocabulary import BodyAxis, Mode
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import SIDES
from reactive_realizer.embodiment.quaternion import rotate, slerp
from reactive_realizer.embodiment.vector import ZERO, add, distance, scale, subtract
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.faults import NoGoals
from reactive_realizer.engines.animation.key_poses.arm_pose import ArmGoals, hand_axes
from reactive_realizer.engines.animation.key_poses.direction import Direction
from reactive_realizer.engines.animation.key_poses.solved_pose import SeveralPoses, SolvedPose
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motions.greta_hands import GretaFigure, HandState
from reactive_realizer.engines.animation.motions.key_pose_gesture import KeyPoseGesture, posed
from reactive_realizer.engines.animation.motions.key_poses import Key
from reactive_realizer.engines.animation.motions.library_names import from_library
from reactive_realizer.engines.animation.motions.reaching import reach
from reactive_realizer.errors import RealizerError

_GESTUARY = "gestuary.xml"
"""The name of this file in Greta."""

_KEPT = 0.4
"""Duration of a stroke in which the hands only keep a pose, s."""
_HELD = 0.5
"""Duration of the hold after a stroke, in durations of the stroke, as in Greta."""
_STEPS = 16
"""Parts of a trajectory by which its length is measured."""
_PREPARED, _PER_METER = 0.25, 0.75
"""Duration of a way on a trajectory: at its start and end, s, and per meter of it (`reach`)."""

_SIDE_OF: Final = {Mode.LEFT_HAND: "l", Mode.RIGHT_HAND: "r"}


class GretaGestureMaker:
    """Makes gestures of a gestuary. What the figure cannot do is left out with a note each."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> KeyPoseGesture:
        """Make a gesture.

        Raises:
            RealizerError: there is no such file or gesture, or nothing of it can be played.
        """
        behavior, context = request.behavior, self._context
        gestuary = self._gestuary(request.file)
        gesture = from_library(request, gestuary.gesture)
        phases = with_hands(gesture.phases, behavior.mode if isinstance(behavior, Gesture) else None)
        figure = GretaFigure(context, gestuary.file)
        hands = [hand for side in SIDES if (hand := _Hand(side, phases, figure)).states]
        notes = tuple({fault.sentence: fault for fault in (*gesture.faults, *figure.notes)}.values())
        if not any(state.asks for hand in hands for state in hand.states.values()):
            reasons = tuple(fault.sentence for fault in notes) or (f"{gesture.id} has no phases in {gestuary.file}",)
            raise RealizerError(notes[0] if len(notes) == 1 else NoGoals(reasons=reasons))
        motion = _motion(behavior.id, hands, context.rest.body, behavior.location)
        motion.notes = notes
        return motion

    def names(self, file: str | None) -> tuple[str, ...]:
        """Return the ids of the gestures of a file.

        Raises:
            RealizerError: there is no such file, or it is invalid.
        """
        return tuple(gesture.id for gesture in self._gestuary(file).gestures)

    def _gestuary(self, file: str | None) -> Gestuary:
        return Gestuary.read(self._context.asset(file or f"**/{_GESTUARY}"))


def with_hands(phases: Sequence[Phase], mode: Mode | None) -> list[Phase]:
    """Return phases of the hands that a behavior names: mirrored if they are for the other hand; all without a mode."""
    if mode is None:
        return list(phases)
    has = {hand.side for phase in phases for hand in phase}
    if mode is Mode.BOTH_HANDS:
        both = len(has) > 1
        return [phase if both else (*phase, *(hand.mirrored() for hand in phase)) for phase in phases]
    side = _SIDE_OF[mode]
    if side in has:
        return [tuple(hand for hand in phase if hand.side == side) for phase in phases]
    return [tuple(hand.mirrored() for hand in phase) for phase in phases]


class _Hand:
    """One hand along a gesture.

    Attributes:
        states: by the number of the phase, from the first one that the hand has.
        begins: the number of the first phase.
    """

    def __init__(self, side: str, phases: Sequence[Phase], figure: GretaFigure) -> None:
        self.states = {phase: figure.state(hand) for phase, hand in filled(phases, side).items()}
        self.begins = min(self.states, default=0)
        self._side = side
        self._arm = figure.arm
        self._axes = hand_axes(side, figure.skeleton)

    def at(self, phase: int, done: float = 1.0) -> SolvedPose:
        """Return the hand after a share of the way to a phase."""
        there = self.states[phase]
        if done == 1.0:
            return self._pose(there)
        return self._pose(self._between(self.states[phase - 1], there, done))

    def moves_freely(self, phase: int) -> bool:
        """Return whether there are no states on the way to a phase: the hand begins there, or it changes in kind."""
        return phase <= self.begins or self.states[phase - 1].kind != self.states[phase].kind

    def length(self, phase: int) -> float:
        """Return the length of the way to a phase if it is a trajectory, m; otherwise 0."""
        if self.moves_freely(phase) or not self.states[phase - 1].waves:
            return 0.0
        start, goal = self.states[phase - 1], self.states[phase]
        places = [self._between(start, goal, step / _STEPS).place or ZERO for step in range(_STEPS + 1)]
        return sum(distance(a, b) for a, b in pairwise(places))

    def _between(self, start: HandState, goal: HandState, done: float) -> HandState:
        place = turn = None
        if start.place is not None and goal.place is not None:
            straight = add(start.place, scale(subtract(goal.place, start.place), done))
            x, y, z = (wave.off(done) for wave in start.waves or (Wave(0.0),) * 3)
            place = add(straight, scale((x if self._side == "l" else -x, y, z), self._arm))
        if start.turn is not None and goal.turn is not None:
            turn = slerp(start.turn, goal.turn, done)
        return goal._replace(
            place=place,
            turn=turn,
            swivel=start.swivel + done * (goal.swivel - start.swivel),
            fingers={j: slerp(start.fingers.get(j, to), to, done) for j, to in goal.fingers.items()},
        )

    def _pose(self, state: HandState) -> SolvedPose:
        stored = dict(state.fingers)
        directions: tuple[Direction, ...] = ()
        if state.turn is not None and state.of_figure:
            turned = state.turn
            axes = (self._axes[axis] for axis in (BodyAxis.FINGERS, BodyAxis.PALM))
            directions = tuple(Direction(axis, rotate(turned, axis)) for axis in axes)
        elif state.turn is not None:
            stored[f"{self._side}_wrist"] = state.turn
        elif state.palm is not None:
            directions = (Direction(self._axes[BodyAxis.PALM], state.palm),)
        if state.place is None and not directions:
            return SolvedPose(stored)
        return SolvedPose(stored, arm=ArmGoals(self._side, state.place, state.tip, directions, state.swivel))


def _motion(name: str, hands: Sequence[_Hand], rest: Body, location: Location) -> KeyPoseGesture:
    """Return the motion of hands; its preferred durations follow from their ways."""
    numbers = sorted({number for hand in hands for number in hand.states})

    def pose(number: int, done: float = 1.0) -> SeveralPoses:
        return SeveralPoses(tuple(hand.at(number, done) for hand in hands if number in hand.states))

    poses = [pose(number) for number in numbers]
    joints = frozenset(joint for each in poses for joint in each.joints)
    bodies = [rest, *(posed(rest, each) for each in poses), rest]
    ways = [reach(before, after, joints).preferred for before, after in pairwise(bodies)]
    for index, number in enumerate(numbers):
        length = max(hand.length(number) for hand in hands if number in hand.states)
        ways[index] = max(ways[index], _PREPARED + _PER_METER * length if length else 0.0)
    times = list(accumulate(ways[:-1]))
    held = _HELD * (times[-1] - times[0]) if len(times) > 1 else _KEPT

    def way(number: int) -> Callable[[float], SeveralPoses] | None:
        if any(hand.moves_freely(number) for hand in hands if number in hand.states):
            return None
        return lambda done: pose(number, done)

    keys = [
        Key(
            begins=times[index] - ways[index],
            reached=times[index],
            left=times[index] + (held if index == len(numbers) - 1 else 0.0),
            profile=minimum_jerk,
            pose=poses[index],
            location=location,
            way=way(number),
        )
        for index, number in enumerate(numbers)
    ]
    return KeyPoseGesture(name, keys, rest, {}, ways[-1])
