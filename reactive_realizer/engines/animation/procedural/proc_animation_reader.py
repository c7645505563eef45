"""Reads ProcAnimation files, in AsapRealizer's format.

Two things are more general here: durations and key times may be formulas of the parameters, so that a nod repeated
three times lasts longer; and names that no Parameter declares are parameters of value 0, as they are there.
"""

import logging
from collections.abc import Iterable
from pathlib import Path

from reactive_realizer.binding.xml_file import Element, attribute, bad, number, read_xml
from reactive_realizer.engines.animation.expression.nodes import Node, Number, variables
from reactive_realizer.engines.animation.expression.parser import parse
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.engines.animation.procedural.tracks import EffectorTrack, Keyframe, KeyframeTrack, RotationTrack
from reactive_realizer.errors import RealizerError

_log = logging.getLogger(__name__)

_WRISTS = {"l_wrist": "l", "r_wrist": "r"}
_READ = ("Rotation", "EndEffector", "Keyframes", "KeyPosition", "Parameter")


def read_proc_animation(path: Path) -> ProcAnimation:
    """The animation in a file. What is not realized (other end effectors, SkeletonInterpolator) is logged and left out.

    Raises:
        RealizerError: "bad-asset", with file, line and element.
        OSError: the file cannot be read.
    """
    root = read_xml(path, "ProcAnimation")
    _note_unread(root, path.name)
    preferred = _formula(root, "prefDuration")
    durations = tuple(
        _formula(root, name) if name in root.attrib else preferred for name in ("minDuration", "maxDuration")
    )
    key_times = {attribute(key, "id"): _formula(key, "time") for key in root.iterfind("KeyPosition")}
    rotations = tuple(_rotation(element) for element in root.iterfind("Rotation"))
    effectors = tuple(_effector(element) for element in root.iterfind("EndEffector") if _side(element))
    keyframes = tuple(_keyframes(element) for element in root.iterfind("Keyframes"))
    times = [preferred, *durations, *key_times.values()]
    motion = [node for track in rotations for node in track.angles]
    motion += [node for track in effectors for node in track.path]
    motion += [node for track in keyframes for key in track.keyframes for node in key.rotation]
    return ProcAnimation(
        name=path.name,
        parameters=_parameters(root, times, motion),
        durations=(preferred, durations[0], durations[1]),
        key_times=key_times,
        rotations=rotations,
        effectors=effectors,
        keyframes=keyframes,
    )


def _note_unread(root: Element, file: str) -> None:
    for element in root:
        target = element.get("target", "")
        if element.tag not in _READ or (element.tag == "EndEffector" and not _side(element)):
            _log.info("%s, line %s: <%s %s> is not realized", file, element.sourceline, element.tag, target)


def _side(element: Element) -> str | None:
    return _WRISTS.get(attribute(element, "target"))


def _parameters(root: Element, times: Iterable[Node], motion: Iterable[Node]) -> dict[str, float]:
    declared = {attribute(element, "sid"): number(element, "value") for element in root.iterfind("Parameter")}
    if ProcAnimation.TIME in declared:
        raise bad(root, f"a parameter may not be called {ProcAnimation.TIME}")
    used = [name for formula in motion for name in variables(formula)]
    in_times = [name for formula in times for name in variables(formula)]
    if ProcAnimation.TIME in in_times:
        raise bad(root, "a duration or key time depends on t")
    missing = dict.fromkeys(name for name in [*in_times, *used] if name not in declared and name != ProcAnimation.TIME)
    return {**declared, **dict.fromkeys(missing, 0.0)}


def _rotation(element: Element) -> RotationTrack:
    return RotationTrack(attribute(element, "target"), _formulas(element, "rotation", 3))


def _effector(element: Element) -> EffectorTrack:
    swivel = _formula(element, "swivel") if "swivel" in element.attrib else Number(0.0)
    path = (*_formulas(element, "translation", 3), swivel)
    return EffectorTrack(_WRISTS[attribute(element, "target")], element.get("local") == "true", path)


def _keyframes(element: Element) -> KeyframeTrack:
    if element.get("encoding") != "quaternion":
        raise bad(element, "keyframes are read only with encoding='quaternion'")
    keys = [
        Keyframe(number(key, "time"), key.get("local") == "true", _formulas(key, "value", 4))
        for key in element.iterfind("Keyframe")
    ]
    if not keys:
        raise bad(element, "no Keyframe inside")
    return KeyframeTrack(attribute(element, "target"), tuple(sorted(keys, key=lambda key: key.phase)))


def _formula(element: Element, name: str) -> Node:
    return _parsed(element, name, attribute(element, name))


def _formulas(element: Element, name: str, size: int) -> tuple[Node, ...]:
    texts = attribute(element, name).split(";")
    if len(texts) != size:
        raise bad(element, f"{name} needs {size} formulas between semicolons, not {len(texts)}")
    return tuple(_parsed(element, name, text) for text in texts)


def _parsed(element: Element, name: str, text: str) -> Node:
    try:
        return parse(text)
    except RealizerError as problem:
        raise bad(element, f"{name}: {problem.fault.sentence}") from problem
