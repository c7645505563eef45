"""Faces of SmartBody: action units with ramps, and visemes."""

from typing import Final

from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.extensions import WHOLE_FACE
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.smartbody.attributes import (
    drop,
    fade_out,
    left_out,
    limit_amount,
    rename,
    take,
    take_number,
    tie,
)
from reactive_realizer.bml.trees import Tree
from reactive_realizer.bml.value_faults import UnknownWord
from reactive_realizer.errors import Fault, RealizerError

_LONGEST: Final = 60.0
_PEAKS: Final = ("ready", "strokeStart", "stroke_start", "stroke")
"""Points of a face at one of which it is complete: the first one that is tied."""
_SHOWN: Final = ("strokeEnd", "stroke_end")
"""Points until which a face stays complete, if its relax is not tied."""
_RAMPS: Final = {
    "duration": ("end", "start"),
    "rampup": ("attackPeak", "start"),
}
"""Times of a face, and the points that they tie after another one."""
_RAMPDOWN: Final = "rampdown"
_USUAL_AMOUNT: Final = 0.5
_VISEMES: Final = {
    word: number
    for number, words in enumerate(
        (
            "_ SIL",
            "PBM BMP",
            "FV F",
            "TH TTEETH",
            "D TROOF",
            "KG TBACK",
            "SHCH SH J",
            "Z",
            "L NG N",
            "R ER",
            "AH AA OPEN",
            "EH AE",
            "IH EE WIDE",
            "AO OH OW",
            "W OO UW",
        )
    )
    for word in words.split()
}
"""Visemes of SmartBody, to the numbers of those of MPEG-4 (ISO/IEC 14496-2, annex C) that have the same sounds."""


def adapt_face(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a face, in place, and returns the faults of what is left out."""
    for point in _PEAKS:
        if point in tree.attrib:
            rename(tree, point, "attackPeak")
    for point in _SHOWN:
        if point in tree.attrib:
            rename(tree, point, "relax")
    drop(tree, *_PEAKS, *_SHOWN)
    amount = limit_amount(tree)
    for name, (point, other) in _RAMPS.items():
        seconds = take_number(tree, name, source, 0.0, _LONGEST)
        if seconds is not None:
            tie(tree, point, other, seconds)
    faults = [*_ramp_down(tree, source), *left_out(tree, source)]
    if tree.get("type", "").lower() == "viseme":
        _show_viseme(tree, amount if "amount" in tree.attrib else _USUAL_AMOUNT, source)
    return faults


def _ramp_down(tree: Tree, source: BlockSource) -> list[Fault]:
    """Ties the relax of a face before its end; the fault of a time that is too long."""
    seconds = take_number(tree, _RAMPDOWN, source, 0.0, _LONGEST)
    if seconds is None:
        return []
    if "end" in tree.attrib:
        return fade_out(tree, _RAMPDOWN, seconds, source)
    tie(tree, "relax", "end", -seconds)
    return []


def _show_viseme(tree: Tree, amount: float, source: BlockSource) -> None:
    """Rewrites a viseme as that of MPEG-4.

    Raises:
        RealizerError: ``bad-attribute``: it is not known.
    """
    viseme = take(tree, "viseme")
    number = _VISEMES.get(viseme.upper())
    if number is None:
        known = tuple(_VISEMES)
        raise source.bad_attribute(tree, "viseme", viseme, RealizerError(UnknownWord(word=viseme, known=known)))
    drop(tree, "type", "amount", "au", "side")
    tree.tag = f"{{{BMLT}}}facefap"
    tree.set("fap", "viseme")
    tree.set("viseme_select1", str(number))
    tree.set("viseme_blend", f"{WHOLE_FACE * max(0.0, min(amount, 1.0)):.0f}")
