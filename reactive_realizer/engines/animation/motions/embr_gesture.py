"""Gestures of EMBOTS' lexicon: one file of EMBRScript each, with sync points of BML in its comments."""

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np

from reactive_realizer.binding.asset_file import first_asset, read_bytes
from reactive_realizer.binding.faults import BadAsset
from reactive_realizer.bml.embr.lexeme import EmbrLexeme, read_lexeme
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.names import Location
from reactive_realizer.bml.vocabulary import Mode
from reactive_realizer.embodiment.body import Body
from reactive_realizer.engines.animation.easing import minimum_jerk
from reactive_realizer.engines.animation.faults import NoGoals
from reactive_realizer.engines.animation.key_poses.solved_pose import SeveralPoses, SolvedPose
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_unit import NAME
from reactive_realizer.engines.animation.motions.key_pose_gesture import KeyPoseGesture, posed
from reactive_realizer.engines.animation.motions.key_poses import Key
from reactive_realizer.engines.animation.motions.pose_goals import PoseGoals
from reactive_realizer.engines.animation.motions.reaching import reach
from reactive_realizer.errors import Fault, RealizerError

_HANDS = {Mode.LEFT_HAND: ("_LH",), Mode.RIGHT_HAND: ("_RH",), Mode.BOTH_HANDS: ("_2H",)}
"""The ends of the names of files with these hands."""
_ANY_HANDS = ("_RH", "_2H", "_LH")

Solved = Mapping[float, SolvedPose]
"""The states of one body group by their times, s."""


class EmbrGestureMaker:
    """Makes gestures of EMBRScript. Goals that the figure cannot have are left out with a note each."""

    def __init__(self, context: MakerContext) -> None:
        self._context = context

    def __call__(self, request: MotionRequest) -> KeyPoseGesture:
        """Make a gesture.

        Raises:
            RealizerError: there is no such file, or nothing of it can be played.
        """
        path = self._file(request)
        lexeme = _read_file(path, path.stat().st_mtime_ns)
        rest, notes = self._context.rest.body, list(lexeme.notes)
        groups = [self._solved(group, rest, notes) for group in lexeme.groups]
        keys, times = _paced(list(_keys(lexeme.holds, groups, request.behavior.location)), rest)
        faults = tuple(_in_file(note, path.name) for note in notes)
        if not keys:
            raise RealizerError(NoGoals(reasons=tuple(fault.sentence for fault in faults)))
        last = posed(rest, keys[-1].pose)
        retraction = reach(last, rest, keys[-1].pose.joints).preferred
        points = {sync: float(np.interp(time, *times)) for sync, time in lexeme.points.items()}
        motion = KeyPoseGesture(request.behavior.id, keys, rest, points, retraction)
        motion.notes = faults
        return motion

    def _file(self, request: MotionRequest) -> Path:
        """Return the file of a request; the name of a gesture may lack the end that says which hands it has.

        Raises:
            RealizerError: there is no such file, or there are two.
        """
        name = request.parameters.get(NAME)
        if request.file is not None or name is None:
            return self._context.file_of(request, "embr")
        mode = getattr(request.behavior, "mode", None)
        ends = ("", *(_ANY_HANDS if mode is None else _HANDS[mode]))
        return first_asset(self._context.asset, *(f"**/{name}{end}.embr" for end in ends))

    def _solved(self, group: KeyPoses, rest: Body, notes: list[Fault]) -> Solved:
        goals = PoseGoals(group.group, self._context, rest)
        poses = {pose.time: goals.solved(pose.goals) for pose in group.poses}
        notes.extend(goals.notes)
        return {time: pose for time, pose in poses.items() if pose is not None}


def _keys(holds: Sequence[tuple[float, float]], groups: Sequence[Solved], location: Location) -> Iterator[Key]:
    """Yield the key poses of all groups together; a group without goals at one keeps the pose that it had before."""
    begins = 0.0
    current: dict[int, SolvedPose] = {}
    for reached, left in holds:
        new = {number: group[reached] for number, group in enumerate(groups) if reached in group}
        if new:
            current |= new
            pose = SeveralPoses(tuple(current.values()))
            yield Key(begins, reached, left, minimum_jerk, pose, location)
            begins = left


def _paced(keys: Sequence[Key], rest: Body) -> tuple[list[Key], tuple[list[float], list[float]]]:
    """Give ways that are shorter than people need the time that they need.

    Returns:
        The key poses; and the times before and after this between which other times follow linearly, s.
    """
    paced: list[Key] = []
    before, body = 0.0, rest
    written, given = [0.0], [0.0]
    for key in keys:
        there = posed(rest, key.pose)
        way = max(key.reached - key.begins, reach(body, there, key.pose.joints).shortest)
        reached, left = before + way, before + way + (key.left - key.reached)
        paced.append(key._replace(begins=before, reached=reached, left=left))
        written += [key.reached, key.left]
        given += [reached, left]
        before, body = left, there
    return paced, (written, given)


@lru_cache(256)
def _read_file(path: Path, changed: int) -> EmbrLexeme:
    try:
        return read_lexeme(read_bytes(path))
    except RealizerError as refused:
        raise RealizerError(_in_file(refused.fault, path.name)) from None


def _in_file(fault: Fault, file: str) -> Fault:
    """Return a fault with a line of an asset, which is none of a BML block."""
    return BadAsset(file=file, row=fault.line, element="gesture", reason=fault.sentence)
