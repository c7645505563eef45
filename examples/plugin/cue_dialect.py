"""A dialect of cue sheets: after the line "#cues", each line has a time in seconds, a verb, and what it is about."""

from typing import Any

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Gaze, Head
from reactive_realizer.bml.block import BehaviorBlock, Parsed, Problem
from reactive_realizer.bml.dialects import Dialect
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.bml.speech import Speech
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.errors import ParsingFault
from reactive_realizer.limits import Limits

_TITLE = "#cues"


class NotACue(ParsingFault):
    """A line that is not a cue."""

    code = "cue-not-a-cue"
    template = "'{text}' is not a cue; write SECONDS say TEXT, SECONDS nod, or SECONDS look TARGET"
    text: str


def read(document: str | bytes, limits: Limits, name: str) -> list[Parsed]:
    """Returns the one block of a cue sheet; lines that are no cues are left out."""
    text = document if isinstance(document, str) else document.decode("utf-8", "replace")
    lines = text.splitlines()[1 : limits.behaviors_per_block]
    behaviors: list[Behavior] = []
    problems: list[Problem] = []
    for row, line in enumerate(lines, 2):
        try:
            behaviors.append(_behavior(line, row, len(behaviors), limits))
        except ValueError:
            problems.append(Problem(NotACue(text=line[:50], line=row, column=1), name))
    block = BehaviorBlock(id=name, behaviors=tuple(behaviors), location=Location(1, 1))
    return [Parsed(block, tuple(problems))]


def _behavior(line: str, row: int, order: int, limits: Limits) -> Behavior:
    time, verb, *words = line.split()
    about = " ".join(words)[: limits.utterance_characters]
    common: dict[str, Any] = {
        "id": f"cue{row}",
        "namespace": BML,
        "location": Location(row, 1),
        "order": order,
        "syncs": {"start": SyncRef(None, None, None, float(time))},
    }
    if verb == "say":
        return Speech(name="speech", text=about, **common)
    if verb == "look":
        return Gaze(name="gaze", target=about, **common)
    if verb == "nod":
        return Head(name="head", lexeme="NOD", **common)
    raise ValueError(verb)


CUES = Dialect(
    media_types=("text/x-cues",),
    recognizes=lambda text: text.startswith(_TITLE),
    read=read,
)
