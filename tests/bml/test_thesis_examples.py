"""The BML examples of the thesis (van Welbergen 2011, examples 2 to 57), each with one of our own that means the same.

The thesis prints many of them as fragments, and some with slips. Where the text of the thesis is available, the printed
examples are tested too. Every repair has a name here; the parser makes none.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.block import Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.references import check_references
from reactive_realizer.limits import Limits
from reactive_realizer.testing.pilot import open_pilot

OWN = Path(__file__).parents[1] / "data" / "bml" / "drafts"

Repair = Callable[[str], str]


def declare_bmlt(text: str) -> str:
    """Declares the namespace, which the thesis omits for clarity."""
    return re.sub(r"<(bml|bmlt:defineproc|bmlt:useproc) ", rf'<\1 xmlns:bmlt="{BMLT}" ', text)


def put_into_a_block(text: str, beside: str = "") -> str:
    """Puts a fragment into a block, with the behaviors to which it refers."""
    return f'<bml id="b" xmlns:bmlt="{BMLT}" bmlt:allowexternalrefs="true">{beside}{text}</bml>'


def take_out_ellipses(text: str, there: str = "") -> str:
    """Replaces lines of dots, which stand for omitted content."""
    return re.sub(r"^(?:\.{2,3}|bmlNew content)$", there, text, flags=re.MULTILINE)


def close(text: str, element: str) -> str:
    """Closes a start tag that has no end tag."""
    return re.sub(rf"<({element} [^<>]*[^/<>])>", r"<\1/>", text)


def write(text: str, wrong: str, right: str) -> str:
    """Corrects a slip."""
    assert wrong in text
    return text.replace(wrong, right, 1)


def block(beside: str = "") -> Repair:
    return partial(put_into_a_block, beside=beside)


def slip(wrong: str, right: str) -> Repair:
    return partial(write, wrong=wrong, right=right)


@dataclass(frozen=True)
class Part:
    """A part of an example.

    Attributes:
        first: its first line in the thesis.
        last: its last line there.
        means: the classes of its content after the repairs.
        repairs: of the printed text.
        printed: the first problem of the printed text, with its line.
        still: the problems after all repairs, which our own example has too.
    """

    first: int
    last: int
    means: str
    repairs: tuple[Repair, ...] = ()
    printed: tuple[str, int] | None = None
    still: str = ""

    def read(self, thesis: list[str]) -> str:
        """The printed text."""
        lines = thesis[self.first - 1 : self.last]
        # The text has a mark at each page break.
        return "\n".join(re.sub(r"<\|.*?\|>", "", line) for line in lines)

    def repaired(self, thesis: list[str]) -> str:
        """The text after the repairs."""
        text = self.read(thesis)
        for repair in self.repairs:
            text = repair(text)
        return text


SYNC = partial(close, element="sync")
GESTURE = partial(close, element="gesture")
DOTS = take_out_ellipses
FRAGMENT = ("not-bml", 1)
UNBOUND = ("malformed-xml", 1)
LOOK = '<gaze id="gaze1" target="AUDIENCE"/>'
SHAKE = '<head id="shake1" rotation="SHAKE"/>'
WELCOME = f'{LOOK}<speech id="speech1"><text>Welcome</text></speech>'
THREE = (
    '<speech id="speech1"><text>a <sync id="sync4"/> b</text></speech><gesture id="beat1" type="BEAT"/>'
    '<head id="nod1" rotation="NOD"/>'
)

EXAMPLES: dict[int, tuple[Part, ...]] = {
    2: (Part(3988, 3991, "Speech", (SYNC, block()), ("malformed-xml", 3)),),
    3: (
        Part(4018, 4028, "Gaze Speech Synchronize"),
        Part(4032, 4037, "Gaze Speech Synchronize", (block(WELCOME),), FRAGMENT),
        Part(4040, 4045, "Speech Gesture Head Synchronize", (block(THREE),), FRAGMENT),
        Part(4049, 4053, "Gaze Speech Order", (block(WELCOME),), FRAGMENT),
    ),
    4: (Part(4119, 4122, "Gaze ForeignBehavior"),),
    5: (Part(4154, 4167, "Speech", (block(),), FRAGMENT),),
    6: (Part(4172, 4196, "Speech", (block(),), FRAGMENT, "other-markup"),),
    7: (Part(4395, 4404, "ProcAnimation Synchronize Synchronize", (DOTS, block()), UNBOUND),),
    8: (Part(4472, 4476, "Speech", (slip("stop+x", "stop+0.5"),), ("bad-attribute", 2)),),
    9: (Part(4541, 4546, "ParameterValueChange", (declare_bmlt,), UNBOUND),),
    10: (
        Part(4594, 4596, "Interrupt", (declare_bmlt,), ("malformed-xml", 2)),
        Part(4599, 4601, "Interrupt", (declare_bmlt,), ("malformed-xml", 2)),
        Part(4605, 4608, "Interrupt Controller", (declare_bmlt,), ("malformed-xml", 2)),
    ),
    11: (
        Part(4715, 4720, "Speech, Speech", (declare_bmlt,), UNBOUND),
        Part(4722, 4730, "Speech, Speech, Speech", (declare_bmlt,), UNBOUND),
        Part(4732, 4734, "Speech", (declare_bmlt,), UNBOUND),
        Part(4737, 4737, "", (declare_bmlt,), UNBOUND),
        Part(4739, 4741, ", , ", (declare_bmlt,), UNBOUND),
        Part(4744, 4745, ", ", (declare_bmlt,), UNBOUND),
    ),
    12: (
        Part(4786, 4788, "", (DOTS, declare_bmlt), UNBOUND),
        Part(4791, 4793, "Activate", (declare_bmlt,), ("malformed-xml", 2)),
        Part(4796, 4800, "Head Activate", (DOTS, declare_bmlt), ("malformed-xml", 3)),
    ),
    13: (
        Part(4838, 4843, "defines Gaze Speech", (declare_bmlt,), UNBOUND),
        Part(4846, 4846, "uses proc1", (declare_bmlt,), UNBOUND),
        Part(4849, 4854, "Gaze Speech"),
    ),
    14: (Part(4879, 4879, "Gaze Interrupt", (block(LOOK),), UNBOUND),),
    15: (Part(4892, 4895, "Head Interrupt Interrupt", (block(SHAKE),), UNBOUND),),
    16: (
        Part(
            4911,
            4917,
            "Head Interrupt Interrupt Interrupt Activate Activate",
            (slip('"include', '" include'), block(SHAKE)),
            UNBOUND,
        ),
    ),
    17: (Part(4940, 4944, "Speech"),),
    18: (
        Part(5026, 5029, "Controller", (block(),), UNBOUND),
        Part(5032, 5039, "Posture", (block(),), ("malformed-xml", 3)),
    ),
    19: (Part(5048, 5055, "Gesture Controller Controller", (block('<gesture id="g1" type="BEAT"/>'),), UNBOUND),),
    20: (Part(5082, 5084, "", (DOTS,), ("stray-text", 1)),),
    21: (Part(5096, 5101, "ParameterValueChange", (declare_bmlt,), UNBOUND),),
    22: (
        Part(5113, 5115, "", (DOTS, declare_bmlt), UNBOUND),
        Part(5119, 5124, "Interrupt Interrupt Interrupt", (DOTS, declare_bmlt), ("malformed-xml", 2)),
        Part(5128, 5130, "", (DOTS,), ("stray-text", 1)),
    ),
    23: (
        Part(5143, 5145, "", (DOTS, declare_bmlt), UNBOUND),
        Part(5148, 5154, "Activate Activate Activate", (DOTS, declare_bmlt), ("malformed-xml", 2)),
    ),
    24: (
        Part(
            5338,
            5341,
            "Gaze Head",
            (partial(DOTS, there='<head id="beh1" rotation="NOD"/>'), slip("<gaze ", '<gaze target="AUDIENCE" ')),
            ("stray-text", 1),
        ),
    ),
    25: (Part(5454, 5457, "Speech Gesture", (slip('id="s1"', 'id="speech1"'),), ("unknown-reference", 3)),),
    26: (
        Part(
            5497,
            5514,
            "Speech Pointing Locomotion Order Order",
            (SYNC, slip("speech:", "speech1:")),
            ("malformed-xml", 5),
            still="unknown-sync",
        ),
    ),
    27: (
        Part(5757, 5763, "Speech Head", (SYNC,), ("malformed-xml", 3)),
        Part(5766, 5772, "Head Speech", (SYNC,), ("malformed-xml", 5)),
    ),
    28: (Part(5796, 5799, "Head Gesture"), Part(5802, 5805, "Gesture Head")),
    29: (
        Part(5810, 5815, "Gesture Gesture Head", (GESTURE,), ("malformed-xml", 6)),
        Part(5827, 5832, "Head Gesture Gesture", (GESTURE,), ("malformed-xml", 6)),
    ),
    30: (Part(6032, 6042, "Speech Pointing Head Locomotion", (SYNC,), ("malformed-xml", 5), still="unknown-sync"),),
    31: (Part(6902, 6913, "Gesture Synchronize Synchronize"),),
    32: (Part(8907, 8910, "Speech Gesture", (SYNC, slip("type=..", 'type="BEAT"')), ("malformed-xml", 2)),),
    33: (Part(8921, 8923, "", (DOTS,), ("stray-text", 1)),),
    34: (Part(8928, 8937, "Order", (DOTS,), ("stray-text", 1)),),
    35: (Part(8942, 8945, "Speech Gesture", (SYNC, slip("type=..", 'type="BEAT"')), ("malformed-xml", 2)),),
    36: (Part(9309, 9312, "Keyframe", (block(),), UNBOUND),),
    37: (Part(9335, 9335, "AudioFile", (block(),), UNBOUND),),
    38: (Part(9359, 9362, "Controller", (block(),), UNBOUND),),
    39: (Part(9382, 9384, "ProcAnimation", (block(),), UNBOUND),),
    40: (Part(9404, 9408, "Transition ProcAnimation", (block(),), UNBOUND),),
    41: (Part(9432, 9435, "Noise", (block(),), UNBOUND),),
    42: (Part(9467, 9468, "FaceMorph", (slip("<facemorph", "<bmlt:facemorph"), block()), FRAGMENT),),
    43: (Part(9511, 9512, "Head Interrupt", (block(SHAKE),), UNBOUND),),
    44: (Part(9536, 9539, "ParameterValueChange", (block(),), UNBOUND),),
    45: (Part(9582, 9584, "", (DOTS, declare_bmlt), UNBOUND),),
    46: (Part(9605, 9605, "Activate", (block(),), UNBOUND),),
    47: (Part(9616, 9627, "ProcAnimation Synchronize Synchronize Synchronize", (block(),), UNBOUND),),
    48: (Part(9636, 9638, "Controller"),),
    49: (
        Part(
            9652,
            9661,
            "Controller Controller",
            (slip('id="balance1" class="BalanceController" start', 'id="balance2" class="BalanceController" start'),),
            ("duplicate-id", 6),
        ),
    ),
    50: (Part(9665, 9671, "Posture Controller"),),
    51: (Part(9682, 9690, "Gesture", (block(),), ("malformed-xml", 4)),),
    52: (Part(9700, 9707, "Speech", still="other-markup"),),
    53: (Part(9710, 9719, "Speech"),),
    54: (Part(9721, 9730, "Speech", still="other-markup"),),
    55: (Part(9774, 9776, "", (DOTS,), ("stray-text", 1)),),
    56: (Part(9786, 9791, "ParameterValueChange", (declare_bmlt,), UNBOUND),),
    57: (
        Part(9803, 9805, "", (DOTS, declare_bmlt), UNBOUND),
        Part(9809, 9814, "Interrupt Interrupt Interrupt", (DOTS, declare_bmlt), ("malformed-xml", 2)),
        Part(9818, 9820, "", (DOTS,), ("stray-text", 1)),
    ),
}
SAYS_THE_SAME = {44: 9, 55: 20, 56: 21, 57: 22}
"""Examples that the thesis prints twice; our own has the earlier number."""
PARTS = {f"{number}-{chr(97 + at)}": part for number, parts in EXAMPLES.items() for at, part in enumerate(parts)}

LATER: dict[type[Behavior], str] = {
    ForeignBehavior: "CUSTOM_BEHAVIOUR_NOT_SUPPORTED",
}
"""The behaviors that are not realized, with their warnings."""


@pytest.fixture(scope="module")
def thesis(shared: Path) -> list[str]:
    """The lines of the thesis."""
    (path,) = (shared / "seeds").glob("000_*.txt")
    return path.read_text(encoding="utf-8").split("\n")


def meaning(text: str) -> list[str]:
    """The classes of the content of each top-level element."""
    return [_meaning(parsed) for parsed in parse(text, Limits())]


def _meaning(parsed: Parsed) -> str:
    if parsed.block is not None and parsed.block.procedure is not None:
        return f"uses {parsed.block.procedure}"
    held = parsed.procedure or parsed.block
    assert held is not None, parsed.problems
    names = " ".join(type(each).__name__ for each in (*held.behaviors, *held.constraints))
    return f"defines {names}" if parsed.procedure else names


def faults(text: str) -> list[tuple[str, int]]:
    """The problems with their lines: those of the parser, then missing references."""
    found = []
    for parsed in parse(text, Limits()):
        held = parsed.procedure or parsed.block
        for problem in (*parsed.problems, *(check_references(held) if held else ())):
            assert problem.fault.line is not None
            found.append((problem.fault.code, problem.fault.line))
    return found


def codes(text: str) -> str:
    return " ".join(code for code, _ in faults(text))


def test_every_example_has_a_row() -> None:
    assert list(EXAMPLES) == list(range(2, 58))
    assert {path.stem for path in OWN.glob("[0-9]*.xml")} == {
        f"{number:02}" for number in EXAMPLES if number not in SAYS_THE_SAME
    }


def test_our_own_examples_mean_the_same_as_those_of_the_thesis(subtests: pytest.Subtests) -> None:
    for number in EXAMPLES:
        with subtests.test(f"example {number}"):
            text = (OWN / f"{SAYS_THE_SAME.get(number, number):02}.xml").read_text()
            parts = EXAMPLES[number]
            means = ", ".join(part.means for part in parts)
            assert ", ".join(meaning(text)).replace("greet", "proc1") == means
            assert codes(text) == " ".join(filter(None, (part.still for part in parts)))


@pytest.mark.parametrize("text", [pytest.param(path.read_text(), id=path.stem) for path in sorted(OWN.glob("*.xml"))])
async def test_a_behavior_that_is_not_realized_yet_gets_one_warning(text: str) -> None:
    blocks = [parsed.block for parsed in parse(text, Limits()) if parsed.block]
    expected = [
        (f"{held.id}:{each.id}", LATER[type(each)]) for held in blocks for each in held.behaviors if type(each) in LATER
    ]
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.perform(text)
        await pilot.tick()
        assert [warning for warning in pilot.feedback.warnings if warning[1] in LATER.values()] == expected


SLIPS: dict[str, tuple[str, tuple[str, int]]] = {
    "an undeclared prefix": (
        '<bml id="b">\n<bmlt:noise id="n" type="perlin" joint="vl5"/></bml>',
        ("malformed-xml", 2),
    ),
    "an undeclared prefix of an attribute": ('<bml id="b" bmlt:preplan="true"/>', UNBOUND),
    "a fragment": ('<speech id="s"><text>Hi</text></speech>', FRAGMENT),
    "a start tag without an end": (
        '<bml id="b">\n<speech id="s"><text>so <sync id="m"> far\n</text></speech></bml>',
        ("malformed-xml", 3),
    ),
    "an attribute without quotes": ('<bml id="b">\n\n<gesture id="g" type=BEAT/></bml>', ("malformed-xml", 3)),
    "attributes without a space between": ('<bml id="b">\n<gaze id="g"target="box"/></bml>', ("malformed-xml", 2)),
    "an ellipsis": ('<bml id="b">\n...\n</bml>', ("stray-text", 1)),
    "an empty id": ('<bml id="">\n<head id="h" rotation="NOD"/></bml>', ("no-block-id", 1)),
    "an offset that is no number": (
        '<bml id="b">\n<speech id="s" start="b:start+y"><text>Hi</text></speech></bml>',
        ("bad-attribute", 2),
    ),
    "an id twice": (
        '<bml id="b">\n<head id="h" rotation="NOD"/>\n<head id="h" rotation="SHAKE"/></bml>',
        ("duplicate-id", 3),
    ),
    "another name than that of the speech": (
        '<bml id="b">\n<speech id="s"><text>Hi</text></speech>\n<gesture id="g" type="BEAT" start="t:go"/></bml>',
        ("unknown-reference", 3),
    ),
}
"""Slips like those of the printed examples, with the first problem and its line."""


def test_slips_like_those_in_print_are_found_at_the_right_line(subtests: pytest.Subtests) -> None:
    printed = {part.printed[0] for part in PARTS.values() if part.printed}
    assert {code for _, (code, _) in SLIPS.values()} >= printed
    for name, (text, problem) in SLIPS.items():
        with subtests.test(name):
            assert faults(text)[0] == problem


def test_the_examples_of_the_thesis_are_read_after_their_repairs(thesis: list[str], subtests: pytest.Subtests) -> None:
    for name, part in PARTS.items():
        with subtests.test(name):
            text = part.repaired(thesis)
            assert ", ".join(meaning(text)) == part.means
            assert codes(text) == part.still


def test_the_printed_examples_are_read_or_refused_at_the_right_line(
    thesis: list[str], subtests: pytest.Subtests
) -> None:
    for name, part in PARTS.items():
        with subtests.test(name):
            found = faults(part.read(thesis))
            if part.repairs:
                assert found[0] == part.printed
            else:
                assert [code for code, _ in found] == part.still.split()
