"""Reads ProcAnimation files, in AsapRealizer's format.

Some things are more general here: durations and key times may be formulas of the parameters, so that a nod repeated
three times lasts longer; ankles may be placed from the hip, and the root from where it is (`local`).
"""

import logging
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from reactive_realizer.binding.sync_id import by_sync_id
from reactive_realizer.binding.xml_file import Element, attribute, bad, boolean, number, read_xml
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.engines.animation.expression.compiler import fold
from reactive_realizer.engines.animation.expression.functions import FUNCTIONS, Function
from reactive_realizer.engines.animation.expression.nodes import Node, Number, variables
from reactive_realizer.engines.animation.expression.parser import parse
from reactive_realizer.engines.animation.keyframe.skeleton_interpolator import read_interpolator
from reactive_realizer.engines.animation.procedural.clip_track import ClipTrack
from reactive_realizer.engines.animation.procedural.effector_track import EFFECTORS, EffectorTrack
from reactive_realizer.engines.animation.procedural.encodings import ENCODINGS
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.engines.animation.procedural.tracks import (
    Keyframe,
    KeyframeTrack,
    RootTrack,
    RotationTrack,
    Track,
)
from reactive_realizer.errors import RealizerError

_log = logging.getLogger(__name__)

LONGEST = 100_000
"""Characters of all formulas of a file; it is read while figures move, and reading so many takes half a second."""

_ELEMENTS = ("SkeletonInterpolator", "Rotation", "EndEffector", "Keyframes", "KeyPosition", "Parameter")
_ROOTS = ("root", ROOT)


def read_proc_animation(path: Path, functions: Mapping[str, Function] = FUNCTIONS) -> ProcAnimation:
    """The animation in a file.

    Args:
        path: the file.
        functions: what its formulas may call.

    Raises:
        RealizerError: "bad-asset", with file, line and element.
        OSError: the file cannot be read.
    """
    return _Reader(functions).animation(read_xml(path, "ProcAnimation"), path.name)


class _Reader:
    """Reads elements of one file."""

    def __init__(self, functions: Mapping[str, Function]) -> None:
        self._functions = functions
        self._characters = 0

    def animation(self, document: Element, name: str) -> ProcAnimation:
        for element in document:
            if element.tag not in _ELEMENTS:
                raise bad(element, f"known are {', '.join(_ELEMENTS)}")
        preferred = self._formula(document, "prefDuration")
        shortest, longest = (
            self._formula(document, limit) if limit in document.attrib else preferred
            for limit in ("minDuration", "maxDuration")
        )
        match fold(shortest), fold(longest):
            case Number(least), Number(most) if least > most:
                raise bad(document, f"it lasts at least {least:g} s and at most {most:g} s")
        points = by_sync_id(document.iterfind("KeyPosition"))
        key_times = {sync: self._formula(key, "time") for sync, key in points.items()}
        root, tracks = self._root(document), tuple(self._tracks(document))
        motion = [*(root.formulas if root else ()), *(node for track in tracks for node in track.formulas)]
        parameters = _parameters(document, [preferred, shortest, longest, *key_times.values()], motion)
        if not motion and not tracks:
            raise bad(document, "it turns and moves nothing")
        return ProcAnimation(
            name=name,
            parameters=parameters,
            durations=(preferred, shortest, longest),
            key_times=key_times,
            root=root,
            tracks=tracks,
        )

    def _root(self, document: Element) -> RootTrack | None:
        roots = [element for element in document.iterfind("EndEffector") if attribute(element, "target") in _ROOTS]
        return (
            RootTrack(boolean(roots[-1], "local", False), self._formulas(roots[-1], "translation", 3))
            if roots
            else None
        )

    def _tracks(self, document: Element) -> Iterator[Track]:
        limbs = (element for element in document.iterfind("EndEffector") if element.get("target") not in _ROOTS)
        effectors = [self._effector(element) for element in limbs]
        led = frozenset().union(*(effector.led for effector in effectors))
        # In AsapRealizer's order: of what turns one joint, the last prevails.
        yield from (self._clip(element) for element in document.iterfind("SkeletonInterpolator"))
        turned: list[KeyframeTrack | RotationTrack] = [
            *(self._keyframes(element) for element in document.iterfind("Keyframes")),
            *(self._rotation(element) for element in document.iterfind("Rotation")),
        ]
        for track in turned:
            if track.joint in led:
                _log.info("%s is where an EndEffector wants it; what else turns it is left out", track.joint)
            else:
                yield track
        yield from effectors

    def _clip(self, element: Element) -> ClipTrack:
        clip = read_interpolator(element)
        if clip.roots is not None:
            raise bad(element, f"encoding='{element.get('encoding')}': in a ProcAnimation only R is read")
        return ClipTrack(clip)

    def _rotation(self, element: Element) -> RotationTrack:
        return RotationTrack(
            attribute(element, "target"), boolean(element, "local", True), self._formulas(element, "rotation", 3)
        )

    def _effector(self, element: Element) -> EffectorTrack:
        target = attribute(element, "target")
        if target not in EFFECTORS:
            raise bad(element, f"no end effector '{target}'; known are {', '.join((*EFFECTORS, *_ROOTS))}")
        swivel = self._formula(element, "swivel") if element.get("swivel", "").strip() else Number(0.0)
        path = (*self._formulas(element, "translation", 3), swivel)
        return EffectorTrack(*EFFECTORS[target], boolean(element, "local", False), path)

    def _keyframes(self, element: Element) -> KeyframeTrack:
        encoding = ENCODINGS.get(attribute(element, "encoding"))
        if encoding is None:
            raise bad(element, f"encoding='{element.get('encoding')}': known are {', '.join(ENCODINGS)}")
        keys = [
            Keyframe(number(key, "time"), boolean(key, "local", True), self._formulas(key, "value", encoding.size))
            for key in element.iterfind("Keyframe")
        ]
        if not keys:
            raise bad(element, "no Keyframe inside")
        return KeyframeTrack(attribute(element, "target"), encoding, tuple(sorted(keys, key=lambda key: key.phase)))

    def _formula(self, element: Element, name: str) -> Node:
        return self._parsed(element, name, attribute(element, name))

    def _formulas(self, element: Element, name: str, size: int) -> tuple[Node, ...]:
        texts = attribute(element, name).split(";")
        if len(texts) != size:
            raise bad(element, f"{name} needs {size} formulas between semicolons, not {len(texts)}")
        return tuple(self._parsed(element, name, text) for text in texts)

    def _parsed(self, element: Element, name: str, text: str) -> Node:
        self._characters += len(text)
        if self._characters > LONGEST:
            raise bad(element, f"{name}: more than {LONGEST} characters of formulas in one file")
        try:
            return parse(text, self._functions)
        except RealizerError as problem:
            raise bad(element, f"{name}: {problem.fault.sentence}") from problem


def _parameters(document: Element, times: Iterable[Node], motion: Iterable[Node]) -> dict[str, float]:
    """Names and values; a name that no Parameter declares is one of value 0, as in AsapRealizer."""
    declared = {attribute(element, "sid"): number(element, "value") for element in document.iterfind("Parameter")}
    if ProcAnimation.TIME in declared:
        raise bad(document, f"a parameter may not be called {ProcAnimation.TIME}")
    in_times = [name for formula in times for name in variables(formula)]
    if ProcAnimation.TIME in in_times:
        raise bad(document, "a duration or key time depends on t")
    used = [*in_times, *(name for formula in motion for name in variables(formula))]
    return {**declared, **dict.fromkeys((name for name in used if name not in declared | {ProcAnimation.TIME: 0}), 0.0)}
