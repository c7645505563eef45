"""Poses are valid and within the limits in any session."""

import asyncio
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.testing.pilot import open_pilot

FRAME = 0.02
# rad/s; of all other joints 15.
FASTEST = {
    **dict.fromkeys(("HumanoidRoot", "vl5", "vt10", "vt6"), 4.0),
    **dict.fromkeys(("vc4", "skullbase", "l_wrist", "r_wrist"), 8.0),
    **dict.fromkeys(("l_eyeball_joint", "r_eyeball_joint"), 16.0),
}
WRIST, ROOT = 2.4, 2.0  # m/s

KINDS = (
    '<gesture id="{}" lexeme="BEAT" mode="BOTH_HANDS"{}/>',
    '<gesture id="{}" lexeme="OFFER" mode="RIGHT_HAND"{}/>',
    '<gesture id="{}" lexeme="BEAT" mode="LEFT_HAND"{}/>',
    '<pointing id="{}" target="bluebox"{}/>',
    '<pointing id="{}" target="greensphere" mode="LEFT_HAND"{}/>',
    '<head id="{}" lexeme="NOD" repetition="2"{}/>',
    '<head id="{}" lexeme="SHAKE"{}/>',
    '<gaze id="{}" target="bluebox" influence="WAIST"{}/>',
    '<gaze id="{}" target="greensphere" influence="EYES"{}/>',
    '<gazeShift id="{}" target="greensphere" influence="SHOULDER"{}/>',
    '<headDirectionShift id="{}" target="bluebox"{}/>',
    '<posture id="{}"{}><stance type="SITTING"/></posture>',
    '<postureShift id="{}"{}><stance type="SITTING"/></postureShift>',
    '<postureShift id="{}"{}><stance type="STANDING"/></postureShift>',
)
TIMES = ("0", "0.2", "0.5", "1.1", "anticipators:t:hit", "anticipators:t:hit+0.3", "anticipators:t:hit-0.4")


@st.composite
def bodies(draw: st.DrawFn) -> str:
    kinds = draw(st.lists(st.sampled_from(KINDS), min_size=1, max_size=4))
    parts = []
    for number, kind in enumerate(kinds):
        times = draw(st.dictionaries(st.sampled_from(["start", "end"]), st.sampled_from(TIMES), max_size=1))
        parts.append(kind.format(f"m{number}", "".join(f' {sync}="{time}"' for sync, time in times.items())))
    return "".join(parts)


moves = st.one_of(
    st.tuples(st.just("predict"), st.floats(-0.5, 2.0)),
    st.tuples(st.sampled_from(["MERGE", "REPLACE"]), bodies()),
    st.tuples(st.just("interrupt"), st.just(None)),
    st.tuples(st.just("move"), st.tuples(*[st.floats(-2.0, 2.0)] * 3)),
)
plays = st.lists(st.tuples(moves, st.sampled_from([0.06, 0.2, 0.5, 0.9])), min_size=1, max_size=6)


async def perform(first: Any, play: Any) -> tuple[tuple[str, ...], list[Frame], list[NDArray[np.float64]]]:
    """The skeleton's joints, and all frames of a performance with its path of both wrists."""
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.watch()
        pilot.predict("t", "hit", 1.0)
        pilot.block("b0", first)
        await pilot.advance(0.4)
        for number, ((what, how), pause) in enumerate(play, 1):
            match what:
                case "predict":
                    pilot.predict("t", "hit", pilot.now + how)
                case "interrupt":
                    pilot.block(f"b{number}", f'<bmla:interrupt id="i" target="b{number - 1}"/>')
                case "move":
                    pilot.move("bluebox", how)
                case _:
                    pilot.block(f"b{number}", how, composition=what)
            await pilot.advance(pause)
        await pilot.advance(1.5)
        joints = pilot.realizer.characters["alice"].humanoid.avatar.skeleton.joints
        return joints, pilot.frames["alice"], [pilot.path(wrist) for wrist in ("l_wrist", "r_wrist")]


def steps(path: NDArray[np.float64]) -> Any:
    """How far a point goes from each frame to the next, m."""
    return np.linalg.norm(np.diff(path, axis=0), axis=1)


def turns(rotations: NDArray[np.float64]) -> Any:
    """How far each joint turns from each frame to the next, rad, (F - 1, J)."""
    ways = np.linalg.norm(rotations[1:] * np.sign(np.sum(rotations[1:] * rotations[:-1], axis=2))[..., None]
                          - rotations[:-1], axis=2)  # fmt: skip
    return 4.0 * np.arcsin(np.clip(0.5 * ways, 0.0, 1.0))


@settings(max_examples=25)
@given(bodies(), plays)
def test_any_session_keeps_poses_valid_and_within_the_limits(first: Any, play: Any) -> None:
    joints, frames, wrists = asyncio.run(perform(first, play))
    rotations = np.array([frame.rotations for frame in frames])
    assert np.isfinite(rotations).all()
    assert np.abs(np.linalg.norm(rotations, axis=2) - 1.0).max() < 1e-6
    limits = np.array([FASTEST.get(joint, 15.0) for joint in joints])
    fastest = turns(rotations).max(axis=0) / FRAME
    assert not [*zip(np.array(joints)[fastest > 1.001 * limits], fastest[fastest > 1.001 * limits], strict=True)]
    assert max(steps(path).max() for path in wrists) < 1.001 * WRIST * FRAME
    assert steps(np.array([frame.root for frame in frames])).max() < 1.001 * ROOT * FRAME
    assert all((frame.weights >= 0.0).all() and (frame.weights <= 1.0).all() for frame in frames)
