"""Reads the key poses inside a behavior."""

from collections.abc import Sequence
from typing import Any

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.faults import DuplicateId, MissingElement
from reactive_realizer.bml.key_poses import GOALS, KeyPose, KeyPoseGoal, KeyPoses
from reactive_realizer.bml.motion_faults import BeyondLimit, HeldCurve, PoseTooEarly
from reactive_realizer.bml.trees import Tree, children_of, name_of
from reactive_realizer.errors import Fault, RealizerError

_GOALS = {kind.ELEMENT: kind for kind in GOALS}


def read_key_poses(tree: Tree, source: BlockSource, notes: list[Fault]) -> dict[str, Any]:
    """The key poses of a behavior; those that cannot be read are left out with a note.

    Raises:
        RealizerError: there are none, or the first one that cannot be read.
    """
    poses: list[KeyPose] = []
    before, goals, most = len(notes), 0, source.limits.goals_per_behavior
    for child in children_of(tree, KeyPose.ELEMENT):
        goals += len(children_of(child, *_GOALS))
        if goals > most:
            beyond = BeyondLimit(element=KeyPose.ELEMENT, limit=most, things="goals", key="goals_per_behavior")
            notes.append(source.located(child, beyond))
            break
        try:
            poses.append(_key_pose(child, poses, source, notes))
        except RealizerError as refused:
            notes.append(refused.fault)
    if not poses and len(notes) > before:
        raise RealizerError(notes[before])
    if not poses:
        missing = MissingElement(element=name_of(tree), children=f"<{KeyPose.ELEMENT}>")
        raise RealizerError(source.located(tree, missing))
    return {"poses": tuple(poses)}


def _key_pose(tree: Tree, poses: Sequence[KeyPose], source: BlockSource, notes: list[Fault]) -> KeyPose:
    attributes = attributes_of(KeyPose)
    notes += source.unknown_content(tree, [each.name for each in attributes], _GOALS)
    values = source.values(tree, attributes)
    if values.get("id") in {*KeyPoses.SYNC_POINTS, *(pose.id for pose in poses if pose.id)}:
        raise RealizerError(source.located(tree, DuplicateId(element=name_of(tree), id=values["id"])))
    last = poses[-1] if poses else None
    earliest = 0.0 if last is None else last.time + last.hold
    if values["time"] < earliest:
        raise RealizerError(source.located(tree, PoseTooEarly(time=values["time"], earliest=earliest)))
    goals: list[KeyPoseGoal] = []
    for child in children_of(tree, *_GOALS):
        try:
            goals.append(_goal(child, source, notes))
        except RealizerError as refused:
            notes.append(refused.fault)
    if not goals:
        wanted = " or ".join(f"<{name}>" for name in _GOALS)
        raise RealizerError(source.located(tree, MissingElement(element=name_of(tree), children=wanted)))
    pose = KeyPose(**values, goals=tuple(goals), location=source.location(tree))
    if pose.hold > 0.0 and pose.curve:
        notes.append(source.located(tree, HeldCurve(attributes=tuple(pose.curve))))
    return pose


def _goal(tree: Tree, source: BlockSource, notes: list[Fault]) -> KeyPoseGoal:
    kind = _GOALS[name_of(tree)]
    attributes = attributes_of(kind)
    notes += source.unknown_content(tree, [each.name for each in attributes])
    return kind(**source.values(tree, attributes), location=source.location(tree))
