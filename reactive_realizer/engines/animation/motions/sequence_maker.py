"""Reads sequence files, and makes sequences of the motions of other makers."""

import logging
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

from reactive_realizer.binding.asset_file import ENDS, XmlElement, asset_error, attribute, number, read_xml, sync_id
from reactive_realizer.engines.animation.faults import NoFile
from reactive_realizer.engines.animation.monotone_curve import MonotoneCurve
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionMaker, MotionRequest, PreloadingMaker
from reactive_realizer.engines.animation.motion_parameters import listed
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.engines.animation.motions.sequence import SequenceMotionUnit, SequencePart
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

_PARTS = ("ProcAnimation", "Gesture", "Keyframe", "noise", "Sequence")
"""Kinds of motions that may be parts. The engine handles others specially: gaze, transitions, and shifts."""

_LONGEST = Limits().time_seconds

_EASES = ("easeIn", "easeOut")

_log = logging.getLogger(__name__)

_MOST = 100
"""Limit of the number of parts of a sequence, nested parts included."""


class SequenceMaker:
    """Makes sequences of motions that other makers make.

    A file has a `Motion` for each part; later parts lie over earlier ones. Its attributes are `type` and `file` as in a
    binding, `start`, and `end` (by default, its preferred duration applies), `easeIn` and `easeOut`, all in s. The
    curve `phases` replaces `end`, and `weights` the eases. Each `parameter` child is a value that the behavior may
    override. A `KeyPosition` makes a sync point of a part (`ref="part:sync"`) one of the sequence.
    """

    def __init__(self, context: MakerContext, makers: Mapping[str, MotionMaker]) -> None:
        """Make sequences for a figure, of parts by these makers."""
        self._context = context
        self._makers = makers
        self._making: list[Path] = []
        self._parts = 0

    def __call__(self, request: MotionRequest) -> SequenceMotionUnit:
        """Make a sequence."""
        path = self._path(request)
        root = read_xml(path, "Sequence")
        if path in self._making:
            raise asset_error(root, "it contains itself")
        self._parts = self._parts if self._making else 0
        self._making.append(path)
        try:
            return self._sequence(root, request)
        finally:
            self._making.pop()

    def preload(self, request: MotionRequest) -> Callable[[], object] | None:
        """Return the loading work of all parts."""
        works = list(self._works(request, set()))
        return (lambda: [work() for work in works]) if works else None

    def _works(self, request: MotionRequest, seen: set[Path]) -> Iterator[Callable[[], object]]:
        """Yield the loading work of the parts of a file, unless it was seen before."""
        path = self._path(request)
        if path in seen or len(seen) == _MOST:
            return
        seen.add(path)
        for element in read_xml(path, "Sequence").findall("Motion")[:_MOST]:
            maker: object = self._makers.get(element.get("type", ""))
            part = _part_request(element, request)
            if maker is self:
                yield from self._works(part, seen)
            elif isinstance(maker, PreloadingMaker) and (work := maker.preload(part)) is not None:
                yield work

    def _path(self, request: MotionRequest) -> Path:
        if request.file is None:
            raise RealizerError(NoFile(element=request.behavior.name))
        return self._context.asset(request.file)

    def _sequence(self, root: XmlElement, request: MotionRequest) -> SequenceMotionUnit:
        for element in root:
            if element.tag not in ("Motion", "KeyPosition"):
                raise asset_error(element, "known are Motion, KeyPosition")
        elements = root.findall("Motion")
        parts = [self._part(element, request) for element in elements]
        if len({part.motion.kind for part in parts}) != 1:
            raise asset_error(root, "it needs one or more parts, all of one kind")
        names: dict[str, SequencePart] = {}
        for element, part in zip(elements, parts, strict=True):
            name = element.get("id", "")
            if name and name in names:
                raise asset_error(element, f"there is already a part '{name}'")
            names[name] = part
        return SequenceMotionUnit(parts, dict(_key_position(key, names) for key in root.iterfind("KeyPosition")))

    def _part(self, element: XmlElement, request: MotionRequest) -> SequencePart:
        unit = attribute(element, "type")
        if unit not in _PARTS:
            raise asset_error(element, f"type='{unit}': a part may be of type {', '.join(_PARTS)}")
        self._parts += 1
        if self._parts > _MOST:
            raise asset_error(element, f"a sequence, with nested ones, has more than {_MOST} parts")
        motion = self._makers[unit](_part_request(element, request))
        _log_unused(element, motion)
        phases, weights = _curve(element, "phases", "end"), _curve(element, "weights", *_EASES)
        start = number(element, "start")
        duration = motion.preferred_duration if phases is None else phases.duration
        end = start + duration if element.get("end") is None else number(element, "end")
        ease_in, ease_out = (number(element, name) if name in element.attrib else 0.0 for name in _EASES)
        if not 0.0 <= start < end or min(ease_in, ease_out) < 0.0 or ease_in + ease_out > end - start:
            raise asset_error(element, "it needs 0 <= start < end, with easeIn and easeOut between them")
        return SequencePart(motion, start, end, ease_in, ease_out, phases, weights)


def _curve(element: XmlElement, name: str, *others: str) -> MonotoneCurve | None:
    """Return the curve of an attribute that replaces others: ``0 0, 1.2 1``, each a time, s, and a value, 0 to 1."""
    if name not in element.attrib:
        return None
    text = attribute(element, name)
    replaced = [other for other in others if other in element.attrib]
    if replaced:
        raise asset_error(element, f"{name} replaces {listed(replaced)}")
    try:
        points = [(float(time), float(value)) for time, value in (point.split() for point in text.split(","))]
    except ValueError:
        points = []
    times = [time for time, _ in points]
    rising = times[:1] == [0.0] and all(earlier < later <= _LONGEST for earlier, later in pairwise(times))
    if len(points) < 2 or not rising or not all(0.0 <= value <= 1.0 for _, value in points):
        form = "two or more times, from 0 on and increasing, each with a value from 0 to 1: 0 0, 0.5 1"
        raise asset_error(element, f"{name}='{text}': it must be {form}")
    return MonotoneCurve(points)


def _log_unused(element: XmlElement, motion: MotionUnit) -> None:
    """Log the parameters of a part that have no effect."""
    if unused := dict(_parameters(element)).keys() - motion.parameter_names:
        _log_once(
            asset_error(
                element, f"no parameter {listed(unused)} of this motion; it has {listed(motion.parameter_names)}"
            ).fault.sentence
        )


@lru_cache
def _log_once(sentence: str) -> None:
    """Log a sentence once."""
    _log.warning("%s", sentence)


def _part_request(element: XmlElement, request: MotionRequest) -> MotionRequest:
    """Return the request for a part, with its own values where the behavior sets none."""
    parameters = {**dict(_parameters(element)), **request.parameters}
    return replace(request, parameters=parameters, file=element.get("file"))


def _parameters(element: XmlElement) -> Iterator[tuple[str, str]]:
    for parameter in element.iterfind("parameter"):
        yield attribute(parameter, "name"), attribute(parameter, "value")


def _key_position(key: XmlElement, parts: Mapping[str, SequencePart]) -> tuple[str, float]:
    name, _, sync = attribute(key, "ref").partition(":")
    if (own := sync_id(key)) in ENDS:
        raise asset_error(key, "start and end are reserved for the whole sequence")
    try:
        return own, parts[name].time(sync)
    except (KeyError, ValueError):
        raise asset_error(key, f"there is no point '{key.get('ref')}'") from None
