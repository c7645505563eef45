"""A character that speaks is alive: it moves with accents and words, and gives way to what it is asked for."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.embodiment.quaternion import rotate
from reactive_realizer.testing.feedback_list import FeedbackMessage
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

PLAIN = (
    "Hello, I am very glad that you came. It is not the red one, but the blue box over there that I really wanted. "
    "Perhaps we can go there tomorrow, because the weather is going to be wonderful."
)
WITHOUT_SUCH_WORDS = (
    "The train to the coast leaves from platform four at ten past nine. Change in the second town, where it waits for "
    "eight minutes, and the slow train takes people along the river to the harbor in less than an hour."
)
"""A text without words that ask for movements of their own."""
Options = Callable[[float | None], SceneOptions]


@pytest.fixture
def options() -> Options:
    return lambda liveliness: SceneOptions(voice="espeak", liveliness=liveliness)


def say(text: str = PLAIN, attributes: str = "") -> str:
    return f'<speech id="s" xmlns:rr="{OWN}" {attributes}><text>{text}</text></speech>'


def head_angles(pilot: RealizerPilot) -> npt.NDArray[np.float64]:
    """Yaw, pitch and roll of the head in each frame, (F, 3), degrees."""
    turns = [body.transform("skullbase").rotation for body in pilot.bodies()]
    ahead, aside = (np.array([rotate(turn, axis) for turn in turns]) for axis in ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)))
    angles: npt.NDArray[np.float64] = np.degrees(
        np.stack([np.arctan2(ahead[:, 0], ahead[:, 2]), np.arcsin(ahead[:, 1]), np.arcsin(aside[:, 1])], 1)
    )
    return angles


def lively(pilot: RealizerPilot) -> list[FeedbackMessage]:
    return [each for each in pilot.feedback.messages if ".lively" in each.id]


def movements(pilot: RealizerPilot) -> set[tuple[str, str]]:
    """Id and lexeme of all movements that were predicted of itself."""
    predicted = (each for message in pilot.feedback.of("predictionFeedback") for each in message.element)
    found = ((each.get("id", ""), each.get("lexeme", "")) for each in predicted)
    return {(id_, lexeme) for id_, lexeme in found if ".lively" in id_ and ":" in id_}


@pytest.mark.parametrize(
    ("voice", "text"),
    [
        ("espeak", PLAIN),
        ("espeak", WITHOUT_SUCH_WORDS),
        pytest.param("kokoro", WITHOUT_SUCH_WORDS, marks=pytest.mark.kokoro),
    ],
)
async def test_in_ten_seconds_of_plain_speech_the_head_moves_as_peoples_does(voice: str, text: str) -> None:
    async with open_pilot(SceneOptions(voice=voice, liveliness=0.5)) as pilot:
        pilot.watch()
        pilot.block("talk", say(text))
        await pilot.advance(10)
        extent = np.ptp(head_angles(pilot), axis=0)
        assert all(4.0 <= angle <= 12.0 for angle in extent), extent
        assert pilot.feedback.warnings == []


async def test_the_head_is_never_jerked(options: Options) -> None:
    async with open_pilot(options(1.0)) as pilot:
        pilot.watch()
        pilot.block("talk", say())
        await pilot.advance(10)
        speeds = 50.0 * np.abs(np.diff(head_angles(pilot), axis=0))
        assert speeds.max() < 60.0


@pytest.mark.parametrize("liveliness", [None, 0.0])
async def test_without_it_a_character_does_only_what_it_is_asked_to_do(
    options: Options, liveliness: float | None
) -> None:
    async with open_pilot(options(liveliness)) as pilot:
        pilot.watch()
        pilot.block("talk", say())
        await pilot.advance(10)
        assert lively(pilot) == []
        assert np.ptp(head_angles(pilot), axis=0).max() < 3.0  # as an idle head moves


async def test_what_is_asked_for_happens_at_the_same_times_with_and_without_it(options: Options) -> None:
    greeting = (PACKAGE_ASSETS / "demo" / "greeting.xml").read_text("utf-8")
    told = []
    for liveliness in (None, 1.0):
        async with open_pilot(options(liveliness)) as pilot:
            pilot.perform(greeting)
            await pilot.advance(40)
            # Planning takes a little longer with words, so some predictions come a tick later, but say the same.
            told.append(sorted(xml for xml in pilot.feedback.raw if ".lively" not in xml))
            assert bool(lively(pilot)) is (liveliness is not None)
    assert told[0] == told[1]


async def test_the_same_speech_is_accompanied_in_the_same_way(options: Options) -> None:
    told = []
    for _ in range(2):
        async with open_pilot(options(0.7)) as pilot:
            pilot.block("talk", say())
            await pilot.advance(10)
            told.append(pilot.feedback.raw)
    assert told[0] == told[1]


async def test_words_ask_for_movements_of_their_own(options: Options, subtests: pytest.Subtests) -> None:
    for text, expected in {
        "That is not my hat.": "SHAKE",
        "Hello my friend.": "SMILE",
        "It is a very big house.": "RAISE_BROWS",
        "Is this your house?": "RAISE_BROWS",
        "We have time, but the shop closes soon.": "LEFT",
        "You have to come soon.": "NOD",
        "We need apples, bread, milk, and wine.": "TILT_LEFT",
    }.items():
        with subtests.test(text):
            async with open_pilot(options(0.5)) as pilot:
                pilot.block("talk", say(text))
                await pilot.advance(4)
                assert expected in {lexeme for _, lexeme in movements(pilot)}
                assert pilot.feedback.warnings == []


async def test_it_looks_away_as_it_begins_a_long_turn_and_has_looked_back_when_it_ends(options: Options) -> None:
    async with open_pilot(options(0.5)) as pilot:
        pilot.block("talk", say())
        await pilot.advance(12)
        looks = [each for each in lively(pilot) if ":gaze" in each.id]
        assert looks[0].id.endswith("start")
        assert looks[0].global_time < 0.5
        assert looks[-1].global_time < pilot.feedback.time("talk:s:end") - 0.5


async def test_nods_and_beats_are_spaced(options: Options) -> None:
    async with open_pilot(options(1.0)) as pilot:
        pilot.block("talk", say())
        await pilot.advance(12)
        for lexemes, least in (({"NOD", "SHAKE", "TOSS", "TILT_FORWARD"}, 0.6), ({"BEAT", "OFFER"}, 2.0)):
            strokes = sorted(
                pilot.feedback.time(f"{id_}:stroke") for id_, lexeme in movements(pilot) if lexeme in lexemes
            )
            assert len(strokes) > 1
            assert np.diff(strokes).min() > least


async def test_a_speech_says_how_lively_it_is(options: Options) -> None:
    async with open_pilot(options(None)) as pilot:
        pilot.block("talk", say(attributes='rr:liveliness="0.5"'))
        await pilot.advance(10)
        assert lively(pilot)


@pytest.mark.parametrize("value", ["2", "much", "nan"])
async def test_a_liveliness_that_is_none_drops_the_speech_with_a_reason(options: Options, value: str) -> None:
    async with open_pilot(options(None)) as pilot:
        pilot.block("talk", say(attributes=f'rr:liveliness="{value}"'))
        await pilot.advance(1)
        (warning,) = pilot.feedback.of("warningFeedback")
        assert f"its liveliness must be a number from 0 to 1, not '{value}'" in warning.text


async def test_the_human_file_says_how_lively_a_character_is(tmp_path: Path) -> None:
    human = tmp_path / "human.toml"
    human.write_text("[character.alice]\nliveliness = 0.5\n[character.bert]\nposition = [1, 0, 0]\n", "utf-8")
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        pilot.block("one", say(), characterId="alice")
        pilot.block("two", say(), characterId="bert")
        await pilot.advance(10)
        assert {each.id.partition(".")[0] for each in lively(pilot)} == {"one"}


async def test_it_is_changed_while_the_speech_plays(options: Options) -> None:
    async with open_pilot(options(0.0)) as pilot:
        pilot.block("talk", say())
        await pilot.advance(2)
        assert lively(pilot) == []
        pilot.block("more", change(1))
        await pilot.advance(3)
        seen = len(lively(pilot))
        assert seen > 0
        pilot.block("less", change(0))
        await pilot.advance(1)
        pilot.feedback.clear()
        await pilot.advance(5)
        assert lively(pilot) == []
        assert pilot.feedback.warnings == []


def change(value: float) -> str:
    return (
        '<bmla:parametervaluechange id="c" target="talk:s" paramId="liveliness" start="0" end="0.1">'
        f'<bmla:trajectory type="linear" targetValue="{value}"/></bmla:parametervaluechange>'
    )


async def test_it_ends_with_a_speech_that_is_interrupted(options: Options) -> None:
    async with open_pilot(options(1.0)) as pilot:
        pilot.block("talk", say())
        await pilot.advance(3)
        pilot.block("stop", '<bmla:interrupt id="i" target="talk"/>')
        await pilot.advance(0.02)
        pilot.feedback.clear()
        await pilot.advance(5)
        assert lively(pilot) == []


async def test_a_mark_may_have_the_name_of_a_word(options: Options) -> None:
    async with open_pilot(options(1.0)) as pilot:
        pilot.block("talk", say('I am <sync id="word4"/>very very glad that it is not <sync id="word2"/>raining.'))
        await pilot.advance(6)
        assert pilot.feedback.status("talk") == "DONE"
        assert pilot.feedback.warnings == []


async def test_very_many_words_are_accompanied_too(options: Options) -> None:
    async with open_pilot(SceneOptions(voice="text", liveliness=0.5)) as pilot:
        pilot.block("talk", say("no " * 1600))
        await pilot.advance(5)
        assert lively(pilot)
        assert pilot.feedback.warnings == []
