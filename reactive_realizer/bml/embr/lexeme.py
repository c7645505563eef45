"""Lexemes of EMBOTS: gestures as pose sequences of EMBRScript, with the sync points of BML in comments."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Final, NamedTuple

from reactive_realizer.bml.embr.faults import NoSequence, TimeBack, TooManyPoses, UnknownName
from reactive_realizer.bml.embr.nucleus import Nuclei
from reactive_realizer.bml.embr.sequence import SequenceReader
from reactive_realizer.bml.embr.syntax import SEQUENCE, read_nodes, text_of
from reactive_realizer.bml.embr.timeline import Timed, timed
from reactive_realizer.bml.embr.values import Notes
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.motion_faults import GivenTwice
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.limits import Limits

_MOST_POSES: Final = 200
"""Limit of the poses of a gesture; EMBOTS's have up to ten."""
_START, _END = "start", "end"
_POINTS: Final[Mapping[str, str]] = MappingProxyType(
    {
        "ready": "ready",
        "stroke_start": "strokeStart",
        "stroke": "stroke",
        "stroke_end": "strokeEnd",
        "relax": "relax",
    }
)
"""Label of a pose -> the sync point of BML at its time."""


class EmbrLexeme(NamedTuple):
    """A gesture, from its preparation until it relaxes. Times count from its start, s.

    Attributes:
        groups: the key poses of each body group; all start with the gesture.
        holds: for each key pose, its time and the end of its hold, in order.
        points: sync id -> time.
        notes: faults of what is left out.
    """

    groups: tuple[KeyPoses, ...]
    holds: tuple[tuple[float, float], ...]
    points: Mapping[str, float]
    notes: tuple[Fault, ...]


def read_lexeme(document: str | bytes) -> EmbrLexeme:
    """Return the gesture of a file.

    Poses up to the one with the label ``start``, and from the one with the label ``end``, are rest poses of EMBR's
    figures: the gesture is prepared from the current pose instead, and retracted to the rest pose of the character. As
    in EMBOTS, the stroke begins after the hold of ``ready``, and the gesture relaxes after that of ``stroke_end``;
    without a ``stroke_end``, the hold of ``ready`` is the stroke.

    Raises:
        RealizerError: there is no sequence with a key pose of the body: "embr-no-sequence", or the first fault of the
            file; "embr-too-many-poses".
    """
    script, faults = read_nodes(text_of(document))
    sequences = [node for node in script.children if node.name == SEQUENCE]
    if not sequences:
        raise RealizerError(faults[0] if faults else NoSequence(line=1, column=1))
    sequence, *others = sequences
    notes, all_times = Notes(Limits()), Notes(Limits())
    notes.faults += faults
    for other in others:
        notes.left_out("another K_POSE_SEQUENCE", "a gesture has only one", other.location)
    if len(sequence.children) > _MOST_POSES:
        place = sequence.location
        raise RealizerError(
            TooManyPoses(poses=len(sequence.children), limit=_MOST_POSES).located(place.line, place.column)
        )
    poses = list(timed(sequence, 0.0, all_times))
    _note_doubles(poses, notes)
    notes.faults += (each for each in all_times.faults if not isinstance(each, TimeBack))  # those are found again below
    begin = next((pose.reached for pose in poses if pose.node.sync == _START), 0.0)
    stroke = _between_rest_poses(poses)
    kept = replace(sequence, children=[pose.node for pose in stroke])
    groups = []
    for behavior in SequenceReader(kept, "gesture", Nuclei(script.children, notes), notes).behaviors():
        if isinstance(behavior, KeyPoses):
            moved = tuple(replace(pose, time=round(pose.time - begin, 6)) for pose in behavior.poses)
            groups.append(replace(behavior, poses=moved))
        else:
            notes.left_out(f"<{behavior.name}>", "a gesture has only key poses of the body", behavior.location)
    if not groups:
        raise RealizerError(notes.faults[0] if notes.faults else NoSequence(line=1, column=1))
    holds = tuple((round(pose.reached - begin, 6), round(pose.left - begin, 6)) for pose in stroke)
    points = {sync: round(time - begin, 6) for sync, time in _points(stroke, notes).items()}
    return EmbrLexeme(tuple(groups), holds, points, tuple(notes.faults))


def _between_rest_poses(poses: Sequence[Timed]) -> Sequence[Timed]:
    labels = [pose.node.sync for pose in poses]
    first = labels.index(_START) + 1 if _START in labels else 0
    last = labels.index(_END) if _END in labels else len(labels)
    return poses[first:last]


def _note_doubles(poses: Iterable[Timed], notes: Notes) -> None:
    """Note labels that several poses have."""
    seen: set[str] = set()
    for pose in poses:
        label = pose.node.sync
        if label in seen:
            counting = "the first one" if label in (_START, _END) else "this one"
            notes.add(GivenTwice(what=f"SYNC:{label}", counting=counting), pose.node.location)
        seen |= {label} if label else set()


def _points(stroke: Iterable[Timed], notes: Notes) -> dict[str, float]:
    points: dict[str, float] = {}
    labels: dict[str, Timed] = {}
    for pose in stroke:
        if pose.node.sync in _POINTS:
            labels[pose.node.sync] = pose
            points[_POINTS[pose.node.sync]] = pose.reached
        elif pose.node.sync not in ("", _START, _END):
            fault = UnknownName(kind="SYNC", name=pose.node.sync, known=(_START, *_POINTS, _END))
            notes.add(fault, pose.node.location)
    implied: dict[str, float] = {}
    if (last := labels.get("stroke_end")) is not None:
        implied["relax"] = last.left
    if (ready := labels.get("ready")) is not None:
        implied |= {"strokeStart": ready.left} if last is not None else {"strokeEnd": ready.left, "relax": ready.left}
    return {**implied, **points}
