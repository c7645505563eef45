"""Movements that accompany words, as behaviors of BML that are tied to the words."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Final, Self
from xml.sax.saxutils import quoteattr

from reactive_realizer.bml.names import BML, BMLT, OWN
from reactive_realizer.liveliness.prosody import SpokenWord
from reactive_realizer.planunit.body_parts import BodyPart
from reactive_realizer.planunit.plan_unit import PlanUnit

PARTS: Final = {
    "head": BodyPart.HEAD,
    "gaze": BodyPart.EYES,
    "faceLexeme": BodyPart.FACE,
    "gesture": BodyPart.ARMS,
}
"""The parts that the elements of movements move."""


SOONEST: Final = 0.1
"""The least time from planning a movement to its start, s; the first ones are planned when the utterance starts."""


def word_point(word: SpokenWord) -> str:
    """The sync point of a word."""
    return f"word{word.index}"


@dataclass(frozen=True, slots=True)
class Anchor:
    """A time by a word.

    Attributes:
        word: the word.
        offset: s from its start.
    """

    word: SpokenWord
    offset: float

    @classmethod
    def at(cls, word: SpokenWord, time: float) -> Self:
        """A time in an utterance, s, by a word of it; none comes before it can be planned."""
        return cls(word, max(SOONEST, time) - word.start)

    @property
    def sync(self) -> str:
        """The sync point of the word."""
        return word_point(self.word)


@dataclass(frozen=True, slots=True)
class Movement:
    """A behavior of BML that accompanies words.

    Attributes:
        element: its name.
        attributes: of the element, beside its sync points and its amount.
        amount: its extent, 0 to 1; None for one without.
        anchors: its sync points that are tied to words.
        span: when it is expected to begin and to end, s from the start of the utterance.
        lasting: whether it is a position that is kept, on which short movements may come.
    """

    element: str
    attributes: Mapping[str, str]
    amount: float | None
    anchors: Mapping[str, Anchor]
    span: tuple[float, float]
    lasting: bool = False
    parts: frozenset[BodyPart] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "parts", frozenset({PARTS[self.element]}))

    def scaled(self, factor: float) -> Self:
        """The same movement with another extent."""
        return self if self.amount is None else replace(self, amount=min(1.0, self.amount * factor))

    def disturbs(self, other: "Movement", gap: float) -> bool:
        """Whether it would be seen as one with another movement, which is nearer than a gap, s."""
        return self.lasting is other.lasting and bool(self.parts & other.parts) and self.overlaps(other.span, gap)

    def overlaps(self, span: tuple[float, float], gap: float = 0.0) -> bool:
        """Whether another span, s, is nearer than a gap, s."""
        return span[0] < self.span[1] + gap and self.span[0] < span[1] + gap


def block_of(id_: str, speech: PlanUnit, movements: Iterable[Movement], replaced: Iterable[str]) -> str:
    """A block of BML that accompanies the block of a speech.

    Args:
        id_: of the block.
        speech: with the words.
        movements: its behaviors.
        replaced: ids of the blocks that it ends.
    """
    own = [_behavior(f"{each.element}{number}", speech, each) for number, each in enumerate(movements, 1)]
    character, block = speech.block
    names = {"id": id_, "characterId": character, "rr:accompanies": block, "bmlt:interrupt": ",".join(replaced)}
    written = "".join(f" {name}={quoteattr(value)}" for name, value in names.items() if value)
    return f'<bml xmlns="{BML}" xmlns:bmlt="{BMLT}" xmlns:rr="{OWN}"{written}>{"".join(own)}</bml>'


def _behavior(id_: str, speech: PlanUnit, movement: Movement) -> str:
    attributes = {"id": id_, **movement.attributes}
    content = ""
    if movement.amount is not None and movement.element == "gesture":
        content = f'<bmlt:parameter name="amount" value="{movement.amount:.3f}"/>'
    elif movement.amount is not None:
        attributes["amount"] = f"{movement.amount:.3f}"
    for sync, anchor in movement.anchors.items():
        attributes[sync] = f"{speech.block.block}:{speech.behavior.id}:{anchor.sync}{anchor.offset:+.3f}"
    written = "".join(f" {name}={quoteattr(value)}" for name, value in attributes.items())
    return f"<{movement.element}{written}>{content}</{movement.element}>"
