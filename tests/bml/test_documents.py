"""Documents: several blocks, content between them, encodings, locations."""

from pathlib import Path
from xml.sax.saxutils import quoteattr

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.block import BehaviorBlock, Parsed
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.elements import ELEMENTS
from reactive_realizer.bml.names import BML, BMLA, Location
from reactive_realizer.bml.references import check_references
from reactive_realizer.limits import Limits

OWN_DATA = Path(__file__).parents[1] / "data" / "bml"
REFUSED = {"no_id.xml": "no-block-id", "bmlnoid.xml": "no-block-id"}


def read(text: str | bytes) -> list[Parsed]:
    return parse(text, Limits())


def ids(text: str | bytes) -> list[str | None]:
    """The id of each block, None for a refused one."""
    return [parsed.block.id if parsed.block else None for parsed in read(text)]


def faults(text: str | bytes) -> list[tuple[str, str]]:
    return [(problem.id, problem.fault.code) for parsed in read(text) for problem in parsed.problems]


def test_a_document_may_have_several_blocks_comments_instructions_and_declarations() -> None:
    text = """<!-- <bml> in a comment -->
      <?xml version="1.0" encoding="UTF-8"?>
      <bml id="one"/> <?go <bml id="no"/> ?>
      <bml id="two"><description><bml id="inside"/></description></bml><!-- end -->
    """
    assert ids(text) == ["one", "two"]


MALFORMED = [
    '<bml id="bad"><head></bml>',
    '<bml id="bad"><head id="h" lexeme=NOD/></bml>',
    '<bml id="bad">&unknown;</bml>',
    '<bml id="bad"><head a="1" a="2"/></bml>',
    '<bml id="bad"><x:head/></bml>',
    '<bml id="bad">a & b</bml>',
    '<bml id="bad">\x01</bml>',
    '<bml id="bad">\ud800</bml>',
    '<bml id="bad"><?xml version="1.0"?></bml>',
    '<bml id="bad" xmlns:x="http://["></bml>',
]


def test_a_malformed_block_is_reported_at_its_line_and_the_next_one_is_read(subtests: pytest.Subtests) -> None:
    for broken in MALFORMED:
        with subtests.test(repr(broken)):
            text = f'<bml id="one"/>\n\n{broken}\n<bml id="two"/>'
            assert ids(text) == ["one", None, "two"]
            assert faults(text) == [("bad", "malformed-xml")]
            assert read(text)[1].problems[0].fault.line == 3


def test_the_problem_of_an_unclosed_block_names_the_open_element() -> None:
    text = '<bml id="one"/>\n<bml id="two">\n  <speech id="s"><text>Hi'
    assert ids(text) == ["one", None]
    (problem,) = read(text)[1].problems
    assert str(problem.fault) == "line 3, column 18: not well-formed XML: the document ends inside <text>"


DECLARING_DOCTYPES = [
    '<!DOCTYPE bml [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><bml id="bad">&b;</bml>',
    '<?xml version="1.0"?>\n<!DOCTYPE bml [<!ENTITY x SYSTEM "file:///etc/passwd">]><bml id="bad">&x;</bml>',
    "<!doctype bml><bml></bml>",
    '<bml id="bad"><!DOCTYPE bml></bml>',
    '<!DOCTYPE bml [<!ENTITY a "</bml>"> <!-- it\'s ]> --> <?go "?> <!ELEMENT bml ANY>\n] ><bml id="bad"><a></bml>',
    '<!DOCTYPE act SYSTEM "]>" [<!ELEMENT act ANY>]><act><bml id="one"/>\n<bml id="two"/></act>',
    '<!DOCTYPE fml-apml [<!ELEMENT fml-apml ANY>]><fml-apml><bml id="bad"/><fml/></fml-apml>',
]


def test_a_doctype_that_declares_something_is_refused_together_with_its_block(subtests: pytest.Subtests) -> None:
    for text in DECLARING_DOCTYPES:
        with subtests.test(text):
            assert [code for _, code in faults(text)] == ["doctype"]
            assert ids(f'{text}<bml id="next"/>') == [None, "next"]


@pytest.mark.parametrize(
    "text",
    ["<!DOCTYPE bml [<!ELEMENT bml ANY>]>\n", '<!DOCTYPE bml [<!ELEMENT bml ANY>\n<bml id="b"/>', "<!DOCTYPE bml ["],
)
def test_a_doctype_without_a_block_or_without_an_end_is_refused_alone(text: str) -> None:
    assert faults(f'<bml id="one"/>{text}') == [("bml", "doctype")]
    assert ids(f'<bml id="one"/>{text}') == ["one", None]


def test_a_long_doctype_takes_no_more_than_its_length() -> None:
    for part in (
        "<!DOCTYPE bml [<!-- -->",
        "<!DOCTYPE bml [' ",
        '<!DOCTYPE bml "',
        "<!DOCTYPE bml [<!ELEMENT a ANY>]>",
    ):
        assert faults(part * 20_000)[-1] == ("bml", "doctype")


PLAIN_DOCTYPES = [
    "<!DOCTYPE bml>",
    "<?xml version='1.0'?>\n<!DOCTYPE bml SYSTEM 'http://example.org/bml.dtd' [ ]>",
    '<!-- one --><!DOCTYPE fml-apml PUBLIC "-//X//EN" "fml-apml.dtd">',
]


def test_a_doctype_that_declares_nothing_has_no_effect(subtests: pytest.Subtests) -> None:
    for doctype in PLAIN_DOCTYPES:
        with subtests.test(doctype):
            assert ids(f'{doctype}<bml id="one"/>{doctype}<bml id="two"/>') == ["one", "two"]
            (problem,) = read(f'{doctype}<bml id="b">&foo;</bml>')[0].problems
            assert problem.fault.code == "malformed-xml"


WITHOUT_BLOCK: list[str | bytes] = ["", "  \n ", b"", "<!-- nothing -->", '<?xml version="1.0"?>', b"\xef\xbb\xbf"]


def test_a_document_without_a_block_is_refused(subtests: pytest.Subtests) -> None:
    for text in WITHOUT_BLOCK:
        with subtests.test(repr(text)):
            assert faults(text) == [("bml", "no-block")]


def test_other_content_between_blocks_is_reported_and_all_blocks_are_read() -> None:
    assert ids('hello <bml id="one"/> <speech/> & <bml id="two"/></bml> <bml id="three"/>') == [
        None,
        "one",
        None,
        None,
        "two",
        None,
        "three",
    ]
    assert faults('hello <speech/> & <bml id="b"/> </bml>') == [
        ("bml", "stray-text"),
        ("bml", "not-bml"),
        ("bml", "malformed-xml"),
        ("bml", "malformed-xml"),
    ]


def test_locations_are_those_of_start_tags_in_lines_and_characters_from_1(subtests: pytest.Subtests) -> None:
    for newline in ["\n", "\r\n", "\r"]:
        with subtests.test(repr(newline)):
            lines = [
                "",
                '<bml id="é">  <wait',
                ' id="é1"/><wait id="2"/></bml> <bml id="b"',
                '><wait id="3"/>',
                "</bml>",
            ]
            one, two = read(newline.join(lines).encode())
            assert one.block is not None
            assert two.block is not None
            assert one.block.location == Location(2, 1)
            assert [behavior.location for behavior in one.block.behaviors] == [Location(2, 15), Location(3, 11)]
            assert two.block.location == Location(3, 32)
            assert [behavior.location for behavior in two.block.behaviors] == [Location(4, 2)]


def test_bytes_are_read_in_their_declared_encoding(subtests: pytest.Subtests) -> None:
    for encoding in ["utf-8", "utf-8-sig", "utf-16", "iso-8859-1"]:
        with subtests.test(encoding):
            declared = encoding.removesuffix("-sig")
            text = f'<?xml version="1.0" encoding="{declared}"?><bml id="é"/>'
            assert ids(text.encode(encoding)) == ["é"]
            assert ids(text) == ["é"]


def test_other_encodings_are_refused(subtests: pytest.Subtests) -> None:
    for encoding in ["rot13", "zip", "utf-7", "klingon", "idna"]:
        with subtests.test(encoding):
            assert faults(f'<?xml version="1.0" encoding="{encoding}"?><bml id="b"/>'.encode()) == [
                ("bml", "bad-encoding")
            ]


def test_invalid_bytes_are_reported_with_their_line() -> None:
    text = b'<bml id="a"/>\n<bml id="bad">\n\xff</bml><bml id="b"/>'
    assert ids(text) == ["a", None, "b"]
    (problem,) = read(text)[1].problems
    assert (problem.id, problem.fault.code, problem.fault.line) == ("bad", "malformed-xml", 3)
    assert "this is not UTF-8; another encoding has to be declared" in problem.fault.sentence


def check(path: Path) -> None:
    for parsed in read(path.read_bytes()):
        codes = [problem.fault.code for problem in parsed.problems]
        assert codes == ([REFUSED[path.name]] if path.name in REFUSED else []), path
        assert (parsed.block is None) == (path.name in REFUSED)


def test_our_own_scripts_are_read_without_problems() -> None:
    paths = sorted(OWN_DATA.glob("*.xml"))
    assert paths
    for path in paths:
        check(path)


@pytest.mark.parametrize("folder", ["realizertester/bml-1", "asap/bml"])
def test_the_scripts_of_other_realizers_are_read_without_problems(shared_cases: Path, folder: str) -> None:
    paths = sorted((shared_cases / folder).rglob("*.xml"))
    assert paths
    for path in paths:
        check(path)


MARKUP = """<bml id='a'>|<bml|</bml>|<bml id='b'/>|<!--|-->|<![CDATA[|]]>|<?xml version='1.0'?>|<!DOCTYPE x>|<required>
</required>|<constraint>|</constraint>|<synchronize>|</synchronize>|<after ref='h:end'>|</after>|<sync ref='1'/>
<speech id='s'>|<text>|<sync id='t'/>|</text>|</speech>|<head id='h' lexeme='N' start='|'/>|s:t+1|nan|&amp;|&x;|<_>|</_>
<face id='f'>|<faceLexeme lexeme='x'/>|</face>|<posture id='p'>|<pose part='ARMS' lexeme='y'/>|</posture>|<x:y| xmlns=''
 xmlns:x='u}v'| xmlns='http://['|>|'|=|\x00|\ud800|é|\r"""
tokens = st.sampled_from([token for line in MARKUP.split("\n") for token in line.split("|")])
documents = st.text() | st.binary() | st.lists(tokens, max_size=30).map("".join)

ROOTS = ["bml", "p:defineproc", "p:useproc"]
INNER = ["text", "tm", "sync", "description", "stance", "pose", "trajectory", "p:trajectory", "p:useproc"]
AROUND = ["required", "constraint", "synchronize", "after"]
NAMES = [*ELEMENTS, *(f"p:{name}" for name, each in ELEMENTS.items() if each.continuous), *INNER, *AROUND]
VALUES = [
    "",
    "x",
    "y",
    "1",
    "2.5",
    "-1",
    "nan",
    "x:start",
    "y:stroke:2-1",
    "x:t-1",
    "BEAT",
    "LEFT_HAND",
    "ARMS",
    "é&",
    "x,y",
    "true",
    "FACS",
    "AT",
]
DRAFTED = ["type", "hand", "rotation", "action", "modality", "shape", "part", "stroke_start", "scheduling"]
ATTRIBUTES = [
    *(each.name for element in ELEMENTS.values() for each in element.attributes),
    *(f"p:{each.name}" for each in attributes_of(BehaviorBlock) if each.continuous),
    *["start", "end", "ref", "composition", "procid", "bmlid", *DRAFTED],
]
tags = st.tuples(st.sampled_from(NAMES), st.dictionaries(st.sampled_from(ATTRIBUTES), st.sampled_from(VALUES)))


def written(tag: tuple[str, dict[str, str]], inside: list[str]) -> str:
    name, attributes = tag
    says = "".join(f" {key}={quoteattr(value)}" for key, value in attributes.items())
    return f"<{name}{says}>{''.join(inside)}</{name}>"


elements = st.recursive(
    st.builds(written, tags, st.just([])), lambda inside: st.builds(written, tags, st.lists(inside, max_size=4))
)
roots = st.tuples(st.sampled_from(ROOTS), st.dictionaries(st.sampled_from(ATTRIBUTES), st.sampled_from(VALUES)))


@st.composite
def blocks(draw: st.DrawFn) -> str:
    name, attributes = draw(roots)
    tag = name, {"id": "b", "xmlns:p": BMLA} | attributes | draw(st.sampled_from([{}, {"xmlns": BML}]))
    return written(tag, draw(st.lists(elements, max_size=6)))


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@settings(derandomize=True, max_examples=200)
@given(documents | blocks())
def test_any_document_has_a_valid_result(document: str | bytes) -> None:
    answer = read(document)
    assert answer
    for parsed in answer:
        problems = list(parsed.problems)
        held = parsed.block or parsed.procedure
        if held:
            problems += check_references(held)
        assert held or parsed.refusal in [problem.fault for problem in problems]
        assert all(str(problem.fault) and problem.id and problem.fault.warning for problem in problems)
