"""The syntax of EMBRScript: elements from BEGIN to END, parameters NAME:VALUE, comments from # to the end of a line.

The grammar is that of EMBR's parser, which goes from word to word; lines matter for comments, and for a value after a
space, which is in the line of its parameter.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Final, NamedTuple

from reactive_realizer.bml.embr.faults import NotAStatement, StrayEnd, Unclosed, UnknownScriptWord
from reactive_realizer.bml.motion_faults import GivenTwice
from reactive_realizer.bml.names import Location
from reactive_realizer.errors import Fault, quoted

SCRIPT: Final = "script"
SEQUENCE: Final = "K_POSE_SEQUENCE"
POSE: Final = "K_POSE"
CLIP: Final = "ANIMATION"
NUCLEUS: Final = "NUCLEUS"
RESET: Final = "TIME_RESET"
POSITION: Final = "POSITION_CONSTRAINT"
ORIENTATION: Final = "ORIENTATION_CONSTRAINT"
SWIVEL: Final = "SWIVEL_CONSTRAINT"
LOOK_AT: Final = "LOOK_AT_CONSTRAINT"
POSE_TARGET: Final = "POSE_TARGET"
MORPH: Final = "MORPH_TARGET"
SHADER: Final = "SHADER"
AUTONOMOUS: Final = "AUTONOMOUS_BEHAVIOR"

_CONSTRAINTS: Final = (POSITION, ORIENTATION, SWIVEL, LOOK_AT, POSE_TARGET, MORPH, SHADER, AUTONOMOUS)

CHILDREN: Final[Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {SCRIPT: (SEQUENCE, NUCLEUS), SEQUENCE: (POSE, CLIP), POSE: _CONSTRAINTS}
)
"""Element -> the elements that it may contain."""

PARAMETERS: Final[Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {
        SEQUENCE: ("CHARACTER", "START", "FADE_IN", "FADE_OUT", "TIME_WARP"),
        POSE: ("TIME_POINT", "HOLD", "NUCLEUS", "TIME_WARP"),
        CLIP: ("TIME_POINT", "ANIMATION_CLIP", "BODY_GROUP"),
        POSITION: ("BODY_GROUP", "TARGET", "JOINT", "OFFSET", "TIME_WARP", "FEEDBACK_ID"),
        ORIENTATION: ("BODY_GROUP", "DIRECTION", "JOINT", "NORMAL", "TIME_WARP", "FEEDBACK_ID"),
        SWIVEL: ("BODY_GROUP", "SWIVEL_ANGLE", "TARGET", "JOINT", "TIME_WARP", "FEEDBACK_ID"),
        LOOK_AT: ("BODY_GROUP", "TARGET", "JOINT", "TIME_WARP", "FEEDBACK_ID"),
        POSE_TARGET: ("BODY_GROUP", "POSE_KEY", "INFLUENCE", "TIME_WARP", "FEEDBACK_ID"),
        MORPH: ("MORPH_KEY", "MORPH_VALUE", "TIME_WARP", "FEEDBACK_ID"),
        SHADER: ("SHADER_KEY", "SHADER_VALUE", "TIME_WARP", "FEEDBACK_ID"),
        AUTONOMOUS: ("BEHAVIOR_KEY", "BEHAVIOR_VALUE", "TIME_WARP", "FEEDBACK_ID"),
        NUCLEUS: ("NUCLEUS_ID", "SPATIAL_EXT", "TEMPORAL_EXT", "POWER", "FLUIDITY"),
    }
)
"""Element -> its parameters."""

_WORD = re.compile(r"[^\s#]+")
_BEGIN, _END = "BEGIN", "END"
_SYNC = re.compile(r"\bSYNC:\s*(\w+)")
_UNWRITABLE = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML, and so feedback and a translation, cannot have."""


class Value(NamedTuple):
    """The value of a parameter.

    Attributes:
        text: as written.
        location: of the name of the parameter.
    """

    text: str
    location: Location


@dataclass(slots=True)
class Node:
    """An element.

    Attributes:
        name: of the element.
        location: of its BEGIN.
        values: of its parameters, the last one of each.
        children: in order.
        sync: the sync point in the comment behind its BEGIN (``# SYNC:ready``), as EMBOTS writes it in its lexicon.
    """

    name: str
    location: Location
    values: dict[str, Value] = field(default_factory=dict)
    children: list["Node"] = field(default_factory=list)
    sync: str = ""


class _Token(NamedTuple):
    text: str
    location: Location


def _tokens(text: str) -> Iterator[_Token]:
    for row, line in enumerate(text.splitlines(), 1):
        for word in _WORD.finditer(line.partition("#")[0]):
            yield _Token(word[0], Location(row, word.start() + 1))


def text_of(document: str | bytes) -> str:
    """The text of a script in UTF-8, or in ISO 8859-1 if it is not; U+FFFD stands for what cannot be written in XML."""
    return _UNWRITABLE.sub("\ufffd", _decoded(document).removeprefix("\ufeff"))


def _decoded(document: str | bytes) -> str:
    if isinstance(document, str):
        return document
    try:
        return document.decode("utf-8")
    except UnicodeDecodeError:
        return document.decode("iso-8859-1")


def read_nodes(text: str) -> tuple[Node, list[Fault]]:
    """Reads a script.

    Returns:
        A node with the elements of the script, TIME_RESET among them; and the faults of what is left out, in order.
    """
    reader = _NodeReader(
        {
            row: found[1]
            for row, line in enumerate(text.splitlines(), 1)
            if (found := _SYNC.search(line.partition("#")[2]))
        }
    )
    for token in _tokens(text):
        reader.take(token)
    reader.finish()
    return reader.script, reader.faults


class _NodeReader:
    """Builds the elements of a script from its words.

    Args:
        syncs: the sync points in comments, by line.
    """

    def __init__(self, syncs: Mapping[int, str]) -> None:
        self._syncs = syncs
        self.script = Node(SCRIPT, Location(1, 1))
        self.faults: list[Fault] = []
        self._open = [self.script]
        self._unknown = 0  # depth in an unknown element
        self._begins: _Token | None = None
        self._named: _Token | None = None

    def take(self, token: _Token) -> None:
        """Takes the next word."""
        if self._named is not None and token.location.line != self._named.location.line:
            self._end_parameter()
        if self._begins is not None:
            self._begins = None
            self._begin(token)
        elif self._named is not None:
            named, self._named = self._named, None
            self._parameter(_Token(named.text + token.text, named.location))
        elif token.text == _BEGIN:
            self._begins = token
        elif token.text == _END:
            self._end(token)
        elif token.text == RESET and len(self._open) == 1:
            self.script.children.append(Node(RESET, token.location))
        elif token.text.endswith(":") and len(token.text) > 1:
            self._named = token
        elif ":" in token.text:
            self._parameter(token)
        elif not self._unknown:
            self._fault(NotAStatement(text=quoted(token.text)), token.location)

    def finish(self) -> None:
        """Takes the end of the script."""
        self._end_parameter()
        for node in self._open[1:]:
            self._fault(Unclosed(element=node.name), node.location)

    def _begin(self, token: _Token) -> None:
        parent = self._open[-1]
        known = CHILDREN.get(parent.name, ())
        if self._unknown or token.text not in known:
            if not self._unknown:
                self._fault(UnknownScriptWord(word=token.text, parent=parent.name, known=known), token.location)
            self._unknown += 1
            return
        node = Node(token.text, token.location, sync=self._syncs.get(token.location.line, ""))
        parent.children.append(node)
        self._open.append(node)

    def _end(self, token: _Token) -> None:
        if self._unknown:
            self._unknown -= 1
        elif len(self._open) > 1:
            self._open.pop()
        else:
            self._fault(StrayEnd(), token.location)

    def _end_parameter(self) -> None:
        """Takes a parameter without a value."""
        if self._named is not None:
            named, self._named = self._named, None
            self._parameter(named)

    def _parameter(self, token: _Token) -> None:
        if self._unknown:
            return
        node = self._open[-1]
        name, _, value = token.text.partition(":")
        known = PARAMETERS.get(node.name, ())
        if name in node.values:
            self._fault(GivenTwice(what=name, counting="this one"), token.location)
        if name in known:
            node.values[name] = Value(value, token.location)
        else:
            self._fault(UnknownScriptWord(word=name, parent=node.name, known=known), token.location)

    def _fault(self, fault: Fault, location: Location) -> None:
        self.faults.append(fault.located(location.line, location.column))
