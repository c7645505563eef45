"""Characters that are shown by pictures, as seen in frames and feedback."""

import logging
from collections.abc import AsyncIterator
from itertools import groupby
from pathlib import Path

import pytest
import pytest_asyncio

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.engine.tts import Phoneme, Utterance, Word
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

PE = 'xmlns:pe="http://hmi.ewi.utwente.nl/pictureengine"'

HUMAN = """[character.alice]
engines = ["speech", "picture", "wait"]
bindings = { picture = "pictures.xml" }
liveliness = 0.0
"""

WAVE = """<xmlanim picturePath="drawn/">
  <frame imgsrc="up.png" duration="0.5"/>
  <sync type="stroke"/>
  <frame imgsrc="left.png" duration="0.25"/>
  <frame imgsrc="right.png" duration="0.25"/>
</xmlanim>"""

BINDING = """<picturebinding>
  <PictureUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="WAVE"/></constraints>
    <parameterdefaults>
      <parameterdefault name="fileName" value="wave.xml"/>
      <parameterdefault name="layer" value="2"/>
    </parameterdefaults>
    <PictureUnit type="AddAnimationXMLPU"/>
  </PictureUnitSpec>
</picturebinding>"""


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    (tmp_path / "drawn").mkdir()
    for name in ("up", "left", "right", "base", "smile"):
        (tmp_path / "drawn" / f"{name}.png").touch()
    (tmp_path / "drawn" / "notes.txt").touch()
    (tmp_path / "wave.xml").write_text(WAVE)
    (tmp_path / "pictures.xml").write_text(BINDING)
    (tmp_path / "human.toml").write_text(HUMAN)
    return tmp_path


@pytest_asyncio.fixture
async def pilot(assets: Path) -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(assets / "human.toml", "text", (assets,))) as pilot:
        pilot.watch()
        yield pilot


def shown(pilot: RealizerPilot) -> list[tuple[float, tuple[str, ...]]]:
    """The pictures, each time from which they are shown, without the folder and the suffix."""
    stems = ((frame.time, tuple(Path(file).stem for file in frame.pictures)) for frame in pilot.frames["alice"])
    return [(next(group)[0], files) for files, group in groupby(stems, key=lambda each: each[1])]


async def test_the_pictures_of_a_gesture_keep_to_its_sync_points(pilot: RealizerPilot) -> None:
    pilot.block("b", '<gesture id="g" lexeme="WAVE" start="1" stroke="2" end="3"/>')
    await pilot.advance(4)
    pictures = shown(pilot)
    assert [files for _, files in pictures] == [(), ("up",), ("left",), ("right",), ()]
    assert [time for time, _ in pictures] == pytest.approx([0.0, 1.0, 2.0, 2.5, 3.0], abs=0.021)
    assert pilot.feedback.time("b:g:stroke") == pytest.approx(2.0)


async def test_pictures_wait_for_a_stroke_whose_prediction_moves(pilot: RealizerPilot) -> None:
    pilot.predict("partner", "hit", 1.5)
    pilot.block("b", '<gesture id="g" lexeme="WAVE" stroke="anticipators:partner:hit"/>')
    await pilot.advance(1.2)
    pilot.predict("partner", "hit", 2.2)
    await pilot.advance(2)
    assert next(time for time, files in shown(pilot) if files == ("left",)) == pytest.approx(2.2, abs=0.021)


async def test_a_picture_on_a_greater_layer_covers_others(pilot: RealizerPilot) -> None:
    add = '<pe:addImage {0} id="{1}" filePath="drawn" fileName="{1}.png" layer="{2}" start="{3}" end="4"/>'
    pilot.block("b", add.format(PE, "smile", 3, 0) + add.format(PE, "base", 1, 1) + add.format(PE, "left", 1, 2))
    await pilot.advance(5)
    assert [files for _, files in shown(pilot)] == [("smile",), ("base", "smile"), ("base", "left", "smile"), ()]


async def test_a_background_stays_until_another_one_or_a_replacing_block(pilot: RealizerPilot) -> None:
    for id_, start in (("base", 0), ("smile", 1)):
        pilot.block(id_, f'<pe:setImage {PE} id="i" filePath="drawn/" fileName="{id_}.png" start="{start}"/>')
    pilot.block("w", '<gesture id="g" lexeme="WAVE" start="1.5"/>')
    await pilot.advance(3)
    pilot.block("r", composition="REPLACE")
    await pilot.advance(1)
    backgrounds = [files[:1] for _, files in shown(pilot)]
    assert [files for files, _ in groupby(backgrounds)] == [("base",), ("smile",), ()]


async def test_the_pictures_of_a_folder_come_in_the_order_of_their_names(pilot: RealizerPilot) -> None:
    folder = f'<pe:addAnimationDir {PE} id="d" resourcePath="" directoryName="drawn" layer="1" start="1" end="3"/>'
    pilot.block("b", folder)
    await pilot.advance(4)
    assert [files for _, files in shown(pilot)] == [(), ("base",), ("left",), ("right",), ("smile",), ("up",), ()]


def warned(pilot: RealizerPilot) -> list[tuple[str, str]]:
    """The id and the text of each warning."""
    return [(message.id, message.text) for message in pilot.feedback.of("warningFeedback")]


async def test_a_picture_of_a_folder_that_another_one_hides_is_left_out(assets: Path, tmp_path: Path) -> None:
    first = tmp_path / "first"
    first.mkdir()
    (first / "smile.png").touch()
    async with open_pilot(SceneOptions(assets / "human.toml", "text", (first, assets))) as pilot:
        pilot.watch()
        pilot.block("b", f'<pe:addAnimationDir {PE} id="d" directoryName="drawn"/>')
        await pilot.advance(2)
    assert [files for _, files in shown(pilot)] == [("base",), ("left",), ("right",), ("up",), ()]


def lasting(element: str, file: str) -> str:
    return f"""<PictureUnitSpec type="{element}">
      <parameterdefaults><parameterdefault name="fileName" value="{file}"/></parameterdefaults>
      <PictureUnit type="AddAnimationXMLPU"/></PictureUnitSpec>"""


async def test_the_mouth_moves_while_words_sound(assets: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (assets / "pictures.xml").write_text(f"<picturebinding>{lasting('speech', 'wave.xml')}</picturebinding>")
    phonemes = (Phoneme("a", 0.2, 0.4), Phoneme("", 0.6, 1.4), Phoneme("a", 2.0, 0.15), Phoneme("", 2.15, 0.85))
    spoken = Utterance("ah ah", 3.0, (Word("ah", 0.2, 0, 2), Word("ah", 2.0, 3, 5)), {}, phonemes)
    monkeypatch.setattr(TextVoice, "synthesize", lambda *_: spoken)
    async with open_pilot(SceneOptions(assets / "human.toml", "text", (assets,))) as pilot:
        pilot.watch()
        pilot.block("b", '<speech id="s" start="1"><text>ah ah</text></speech>')
        await pilot.advance(6)
    mouths = [files for _, files in shown(pilot)]
    assert mouths == [(), ("up",), ("left",), (), ("up",), ()], "it begins anew after a pause"


async def test_pictures_at_rest_are_repeated(assets: Path) -> None:
    entry = lasting("rest", "wave.xml").replace('type="rest"', 'type="rest" namespace="urn:reactive-realizer:1"')
    (assets / "pictures.xml").write_text(f"<picturebinding>{entry}</picturebinding>")
    async with open_pilot(SceneOptions(assets / "human.toml", "text", (assets,))) as pilot:
        pilot.watch()
        await pilot.advance(1.9)
    assert [files for _, files in shown(pilot)] == [("up",), ("left",), ("right",)] * 2


async def test_what_accompanies_speech_and_has_no_pictures_is_left_out_silently(assets: Path) -> None:
    (assets / "human.toml").write_text(HUMAN.replace("liveliness = 0.0", "liveliness = 1.0"))
    async with open_pilot(SceneOptions(assets / "human.toml", "text", (assets,))) as pilot:
        pilot.block("b", '<speech id="s"><text>Never say that this is not wonderful, my friend!</text></speech>')
        await pilot.advance(5)
        assert warned(pilot) == []


@pytest.mark.parametrize(
    ("behavior", "told"),
    [
        (f'<pe:addImage {PE} id="x" fileName="none.png"/>', "there is no asset named 'none.png'"),
        (f'<pe:addImage {PE} id="x" fileName="../wave.xml.png"/>', "is not a valid asset name"),
        (f'<pe:addImage {PE} id="x" filePath="drawn" fileName="notes.txt"/>', "is not a picture"),
        (f'<pe:addImage {PE} id="x" filePath="drawn"/>', "needs the parameter fileName"),
        (f'<pe:addImage {PE} id="x" filePath="drawn" fileName="up.png" layer="nan"/>', "must be a number, not 'nan'"),
        (f'<pe:addAnimationDir {PE} id="x" directoryName="nowhere"/>', "no pictures in the folder 'nowhere'"),
        (f'<pe:addAnimationXML {PE} id="x" fileName="pictures.xml"/>', "should begin with <xmlanim>"),
        (f'<pe:addAnimationDir {PE} id="x" directoryName="{"a" * 300}"/>', "no pictures in the folder 'aaa"),
        ('<gesture id="x" lexeme="BOW"/>', "no entry of the picture binding for <gesture> fits"),
    ],
)
async def test_pictures_that_cannot_be_shown_are_named_and_the_rest_plays(
    pilot: RealizerPilot, behavior: str, told: str
) -> None:
    pilot.block("b", behavior + '<gesture id="g" lexeme="WAVE"/>')
    await pilot.advance(2)
    ((id_, warning),) = warned(pilot)
    assert id_ == "b:x"
    assert told in warning
    assert "b:g:end" in pilot.feedback.progress


@pytest.mark.parametrize(
    ("inside", "told"),
    [
        ("", "no frame inside"),
        ('<frame imgsrc="up.png" duration="0"/>', "line 2, <frame>: duration='0' is not above 0"),
        ('<frame imgsrc="up.png"/>', "line 2, <frame>: the attribute duration is missing"),
        ('<frame duration="1"/>', "line 2, <frame>: the attribute imgsrc is missing"),
        ('<frame imgsrc="up.png" duration="1"/><blink/>', "line 2, <blink>: known are frame and sync"),
        ('<frame imgsrc="up.png" duration="1"/><sync type="start"/>', "start is where the sequence starts"),
        ('<frame imgsrc="up.png" duration="1"/><sync type="a b"/>', "cannot name a sync point"),
        (
            '<sync type="ready"/><frame imgsrc="up.png" duration="1"/><sync type="ready"/>',
            "a second sync with type='ready'",
        ),
        ('<frame imgsrc="up.png" duration="1e308"/>' * 2, "it lasts inf s; the limit is 3600 s"),
        ('<frame imgsrc="up.png" duration="0.001"/>' * 1001, "has more than 1000 pictures"),
    ],
)
async def test_a_sequence_that_cannot_be_read_is_named_with_its_line(
    pilot: RealizerPilot, assets: Path, inside: str, told: str
) -> None:
    (assets / "wave.xml").write_text(f'<xmlanim picturePath="drawn">\n{inside}</xmlanim>')
    pilot.block("b", '<gesture id="g" lexeme="WAVE"/>')
    await pilot.advance(0.1)
    ((_, warning),) = warned(pilot)
    assert told in warning


async def test_an_entry_with_an_unknown_unit_is_named(pilot: RealizerPilot, assets: Path) -> None:
    (assets / "pictures.xml").write_text(BINDING.replace("AddAnimationXMLPU", "AddAnimationPU"))
    async with open_pilot(SceneOptions(assets / "human.toml", "text", (assets,))) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="WAVE"/>')
        await pilot.advance(0.1)
        ((_, warning),) = warned(pilot)
        assert "there is no picture unit 'AddAnimationPU'" in warning


async def test_a_mouth_that_cannot_be_shown_is_logged_and_left_out(
    assets: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (assets / "pictures.xml").write_text(f"<picturebinding>\n{lasting('speech', 'none.xml')}</picturebinding>")
    with caplog.at_level(logging.WARNING):
        async with open_pilot(SceneOptions(assets / "human.toml", "text", (assets,))) as pilot:
            await pilot.advance(0.1)
    assert "pictures.xml, line 2: this entry is skipped: there is no asset named 'none.xml'" in caplog.text
