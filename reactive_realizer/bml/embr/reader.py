"""Reads EMBRScript as blocks of BML (A. Heloir and M. Kipp, "Real-time animation of interactive agents", 2010)."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Final

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import CAST, BehaviorBlock, Parsed, Problem
from reactive_realizer.bml.dialects import Dialect
from reactive_realizer.bml.embr.faults import NoSequence
from reactive_realizer.bml.embr.nucleus import Nuclei
from reactive_realizer.bml.embr.sequence import SequenceReader
from reactive_realizer.bml.embr.syntax import NUCLEUS, RESET, Node, read_nodes, text_of
from reactive_realizer.bml.embr.values import Notes
from reactive_realizer.bml.faults import MoreProblems, TooManyBehaviors, TooManyBytes
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.names import BLOCK, Location
from reactive_realizer.bml.vocabulary import Composition
from reactive_realizer.bml.writer import written
from reactive_realizer.errors import Fault
from reactive_realizer.limits import Limits

_BEGINNING: Final = re.compile(r"\ufeff?(?:\s|#[^\n]*(?:\n|$))*(?:TIME_RESET|BEGIN\s+(?:K_POSE_SEQUENCE|NUCLEUS))\b")


@dataclass(slots=True)
class _Section:
    """The sequences of one character between two TIME_RESETs.

    Attributes:
        character: its name in the script; empty for none.
        resets: whether a TIME_RESET precedes them.
        location: of the TIME_RESET, or of the first sequence.
        behaviors: of the sequences.
        notes: of the faults in them.
    """

    character: str
    resets: bool
    location: Location
    notes: Notes
    behaviors: list[Behavior] = field(default_factory=list)


def read(document: str | bytes, limits: Limits, name: str) -> list[Parsed]:
    """The blocks of a script: one for each character, and new ones after each TIME_RESET.

    Args:
        document: the script.
        limits: the sizes that are refused.
        name: id of the first block; the second one gets ``name_2``, and so on.
    """
    size = len(document) if isinstance(document, bytes) else len(document.encode("utf-8", "surrogatepass"))
    if size > limits.bml_bytes:
        return [_refused(TooManyBytes(size=size, limit=limits.bml_bytes, line=1, column=1))]
    script, faults = read_nodes(text_of(document))
    sections = _sections(script.children, limits)
    if not sections:
        return [_refused(*faults, NoSequence(line=1, column=1))]
    sections[0].notes.faults[:0] = faults
    ids = [name, *(f"{name}_{number}" for number in range(2, len(sections) + 1))]
    return [_parsed(section, id_, sections[0], limits) for section, id_ in zip(sections, ids, strict=True)]


def _refused(*faults: Fault) -> Parsed:
    return Parsed(None, tuple(Problem(fault, BLOCK) for fault in faults))


def _sections(nodes: Sequence[Node], limits: Limits) -> list[_Section]:
    notes = Notes(limits)
    nuclei = Nuclei(nodes, notes)
    sections: list[_Section] = []
    current: dict[str, _Section] = {}
    reset: Location | None = None
    for number, node in _numbered(nodes):
        if node.name == RESET:
            current, reset = {}, node.location
        elif node.name == NUCLEUS:
            continue
        else:
            value = node.values.get("CHARACTER")
            character = value.text if value else ""
            if character not in current:
                current[character] = _Section(character, reset is not None, reset or node.location, notes)
                sections.append(current[character])
            section = current[character]
            reader = SequenceReader(node, f"sequence{number}", nuclei, section.notes)
            section.behaviors += reader.behaviors()
    if reset is not None and not current:  # it ends what plays, even if nothing follows
        sections.append(_Section("", True, reset, notes))
    return sections


def _numbered(nodes: Iterable[Node]) -> Iterator[tuple[int, Node]]:
    """The elements, with the number of each sequence."""
    number = 0
    for node in nodes:
        number += node.name not in (RESET, NUCLEUS)
        yield number, node


def _parsed(section: _Section, name: str, first: _Section, limits: Limits) -> Parsed:
    """The block of a section; the first one has the problems of the script.

    Its first character may have another name here, because EMBR's are figures of its own.
    """
    most = limits.behaviors_per_block
    faults = first.notes.faults if section is first else []
    cast = section.character if section.character == first.character else ""
    if len(section.behaviors) > most:
        fault = TooManyBehaviors(size=len(section.behaviors), limit=most)
        return _refused(fault.located(section.location.line, section.location.column))
    # Feedback writes a behavior in a tick, so key poses are written here, where there is time for it.
    behaviors = tuple(
        replace(each, order=order, source=written(each) if isinstance(each, KeyPoses) else "")
        for order, each in enumerate(section.behaviors)
    )
    block = BehaviorBlock(
        id=name,
        character=None if cast else section.character or None,
        composition=Composition.REPLACE if section.resets else Composition.MERGE,
        behaviors=behaviors,
        extensions=MappingProxyType({CAST: cast} if cast else {}),
        location=section.location,
    )
    return Parsed(block, _problems(faults, name, limits))


def _problems(faults: list[Fault], name: str, limits: Limits) -> tuple[Problem, ...]:
    ordered = sorted(faults, key=lambda fault: (fault.line or 0, fault.column or 0))
    first, others = ordered[: limits.reported_problems], ordered[limits.reported_problems :]
    if others:
        first.append(MoreProblems(number=len(others)).located(1, 1))
    return tuple(Problem(fault, name) for fault in first)


DIALECT: Final = Dialect(("application/vnd.embr",), lambda text: _BEGINNING.match(text) is not None, read)
"""EMBRScript."""
