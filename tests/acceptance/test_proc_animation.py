"""ProcAnimation files, from BML to frames: all of AsapRealizer's format."""

import math
import os
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, difference, from_euler
from reactive_realizer.testing.pilot import RealizerPilot

PACKAGE = Path(__file__).parents[2] / "reactive_realizer" / "assets" / "procanimation"

ENTRY = """
<MotionUnitSpec type="gesture">
  <constraints><constraint name="lexeme" value="{lexeme}"/></constraints>
  <parameterdefaults>{defaults}</parameterdefaults>
  <MotionUnit type="ProcAnimation" file="{file}"/>
</MotionUnitSpec>
"""


def entry(lexeme: str, file: str | Path, **defaults: str) -> str:
    """An entry of a binding that plays a file as it is."""
    given = "".join(f'<parameterdefault name="{name}" value="{value}"/>' for name, value in defaults.items())
    return ENTRY.format(lexeme=lexeme, file=file, defaults=given)


def animation(content: str, duration: str = "2") -> str:
    return f'<ProcAnimation prefDuration="{duration}">\n{content}\n</ProcAnimation>'


Open = Callable[..., AbstractAsyncContextManager[RealizerPilot]]


@pytest.fixture
def opened(tmp_path: Path, open_still: Open) -> Open:
    """Opens a pilot of Alice without idle animation, with entries of a binding and files."""

    @asynccontextmanager
    async def opened_with(*entries: str, avatar: str = "female", **files: str) -> AsyncIterator[RealizerPilot]:
        (tmp_path / "gesturebinding.xml").write_text(f"<gesturebinding>{''.join(entries)}</gesturebinding>")
        for name, text in files.items():
            (tmp_path / f"{name}.xml").write_text(text)
        async with open_still(tmp_path, avatar=avatar) as pilot:
            yield pilot

    return opened_with


def shown(pilot: RealizerPilot, time: float) -> Body:
    """The figure as it was shown at a time."""
    shown = zip(pilot.frames["alice"], pilot.bodies("alice"), strict=True)
    frame, body = next((frame, body) for frame, body in shown if frame.time >= time - 1e-9)
    assert frame.time == pytest.approx(time)
    return body


def gap(a: tuple[float, float, float, float], b: tuple[float, float, float, float]) -> float:
    """The angle between two rotations, rad."""
    return angle(difference(a, b))


async def test_joints_follow_formulas(opened: Open) -> None:
    file = animation(
        '<Rotation target="vc4" rotation="0.4*t^2; 0.2*sin(2*pi*t); if(t &gt; 0.5 &amp;&amp; t &lt; 0.9, 0.1, 0)"/>'
    )
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PLAY" start="1" end="3"/>')
        await pilot.advance(4)
        assert pilot.feedback.warnings == []
        for time in (1.4, 1.8, 2.2, 2.4, 2.96):
            t = (time - 1) / 2
            wanted = from_euler(0.4 * t * t, 0.2 * math.sin(2 * math.pi * t), 0.1 if 0.5 < t < 0.9 else 0.0)
            assert gap(shown(pilot, time).rotation("vc4"), wanted) < 0.002


async def test_hands_and_feet_follow_formulas_within_a_centimeter(opened: Open) -> None:
    file = animation(
        '<EndEffector target="l_wrist" translation="0.25; 1.1 + 0.2*t; 0.3"/>'
        '<EndEffector target="r_wrist" local="true" translation="-0.1; -0.2; 0.2 + 0.1*t" swivel="0.3"/>'
        '<EndEffector target="l_ankle" translation="0.15; 0.1 + 0.3*t; 0.1*t"/>'
    )
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PLAY" start="0" end="2"/>')
        await pilot.advance(3)
        assert pilot.feedback.warnings == []
        for time in (0.6, 1.2, 2.0):
            t, body = time / 2, shown(pilot, time)
            place = {
                joint: np.array(body.transform(joint).position)
                for joint in ("l_wrist", "r_wrist", "r_shoulder", "l_ankle")
            }
            assert place["l_wrist"] == pytest.approx((0.25, 1.1 + 0.2 * t, 0.3), abs=0.01)
            assert place["l_ankle"] == pytest.approx((0.15, 0.1 + 0.3 * t, 0.1 * t), abs=0.01)
            assert np.linalg.norm(place["r_wrist"] - place["r_shoulder"]) == pytest.approx(
                math.hypot(0.1, 0.2, 0.2 + 0.1 * t), abs=0.01
            )


async def test_the_root_follows_formulas_and_returns(opened: Open) -> None:
    file = animation(
        '<EndEffector target="HumanoidRoot" local="true" translation="0.1*t; 0-0.15*t; 0"/>'
        '<Rotation target="HumanoidRoot" rotation="0;0.5*t;0"/>'
    )
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PLAY" start="0" end="2"/>')
        await pilot.advance(4)
        before, half, end, after = (shown(pilot, time) for time in (0.0, 1.0, 2.0, 3.8))
        moved = [np.subtract(body.root, before.root) for body in (half, end, after)]
        assert moved[0] == pytest.approx((0.05, -0.075, 0.0), abs=0.005)
        assert moved[1] == pytest.approx((0.1, -0.15, 0.0), abs=0.005)
        assert moved[2] == pytest.approx((0.0, 0.0, 0.0), abs=0.005)
        assert gap(end.rotation("HumanoidRoot"), from_euler(0.0, 0.5, 0.0)) < 0.01


async def test_an_animation_of_the_root_alone_fades_out_like_one_of_an_arm(opened: Open) -> None:
    file = animation('<EndEffector target="root" local="true" translation="0; 0.1; 0"/>', "1")
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PLAY" start="0.5"/>')
        await pilot.advance(4)
        heights = [shown(pilot, time).root[1] for time in (0.4, 1.48, 1.6, 3.8)]
        assert heights == pytest.approx([0.0, 0.1, 0.095, 0.0], abs=0.005)


async def test_nothing_jumps_at_the_start_and_at_the_end(opened: Open) -> None:
    file = animation('<EndEffector target="r_wrist" translation="-0.3;1.4;0.3"/>', "1")
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PLAY" start="0.5"/>')
        await pilot.advance(4)
        steps = np.linalg.norm(np.diff(pilot.path("r_wrist"), axis=0), axis=1)
        assert steps.max() < 0.15
        assert steps[-10:].max() < 1e-3
        assert pilot.feedback.time("b:g:end") == 1.5


async def test_key_positions_with_any_name_are_sync_points_for_other_behaviors(opened: Open) -> None:
    file = animation(
        '<Rotation target="vc4" rotation="0.1*t;0;0"/><KeyPosition id="beat1" time="0.25" weight="1"/>'
        '<KeyPosition id="beat2" time="0.5" weight="1"/>'
    )
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PLAY" start="1"/><head id="h" lexeme="NOD" start="g:beat2"/>')
        await pilot.advance(4)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.time("b:g:beat1") == 1.5
        assert pilot.feedback.time("b:g:beat2") == pilot.feedback.time("b:h:start") == 2.0


async def test_parameters_may_change_while_it_plays(opened: Open) -> None:
    file = animation('<Rotation target="vc4" rotation="a;0;0"/><Parameter sid="a" value="0.1"/>')
    change = (
        '<bmla:parametervaluechange id="p" target="b:g" paramId="a" start="0.8" end="1.2">'
        '<bmla:trajectory type="linear" targetValue="0.3"/></bmla:parametervaluechange>'
    )
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", f'<gesture id="g" lexeme="PLAY" start="0" end="2"/>{change}')
        await pilot.advance(3)
        assert pilot.feedback.warnings == []
        for time, a in ((0.6, 0.1), (1.0, 0.2), (1.6, 0.3)):
            assert gap(shown(pilot, time).rotation("vc4"), from_euler(a, 0.0, 0.0)) < 0.01
        assert pilot.feedback.time("b:g:end") == 2.0


async def test_a_formula_without_a_value_stops_only_its_unit(opened: Open) -> None:
    broken = animation('<Rotation target="l_elbow" rotation="0-sqrt(a);0;0"/><Parameter sid="a" value="0.5"/>')
    other = animation('<Rotation target="r_elbow" rotation="0-t;0;0"/>')
    change = (
        '<bmla:parametervaluechange id="p" target="b:g" paramId="a" start="0.8">'
        '<bmla:trajectory type="instant" targetValue="-1"/></bmla:parametervaluechange>'
    )
    async with opened(entry("BREAK", "broken.xml"), entry("PLAY", "other.xml"), broken=broken, other=other) as pilot:
        pilot.block("b", f'<gesture id="g" lexeme="BREAK" start="0"/>{change}<gesture id="h" lexeme="PLAY" start="0"/>')
        await pilot.advance(3)
        assert pilot.feedback.warnings == [("b:g", "EXECUTION_FAILURE")]
        assert pilot.feedback.time("b:h:end") == 2.0
        assert gap(shown(pilot, 2.0).rotation("r_elbow"), from_euler(-1.0, 0.0, 0.0)) < 0.01
        assert pilot.feedback.status("b") == "DONE"


async def test_an_animation_is_mirrored_and_then_restricted_to_joints(opened: Open) -> None:
    file = animation('<Rotation target="r_elbow" rotation="0-1;0;0.2"/><Rotation target="vc4" rotation="0.3;0;0"/>')
    specs = entry("PLAY", "play.xml"), entry("PART", "play.xml", mirror="true", joints="l_elbow, l_wrist")
    async with opened(*specs, play=file) as pilot:
        pilot.block(
            "b", '<gesture id="g" lexeme="PLAY" start="0" end="2"/><gesture id="h" lexeme="PART" start="3" end="5"/>'
        )
        await pilot.advance(6)
        assert pilot.feedback.warnings == []
        whole, before, part = shown(pilot, 1.6), shown(pilot, 3.0), shown(pilot, 4.6)
        assert gap(whole.rotation("r_elbow"), from_euler(-1.0, 0.0, 0.2)) < 0.01
        assert gap(part.rotation("l_elbow"), from_euler(-1.0, 0.0, -0.2)) < 0.01
        assert gap(part.rotation("vc4"), before.rotation("vc4")) < 0.01
        assert gap(part.rotation("r_elbow"), before.rotation("r_elbow")) < 0.01


async def test_joints_that_an_animation_does_not_turn_are_reported(opened: Open) -> None:
    file = animation('<Rotation target="r_elbow" rotation="t;0;0"/>')
    async with opened(entry("PART", "play.xml", joints="l_elbow"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PART"/>')
        await pilot.advance(1)
        (line,) = pilot.feedback.of("warningFeedback")
        assert (line.id, line.element.get("type")) == ("b:g", "CANNOT_CREATE_BEHAVIOR")
        assert "play.xml turns none of l_elbow; it turns r_elbow" in line.text


async def test_a_changed_file_is_read_again_by_a_block_that_failed_before(opened: Open, tmp_path: Path) -> None:
    bend = animation('<Rotation target="vc4" rotation="{0};0;0"/>')
    fails = '<required><constraint><before ref="w:start"><sync ref="w:end"/></before></constraint></required>'
    async with opened(entry("PLAY", "play.xml"), play=bend.format(0.1)) as pilot:
        pilot.block("b", f'<gesture id="g" lexeme="PLAY"/><wait id="w" duration="1"/>{fails}')
        await pilot.advance(1)
        assert pilot.feedback.status("b") == "FAILED"
        (tmp_path / "play.xml").write_text(bend.format(0.3))
        os.utime(tmp_path / "play.xml", ns=(0, 1))
        pilot.block("b", '<wait id="w" duration="1"/><gesture id="g" lexeme="PLAY"/>')
        await pilot.advance(1)
        last = shown(pilot, float(pilot.frames["alice"][-1].time))
        assert gap(last.rotation("vc4"), from_euler(0.3, 0.0, 0.0)) < 0.01


async def test_a_changed_file_is_read_again_at_its_next_use(opened: Open, tmp_path: Path) -> None:
    async with opened(
        entry("PLAY", "play.xml"), play=animation('<Rotation target="vc4" rotation="0.1;0;0"/>')
    ) as pilot:
        for id_, angle_ in (("b", 0.1), ("c", 0.3)):
            (tmp_path / "play.xml").write_text(animation(f'<Rotation target="vc4" rotation="{angle_};0;0"/>'))
            os.utime(tmp_path / "play.xml", ns=(0, int(angle_ * 1e10)))
            pilot.block(id_, '<gesture id="g" lexeme="PLAY"/>')
            await pilot.advance(1)
            assert (
                gap(shown(pilot, float(pilot.frames["alice"][-1].time)).rotation("vc4"), from_euler(angle_, 0.0, 0.0))
                < 0.01
            )
            await pilot.advance(3)


async def test_an_invalid_formula_is_refused_with_file_line_element_and_character(opened: Open) -> None:
    file = animation('<Rotation target="vc4" rotation="0;0.1*sin(t;0"/>')
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PLAY"/>')
        await pilot.advance(1)
        (line,) = pilot.feedback.of("warningFeedback")
        assert (line.id, line.element.get("type")) == ("b:g", "CANNOT_CREATE_BEHAVIOR")
        assert "play.xml, line 2, <Rotation>: rotation: ')' is missing at character 10 of '0.1*sin(t'" in line.text


async def test_a_file_of_100_megabytes_is_refused_unread(opened: Open, tmp_path: Path) -> None:
    async with opened(entry("PLAY", "play.xml"), play="") as pilot:
        os.truncate(tmp_path / "play.xml", 100_000_000)
        pilot.block("b", '<gesture id="g" lexeme="PLAY"/>')
        await pilot.advance(1)
        (line,) = pilot.feedback.of("warningFeedback")
        assert "play.xml is 100000000 bytes; the limit is 8388608" in line.text


async def test_a_file_with_too_many_formulas_is_refused(opened: Open) -> None:
    file = animation('<Rotation target="vc4" rotation="t*t*t*t*t*t*t*t*t*t*t*t*t*t*t;0;0"/>\n' * 4000)
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PLAY"/>')
        await pilot.advance(1)
        (line,) = pilot.feedback.of("warningFeedback")
        assert "more than 100000 characters of formulas in one file" in line.text


async def test_formulas_may_call_functions_of_plug_ins(
    opened: Open, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "wobbling.py").write_text("def wobble(x, strength=0.2):\n    return strength * x\n")
    about = tmp_path / "wobbling-1.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: wobbling\nVersion: 1\n")
    (about / "entry_points.txt").write_text("[reactive_realizer.functions]\nwobble = wobbling:wobble\n")
    monkeypatch.syspath_prepend(tmp_path)
    file = animation('<Rotation target="vc4" rotation="wobble(t); wobble(t, 0.4); 0"/>')
    async with opened(entry("PLAY", "play.xml"), play=file) as pilot:
        pilot.block("b", '<gesture id="g" lexeme="PLAY" start="0" end="2"/>')
        await pilot.advance(3)
        assert pilot.feedback.warnings == []
        assert gap(shown(pilot, 2.0).rotation("vc4"), from_euler(0.2, 0.4, 0.0)) < 0.01


def texts(folder: Path) -> dict[str, str]:
    """The contents of the files of a folder, under neutral names."""
    return {f"own{i}": file.read_text(encoding="utf-8") for i, file in enumerate(sorted(folder.rglob("*.xml")))}


async def all_play(opened: Open, names: dict[str, str], avatar: str, lasting: float = 1.2) -> None:
    """Plays animations one after the other, in a time that the limits of all of them allow, and checks all frames."""
    gestures = "".join(
        f'<gesture id="g{i}" lexeme="{name}" start="{1.4 * i}" end="{1.4 * i + lasting}"/>'
        for i, name in enumerate(names)
    )
    async with opened(*(entry(name, f"{name}.xml") for name in names), avatar=avatar, **names) as pilot:
        pilot.block("b", gestures)
        await pilot.advance(1.4 * len(names) + 1)
        assert pilot.feedback.warnings == []
        assert pilot.feedback.status("b") == "DONE"
        rotations = np.array([frame.rotations for frame in pilot.frames["alice"]])
        assert np.linalg.norm(rotations, axis=2) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("avatar", ["female", "male"])
async def test_animations_in_the_style_of_published_ones_play(opened: Open, avatar: str, tests_data: Path) -> None:
    await all_play(opened, texts(tests_data / "procanimation"), avatar)


@pytest.mark.parametrize("avatar", ["female", "male"])
async def test_all_animations_of_asaprealizer_play(opened: Open, avatar: str, shared_cases: Path) -> None:
    peers = texts(shared_cases / "asap" / "procanimation")
    assert len(peers) == 11
    await all_play(opened, peers, avatar, lasting=1.3)


@pytest.mark.parametrize(("avatar", "half"), [("female", 0), ("male", 1)])
async def test_all_animations_of_the_package_play(opened: Open, avatar: str, half: int) -> None:
    ours = texts(PACKAGE)
    assert len(ours) == 54
    await all_play(opened, dict(list(ours.items())[half::2]), avatar)
