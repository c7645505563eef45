"""Speech of drafts: text beside its element ``<text>``, attributes of other voices, and prosody between marks.

Accents and boundaries (APML: B. De Carolis, C. Pelachaud, I. Poggi and M. Steedman, "APML, a markup language for
believable behavior generation", 2004) become a description of the speech in SSML, which voices follow as they can.
"""

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Final, NamedTuple

from lxml import etree

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.draft_ssml import describe_ssml
from reactive_realizer.bml.smartbody.requests import UNCLOSED_MARK
from reactive_realizer.bml.speech_faults import TooMuchMarkup, UnknownMark
from reactive_realizer.bml.ssml_elements import SSML
from reactive_realizer.bml.ssml_reader import MOST_MARKUP
from reactive_realizer.bml.ssml_values import LONGEST_BREAK
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.trees import Tree, children_of, name_of, stray_text_of
from reactive_realizer.errors import Fault, RealizerError

_OF_OTHER_VOICES: Final = ("language", "voice", "type")
"""Attributes that select a voice of another system; the voice of the character speaks."""
_OTHER_POINTS: Final = ("ready", "strokeStart", "stroke", "strokeEnd", "relax")
"""Sync points that speech files of SmartBody state, and that a speech does not have."""
_NO_FILE: Final = "voice_defaultTTS"
"""The Virtual Human Toolkit names this recording where a voice is to speak the text."""
_MARKS: Final = {"tm": "tm", UNCLOSED_MARK: "tm", "mark": "mark"}
"""Elements of marks, with the names by which they were written."""
_ACCENT, _BOUNDARY = "pitchaccent", "boundary"
_STRENGTHS: Final = ("strong", "moderate", "reduced", "none")
_LEVELS: Final = {"none": "none", "reduced": "reduced", "low": "reduced", "strong": "strong", "high": "strong"}


def modernize_speech(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a speech as BML 1.0, in place, and returns the faults of accents and boundaries that are left out."""
    if any(name in tree.attrib for name in _OTHER_POINTS):
        tree.attrib.pop("end", "")  # in these files, the same for every recording
    for name in (*_OF_OTHER_VOICES, *_OTHER_POINTS):
        tree.attrib.pop(name, "")
    for holder in (tree, *children_of(tree, "text")):
        _name_marks(holder, source)
    _describe_file(tree, str(tree.attrib.pop("ref", "")), source)
    said = str(tree.attrib.pop("text", "")).strip()
    if not children_of(tree, "text") and (said or stray_text_of(tree) or children_of(tree, "sync")):
        _wrap_text(tree, said, source)
    for text in children_of(tree, "text"):
        describe_ssml(tree, text, source)
        _name_marks(text, source)  # and those that were inside of SSML
    return [fault for text in children_of(tree, "text") for fault in _prosody(tree, text, source)]


def _name_marks(holder: Tree, source: BlockSource) -> None:
    """Rewrites the marks among the words as sync points."""
    for mark in children_of(holder, *_MARKS):
        source.rename(mark, "sync", _MARKS[name_of(mark)])
        if "name" in mark.attrib and "id" not in mark.attrib:
            mark.set("id", str(mark.attrib.pop("name")))
    _drop_repeated_marks(holder)


def _drop_repeated_marks(holder: Tree) -> None:
    """Removes marks with the id of an earlier one, which is the one that Greta finds; their text stays."""
    seen = set()
    for mark in children_of(holder, "sync"):
        id_ = mark.get("id")
        if id_ in seen:
            _say(holder, [_said_before(mark), mark.tail or ""], before=mark)
            mark.tail = None
            holder.remove(mark)
        elif id_:
            seen.add(id_)


def _said_before(child: Tree) -> str:
    """The text in front of a child of an element, up to the child before it."""
    before, parent = child.getprevious(), child.getparent()
    return (before.tail if before is not None else parent.text if parent is not None else None) or ""


def _wrap_text(tree: Tree, said: str, source: BlockSource) -> None:
    """Moves the text and its sync points into a ``<text>`` element; without any, that has the text of the attribute."""
    written = bool(stray_text_of(tree))
    text = source.insert(tree, "text")
    pieces, tree.text = [tree.text or "" if written else said], None
    for child in list(tree)[1:]:
        if name_of(child) != "description":
            _say(text, pieces)
            pieces = [child.tail or ""]
            text.append(child)
        else:
            pieces.append(child.tail or "")
            child.tail = None
    _say(text, pieces)


def _say(text: Tree, pieces: Iterable[str], before: Tree | None = None) -> None:
    """Sets the text in front of a child of an element, or behind the last one."""
    last = before.getprevious() if before is not None else _last_child(text)
    if last is None:
        text.text = "".join(pieces)
    else:
        last.tail = "".join(pieces)


def _last_child(tree: Tree) -> Tree | None:
    """The last child of an element; to ask for the number of children would take time for each of them."""
    return next(tree.iterchildren(reversed=True), None)


def _describe_file(tree: Tree, ref: str, source: BlockSource) -> None:
    """Describes a speech as the recording that its attribute ``ref`` names."""
    if ref.strip() and ref.strip() != _NO_FILE:
        description = source.insert(tree, "description", {"priority": "1", "type": "audio/x-wav"})
        source.insert(description, "file", {"ref": ref.strip()})


class _Piece(NamedTuple):
    """A part of a text: a mark, and the text from there to the next one."""

    mark: str
    text: str


def _prosody(tree: Tree, text: Tree, source: BlockSource) -> Iterator[Fault]:
    """Takes accents and boundaries out of a text, and describes the speech with them."""
    marked = children_of(text, _ACCENT, _BOUNDARY)
    if len(marked) > MOST_MARKUP:
        yield source.located(text, TooMuchMarkup(limit=MOST_MARKUP))
        return
    pieces = _without(marked, text)
    places = {piece.mark: number for number, piece in enumerate(pieces) if piece.mark}
    changes: dict[str, Counter[int]] = {level: Counter() for level in _STRENGTHS}
    breaks: dict[int, Mapping[str, str]] = {}
    for each in marked:
        try:
            first, last, pause = _span(each, places, source)
        except RealizerError as refused:
            yield refused.fault
            continue
        if name_of(each) == _ACCENT:
            change = changes[_LEVELS.get(each.get("level", "").lower(), "moderate")]
            change[first] += 1
            change[max(last, first + 1)] -= 1
        else:
            breaks[last] = {"time": f"{min(pause, LONGEST_BREAK):g}s"} if pause > 0.0 else {"strength": "medium"}
    if breaks or any(changes.values()):
        _describe(tree, pieces, _levels(changes, len(pieces)), breaks, source)


def _without(marked: Collection[Tree], text: Tree) -> list[_Piece]:
    """The pieces of a text, from which some elements are removed, but not the text behind these."""
    gone, pieces = set(marked), [_Piece("", text.text or "")]
    behind = [pieces[0].text]
    for child in list(text):
        after = child.tail or ""
        if child in gone:
            child.tail = None
            text.remove(child)
            behind.append(after)
            pieces[-1] = pieces[-1]._replace(text=pieces[-1].text + after)
        else:
            _say(text, behind, before=child)
            behind = [after]
            pieces.append(_Piece(child.get("id", ""), "".join(map(str, child.itertext())) + after))
    if gone:
        _say(text, behind)
    return pieces


def _levels(changes: Mapping[str, Counter[int]], size: int) -> list[str]:
    """The strongest emphasis of each piece, or an empty text."""
    open_ = dict.fromkeys(_STRENGTHS, 0)
    levels = []
    for number in range(size):
        for level, change in changes.items():
            open_[level] += change[number]
        levels.append(next((level for level in _STRENGTHS if open_[level]), ""))
    return levels


def _span(each: Tree, places: Mapping[str, int], source: BlockSource) -> tuple[int, int, float]:
    """The pieces from the start to the end of an accent or boundary, and the time (s) between, if both name one mark.

    Raises:
        RealizerError: ``missing-attribute``, ``bad-attribute`` or ``unknown-mark``.
    """
    start, end = (source.ref(each, name) for name in ("start", "end"))
    first, last = (_place(ref, each, places, source) for ref in (start, end))
    return first, last, end.offset - start.offset if first == last else 0.0


def _place(ref: SyncRef, each: Tree, places: Mapping[str, int], source: BlockSource) -> int:
    if ref.sync is None or ref.sync not in places:
        raise RealizerError(source.located(each, UnknownMark(mark=ref.sync or str(ref), known=tuple(places))))
    return places[ref.sync]


def _describe(
    tree: Tree,
    pieces: list[_Piece],
    levels: Sequence[str],
    breaks: Mapping[int, Mapping[str, str]],
    source: BlockSource,
) -> None:
    """Describes a speech in SSML: each piece with its mark, the pause before it, and its emphasis."""
    description = source.insert(tree, "description", {"priority": "0", "type": "application/ssml+xml"})
    # In its own namespace, so that what is written of it in BML 1.0 is read again.
    speak = source.insert(description, f"{{{SSML}}}speak")
    for number, piece in enumerate(pieces):
        if piece.mark:
            _add_last(speak, "mark", {"name": piece.mark}, source)
        if number in breaks:
            _add_last(speak, "break", breaks[number], source)
        if levels[number] and piece.text.strip():
            _add_last(speak, "emphasis", {"level": levels[number]}, source).text = piece.text
        elif (last := _last_child(speak)) is not None:
            last.tail = piece.text
        else:
            speak.text = piece.text


def _add_last(speak: Tree, name: str, attributes: Mapping[str, str], source: BlockSource) -> Tree:
    child = etree.SubElement(speak, f"{{{SSML}}}{name}", dict(attributes))
    source.place(child, speak)
    return child
