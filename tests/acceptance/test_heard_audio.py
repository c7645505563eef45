"""Speech, and what is tied to it, follows what a page reports as heard (thesis 8.17)."""

from collections.abc import AsyncIterator

import pytest
import pytest_asyncio

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.bml.names import OWN
from reactive_realizer.embodiment.audio import AudioMove
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

pytestmark = pytest.mark.speech

TEXT = 'This is the <sync id="one"/>first one, and that is the <sync id="two"/>second one of many.'
SPEECH = f'<speech id="s" xmlns:rr="{OWN}" rr:words="true"><text>{TEXT}</text></speech>'
CLIP = "alice-speech-1"


@pytest_asyncio.fixture
async def talking() -> AsyncIterator[RealizerPilot]:
    """A speech that has played for half a second, with behaviors tied to it."""
    async with open_pilot(SceneOptions(voice="espeak", verify=True)) as pilot:
        pilot.block(
            "b",
            SPEECH
            + '<gesture id="beat" lexeme="BEAT" stroke="s:two"/>'
            + '<head id="nod" lexeme="NOD" stroke="s:word9+0.1"/>'
            + '<wait id="after" start="s:end+0.2" duration="0.3"/>'
            + '<head id="own" lexeme="SHAKE" start="0.7" end="1.5"/>',
        )
        pilot.block("other", '<wait id="w" start="b:s:two-0.1" duration="0.1"/>')
        while not pilot.feedback.reached("b:s:start"):
            await pilot.tick()
        await pilot.advance(0.5)
        yield pilot


def start(pilot: RealizerPilot) -> float:
    return pilot.feedback.time("b:s:start")


def report(pilot: RealizerPilot, late: float, clip: str = CLIP) -> None:
    """Report that the position of the plan is heard some seconds late."""
    pilot.heard(clip, pilot.now - start(pilot) - late, pilot.now)


async def hear(pilot: RealizerPilot, late: float, times: int = 2) -> None:
    for _ in range(times):
        report(pilot, late)
        await pilot.advance(0.1)


def planned(pilot: RealizerPilot) -> dict[str, float]:
    """The predicted times of the points of both blocks."""
    pegs = {str(each.key): each.time for each in pilot.realizer.board.snapshot()}
    return {key.split("/")[-1]: time for key, time in pegs.items() if time is not None}


async def test_points_ahead_and_what_is_tied_to_them_move_to_what_is_heard(talking: RealizerPilot) -> None:
    before = planned(talking)
    await hear(talking, 0.15)
    after = planned(talking)
    moved = {key: round(after[key] - time, 6) for key, time in before.items() if key in after}
    for key in ("b:s:two", "b:s:end", "b:beat:stroke", "b:beat:end", "b:nod:stroke", "b:after:start", "b:after:end"):
        assert moved[key] == 0.15, key
    assert moved["other:w:start"] == moved["other:w:end"] == 0.15
    assert moved["b:end"] == 0.15
    for key in ("b:s:start", "b:s:word0", "b:own:start", "b:own:end"):
        assert moved[key] == 0, key
    await talking.advance(6)
    told = talking.feedback
    for key in ("b:s:two", "b:s:end", "b:beat:stroke", "b:nod:stroke", "b:after:start"):
        assert told.time(key) == pytest.approx(after[key], abs=1e-6)
    assert told.warnings == []
    assert told.status("b") == told.status("other") == "DONE"


@pytest.mark.parametrize(
    "other", ["", '<gesture id="beat" lexeme="BEAT" stroke="s:two"/>'], ids=["alone", "with other"]
)
async def test_what_is_tied_to_a_point_that_was_reported_keeps_its_time(other: str) -> None:
    async with open_pilot(SceneOptions(voice="espeak", verify=True)) as pilot:
        brows = '<faceLexeme id="brows" lexeme="RAISE_BROWS" start="s:start" end="s:one+0.9"/>'
        pilot.block("b", SPEECH + brows + other)
        while not pilot.feedback.reached("b:s:one"):
            await pilot.tick()
        await hear(pilot, 0.15)
        await pilot.advance(6)
        assert pilot.feedback.time("b:brows:end") == pytest.approx(pilot.feedback.time("b:s:one") + 0.9)
        assert pilot.feedback.warnings == []


@pytest.mark.parametrize("late", [0.15, -0.1])
@pytest.mark.parametrize(("order", "nod"), [("after", "start"), ("after", "stroke"), ("before", "end")])
async def test_what_comes_before_or_after_a_word_gives_way(order: str, nod: str, late: float) -> None:
    # What follows a word that is heard early keeps to its plan, which is not as early as can be.
    async with open_pilot(SceneOptions(voice="espeak", verify=late > 0)) as pilot:
        rule = f'<constraint id="c"><{order} ref="s:two"><sync ref="n:{nod}"/></{order}></constraint>'
        start_ = ' start="s:two-0.71"' if order == "before" else ""
        pilot.block("b", SPEECH + f'<head id="n" lexeme="NOD"{start_}/>' + rule)
        while not pilot.feedback.reached("b:s:start"):
            await pilot.tick()
        await pilot.advance(0.5)
        await hear(pilot, late)
        await hear(pilot, late + 0.05)
        await pilot.advance(5)
        word, point = (pilot.feedback.time(f"b:{each}") for each in ("s:two", f"n:{nod}"))
        assert point >= word - 1e-6 if order == "after" else point <= word + 1e-6
        assert pilot.feedback.warnings == []


async def test_words_are_reported_when_they_are_heard(talking: RealizerPilot) -> None:
    before = planned(talking)
    await hear(talking, 0.12)
    await talking.advance(5)
    late = [f"b:s:word{index}" for index in range(6, 12)]
    assert [talking.feedback.time(key) - before[key] for key in late] == pytest.approx([0.12] * len(late), abs=1e-6)


async def test_words_are_reported_when_heard_even_if_a_tied_word_before_them_was_heard_before_the_report() -> None:
    async with open_pilot(SceneOptions(voice="espeak", verify=True)) as pilot:
        pilot.block("b", SPEECH + '<head id="nod" lexeme="NOD" end="s:one"/>')
        while not pilot.feedback.reached("b:s:start"):
            await pilot.tick()
        before = planned(pilot)
        while pilot.now < before["b:s:one"] - 0.05:
            await pilot.tick()
        report(pilot, -0.1)
        report(pilot, -0.1)
        known = pilot.now
        await pilot.advance(5)
        assert pilot.feedback.time("b:nod:end") == pilot.feedback.time("b:s:one") == known
        later = [f"b:s:word{index}" for index in range(4, 12)]
        assert [pilot.feedback.time(key) - before[key] for key in later] == pytest.approx([-0.1] * len(later), abs=1e-6)


async def test_the_new_times_are_predicted_and_announced_once(talking: RealizerPilot) -> None:
    announced, told = len(talking.sounds), len(talking.feedback.of("predictionFeedback"))
    await hear(talking, 0.15, 6)
    (move,) = talking.sounds[announced:]
    assert isinstance(move, AudioMove)
    assert move.id == CLIP
    assert move.start == pytest.approx(start(talking) + 0.15)
    predicted = [line for line in talking.feedback.of("predictionFeedback")[told:] if line.id == "b"]
    assert len(predicted) == 1


@pytest.mark.parametrize("late", [[0.02] * 6, [-0.02] * 6, [0.3, -0.3] * 3, [0.3, 0.0, 0.3, 0.01, -0.2, 0.0]])
async def test_noise_moves_nothing(talking: RealizerPilot, late: list[float]) -> None:
    before = planned(talking)
    for each in late:
        await hear(talking, each, 1)
    assert planned(talking) == before
    assert not any(isinstance(each, AudioMove) for each in talking.sounds)


async def test_two_reports_move_by_the_smaller_drift(talking: RealizerPilot) -> None:
    end = planned(talking)["b:s:end"]
    await hear(talking, 0.3, 1)
    await hear(talking, 0.1, 1)
    assert planned(talking)["b:s:end"] == pytest.approx(end + 0.1)


async def test_drift_is_followed_again_and_back(talking: RealizerPilot) -> None:
    end = planned(talking)["b:s:end"]
    for late in (0.2, 0.35, 0.05, -0.1):
        await hear(talking, late)
        assert planned(talking)["b:s:end"] == pytest.approx(end + late)
    await talking.advance(5)
    assert talking.feedback.time("b:s:end") == pytest.approx(end - 0.1)
    assert talking.feedback.warnings == []


async def test_without_further_reports_the_plan_is_played(talking: RealizerPilot) -> None:
    end = planned(talking)["b:s:end"]
    await hear(talking, 0.3, 1)
    await talking.advance(5)
    assert talking.feedback.time("b:s:end") == pytest.approx(end)


async def test_reports_that_cannot_be_true_move_nothing(talking: RealizerPilot) -> None:
    before, begun = planned(talking), start(talking)
    for position, time in [
        (0.1, begun + 1.2),
        (1.5, begun + 0.4),
        (-0.1, begun),
        (99.0, begun + 99),
        (0.5, float("nan")),
    ]:
        for _ in range(2):
            talking.heard(CLIP, position, time)
            await talking.tick()
    for clip in ("alice-2", "bob-1", ""):
        report(talking, 0.3, clip)
        report(talking, 0.3, clip)
        await talking.tick()
    assert planned(talking) == before


async def test_a_liar_moves_a_speech_by_a_second_at_most(talking: RealizerPilot) -> None:
    end = planned(talking)["b:s:end"]
    for _ in range(3):
        for late in (0.4, 0.8, 0.99, 1.3, 1.7):
            await hear(talking, late)
    assert planned(talking)["b:s:end"] <= end + 1.0


@pytest.mark.parametrize(("how", "late"), [("now", 0.15), ("word", 0.15), ("word", -0.1)])
async def test_an_interruption_reports_what_was_heard(talking: RealizerPilot, how: str, late: float) -> None:
    words = {key: time for key, time in planned(talking).items() if key.startswith("b:s:word")}
    await hear(talking, late)
    talking.block("stop", f'<bmla:interrupt id="i" target="b" include="s" speech="{how}"/>')
    at = talking.now
    await talking.advance(2)
    (end,) = (line.element for line in talking.feedback.of("syncPointProgress") if line.id == "b:s:end")
    begun = [key for key, time in words.items() if time + late < at]
    assert end.get(f"{{{OWN}}}word") == str(len(begun) - 1)
    if how == "word":
        assert talking.feedback.time("b:s:end") == pytest.approx(words[f"b:s:word{len(begun)}"] + late)


async def test_a_scheduled_cut_moves_too(talking: RealizerPilot) -> None:
    talking.block("stop", '<bmla:interrupt id="i" target="b" include="s" speech="word"/>')
    words = sorted(time for key, time in planned(talking).items() if key.startswith("b:s:word"))
    cut = next(time for time in words if time > talking.now)
    await talking.tick()
    for _ in range(2):
        report(talking, 0.1)
        await talking.tick()
    await talking.advance(2)
    assert talking.feedback.time("b:s:end") == pytest.approx(cut + 0.1)


async def test_lips_follow(talking: RealizerPilot) -> None:
    """The mouth has the shapes of a speech without drift, later by the drift."""

    async def mouths(late: float) -> list[float]:
        async with open_pilot(SceneOptions(voice="espeak")) as pilot:
            pilot.watch()
            pilot.block("b", SPEECH)
            while not pilot.feedback.reached("b:s:start"):
                await pilot.tick()
            await pilot.advance(0.4)
            await hear(pilot, late)
            await pilot.advance(2)
            jaw = pilot.realizer.characters["alice"].humanoid.avatar.morphs.index("jawOpen")
            return [float(frame.weights[jaw]) for frame in pilot.frames["alice"]]

    plain, late = await mouths(0.0), await mouths(0.2)
    assert late[45:120] == pytest.approx(plain[35:110])
    assert late[:20] == plain[:20]
