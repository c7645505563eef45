"""docs/formulas.md: its formulas have the values that it gives, it lists every function, and its animation plays."""

import re
from itertools import pairwise, product
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions
from reactive_realizer.engines.animation.expression.compiler import compile_formulas
from reactive_realizer.engines.animation.expression.functions import FUNCTIONS
from reactive_realizer.engines.animation.expression.syntax import DEEPEST, LONGEST, parse
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import LONGEST as LONGEST_OF_A_FILE
from reactive_realizer.testing.pilot import open_pilot

from .conftest import EXAMPLES, fences, page
from .installing import install

PAGE = "docs/formulas.md"
TEXT = page(PAGE)
VALUES = re.findall(r"^\| `(.+)` \| ([\d.]*) ?\| (-?[\d.]+) \|$", TEXT, re.MULTILINE)
(REFUSED,) = re.findall(r"^ {4}x\.xml, line 2, (.*)$", TEXT, re.MULTILINE)
PLAY = '<bmlt:procanimation id="a" fileName="{}"/>'


async def warned(assets: Path, behavior: str) -> list[tuple[str | None, str]]:
    """Type and text of the warnings of a block with one behavior, and that it ends."""
    async with open_pilot(SceneOptions(DEFAULT_HUMAN, "text", (assets,))) as pilot:
        pilot.watch()
        pilot.block("b", behavior)
        await pilot.advance(4)
        assert pilot.feedback.status("b") == "DONE"
        return [(each.element.get("type"), each.text) for each in pilot.feedback.of("warningFeedback")]


@pytest.mark.parametrize(("formula", "t", "value"), VALUES)
def test_a_formula_in_the_table_has_the_value_beside_it(formula: str, t: str, value: str) -> None:
    compiled = compile_formulas([parse(formula)], ["t"])
    assert compiled(float(t or "nan")) == pytest.approx((float(value),))


def test_the_table_has_nine_formulas() -> None:
    assert len(VALUES) == 9


def test_the_page_has_a_row_for_every_function_and_no_other() -> None:
    table = TEXT.partition("## Functions\n")[2].partition("\n## ")[0]
    named = re.findall(
        r"`(\w+)\(", "".join(line.split(" | ")[0] for line in table.splitlines() if line.startswith("|"))
    )
    assert set(named) == {"if", *FUNCTIONS}


def test_each_row_of_operators_binds_more_tightly_than_the_one_above_and_is_left_associative() -> None:
    table = TEXT.partition("| operators |")[2].partition("\n\n")[0]
    cells = [re.split(r"(?<!\\)\|", line)[1].replace("\\|", "|") for line in table.splitlines()[2:]]
    rows = [re.findall(r"`([^`]+)`", cell) for cell in cells]
    assert rows[-2:] == [["-", "+", "!"], ["^"]]
    assert parse("-2^2") == parse("-(2^2)") != parse("(-2)^2")
    assert parse("-2*3") == parse("(-2)*3")
    assert parse("2^3^4") == parse("2^(3^4)")
    binary = rows[:-2]
    for (loose, *_), (tight, *_) in pairwise(binary):
        assert parse(f"1 {loose} 2 {tight} 3") == parse(f"1 {loose} (2 {tight} 3)")
        assert parse(f"1 {tight} 2 {loose} 3") == parse(f"(1 {tight} 2) {loose} 3")
    for row in binary:
        for left, right in product(row, repeat=2):
            assert parse(f"1 {left} 2 {right} 3") == parse(f"(1 {left} 2) {right} 3")


def test_the_limits_are_those_of_the_code() -> None:
    for limit in (LONGEST, DEEPEST, LONGEST_OF_A_FILE):
        assert f"{limit:,}" in TEXT


async def test_the_animation_with_a_function_of_a_plug_in_plays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (animation,) = fences(PAGE, "xml")
    assets, site = tmp_path / "assets", tmp_path / "site"
    assets.mkdir()
    site.mkdir()
    (assets / animation.note).write_text(animation.text, encoding="utf-8")
    ((type_, text),) = await warned(assets, PLAY.format(animation.note))
    assert type_ == "CANNOT_CREATE_BEHAVIOR"
    assert "unknown function 'accent'" in text
    install(EXAMPLES / "plugin", site, monkeypatch)
    assert await warned(assets, PLAY.format(animation.note)) == []


async def test_the_error_of_an_invalid_formula_has_the_text_on_the_page(tmp_path: Path) -> None:
    formula = re.search(r" of '(.*)'$", REFUSED)
    assert formula
    text = f'<ProcAnimation prefDuration="1">\n<Rotation target="vc4" rotation="0;0;{formula[1]}"/></ProcAnimation>'
    (tmp_path / "x.xml").write_text(text, encoding="utf-8")
    ((type_, told),) = await warned(tmp_path, PLAY.format("x.xml"))
    assert type_ == "CANNOT_CREATE_BEHAVIOR"
    assert told.endswith(f"x.xml, line 2, {REFUSED}")


@pytest.mark.parametrize("formula", ["1/(t > 0.5)", "log(0 - t)", "(-8)^0.5"])
async def test_a_formula_without_a_value_stops_only_its_behavior(tmp_path: Path, formula: str) -> None:
    text = f'<ProcAnimation prefDuration="1"><Rotation target="vc4" rotation="{formula};0;0"/></ProcAnimation>'
    (tmp_path / "x.xml").write_text(text.replace("&", "&amp;"), encoding="utf-8")
    ((type_, _),) = await warned(tmp_path, PLAY.format("x.xml") + '<head id="n" lexeme="NOD" start="1"/>')
    assert type_ == "EXECUTION_FAILURE"
