"""Kinds of motion of plug-ins: what fails in one of them costs its own behavior, and nothing else."""

import math
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.assembly.registry import load, names
from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat
from reactive_realizer.engines.animation.motion_maker import MakerContext, MotionRequest
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit
from reactive_realizer.errors import RealizerError
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

SCENE = "reactive_realizer.assembly.scene"
ENTRY = '<MotionUnitSpec type="tilt" namespace="urn:t"><MotionUnit type="class" class="tilt"/></MotionUnitSpec>'
BLOCK = '<tilt xmlns="urn:t" id="t" start="0.2"/><gesture id="g" lexeme="BEAT"/>'

Open = Callable[..., AbstractAsyncContextManager[RealizerPilot]]


class Tilt(MotionUnit):
    kind = LayerKind.ADDITIVE
    joints = frozenset({"skullbase"})
    preferred_duration = 1.0

    def __init__(self, pose: Callable[[], Any]) -> None:
        self.parameters = {}
        self._pose = pose

    def start(self, body: Body) -> None:
        pass

    def pose(self, moment: Moment) -> MotionPose:
        found: MotionPose = self._pose()
        return found


def raises() -> MotionPose:
    raise ZeroDivisionError


POSES: dict[str, Callable[[], Any]] = {
    "an exception": raises,
    "no pose": lambda: None,
    "not a number": lambda: MotionPose({"skullbase": (math.nan, 0.0, 0.0, 0.0)}),
    "no rotation": lambda: MotionPose({"skullbase": "left"}),  # type: ignore[dict-item]
}


@pytest.fixture
def plugin(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Open:
    """Opens a scene with a kind of motion, made by a function that gets the request; None for a broken maker."""

    @asynccontextmanager
    async def open_(make: Callable[[MotionRequest], object] | None, name: str = "tilt") -> AsyncIterator[RealizerPilot]:
        def maker(context: MakerContext) -> Callable[[MotionRequest], object]:
            if make is None:
                raise ZeroDivisionError
            return make

        monkeypatch.setattr(f"{SCENE}.names", lambda group: [name] if group == "motions" else names(group))
        monkeypatch.setattr(f"{SCENE}.load", lambda group, *which: maker if group == "motions" else load(group, *which))
        (tmp_path / "own.xml").write_text(f"<gesturebinding>{ENTRY}</gesturebinding>", encoding="utf-8")
        human = tmp_path / "human.toml"
        human.write_text('[character.alice]\nbindings = { gesture = "own.xml" }\n', encoding="utf-8")
        async with open_pilot(SceneOptions(human, "text", (tmp_path,))) as pilot:
            pilot.watch()
            yield pilot

    return open_


async def test_a_kind_of_motion_plays(plugin: Open) -> None:
    turned: Quat = (math.cos(0.1), 0.0, 0.0, math.sin(0.1))
    async with plugin(lambda request: Tilt(lambda: MotionPose({"skullbase": turned}))) as pilot:
        pilot.block("b", BLOCK)
        await pilot.advance(3)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:t:end") == pytest.approx(1.2)


@pytest.mark.parametrize("pose", POSES)
async def test_a_motion_that_fails_ends_with_a_warning_and_the_others_go_on(plugin: Open, pose: str) -> None:
    async with plugin(lambda request: Tilt(POSES[pose])) as pilot:
        pilot.block("b", BLOCK)
        await pilot.advance(3)
    told = pilot.feedback
    assert [id_ for id_, _ in told.warnings] == ["b:t"]
    assert told.time("b:t:end") < 0.5
    assert told.time("b:g:end") > 1.0
    assert told.status("b") == "DONE"


@pytest.mark.parametrize("made", [None, "left", Tilt(lambda: MotionPose({"skullbase": IDENTITY})).kind])
async def test_what_is_no_motion_is_dropped_with_a_warning(plugin: Open, made: object) -> None:
    async with plugin(lambda request: made) as pilot:
        pilot.block("b", BLOCK)
        await pilot.advance(3)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:t"]
    assert pilot.feedback.time("b:g:end") > 1.0


async def test_a_maker_that_raises_is_dropped_with_a_warning(plugin: Open) -> None:
    async with plugin(lambda request: raises()) as pilot:
        pilot.block("b", BLOCK)
        await pilot.advance(3)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:t"]
    assert pilot.feedback.time("b:g:end") > 1.0


@pytest.mark.parametrize(("name", "value"), [("kind", "upper body"), ("preferred_duration", math.inf)])
async def test_a_motion_that_cannot_be_played_with_others_is_dropped_with_the_reason(
    plugin: Open, name: str, value: object
) -> None:
    def make(request: MotionRequest) -> Tilt:
        tilt = Tilt(lambda: MotionPose({"skullbase": IDENTITY}))
        setattr(tilt, name, value)
        return tilt

    async with plugin(make) as pilot:
        pilot.block("b", BLOCK)
        await pilot.advance(3)
    (warning,) = pilot.feedback.of("warningFeedback")
    assert warning.id == "b:t"
    assert "the motion 'tilt' of a plug-in has the" in str(warning.text)
    assert pilot.feedback.time("b:g:end") > 1.0


async def test_a_maker_that_cannot_be_created_is_left_out(plugin: Open, caplog: pytest.LogCaptureFixture) -> None:
    async with plugin(None) as pilot:
        pilot.block("b", BLOCK)
        await pilot.advance(3)
    assert [id_ for id_, _ in pilot.feedback.warnings] == ["b:t"]
    assert pilot.feedback.time("b:g:end") > 1.0
    assert "the kind of motion 'tilt' of a plug-in cannot be created" in caplog.text


async def test_a_name_of_the_package_is_refused(plugin: Open) -> None:
    with pytest.raises(RealizerError, match="gaze"):
        async with plugin(lambda request: None, name="gaze"):
            pass
