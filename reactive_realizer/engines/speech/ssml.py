"""A text with marks as SSML, and the way back from places in the SSML to places in the text."""

from dataclasses import dataclass
from xml.sax.saxutils import escape


@dataclass(frozen=True, slots=True)
class Markup:
    """A text as SSML.

    Attributes:
        ssml: the whole document; mark number n of the text is named ``mn``, so that no name has to be quoted.
        origins: for each character of the SSML the index of the character of the text that it stands for; a tag stands
            for what follows it.
    """

    ssml: str
    origins: tuple[int, ...]

    def origin(self, position: int) -> int:
        """The index into the text for a 1-based position in the SSML, as espeak-ng counts."""
        return self.origins[min(max(position, 1), len(self.origins)) - 1]


def marked_up(text: str, marks: tuple[int, ...]) -> Markup:
    """A plain text with empty ``<mark>`` elements at the given indices (0 to ``len(text)``)."""
    pieces: list[tuple[str, int]] = [("<speak>", 0)]
    pending = sorted((index, number) for number, index in enumerate(marks))
    for index in range(len(text) + 1):
        while pending and pending[0][0] <= index:
            pieces.append((f'<mark name="m{pending.pop(0)[1]}"/>', index))
        pieces.append((escape(text[index : index + 1]), index))
    pieces.append(("</speak>", len(text)))
    return Markup("".join(piece for piece, _ in pieces), tuple(origin for piece, origin in pieces for _ in piece))
