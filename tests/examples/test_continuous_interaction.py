"""The examples of continuous interaction show what they promise."""

import itertools
import re
import runpy
import sys
from collections.abc import Callable, Iterator
from math import degrees
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from reactive_realizer.bml.names import OWN
from reactive_realizer.embodiment.audio import AudioGain, AudioStart, AudioStop
from reactive_realizer.embodiment.quaternion import angle
from reactive_realizer.testing.pilot import RealizerPilot

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"

Play = Callable[[str], dict[str, Any]]


@pytest.fixture
def example(monkeypatch: pytest.MonkeyPatch) -> Iterator[Play]:
    """The names that an example program defines."""
    monkeypatch.syspath_prepend(str(EXAMPLES))
    yield lambda name: runpy.run_path(str(EXAMPLES / f"{name}.py"))
    sys.modules.pop("example_scene", None)


def well(scene: RealizerPilot, *blocks: str) -> None:
    """Every one of these blocks was played without a warning."""
    assert scene.feedback.warnings == []
    assert {block: scene.feedback.status(block) for block in blocks} == dict.fromkeys(blocks, "DONE")


def last_word(scene: RealizerPilot, speech: str) -> str | None:
    """The word that was heard last of an interrupted speech; None if it was not interrupted."""
    end = next(line.element for line in scene.feedback.messages if line.id == f"{speech}:end")
    return end.get(f"{{{OWN}}}text")


async def test_the_trainer_is_ahead_of_a_user_who_hurries_and_slows_down(example: Play) -> None:
    trainer = example("trainer")
    scene = await trainer["main"]()
    jumps = trainer["when_the_user_jumps"]()
    numbers = range(trainer["FIRST"], trainer["LAST"] + 1)
    ahead = [jumps[n - 1] - scene.feedback.time(f"jump{n}:arms:stroke") for n in numbers]
    assert all(0.1 < each < 0.5 for each in ahead)
    assert np.mean(ahead) == pytest.approx(trainer["AHEAD"], abs=0.05)
    well(scene, *(f"jump{n}" for n in numbers))


async def test_the_conductor_is_ahead_of_the_music_and_stands_when_it_is_pushed(
    example: Play, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also where a beat is not heard, or heard twice, it is ahead; and its right arm does not notice the push."""
    conductor = example("conductor")
    scene = await conductor["main"]()
    beats = conductor["when_the_music_beats"]()
    numbers = range(conductor["FIRST"], conductor["LAST"] + 1)
    ahead = [beats[n - 1] - scene.feedback.time(f"bar{n}:beat:stroke") for n in numbers]
    assert all(0.03 < each < 0.16 for each in ahead)
    printed = capsys.readouterr().out
    assert "right arm: 0.0000" in printed
    before, after = map(int, re.findall(r"(\d+) mm", printed))
    assert 5 < before < after < 100
    assert scene.feedback.of("fall") == []
    assert printed.endswith("did not fall\n")
    bends = [degrees(angle(body.rotation("l_elbow"))) for body in scene.bodies()]
    cues = [scene.feedback.time(f"cue{number}:hand:stroke") for number in conductor["CUES"]]
    assert min(bends[round(50 * time)] for time in cues) > 60
    well(scene, *(f"bar{n}" for n in numbers), *(f"cue{number}" for number in conductor["CUES"]))


async def test_the_nods_are_with_the_taps_also_where_one_is_missed(example: Play) -> None:
    entrainment = example("entrainment")
    scene = await entrainment["main"]()
    nods = len([line for line in scene.feedback.of("syncPointProgress") if line.id.endswith(":nod:stroke")])
    strokes = [scene.feedback.time(f"beat{number}:nod:stroke") for number in range(1, nods + 1)]
    late = [stroke - tap for stroke, tap in zip(strokes, entrainment["taps"]()[2:], strict=True)]
    assert all(abs(each) < 0.1 for each in late)
    assert abs(np.mean(late)) < 0.03
    assert scene.feedback.warnings == []


async def test_the_listener_nods_after_each_clause_that_ends_low_and_after_no_other(
    example: Play, capsys: pytest.CaptureFixture[str]
) -> None:
    listening = example("listening")
    scene = await listening["main"]()
    ends = [time for time, _, end in listening["story"]() if "low" in end]
    nods = [scene.feedback.time(f"nod{number}:nod:start") for number in range(1, len(ends) + 1)]
    assert [nod - end for nod, end in zip(nods, ends, strict=True)] == pytest.approx([0.56] * len(ends), abs=0.05)
    assert not scene.feedback.reached(f"nod{len(ends) + 1}:nod:start")
    assert "a clause that goes on" in capsys.readouterr().out
    assert scene.feedback.warnings == []


async def test_the_turn_is_taken_after_its_end_and_not_in_a_pause(
    example: Play, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = await example("taking_the_turn")["main"]()
    told = [
        line.rpartition("the answer is ")[2] for line in capsys.readouterr().out.splitlines() if "answer is" in line
    ]
    assert told[0] == told[3] == "not expected yet"
    in_the_pause, with_more_words, after_voice, after_sentence = (float(told[i].split()[-1]) for i in (1, 2, 4, 5))
    assert in_the_pause < with_more_words
    assert after_sentence < after_voice
    assert scene.feedback.time("reply:words:start") == pytest.approx(after_sentence, abs=0.01)
    assert scene.feedback.time("reply:nod:start") == pytest.approx(after_sentence - 0.2, abs=0.01)
    well(scene, "reply")


@pytest.mark.speech
async def test_the_turn_is_kept_by_a_voice_that_rises_from_a_word_on_and_falls_again(example: Play) -> None:
    scene = await example("keeping_the_turn")["main"]()
    well(scene, "talk", "louder", "as_before")
    rising, risen = scene.feedback.time("talk:words:important"), scene.feedback.time("louder:up:end")
    assert risen == pytest.approx(rising + 0.5)
    gains = [(each.time, each.gain) for each in scene.sounds if isinstance(each, AudioGain)]
    assert len([each for each in scene.sounds if isinstance(each, AudioStart)]) == 1
    assert all(rising <= time <= risen + 0.02 for time, gain in gains if time < risen + 0.1)
    assert max(gain for _, gain in gains) == pytest.approx(90 / 50)
    assert gains[-1][1] == pytest.approx(1.0)
    halfway = min(gains, key=lambda each: abs(each[0] - (rising + risen) / 2))
    assert halfway[1] == pytest.approx((50 + 90) / 2 / 50, abs=0.05)


async def test_the_turn_is_yielded_as_far_as_the_gesture_is(example: Play) -> None:
    before, amid, after = await example("yielding_the_turn")["main"]()
    assert [last_word(scene, "talk:words") for scene in (before, amid, after)] == ["the", "left", "there"]
    assert not before.feedback.reached("talk:left:start")
    assert amid.feedback.time("talk:left:end") == amid.feedback.time("yield:please:start") == 3.0
    assert not amid.feedback.reached("talk:left:strokeEnd")
    assert not after.feedback.reached("yield:please:start")
    assert 3.8 < after.feedback.time("talk:words:end") < after.feedback.time("talk:left:end")
    assert [scene.feedback.status("talk") for scene in (before, amid, after)] == ["INTERRUPTED", "INTERRUPTED", "DONE"]
    for scene in (before, amid, after):
        assert scene.feedback.status("yield") == "DONE"
        assert scene.feedback.warnings == []


@pytest.mark.speech
@pytest.mark.parametrize("path", [("eh", "costs", "crowns"), ("well", "have", "crowns"), ("say", "crowns")])
async def test_a_path_of_the_plan_is_spoken_without_a_gap_and_the_others_are_given_up(
    example: Play, path: tuple[str, ...]
) -> None:
    speech_plan = example("speech_plan")
    scene = await speech_plan["answer"](*path)
    well(scene, "path", *path)
    assert scene.feedback.time(f"{path[0]}:start") == scene.feedback.time("path:start")
    for piece, after in itertools.pairwise(path):
        assert scene.feedback.time(f"{after}:words:start") == scene.feedback.time(f"{piece}:words:end")
    others = [piece for piece in speech_plan["PIECES"] if piece not in path]
    assert {piece: scene.feedback.status(piece) for piece in others} == dict.fromkeys(others, "REVOKED")
    stopped = [each.id for each in scene.sounds if isinstance(each, AudioStop)]
    assert len([each for each in scene.sounds if isinstance(each, AudioStart)]) == len(path) + len(stopped)


async def test_each_utterance_starts_with_the_release_at_the_end_of_the_response_before_it(example: Play) -> None:
    speaker = example("attentive_speaker")
    scene, releases = await speaker["main"]()
    parts = [f"part{number}" for number in range(1, len(speaker["ROUTE"]) + 1)]
    assert [scene.feedback.time(f"{part}:words:start") for part in parts] == pytest.approx(releases)
    well(scene, *parts)


async def test_each_part_is_broken_off_where_it_was_said_and_goes_on_as_it_was_prepared(example: Play) -> None:
    scene = await example("graceful_interruption")["main"]()
    told = scene.feedback
    assert told.time("explain:nod:end") == told.time("stop:start") == pytest.approx(0.7)
    assert told.time("explain:show:end") == told.time("explain:show:strokeEnd") == told.time("give_way:please:start")
    assert told.time("explain:words:end") == told.time("explain:words:here") == told.time("trail_off:words:start")
    assert told.time("explain:show:end") < told.time("explain:words:end")
    assert last_word(scene, "explain:words") == "that"
    assert told.status("explain") == "INTERRUPTED"
    well(scene, "stop", "trail_off", "give_way")


@pytest.mark.speech
async def test_an_example_may_be_watched_on_a_page_in_real_time(example: Play, monkeypatch: pytest.MonkeyPatch) -> None:
    module = example("example_scene")
    monkeypatch.setattr(sys, "argv", ["example_scene.py", "--watch"])
    monkeypatch.setattr("builtins.input", lambda _: "")
    module["open_example"].__wrapped__.__globals__["PORT"] = 0
    async with module["open_example"]() as watched:
        watched.block("b", '<wait id="w" duration="0.05"/>')
        await watched.until(0.2)
        assert type(watched).__name__ == "WatchedExample"
        assert watched.feedback.status("b") == "DONE"
