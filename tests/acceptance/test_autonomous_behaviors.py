"""Autonomous behaviors of one's own: what a character does by itself, periodically, at random, or at an event."""

from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.errors import RealizerError
from reactive_realizer.realizer.inputs import TickInputs
from reactive_realizer.realizer.session import replay
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

SIGH = 'behavior = \'<gesture id="sigh" lexeme="BREATHE"/>\''
NOD = 'behavior = \'<head id="n" lexeme="NOD"/>\''


def scene(folder: Path, autonomous: str) -> SceneOptions:
    human = folder / "human.toml"
    human.write_text(f'[character.alice]\navatar = "avatars/female.glb"\n{autonomous}')
    return SceneOptions(human, "text", verify=True)


def times(pilot: RealizerPilot, behavior: str) -> list[float]:
    """When a behavior has started in any block."""
    points = pilot.feedback.of("syncPointProgress")
    return [point.time for point in points if point.id.endswith(f":{behavior}:start") and point.time is not None]


async def test_a_periodic_behavior_comes_at_its_period(tmp_path: Path) -> None:
    async with open_pilot(
        scene(tmp_path, f'[character.alice.autonomous.sigh]\n{SIGH}\ntrigger = "periodic"\nevery = 4')
    ) as pilot:
        pilot.watch()
        await pilot.advance(14)
        assert np.diff([0.0, *times(pilot, "sigh")]) == pytest.approx([4, 4, 4], abs=0.03)
        lift = [-2.0 * body.rotation("r_sternoclavicular")[3] for body in pilot.bodies()]
        assert max(lift[200:400]) > max(lift[:200]) + 0.015
        assert pilot.feedback.warnings == []


async def test_a_random_behavior_comes_on_average_at_its_period_and_always_at_the_same_times(tmp_path: Path) -> None:
    seen = []
    for _ in range(2):
        async with open_pilot(scene(tmp_path, f"[character.alice.autonomous.sigh]\n{SIGH}\nevery = 5")) as pilot:
            await pilot.advance(60)
            seen.append(times(pilot, "sigh"))
    pauses = np.diff(seen[0])
    assert seen[0] == seen[1]
    assert pauses.mean() == pytest.approx(5, abs=1)
    assert 2.4 < pauses.min() < 4
    assert 6 < pauses.max() < 7.6


async def test_a_behavior_comes_at_each_event(tmp_path: Path) -> None:
    event = f'[character.alice.autonomous.nod]\n{NOD}\ntrigger = "event"\nevent = "partner:bang"'
    async with open_pilot(scene(tmp_path, event)) as pilot:
        for bang in (2.0, 6.0):
            pilot.predict("partner", "bang", bang)
            await pilot.advance(bang + 2.0 - pilot.now)
        assert times(pilot, "n") == pytest.approx([2.0, 6.0], abs=0.02)
        assert pilot.feedback.warnings == []


async def test_an_emitted_event_triggers_a_behavior(tmp_path: Path) -> None:
    event = f'[character.alice.autonomous.nod]\n{NOD}\ntrigger = "event"\nevent = "events:please"'
    async with open_pilot(scene(tmp_path, event)) as pilot:
        emit = '<bmla:emit xmlns:bmla="http://www.asap-project.org/bmla" id="e" event="please" start="1.5"/>'
        pilot.block("b", emit)
        await pilot.advance(4)
        assert times(pilot, "n") == pytest.approx([1.5], abs=0.02)


async def test_it_gives_way_to_what_is_asked_for(tmp_path: Path) -> None:
    periodic = f'[character.alice.autonomous.nod]\n{NOD}\ntrigger = "periodic"\nevery = 2'
    async with open_pilot(scene(tmp_path, periodic)) as pilot:
        pilot.watch()
        pilot.block("b", '<head id="tilt" lexeme="TILT_LEFT" start="0" end="5"/>')
        await pilot.advance(5)
        alone = [body.rotation("skullbase")[1] for body in pilot.bodies()][60:220]
        assert np.ptp(alone) < 0.03
        await pilot.advance(3)
        nodding = [body.rotation("skullbase")[1] for body in pilot.bodies()][290:]
        assert np.ptp(nodding) > 0.03


async def test_everything_that_is_replaced_does_not_end_it_for_good(tmp_path: Path) -> None:
    event = f'[character.alice.autonomous.nod]\n{NOD}\ntrigger = "event"\nevent = "partner:bang"'
    async with open_pilot(scene(tmp_path, event)) as pilot:
        await pilot.advance(1)
        pilot.block("all", composition="REPLACE")
        await pilot.advance(2)
        pilot.predict("partner", "bang", 4.0)
        await pilot.advance(3)
        assert times(pilot, "n") == pytest.approx([4.0], abs=0.02)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ('trigger = "sometimes"', "autonomous.x.trigger: 'sometimes' is not one of periodic, random, event"),
        ("every = 0.1", "autonomous.x.every: 0.1 is not from 0.5"),
        ('trigger = "event"', "autonomous.x.event: the trigger event needs an anticipator and a point"),
        ('trigger = "event"\nevent = "bang"', "autonomous.x.event: the trigger event needs"),
        ('event = "partner:bang"', "autonomous.x.event"),
        ('sound = "a.wav"', "autonomous.x.sound: unknown; known are behavior, trigger, every, event"),
    ],
)
async def test_a_mistake_in_the_human_file_is_named_with_its_key(tmp_path: Path, wrong: str, told: str) -> None:
    with pytest.raises(RealizerError, match=r"human\.toml") as refused:
        async with open_scene(scene(tmp_path, f"[character.alice.autonomous.x]\n{NOD}\n{wrong}")):
            pass
    assert told in str(refused.value)


async def test_a_behavior_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    with pytest.raises(RealizerError, match=r"autonomous.x.behavior: .*requires the attribute 'lexeme'"):
        async with open_scene(scene(tmp_path, "[character.alice.autonomous.x]\nbehavior = '<head id=\"n\"/>'")):
            pass


async def test_a_session_with_them_is_replayed_byte_by_byte(tmp_path: Path) -> None:
    habits = (
        f"[character.alice.autonomous.sigh]\n{SIGH}\nevery = 3\n"
        f'[character.alice.autonomous.nod]\n{NOD}\ntrigger = "event"\nevent = "partner:bang"'
    )
    session: list[TickInputs] = []
    async with open_pilot(scene(tmp_path, habits)) as pilot:
        pilot.realizer.record(session.append)
        pilot.predict("partner", "bang", 2.0)
        pilot.block("b", '<head id="h" lexeme="SHAKE" start="2.5"/>')
        await pilot.advance(10)
        played = pilot.feedback.raw
    async with open_pilot(scene(tmp_path, habits)) as pilot:
        await replay(pilot.realizer, session)
        assert pilot.feedback.raw == played
    assert len(played) > 20


@pytest.mark.parametrize("written", ["", "<!-- nothing -->", "</bml><bml id='x'>"])
async def test_something_else_than_behaviors_is_refused(tmp_path: Path, written: str) -> None:
    table = f'[character.alice.autonomous.x]\nbehavior = "{written}"'
    with pytest.raises(RealizerError, match=r"autonomous.x.behavior: it must be one or more behaviors of BML"):
        async with open_scene(scene(tmp_path, table)):
            pass
