"""Reads ProcAnimation files in AsapRealizer's format, and caches them.

The format is extended: durations and key times may be formulas of the parameters, so a nod that repeats three times
lasts longer; ankles may be placed relative to the hip, and the root relative to its position (`local`).
"""

import logging
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, lru_cache, partial
from pathlib import Path
from types import MappingProxyType

from reactive_realizer.binding.asset_file import (
    XmlElement,
    asset_error,
    attribute,
    boolean,
    by_sync_id,
    number,
    read_xml,
)
from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.engines.animation.expression.compiler import fold
from reactive_realizer.engines.animation.expression.functions import FUNCTIONS, Function
from reactive_realizer.engines.animation.expression.syntax import Constant, Formula, parse, variables
from reactive_realizer.engines.animation.keyframe.keyframe_files import read_interpolator
from reactive_realizer.engines.animation.procedural.effector_track import EFFECTORS, EffectorTrack
from reactive_realizer.engines.animation.procedural.keyframe_track import (
    ENCODINGS,
    ClipTrack,
    KeyframeTrack,
    RotationKey,
)
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.engines.animation.procedural.tracks import RootTrack, RotationTrack, Track
from reactive_realizer.errors import RealizerError

_log = logging.getLogger(__name__)

LONGEST = 100_000
"""Limit of the characters of all formulas of a file. Reading that many takes half a second, while figures move."""

MOST_PARAMETERS = 1_000
"""Limit of the parameters of a file; each becomes a cell for every behavior that plays it."""

_ELEMENTS = ("SkeletonInterpolator", "Rotation", "EndEffector", "Keyframes", "KeyPosition", "Parameter")
_ROOTS = ("root", ROOT)


def read_procedural_animation(path: Path, functions: Mapping[str, Function] = FUNCTIONS) -> ProceduralAnimation:
    """Read the animation of a file.

    Args:
        path: of the file.
        functions: that its formulas may call.

    Raises:
        RealizerError: "bad-asset", with file, line and element.
        OSError: the file cannot be read.
    """
    return _Reader(functions).animation(read_xml(path, "ProcAnimation"), path.name)


class _Reader:
    """Reads the elements of one file."""

    def __init__(self, functions: Mapping[str, Function]) -> None:
        # Most formulas of a file are "0".
        self._parse = cache(partial(parse, functions=functions))
        self._characters = 0

    def animation(self, document: XmlElement, name: str) -> ProceduralAnimation:
        for element in document:
            if element.tag not in _ELEMENTS:
                raise asset_error(element, f"known are {', '.join(_ELEMENTS)}")
        durations = self._durations(document)
        points = by_sync_id(document.iterfind("KeyPosition"))
        key_times = {sync: self._formula(key, "time") for sync, key in points.items()}
        root, tracks = self._root(document), tuple(self._tracks(document))
        motion = [*(root.formulas if root else ()), *(node for track in tracks for node in track.formulas)]
        parameters = _parameters(document, [*durations, *key_times.values()], motion)
        if not motion and not tracks:
            raise asset_error(document, "it has no tracks")
        return ProceduralAnimation(
            name=name,
            parameters=parameters,
            durations=durations,
            key_times=key_times,
            root=root,
            tracks=tracks,
        )

    def _durations(self, document: XmlElement) -> tuple[Formula, Formula, Formula]:
        """Return the preferred, the shortest and the longest duration."""
        preferred = self._formula(document, "prefDuration")
        shortest, longest = (
            self._formula(document, limit) if limit in document.attrib else preferred
            for limit in ("minDuration", "maxDuration")
        )
        match fold(shortest), fold(longest):
            case Constant(least), Constant(most) if least > most:
                raise asset_error(document, f"it lasts at least {least:g} s and at most {most:g} s")
        return preferred, shortest, longest

    def _root(self, document: XmlElement) -> RootTrack | None:
        roots = [element for element in document.iterfind("EndEffector") if attribute(element, "target") in _ROOTS]
        return (
            RootTrack(boolean(roots[-1], "local", False), self._formulas(roots[-1], "translation", 3))
            if roots
            else None
        )

    def _tracks(self, document: XmlElement) -> Iterator[Track]:
        limbs = (element for element in document.iterfind("EndEffector") if element.get("target") not in _ROOTS)
        effectors = [self._effector(element) for element in limbs]
        controlled = frozenset().union(*(effector.controlled for effector in effectors))
        # In AsapRealizer's order: the last track of a joint wins.
        yield from (self._clip(element) for element in document.iterfind("SkeletonInterpolator"))
        turned: list[KeyframeTrack | RotationTrack] = [
            *(self._keyframes(element) for element in document.iterfind("Keyframes")),
            *(self._rotation(element) for element in document.iterfind("Rotation")),
        ]
        for track in turned:
            if track.joint in controlled:
                _log.info("%s is controlled by an EndEffector; its other tracks are ignored", track.joint)
            else:
                yield track
        yield from effectors

    def _clip(self, element: XmlElement) -> ClipTrack:
        clip = read_interpolator(element)
        if clip.roots is not None:
            raise asset_error(element, f"encoding='{element.get('encoding')}': only R is supported in a ProcAnimation")
        return ClipTrack(clip)

    def _rotation(self, element: XmlElement) -> RotationTrack:
        return RotationTrack(
            attribute(element, "target"), boolean(element, "local", True), self._formulas(element, "rotation", 3)
        )

    def _effector(self, element: XmlElement) -> EffectorTrack:
        target = attribute(element, "target")
        if target not in EFFECTORS:
            raise asset_error(element, f"no end effector '{target}'; known are {', '.join((*EFFECTORS, *_ROOTS))}")
        swivel = self._formula(element, "swivel") if element.get("swivel", "").strip() else Constant(0.0)
        path = (*self._formulas(element, "translation", 3), swivel)
        return EffectorTrack(*EFFECTORS[target], boolean(element, "local", False), path)

    def _keyframes(self, element: XmlElement) -> KeyframeTrack:
        encoding = ENCODINGS.get(attribute(element, "encoding"))
        if encoding is None:
            raise asset_error(element, f"encoding='{element.get('encoding')}': known are {', '.join(ENCODINGS)}")
        keys = [
            RotationKey(number(key, "time"), boolean(key, "local", True), self._formulas(key, "value", encoding.size))
            for key in element.iterfind("Keyframe")
        ]
        if not keys:
            raise asset_error(element, "no Keyframe inside")
        return KeyframeTrack(attribute(element, "target"), encoding, tuple(sorted(keys, key=lambda key: key.phase)))

    def _formula(self, element: XmlElement, name: str) -> Formula:
        return self._parsed(element, name, attribute(element, name))

    def _formulas(self, element: XmlElement, name: str, size: int) -> tuple[Formula, ...]:
        texts = attribute(element, name).split(";")
        if len(texts) != size:
            raise asset_error(element, f"{name} needs {size} formulas between semicolons, not {len(texts)}")
        return tuple(self._parsed(element, name, text) for text in texts)

    def _parsed(self, element: XmlElement, name: str, text: str) -> Formula:
        self._characters += len(text)
        if self._characters > LONGEST:
            raise asset_error(element, f"{name}: more than {LONGEST} characters of formulas in one file")
        try:
            return self._parse(text)
        except RealizerError as problem:
            raise asset_error(element, f"{name}: {problem.fault.sentence}") from problem


def _parameters(document: XmlElement, times: Iterable[Formula], motion: Iterable[Formula]) -> dict[str, float]:
    """Return the parameters with their values. An undeclared name is a parameter with value 0, as in AsapRealizer."""
    declared = {attribute(element, "sid"): number(element, "value") for element in document.iterfind("Parameter")}
    if ProceduralAnimation.TIME in declared:
        raise asset_error(document, f"a parameter may not be called {ProceduralAnimation.TIME}")
    in_times = [name for formula in times for name in variables(formula)]
    if ProceduralAnimation.TIME in in_times:
        raise asset_error(document, "a duration or key time depends on t")
    used = [*in_times, *(name for formula in motion for name in variables(formula))]
    given = {*declared, ProceduralAnimation.TIME}
    parameters = declared | dict.fromkeys((name for name in used if name not in given), 0.0)
    if len(parameters) > MOST_PARAMETERS:
        raise asset_error(document, f"more than {MOST_PARAMETERS} parameters in one file")
    return parameters


NO_FUNCTIONS: Mapping[str, Function] = MappingProxyType({})


def load_animation(
    path: Path,
    skeleton: Skeleton,
    *,
    mirror: bool = False,
    joints: frozenset[str] = frozenset(),
    functions: Mapping[str, Function] = NO_FUNCTIONS,
) -> ProceduralAnimation:
    """Load the animation of a file for a figure; changed files are read again.

    Args:
        path: of the file.
        skeleton: of the figure.
        mirror: whether left and right are exchanged.
        joints: to which it is restricted after mirroring; empty for no restriction.
        functions: that its formulas may call besides `FUNCTIONS`.

    Raises:
        RealizerError: the file is invalid, or turns none of the joints.
    """
    return _made(path, path.stat().st_mtime_ns, tuple(functions.items()), skeleton, mirror, joints)


_Functions = tuple[tuple[str, Function], ...]


_MOST = 512
"""Number of cached animations: of all files of the package, for several figures."""


@lru_cache(_MOST)
def _made(
    path: Path, changed: int, functions: _Functions, skeleton: Skeleton, mirror: bool, joints: frozenset[str]
) -> ProceduralAnimation:
    animation = _read(path, changed, functions)
    if mirror:
        animation = animation.mirrored()
    return (animation.restricted_to(joints) if joints else animation.with_girdles()).fitted_to(skeleton)


@lru_cache
def _read(path: Path, changed: int, functions: _Functions) -> ProceduralAnimation:
    """Read a file once for all characters: this takes several milliseconds, which a tick can hardly spare."""
    return read_procedural_animation(path, {**FUNCTIONS, **dict(functions)})
