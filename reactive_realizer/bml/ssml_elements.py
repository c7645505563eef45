"""Reads elements of SSML as markup of the text inside them."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from types import MappingProxyType
from typing import Final, TypeVar

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.faults import MissingAttribute
from reactive_realizer.bml.markup import Markup, MarkupKind
from reactive_realizer.bml.ssml_values import read_pitch, read_rate, read_strength, read_time, read_volume
from reactive_realizer.bml.trees import Tree, name_of, names_in, namespace_of
from reactive_realizer.bml.value_faults import UnknownWord
from reactive_realizer.errors import Fault, RealizerError, quoted

SSML: Final = "http://www.w3.org/2001/10/synthesis"
"""The namespace of SSML."""

ATTRIBUTES: Final[Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {
        "speak": ("version", "onlangfailure"),
        "p": (),
        "s": (),
        "w": ("role",),
        "token": ("role",),
        "break": ("time", "strength"),
        "emphasis": ("level",),
        "lang": ("onlangfailure",),
        "mark": ("name",),
        "phoneme": ("ph", "alphabet", "type"),
        "prosody": ("rate", "pitch", "volume", "contour", "range", "duration"),
        "say-as": ("interpret-as", "format", "detail"),
        "sub": ("alias",),
        "voice": ("name", "gender", "age", "variant", "languages", "required", "onvoicefailure"),
    }
)
"""The elements that a voice may follow, and their attributes."""

T = TypeVar("T")

_LANG: Final = "{http://www.w3.org/XML/1998/namespace}lang"
_LEVELS: Final = ("strong", "moderate", "none", "reduced")
_SPELLED: Final = {"characters": "characters", "spell-out": "characters", "digits": "digits", "telephone": "digits"}
_FACTORS: Final[Mapping[str, tuple[MarkupKind, Callable[[str], float | None]]]] = MappingProxyType(
    {
        "rate": (MarkupKind.RATE, read_rate),
        "pitch": (MarkupKind.PITCH, read_pitch),
        "volume": (MarkupKind.VOLUME, read_volume),
    }
)


def is_ssml(tree: Tree) -> bool:
    """Returns whether an element has the namespace of SSML, or none."""
    return namespace_of(tree) in {"", SSML}


def properties_of(tree: Tree, source: BlockSource, notes: list[Fault]) -> Iterator[Markup]:
    """Yields the markup of the text inside an element, without its place in the text.

    Args:
        tree: the element.
        source: its block.
        notes: receives the faults of attributes that are ignored.
    """
    for read in _readers(tree, source):
        try:
            yield from read()
        except RealizerError as refused:
            notes.append(refused.fault)


def break_of(tree: Tree, source: BlockSource) -> Markup | None:
    """The silence of a ``<break>``; None for one that prevents a silence.

    Raises:
        RealizerError: ``bad-attribute``.
    """
    name, read = ("time", read_time) if "time" in tree.attrib else ("strength", read_strength)
    seconds = _read(tree, name, read, source) if name in tree.attrib else read_strength("medium")
    return Markup(MarkupKind.BREAK, 0, 0, "<break>", number=seconds) if seconds else None


def _readers(tree: Tree, source: BlockSource) -> Iterator[Callable[[], Iterator[Markup]]]:
    """A reader of each property, so that one bad attribute does not lose another one."""
    name = name_of(tree)
    if not is_ssml(tree) or name not in ATTRIBUTES:
        yield partial(_other, f"<{name}>")
        return
    if _LANG in tree.attrib:
        yield partial(_language, tree)
    if name == "prosody":
        yield from (partial(_prosody, tree, attribute, source) for attribute in names_in(tree))
    elif name in _READERS:
        yield partial(_READERS[name], tree, source)


def _other(written: str) -> Iterator[Markup]:
    yield Markup(MarkupKind.OTHER, 0, 0, written)


def _language(tree: Tree) -> Iterator[Markup]:
    language = tree.get(_LANG, "").strip()
    yield Markup(MarkupKind.LANGUAGE, 0, 0, f'<{name_of(tree)} xml:lang="{quoted(language)}">', text=language)


def _sentence(tree: Tree, source: BlockSource) -> Iterator[Markup]:
    yield Markup(MarkupKind.SENTENCE, 0, 0, f"<{name_of(tree)}>")


def _prosody(tree: Tree, attribute: str, source: BlockSource) -> Iterator[Markup]:
    written = _start(tree, attribute)
    if attribute in _FACTORS:
        kind, read = _FACTORS[attribute]
        factor = _read(tree, attribute, read, source)
        yield Markup(MarkupKind.OTHER, 0, 0, written) if factor is None else Markup(kind, 0, 0, written, factor)
    elif attribute in ATTRIBUTES["prosody"]:
        yield Markup(MarkupKind.OTHER, 0, 0, written)


def _emphasis(tree: Tree, source: BlockSource) -> Iterator[Markup]:
    level = _read(tree, "level", partial(_word, _LEVELS), source) if "level" in tree.attrib else "moderate"
    if level != "none":
        yield Markup(MarkupKind.EMPHASIS, 0, 0, "<emphasis>", text=level)


def _sub(tree: Tree, source: BlockSource) -> Iterator[Markup]:
    yield Markup(MarkupKind.SUB, 0, 0, "<sub>", text=_wanted(tree, "alias", source))


def _say_as(tree: Tree, source: BlockSource) -> Iterator[Markup]:
    form = _wanted(tree, "interpret-as", source)
    written = _start(tree, "interpret-as")
    kind = MarkupKind.SAY_AS if form in _SPELLED else MarkupKind.OTHER
    yield Markup(kind, 0, 0, written, text=_SPELLED.get(form, form))


def _phoneme(tree: Tree, source: BlockSource) -> Iterator[Markup]:
    sounds, alphabet = _wanted(tree, "ph", source), tree.get("alphabet", "ipa")
    kind = MarkupKind.PHONEME if alphabet == "ipa" else MarkupKind.OTHER
    yield Markup(kind, 0, 0, f'<phoneme alphabet="{quoted(alphabet)}">', text=sounds)


def _voice(tree: Tree, source: BlockSource) -> Iterator[Markup]:
    others = [name for name in ("gender", "age", "variant", "languages") if name in tree.attrib]
    if name := tree.get("name", "").strip():
        yield Markup(MarkupKind.VOICE, 0, 0, _start(tree, "name"), text=name)
    for attribute in others:
        yield Markup(MarkupKind.OTHER, 0, 0, _start(tree, attribute))


_READERS: Final[Mapping[str, Callable[[Tree, BlockSource], Iterator[Markup]]]] = MappingProxyType(
    {
        "s": _sentence,
        "p": _sentence,
        "emphasis": _emphasis,
        "sub": _sub,
        "say-as": _say_as,
        "phoneme": _phoneme,
        "voice": _voice,
    }
)


def _start(tree: Tree, attribute: str) -> str:
    """The start tag of an element with one of its attributes."""
    return f'<{name_of(tree)} {attribute}="{quoted(tree.get(attribute, ""))}">'


def _wanted(tree: Tree, name: str, source: BlockSource) -> str:
    value = tree.get(name, "").strip()
    if not value:
        raise RealizerError(source.located(tree, MissingAttribute(element=name_of(tree), attribute=name)))
    return value


def _read(tree: Tree, name: str, read: Callable[[str], T], source: BlockSource) -> T:
    text = tree.get(name, "").strip()
    try:
        return read(text)
    except RealizerError as refused:
        raise source.bad_attribute(tree, name, text, refused) from None


def _word(known: tuple[str, ...], text: str) -> str:
    if text not in known:
        raise RealizerError(UnknownWord(word=text, known=known))
    return text
