"""From a file to motions that are played as one."""

import logging
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from reactive_realizer.binding.sync_id import ENDS, sync_id
from reactive_realizer.binding.xml_file import Element, attribute, bad, number, read_xml
from reactive_realizer.engines.animation.actor import Actor, Maker, SlowMaker, Wanted
from reactive_realizer.engines.animation.in_vain import listed
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.engines.animation.sequence.part import Part
from reactive_realizer.engines.animation.sequence.sequence_motion_unit import SequenceMotionUnit
from reactive_realizer.errors import error

_PARTS = ("ProcAnimation", "Gesture", "Keyframe", "noise", "Sequence")
"""Of the others the engine has to know: where eyes look, where a transition leads, what stays."""

_log = logging.getLogger(__name__)

_MOST = 100
"""Parts of a sequence, those of its parts among them."""


class SequenceMaker:
    """Makes sequences of what other makers make.

    A file has a `Motion` for each part, the later over the earlier: its `type` and `file` as in a binding, `start`, and
    `end` (else it takes as long as it would like to), `easeIn`, `easeOut`, all in s, and a `parameter` for each of its
    values, which the behavior may overrule. A `KeyPosition` gives a sync point of a part (`ref="part:sync"`) to the
    whole.
    """

    def __init__(self, actor: Actor, makers: Mapping[str, Maker]) -> None:
        """Makes them for an actor, of parts by these makers."""
        self._actor = actor
        self._makers = makers
        self._making: list[Path] = []
        self._parts = 0

    def __call__(self, wanted: Wanted) -> SequenceMotionUnit:
        """As every maker."""
        path = self._path(wanted)
        root = read_xml(path, "Sequence")
        if path in self._making:
            raise bad(root, "it is a part of itself")
        self._parts = self._parts if self._making else 0
        self._making.append(path)
        try:
            return self._sequence(root, wanted)
        finally:
            self._making.pop()

    def reading(self, wanted: Wanted) -> Callable[[], object] | None:
        """As `SlowMaker`: the work of all its parts."""
        works = list(self._works(wanted, set()))
        return (lambda: [work() for work in works]) if works else None

    def _works(self, wanted: Wanted, seen: set[Path]) -> Iterator[Callable[[], object]]:
        """The work of the parts of a file, if it has not been seen yet."""
        path = self._path(wanted)
        if path in seen or len(seen) == _MOST:
            return
        seen.add(path)
        for element in read_xml(path, "Sequence").findall("Motion")[:_MOST]:
            maker: object = self._makers.get(element.get("type", ""))
            part = _of_part(element, wanted)
            if maker is self:
                yield from self._works(part, seen)
            elif isinstance(maker, SlowMaker) and (work := maker.reading(part)) is not None:
                yield work

    def _path(self, wanted: Wanted) -> Path:
        if wanted.file is None:
            raise error("no-file", element=wanted.behavior.name)
        return self._actor.asset(wanted.file)

    def _sequence(self, root: Element, wanted: Wanted) -> SequenceMotionUnit:
        for element in root:
            if element.tag not in ("Motion", "KeyPosition"):
                raise bad(element, "known are Motion, KeyPosition")
        elements = root.findall("Motion")
        parts = [self._part(element, wanted) for element in elements]
        if len({part.motion.kind for part in parts}) != 1:
            raise bad(root, "its parts have to be one or more, all of one kind")
        names = {element.get("id", ""): part for element, part in zip(elements, parts, strict=True)}
        return SequenceMotionUnit(parts, dict(_key_position(key, names) for key in root.iterfind("KeyPosition")))

    def _part(self, element: Element, wanted: Wanted) -> Part:
        unit = attribute(element, "type")
        if unit not in _PARTS:
            raise bad(element, f"type='{unit}': a part may be of type {', '.join(_PARTS)}")
        self._parts += 1
        if self._parts > _MOST:
            raise bad(element, f"with those of its parts a sequence has more than {_MOST} parts")
        motion = self._makers[unit](_of_part(element, wanted))
        _tell_vain(element, motion)
        start = number(element, "start")
        end = start + motion.preferred_duration if element.get("end") is None else number(element, "end")
        eases = [number(element, name) if name in element.attrib else 0.0 for name in ("easeIn", "easeOut")]
        if not 0.0 <= start < end or min(eases) < 0.0 or sum(eases) > end - start:
            raise bad(element, "0 <= start < end is wanted, and easeIn and easeOut between them")
        return Part(motion, start, end, *eases)


def _tell_vain(element: Element, motion: MotionUnit) -> None:
    """Log the parameters of a part that mean nothing to it."""
    if vain := dict(_parameters(element)).keys() - motion.known:
        _tell(bad(element, f"no parameter {listed(vain)} of this motion; it has {listed(motion.known)}").fault.sentence)


@lru_cache
def _tell(sentence: str) -> None:
    """Once, however often it is played."""
    _log.warning("%s", sentence)


def _of_part(element: Element, wanted: Wanted) -> Wanted:
    """What is wanted of a part: its own values, where the behavior says no others."""
    parameters = {**dict(_parameters(element)), **wanted.parameters}
    return replace(wanted, parameters=parameters, file=element.get("file"))


def _parameters(element: Element) -> Iterator[tuple[str, str]]:
    for parameter in element.iterfind("parameter"):
        yield attribute(parameter, "name"), attribute(parameter, "value")


def _key_position(key: Element, parts: Mapping[str, Part]) -> tuple[str, float]:
    name, _, sync = attribute(key, "ref").partition(":")
    if (own := sync_id(key)) in ENDS:
        raise bad(key, "start and end are those of the whole")
    if name not in parts or sync not in parts[name].motion.key_positions:
        raise bad(key, f"there is no point '{key.get('ref')}'")
    return own, parts[name].time(sync)
