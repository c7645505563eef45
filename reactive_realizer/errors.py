"""Faults: errors as data, with a code for programs and a sentence for people.

Each package defines its own kinds of fault, in its ``faults.py`` or where they arise, and so does a plug-in
(docs/plugins.md). docs/errors.md is generated from them.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from enum import StrEnum
from string import Formatter
from typing import ClassVar, Self, cast, dataclass_transform

from reactive_realizer.nearest_name import nearest_name


class WarningType(StrEnum):
    """Types of BML 1.0 warningFeedback, and EXECUTION_FAILURE as AsapRealizer sends it."""

    PARSING_FAILURE = "PARSING_FAILURE"
    NO_SUCH_TARGET = "NO_SUCH_TARGET"
    IMPOSSIBLE_TO_SCHEDULE = "IMPOSSIBLE_TO_SCHEDULE"
    BEHAVIOR_TYPE_NOT_SUPPORTED = "BEHAVIOR_TYPE_NOT_SUPPORTED"
    CUSTOM_BEHAVIOUR_NOT_SUPPORTED = "CUSTOM_BEHAVIOUR_NOT_SUPPORTED"
    CUSTOM_ATTRIBUTE_NOT_SUPPORTED = "CUSTOM_ATTRIBUTE_NOT_SUPPORTED"
    CANNOT_CREATE_BEHAVIOR = "CANNOT_CREATE_BEHAVIOR"
    EXECUTION_FAILURE = "EXECUTION_FAILURE"


FAULTS: dict[str, type["Fault"]] = {}
"""Every kind of fault by its code: a class is registered when it is defined."""


@dataclass_transform(frozen_default=True, kw_only_default=True)
class _Kind:
    """Makes each kind of fault a frozen data class, checks its template and registers it."""

    def __init_subclass__(cls) -> None:
        dataclass(frozen=True, kw_only=True)(cls)
        if "code" in vars(cls):
            kind = cast("type[Fault]", cls)
            names = {*kind.compared, *(name for _, name, _, _ in Formatter().parse(kind.template) if name)}
            if unknown := names - {own.name for own in fields(kind)}:
                raise TypeError(f"the template of {cls.__name__} mentions {', '.join(unknown)}, which is not a field")
            if kind.unknown and not {kind.unknown, "known"} <= {own.name for own in fields(kind)}:
                raise TypeError(f"{cls.__name__} suggests names, so it needs the fields {kind.unknown} and known")
            if kind.code in FAULTS:
                raise TypeError(f"{kind.code} is already the code of {FAULTS[kind.code].__name__}")
            FAULTS[kind.code] = kind


class Fault(_Kind):
    """One error.

    A subclass is a kind of fault: it sets ``code`` and ``template`` and declares a field for each detail. Subclasses
    are frozen data classes with keyword arguments.

    Attributes:
        code: the name of the kind. Programs rely on it, so it never changes.
        template: the sentence for people. Fields are in braces; tuples are listed, and numbers without a format are
            `rounded`.
        compared: the fields of numbers that are wrong because they differ; the sentence shows that they do.
        unknown: the field with the name, or the tuple of names, that is unknown; the sentence then suggests the names
            of the field ``known``, a tuple, that are most like it. Empty for a fault without such names.
        warning: the type of the warningFeedback that reports it; None if feedback does not.
        line: 1-based line of the element in its document; None without a document.
        column: 1-based column of the start tag of the element.
    """

    code: ClassVar[str]
    template: ClassVar[str]
    compared: ClassVar[tuple[str, ...]] = ()
    unknown: ClassVar[str] = ""
    warning: ClassVar[WarningType | None] = None
    line: int | None = None
    column: int | None = None

    @property
    def details(self) -> Mapping[str, object]:
        """The values of the fields that its kind declares, by name."""
        return {own.name: getattr(self, own.name) for own in fields(self) if own.name not in ("line", "column")}

    @property
    def sentence(self) -> str:
        """The sentence for people, without the place."""
        sentence = self.template.format(**self._shown())
        meant = " and ".join(f"'{name}'" for name in self._nearest())
        return f"{sentence}; did you mean {meant}?" if meant else sentence

    def located(self, line: int, column: int) -> Self:
        """This fault with a place, unless it already has one."""
        return self if self.line is not None else replace(self, line=line, column=column)

    def _shown(self) -> dict[str, object]:
        """The values of the fields as the sentence shows them."""
        shown = {name: _listed(value) for name, value in self.details.items()}
        for _, name, form, _ in Formatter().parse(self.template):
            if name and not form and isinstance(value := shown[name], float):
                others = self.compared if name in self.compared else ()
                shown[name] = rounded(value, *(cast("float", self.details[other]) for other in others))
        return shown

    def _nearest(self) -> list[str]:
        """The known names that are most like the unknown ones, each once."""
        if not self.unknown:
            return []
        written, known = self.details[self.unknown], cast("tuple[str, ...]", self.details["known"])
        names = dict.fromkeys(written if isinstance(written, tuple) else (str(written),))
        found = dict.fromkeys(nearest_name(name, known) for name in names)
        return [name for name in found if name is not None]

    def __str__(self) -> str:
        place = "" if self.line is None else f"line {self.line}, column {self.column}: "
        return place + self.sentence


_MOST_LISTED = 40
_MOST_QUOTED = 60
_DIGITS = range(2, 7)
_LARGE = 1e9
"""A number from which on its digits tell a reader nothing."""


def rounded(number: float, *others: float) -> str:
    """A number for a message, with two digits after the point, or up to six where two show no difference.

    Args:
        number: in any unit.
        others: the numbers from which the reader has to tell it; zero if there are none.
    """
    if abs(number) >= _LARGE:
        return f"{number:g}"
    different = {number, *(others or (0.0,))}
    telling = (digits for digits in _DIGITS if len({round(each, digits) for each in different}) == len(different))
    digits = next(telling, _DIGITS[0])
    return f"{round(number, digits) + 0.0:.{digits}f}"  # no negative zero


def quoted(text: str) -> str:
    """A text of the document for a message: on one line, truncated if it is long."""
    line = " ".join(text.split())
    return line if len(line) <= _MOST_QUOTED else f"{line[:_MOST_QUOTED]}..."


def _listed(value: object) -> object:
    """A tuple of names for a message, separated by commas, truncated if there are many; other values as they are."""
    if not isinstance(value, tuple):
        return value
    distinct: dict[str, None] = {}
    for each in value:
        if len(distinct) == _MOST_LISTED and str(each) not in distinct:
            return ", ".join([*map(quoted, distinct), "..."])
        distinct[str(each)] = None
    return ", ".join(map(quoted, distinct)) or "none"


class ParsingFault(Fault):
    """A part of a document that cannot be read."""

    warning = WarningType.PARSING_FAILURE


class TargetFault(Fault):
    """A name of something that does not exist."""

    warning = WarningType.NO_SUCH_TARGET


class SchedulingFault(Fault):
    """A behavior, block or constraint without possible times."""

    warning = WarningType.IMPOSSIBLE_TO_SCHEDULE


class CreationFault(Fault):
    """A behavior that cannot be made from its description."""

    warning = WarningType.CANNOT_CREATE_BEHAVIOR


class PlayingFault(Fault):
    """A failure during playback."""

    warning = WarningType.EXECUTION_FAILURE


class NotANumber(Fault):
    """A value that is not a finite number."""

    code = "not-a-number"
    template = "not a finite number"


class RealizerError(Exception):
    """Carries a fault to the code that reports it."""

    def __init__(self, fault: Fault) -> None:
        super().__init__(fault)
        self.fault = fault

    def __str__(self) -> str:
        return str(self.fault)
