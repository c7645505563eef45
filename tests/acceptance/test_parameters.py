"""Parameters of playing behaviors change along trajectories, with immediate effect on sound and frames."""

from collections.abc import AsyncIterator
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioGain, AudioStart
from reactive_realizer.reactive.cell import Derived
from reactive_realizer.reactive.graph import Commit
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .parameter_changes import HEAD, SPEECH, change, points

RAISED = '<gesture id="g" lexeme="OFFER" mode="RIGHT_HAND" start="0" ready="0.8" relax="6" end="7"/>'


def warned(pilot: RealizerPilot) -> tuple[Any, Any, Any]:
    """Id, type and sentence of its only warning."""
    (line,) = pilot.feedback.of("warningFeedback")
    return line.id, line.element.get("type"), line.text


# --- what is heard


@pytest.fixture
async def voiced() -> AsyncIterator[RealizerPilot]:
    async with open_pilot(SceneOptions(voice="espeak")) as pilot:
        yield pilot


def gains(pilot: RealizerPilot) -> list[tuple[float, float]]:
    """Times and gains, the first as announced."""
    (start,) = (change for change in pilot.sounds if isinstance(change, AudioStart))
    return [
        (0.0, start.gain),
        *((change.time, change.gain) for change in pilot.sounds if isinstance(change, AudioGain)),
    ]


@pytest.mark.speech
async def test_a_change_of_volume_is_audible_in_its_tick(voiced: RealizerPilot) -> None:
    voiced.block("b", SPEECH + change("p", 'start="s:start+0.5"', type="instant"))
    await voiced.advance(1)
    started = voiced.feedback.time("b:s:start")
    assert gains(voiced) == [(0.0, 1.0), (pytest.approx(started + 0.5), 2.0)]
    assert voiced.feedback.time("b:p:start") == voiced.feedback.time("b:p:end") == started + 0.5


@pytest.mark.speech
async def test_a_linear_change_is_reported_once_a_tick_and_ends_exactly_at_its_target(voiced: RealizerPilot) -> None:
    voiced.block("b", SPEECH + change("p", 'start="0" end="1"'))
    await voiced.advance(2)
    told = gains(voiced)
    begin = voiced.feedback.time("b:p:start")
    assert all(gain == pytest.approx(1 + (time - begin)) for time, gain in told[1:])
    assert len(told) == 101
    assert told[-1] == pytest.approx((begin + 1, 2.0))


@pytest.mark.speech
async def test_an_unchanged_volume_is_not_reported(voiced: RealizerPilot) -> None:
    voiced.block("b", SPEECH + change("p", 'start="0" end="1"', targetValue=50))
    await voiced.advance(2)
    assert len(gains(voiced)) == 1


@pytest.mark.speech
async def test_a_change_before_the_start_of_a_speech_is_reported_before_it(voiced: RealizerPilot) -> None:
    later = SPEECH.replace("<speech", '<speech start="2"')
    voiced.block("b", later + change("p", 'start="0"', type="instant", targetValue=0))
    await voiced.advance(1)
    assert gains(voiced)[-1][1] == 0.0


@pytest.mark.speech
async def test_easing_is_slow_at_both_ends(voiced: RealizerPilot) -> None:
    voiced.block("b", SPEECH + change("p", 'start="0" end="1"', type="ease-in-ease-out", initialValue=0))
    await voiced.advance(2)
    steps = np.diff([gain for _, gain in gains(voiced)[1:]])
    assert steps.min() > 0
    assert max(steps[0], steps[-1]) < 0.1 * steps[len(steps) // 2]


@pytest.mark.speech
async def test_of_two_changes_the_later_one_wins_and_starts_from_the_current_value(voiced: RealizerPilot) -> None:
    both = change("p", 'start="0" end="2"') + change("q", 'start="1" end="1.5"', targetValue=0)
    voiced.block("b", SPEECH + both)
    await voiced.advance(3)
    told = gains(voiced)
    assert max(gain for _, gain in told) == pytest.approx(1.5, abs=0.02)
    assert told[-1][1] == 0.0
    assert max(abs(a - b) for (_, a), (_, b) in pairwise(told)) < 0.05
    assert voiced.feedback.time("b:p:end") == voiced.feedback.time("b:p:start") + 2
    assert voiced.feedback.warnings == []


@pytest.mark.speech
async def test_a_change_at_the_end_of_another_one_starts_from_the_target_of_the_other(
    voiced: RealizerPilot,
) -> None:
    voiced.block("b", SPEECH + change("p", 'start="0" end="1"') + change("q", 'start="p:end" end="2"', targetValue=0))
    await voiced.advance(3)
    told = gains(voiced)
    assert max(gain for _, gain in told) == 2.0
    assert told[-1][1] == 0.0


@pytest.mark.speech
async def test_a_change_waits_until_its_target_is_prepared(voiced: RealizerPilot) -> None:
    voiced.block("b", SPEECH)
    voiced.block("c", change("p", 'start="0"', type="instant"))
    await voiced.advance(1)
    assert voiced.feedback.warnings == []
    assert gains(voiced)[-1][1] == 2.0


# --- what is seen


def nods(pilot: RealizerPilot) -> Any:
    """How far the head is turned from where it was at first, rad, in each frame."""
    return _turns(pilot, "skullbase")


def _turns(pilot: RealizerPilot, joint: str) -> Any:
    joints = pilot.realizer.characters["alice"].humanoid.avatar.skeleton.joints
    path = np.array([frame.rotations for frame in pilot.frames["alice"]])[:, joints.index(joint)]
    return 2 * np.arccos(np.clip(np.abs(path @ path[0]), 0, 1))


async def test_the_amount_of_a_nod_is_its_attribute_until_a_change(pilot: RealizerPilot) -> None:
    pilot.watch()
    pilot.block(
        "b",
        HEAD.format(1) + change("p", 'start="2"', target="b:h", parameter="amount", type="instant", targetValue=0.25),
    )
    await pilot.advance(4)
    seen = nods(pilot)
    before, after = seen[:95].max(), seen[110:190].max()
    assert before == pytest.approx(0.26, abs=0.03)
    assert after == pytest.approx(0.25 * 0.26, abs=0.03)
    assert pilot.feedback.warnings == []


async def test_a_gesture_with_a_smaller_amount_stays_nearer_to_the_rest_pose_without_jumps() -> None:
    less = change("p", 'start="2" end="3"', target="g", parameter="amount", targetValue=0.5)
    seen = []
    for more in ("", less):
        async with open_pilot() as pilot:
            pilot.watch()
            await pilot.advance(0.1)
            pilot.block("b", RAISED + more)
            await pilot.advance(5)
            seen.append(_turns(pilot, "r_elbow"))
    whole, part = seen
    assert part[:100] == pytest.approx(whole[:100])
    assert part[160:] == pytest.approx(0.5 * whole[160:], abs=0.02)
    assert np.abs(np.diff(part)).max() < 0.1


async def test_a_gesture_may_have_a_smaller_amount_from_the_start() -> None:
    seen = []
    for amount in (1, 0.5):
        async with open_pilot() as pilot:
            pilot.watch()
            await pilot.advance(0.1)
            pilot.block("b", RAISED.replace("/>", f'><bmlt:parameter name="amount" value="{amount}"/></gesture>'))
            await pilot.advance(2)
            assert pilot.feedback.warnings == []
            seen.append(_turns(pilot, "r_elbow"))
    whole, half = seen
    assert half[-1] == pytest.approx(0.5 * whole[-1], abs=0.02)


# --- what cannot be


@pytest.mark.parametrize(
    ("behavior", "kind", "words"),
    [
        (change("p", 'start="1"', parameter="pitch"), "NO_SUCH_TARGET", ["pitch", "volume"]),
        (change("p", 'start="1"', target="b:nobody"), "NO_SUCH_TARGET", ["nobody"]),
        (change("p", 'start="1"', target="nothing:s"), "NO_SUCH_TARGET", ["nothing"]),
        (change("p", 'start="1"', targetValue=100.5), "EXECUTION_FAILURE", ["100.5", "0 and 100"]),
        (change("p", 'start="1"', targetValue=-1), "EXECUTION_FAILURE", ["-1"]),
        (change("p", 'start="1"', initialValue=101), "EXECUTION_FAILURE", ["101"]),
        (
            change("p", 'start="1"', type="wavy"),
            "CANNOT_CREATE_BEHAVIOR",
            ["wavy", "ease-in-ease-out, instant, linear"],
        ),
        (change("p", 'start="1"', targetValue="NaN"), "PARSING_FAILURE", ["NaN"]),
        (change("p", 'start="1"', targetValue="1e999"), "PARSING_FAILURE", ["1e999"]),
        (change("p", 'start="30"'), "IMPOSSIBLE_TO_SCHEDULE", ["ended"]),
    ],
)
async def test_an_invalid_change_is_dropped_with_one_warning_and_its_reason(
    pilot: RealizerPilot, behavior: Any, kind: str, words: list[str]
) -> None:
    pilot.block("b", f'{SPEECH}<wait id="w" duration="31"/>{behavior}')
    await pilot.advance(32)
    id_, type_, sentence = warned(pilot)
    assert (id_, type_) == ("b:p", kind)
    assert all(word in sentence for word in words), sentence
    assert points(pilot, "b:p") == []
    assert pilot.feedback.status("b") == "DONE"


async def test_the_name_of_a_trajectory_may_be_in_any_case(pilot: RealizerPilot) -> None:
    pilot.block("b", SPEECH + change("p", 'start="0"', type="Ease_in_Ease_out"))
    await pilot.advance(1)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.reached("b:p:end")


# --- what is computed


def steps(pilot: RealizerPilot) -> Derived[float]:
    """The cell of the volume of the speech."""
    (block,) = pilot.realizer.scheduler.blocks.alive
    return next(unit for unit in block.units if unit.behavior.id == "s").parameters["volume"].cell


async def test_a_parameter_depends_on_its_trajectory_only_while_that_plays(voiceless: RealizerPilot) -> None:
    pilot = voiceless
    commits: list[Commit] = []
    pilot.predict("partner", "hit", 1.5)
    pilot.block("b", SPEECH + change("p", 'start="0.5" end="anticipators:partner:hit"'))
    await pilot.advance(0.4)
    volume = steps(pilot)
    assert list(volume.dependencies) == []
    await pilot.advance(0.6)
    (followed,) = volume.dependencies
    pilot.realizer.board.graph.listen(commits.append)
    await pilot.advance(0.2)
    assert {commit.stamp.cause for commit in commits} == {"time"}
    assert volume.value == pytest.approx(50 + 50 * 0.69)
    pilot.predict("partner", "hit", 3.0)
    await pilot.advance(0.9)
    assert followed.depends_on(pilot.realizer.board.predicted("partner", "hit"))
    assert volume.value == pytest.approx(50 + 50 * 0.69 + 50 * 0.31 * 0.9 / 1.81)
    pilot.predict("partner", "hit", 2.2)
    await pilot.advance(0.3)
    assert (volume.dependencies, volume.value) == ((), 100.0)
    commits.clear()
    await pilot.advance(0.5)
    assert commits == []


@pytest.fixture
async def voiceless() -> AsyncIterator[RealizerPilot]:
    async with open_pilot() as pilot:
        yield pilot


async def test_a_trajectory_that_fails_ends_its_change_alone_and_the_parameter_keeps_its_value(
    voiceless: RealizerPilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    pilot = voiceless

    def half(share: float) -> float:
        if share > 0.5:
            raise ArithmeticError("no second half")
        return share

    engine = next(each for each in pilot.realizer.characters["alice"].engines if each.name.endswith("value_change"))
    monkeypatch.setattr(engine, "_trajectories", {"linear": half})
    pilot.block("b", SPEECH + change("p", 'start="0" end="2"'))
    await pilot.advance(1.5)
    assert warned(pilot)[:2] == ("b:p", "EXECUTION_FAILURE")
    assert steps(pilot).value == pytest.approx(75.0)
    await pilot.advance(3)
    assert pilot.feedback.status("b") == "DONE"
    assert "b:s:end" in pilot.feedback.progress
