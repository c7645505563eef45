"""The words with which people move are read from a file."""

import tomllib
from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.errors import RealizerError
from reactive_realizer.liveliness.prosody import SpokenWord
from reactive_realizer.liveliness.word_classes import read_word_classes
from reactive_realizer.testing.pilot import open_pilot

ENGLISH = PACKAGE_ASSETS / "liveliness" / "english.toml"


def spoken(text: str, prominence: float = 1.0) -> list[SpokenWord]:
    words = enumerate(text.split())
    return [
        SpokenWord(index, word, index / 2, index / 2 + 0.4, index / 2, 1.0, True, prominence) for index, word in words
    ]


@pytest.mark.parametrize(
    ("text", "kinds"),
    [
        ("it is not here", {"negation": "not", "place": "here"}),
        ("we can't go", {"negation": "can't"}),
        ("good morning", {"greeting": "good"}),
        ("a good boy", {}),
        ("i don't know", {"negation": "don't", "uncertainty": "i", "self": "i"}),
    ],
)
def test_words_of_classes_are_found(text: str, kinds: dict[str, str]) -> None:
    assert {found.kind.name: found.word.text for found in read_word_classes(ENGLISH).find(spoken(text))} == kinds


def test_some_classes_are_of_stressed_words_only() -> None:
    names = [found.kind.name for found in read_word_classes(ENGLISH).find(spoken("you are here", 0.3))]
    assert names == []


async def test_a_file_of_the_user_takes_the_place_of_that_of_the_package(tmp_path: Path) -> None:
    (tmp_path / "liveliness").mkdir()
    (tmp_path / "liveliness" / "english.toml").write_text(
        """
        function_words = []
        [[class]]
        name = "color"
        words = ["red"]
        behaviors = [{element = "head", lexeme = "WIGGLE", amount = 0.3, span = "word"}]
        """,
        "utf-8",
    )
    async with open_pilot(SceneOptions(voice="text", assets=(tmp_path,), liveliness=0.5)) as pilot:
        pilot.block("b", "<speech id='s'><text>It is not a red house.</text></speech>")
        await pilot.advance(2)
        assert 'lexeme="WIGGLE"' in "".join(pilot.feedback.raw)
        assert 'lexeme="SHAKE"' not in "".join(pilot.feedback.raw)


CLASS = 'function_words = []\n[[class]]\nname = "c"\nwords = ["w"]\nbehaviors = [{%s}]'


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("function_words = [", "Invalid value"),
        ("function_words = []", "the key 'class' is missing"),
        (CLASS % 'element = "dance", span = "word"', "the element is 'dance'"),
        (CLASS % 'element = "head", span = "long"', "the span is 'long'"),
        (CLASS % 'element = "head", span = "word", amount = 3', "not from 0 to 1"),
    ],
)
def test_a_file_with_a_mistake_is_refused_with_the_reason(tmp_path: Path, text: str, reason: str) -> None:
    file = tmp_path / "english.toml"
    file.write_text(text, "utf-8")
    with pytest.raises(RealizerError) as refused:
        read_word_classes(file)
    assert refused.value.fault.code == "bad-word-classes"
    assert reason in str(refused.value)


async def test_every_class_of_the_package_plays_without_a_warning() -> None:
    classes = tomllib.loads(ENGLISH.read_text("utf-8"))["class"]
    async with open_pilot(SceneOptions(voice="text", liveliness=1.0)) as pilot:
        for number, entry in enumerate(classes):
            text = f"<text>{entry['words'][0].replace('*', 'do')}</text>"
            pilot.block(f"b{number}", f'<speech id="s">{text}</speech>', composition="APPEND")
        await pilot.advance(40)
        assert pilot.feedback.warnings == []
        assert len([each for each in pilot.feedback.progress if ".lively" in each and each.endswith(":end")]) > len(
            classes
        )
