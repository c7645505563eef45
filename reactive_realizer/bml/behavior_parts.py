"""Reads the child elements of behaviors: texts, expressions, poses, trajectories, keyframes, parameters."""

import re
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any, Final

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Face, Pose, Posture, Stance
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.extensions import BehaviorParameter, ParameterValueChange, Trajectory
from reactive_realizer.bml.faults import DuplicateId, EventTooLong, MissingElement, RepeatedElement
from reactive_realizer.bml.names import OWN
from reactive_realizer.bml.speech import Mark, MarkTime, SoundStream, Speech
from reactive_realizer.bml.speech_faults import UnknownMark, UtteranceTooLong
from reactive_realizer.bml.trees import PARAMETER, Tree, children_of, is_core, name_of
from reactive_realizer.bml.vocabulary import PosePart
from reactive_realizer.errors import Fault, RealizerError

_MARK: Final = "sync"
_MARK_ATTRIBUTES: Final = tuple(each.name for each in attributes_of(Mark))
_RECORDING_FILES: Final = {"file": ("ref",), "audiofile": ("filename", "fileName")}
"""The elements that name the file of a recording, and the attributes that hold its name."""


def read_speech(tree: Tree, source: BlockSource, notes: list[Fault]) -> dict[str, Any]:
    """The text and the marks of a speech, from its ``<text>``.

    Raises:
        RealizerError: there is not exactly one text, or it is too long.
    """
    text_element = _only_text(tree, source)
    notes += source.unknown_parts(text_element, [], [_MARK])
    text = ""
    places: dict[str, int] = {}
    times: dict[str, float | None] = {}
    for piece in _pieces(text_element):
        if isinstance(piece, str):
            text = _joined(text, piece)
            _check_length(text, text_element, source)
        else:
            notes += source.unknown_parts(piece, _MARK_ATTRIBUTES)
            try:
                values = _new_mark(piece, places, source)
                places[values["id"]], times[values["id"]] = len(text), values.get("time")
            except RealizerError as refused:
                notes.append(refused.fault)
    text = text.rstrip()
    marks = tuple(Mark(id=id_, time=times[id_], char_index=min(at, len(text))) for id_, at in places.items())
    return {"text": text, "marks": marks}


def read_recording(description: Tree, marks: Sequence[Mark], source: BlockSource) -> dict[str, Any] | None:
    """The file of a speech that is described as audio, and the times of its marks; None for another description.

    The file is the one of ``<file ref="..."/>``, in any namespace and at any depth, as in the thesis (example 5) and in
    SmartBody's speech files, or that of a ``<bmlt:audiofile>``.

    Raises:
        RealizerError: a time is bad, or the speech has no such mark.
    """
    references = ((name_of(each), each) for each in description.iterdescendants())
    names = (each.get(attribute) for name, each in references for attribute in _RECORDING_FILES.get(name, ()))
    file_name = next((name for name in names if name is not None), None)
    if file_name is None:
        return None
    known = tuple(mark.id for mark in marks)
    times = {mark.id: MarkTime(id=mark.id, time=mark.time) for mark in marks if mark.time is not None}
    for sync in description.iterdescendants("{*}sync"):
        time = MarkTime(**source.values(sync, attributes_of(MarkTime)))
        if time.id not in known:
            raise RealizerError(source.located(sync, UnknownMark(mark=time.id, known=known)))
        times[time.id] = time
    return {"file_name": file_name, "mark_times": tuple(times.values())}


def read_stream(description: Tree, source: BlockSource, notes: list[Fault]) -> SoundStream | None:
    """The stream of a speech that is described as one: its ``<stream>`` in our own namespace; None without one.

    Raises:
        RealizerError: an attribute is missing or bad.
    """
    stream = description.find(f"{{{OWN}}}stream")
    return None if stream is None else SoundStream(**_values(stream, SoundStream, source, notes))


def read_face(tree: Tree, source: BlockSource, notes: list[Fault]) -> dict[str, Any]:
    """The expressions of a face.

    Raises:
        RealizerError: there are none, or one is bad.
    """
    parts = children_of(tree, *Face.CHILDREN)
    _check_some(parts, tree, Face.CHILDREN, source)
    return {"parts": tuple(_expression(part, source, notes) for part in parts)}


def read_posture(tree: Tree, source: BlockSource, notes: list[Fault]) -> dict[str, Any]:
    """The stance and the poses of a posture.

    Raises:
        RealizerError: there are none, there are two for one part of the body, or one is bad.
    """
    stances, poses = children_of(tree, "stance"), children_of(tree, "pose")
    _check_some(stances + poses, tree, Posture.CHILDREN, source)
    if len(stances) > 1:
        raise _repeated(stances[1], "stance", tree, source)
    stance = Stance(**_values(stances[0], Stance, source, notes)).type if stances else None
    by_part: dict[PosePart, Pose] = {}
    for child in poses:
        pose = Pose(**_values(child, Pose, source, notes))
        if pose.part in by_part:
            raise _repeated(child, f"pose part='{pose.part}'", tree, source)
        by_part[pose.part] = pose
    return {"stance": stance, "poses": tuple(by_part.values())}


def read_trajectory(tree: Tree, source: BlockSource, notes: list[Fault]) -> dict[str, Any]:
    """The trajectory of a parameter value change.

    Raises:
        RealizerError: there is none, there are two, or it is bad.
    """
    trajectories = children_of(tree, "trajectory")
    _check_some(trajectories, tree, ParameterValueChange.CHILDREN, source)
    if len(trajectories) > 1:
        raise _repeated(trajectories[1], "trajectory", tree, source)
    return {"trajectory": Trajectory(**_values(trajectories[0], Trajectory, source, notes))}


def read_interpolator(tree: Tree, source: BlockSource, notes: list[Fault]) -> dict[str, Any]:
    """The interpolator inside a keyframe animation of the body or the face, None if there is none.

    Raises:
        RealizerError: there are two.
    """
    written = children_of(tree, *ELEMENTS[name_of(tree)].children)
    if len(written) > 1:
        raise _repeated(written[1], name_of(written[1]), tree, source)
    return {"interpolator": source.xml(written[0]) if written else None}


def read_event(tree: Tree, source: BlockSource, notes: list[Fault]) -> dict[str, Any]:
    """The content of an emitted event.

    Raises:
        RealizerError: it is too long.
    """
    content, limit = source.content(tree), source.limits.event_characters
    if len(content) > limit:
        raise RealizerError(source.located(tree, EventTooLong(limit=limit)))
    return {"content": content}


def read_parameters(tree: Tree, source: BlockSource, notes: list[Fault]) -> Mapping[str, str]:
    """The parameters that a behavior gives to its engine, name to value (thesis C.1.1).

    Raises:
        RealizerError: one is repeated or bad.
    """
    parameters: dict[str, str] = {}
    for child in children_of(tree, PARAMETER):
        parameter = BehaviorParameter(**_values(child, BehaviorParameter, source, notes))
        if parameter.name in parameters:
            raise _repeated(child, f"{PARAMETER} name='{parameter.name}'", tree, source)
        parameters[parameter.name] = parameter.value
    return MappingProxyType(parameters)


def _only_text(tree: Tree, source: BlockSource) -> Tree:
    texts = children_of(tree, "text")
    if not texts:
        raise RealizerError(source.located(tree, MissingElement(element=name_of(tree), children="<text>")))
    if len(texts) > 1:
        raise RealizerError(source.located(texts[1], RepeatedElement(element=name_of(texts[1]), parent=name_of(tree))))
    return texts[0]


def _pieces(text_element: Tree) -> Iterator[str | Tree]:
    """Text and inline sync points in document order; other elements give their text only."""
    yield text_element.text or ""
    for child in text_element:
        if is_core(child) and name_of(child) == _MARK:
            yield child
        yield "".join(map(str, child.itertext()))
        yield child.tail or ""


def _joined(text: str, piece: str) -> str:
    """Both, with single spaces and none at the beginning."""
    spaced = re.sub(r"\s+", " ", piece)
    return text + (spaced.lstrip() if not text or text.endswith(" ") else spaced)


def _check_length(text: str, text_element: Tree, source: BlockSource) -> None:
    limit = source.limits.utterance_characters
    if len(text.rstrip()) > limit:
        raise RealizerError(source.located(text_element, UtteranceTooLong(limit=limit)))


def _new_mark(sync: Tree, taken: Container[str], source: BlockSource) -> dict[str, Any]:
    """The values of the attributes of a mark."""
    values = source.values(sync, attributes_of(Mark))
    name = values["id"]
    if name in taken or name in Speech.SYNC_POINTS:
        raise RealizerError(source.located(sync, DuplicateId(element=name_of(sync), id=name)))
    return values


def _expression(tree: Tree, source: BlockSource, notes: list[Fault]) -> Behavior:
    """A part of a face, which needs no id and has no sync points."""
    element = ELEMENTS[name_of(tree)]
    attributes = [each for each in element.attributes if each.field != "id"]
    notes += source.unknown_content(tree, ["id", *(each.name for each in attributes)])
    values = source.element_fields(tree) | source.values(tree, attributes)
    return element.behavior(**values, id=tree.get("id", ""), namespace=element.namespace, order=0)


def _values(tree: Tree, kind: type, source: BlockSource, notes: list[Fault]) -> dict[str, Any]:
    attributes = attributes_of(kind)
    notes += source.unknown_content(tree, [each.name for each in attributes])
    return source.values(tree, attributes)


def _check_some(parts: list[Tree], tree: Tree, names: Iterable[str], source: BlockSource) -> None:
    if not parts:
        wanted = " or ".join(f"<{name}>" for name in names)
        raise RealizerError(source.located(tree, MissingElement(element=name_of(tree), children=wanted)))


def _repeated(child: Tree, element: str, tree: Tree, source: BlockSource) -> RealizerError:
    return RealizerError(source.located(child, RepeatedElement(element=element, parent=name_of(tree))))
