"""What the gallery shows: each lexeme that plays, and each unit."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Entry:
    """One strip.

    Attributes:
        name: of its file and of its block.
        behaviors: as BML.
        whole_body: whether feet are to be seen.
        seconds: at least shown, for what is not over when its block is.
    """

    name: str
    behaviors: str
    whole_body: bool = False
    seconds: float = 0.0

    @property
    def block(self) -> str:
        """The block that plays it."""
        namespaces = 'xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"'
        return f'<bml {namespaces} id="{self.name}">{self.behaviors}</bml>'


def entries() -> list[Entry]:
    """All strips, in order."""
    return [
        Entry("gesture-beat-right", '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>'),
        Entry("head-nod", '<head id="h" lexeme="NOD" amount="1"/>'),
    ]
