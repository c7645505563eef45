"""One strip of the gallery."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Entry:
    """One strip.

    Attributes:
        name: of its file and of its block.
        behaviors: as BML.
        whole_body: whether the picture includes the feet.
        seconds: minimum duration, s, for motion that continues after the end of the block.
        push: force on the trunk for 0.2 s, N, one second after the start; None for no push.
        face: whether the picture shows the face only.
        closeup: part of the face that the picture shows alone: mouth, eyes, nose or ears; empty for none.
        held: how many faces it holds, each in one picture, which the caption names; 0 for other strips.
        avatar: name of its file without the suffix.
        caption: is shown below the picture, if it is not empty.
        script: EMBRScript that plays instead of the behaviors, if it is not empty.
    """

    name: str
    behaviors: str
    whole_body: bool = False
    seconds: float = 0.0
    push: tuple[float, float, float] | None = None
    face: bool = False
    closeup: str = ""
    held: int = 0
    avatar: str = "female"
    caption: str = ""
    script: str = ""

    @property
    def block(self) -> str:
        """The id of the block that plays it, the first one of a session."""
        return "document1" if self.script else self.name

    @property
    def document(self) -> str:
        """The document that plays it."""
        if self.script:
            return self.script
        namespaces = 'xmlns="http://www.bml-initiative.org/bml/bml-1.0" xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"'
        return f'<bml {namespaces} id="{self.name}">{self.behaviors}</bml>'
