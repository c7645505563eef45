"""A character that nobody asks for anything is alive, from frames of a minute."""

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import angle, difference, rotate
from reactive_realizer.embodiment.vector import FORWARD
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot


async def minute(pilot: RealizerPilot) -> list[Body]:
    pilot.watch()
    await pilot.advance(60)
    return pilot.bodies("alice")


def directions(bodies: list[Body], joint: str) -> NDArray[np.float64]:
    """Yaw and pitch of where a joint faces in the world, degrees, (F, 2)."""
    ahead = [rotate(body.transform(joint).rotation, FORWARD) for body in bodies]
    return np.degrees([(math.atan2(x, z), math.asin(y)) for x, y, z in ahead])


def turned(bodies: list[Body], joint: str) -> float:
    """How far a joint turns at most between any frame and the first one, degrees."""
    first = bodies[0].rotation(joint)
    return math.degrees(max(angle(difference(first, body.rotation(joint))) for body in bodies))


async def test_head_elbows_fingers_and_eyes_move_a_little() -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        bodies = await minute(pilot)
    head = directions(bodies, "skullbase")
    assert 1.0 < np.ptp(head, axis=0).max() < 3.0 * math.sqrt(2.0)
    assert 1.0 < np.linalg.norm(head - head.mean(axis=0), axis=1).max() < 3.0
    assert all(turned(bodies, f"{side}_{finger}1") > 1.0 for side in "lr" for finger in ("middle", "ring", "pinky"))
    assert all(0.5 < turned(bodies, f"{side}_elbow") < 1.5 for side in "lr")
    eyes = [body.rotation("l_eyeball_joint") for body in bodies]
    saccades = [step for one, other in pairwise(eyes) if (step := math.degrees(angle(difference(one, other)))) > 0.05]
    assert len(saccades) > 40


async def test_an_elbow_is_still_while_a_motion_moves_its_arm_and_loose_again_afterward() -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.watch()
        pilot.block("b", '<gesture id="g" lexeme="OFFER" mode="RIGHT_HAND" stroke="2" strokeEnd="3" relax="21"/>')
        await pilot.advance(60)
        bodies = pilot.bodies("alice")
    held, after = bodies[160:1040], bodies[1200:]
    assert turned(held, "r_elbow") < 0.01
    assert turned(held, "l_elbow") > 0.3
    assert turned(after, "r_elbow") > 0.3


def weights(pilot: RealizerPilot, morph: str) -> NDArray[np.float64]:
    """Of a morph target in each frame, (F,)."""
    morphs = pilot.realizer.characters["alice"].humanoid.avatar.morphs
    return np.array([frame.weights[morphs.index(morph)] for frame in pilot.frames["alice"]])


async def test_the_face_smiles_a_little_more_and_less_and_lids_and_brows_move() -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        await minute(pilot)
        smile = weights(pilot, "mouthSmileLeft")
        assert 0.03 < smile.min() < smile.max() < 0.2
        for morph in ("mouthSmileLeft", "eyeSquintLeft", "browInnerUp"):
            assert np.ptp(weights(pilot, morph)) > 0.05
            assert np.abs(np.diff(weights(pilot, morph))).max() < 0.005


async def test_it_gives_way_softly_to_an_expression_and_comes_back() -> None:
    async with open_pilot(SceneOptions(voice="text")) as pilot:
        pilot.watch()
        await pilot.advance(2)
        pilot.block(
            "b", '<faceLexeme id="f" lexeme="LOWER_MOUTH_CORNERS" start="0" attackPeak="0.5" relax="2" end="2.5"/>'
        )
        await pilot.advance(5)
        smile = weights(pilot, "mouthSmileLeft")
        assert smile[150:200].max() == 0.0
        assert smile[-1] > 0.03
        assert np.abs(np.diff(smile)).max() < 0.01
        assert weights(pilot, "browInnerUp")[150:200].max() > 0.0


@pytest.mark.parametrize(("degree", "most"), [(0.3, 1.0), (0, 0.0)])
async def test_idle_has_a_degree(tmp_path: Path, degree: float, most: float) -> None:
    human = tmp_path / "human.toml"
    human.write_text(f"[character.alice]\nidle = {degree}\n", encoding="utf-8")
    async with open_pilot(SceneOptions(human, "text")) as pilot:
        bodies = await minute(pilot)
        head = directions(bodies, "skullbase")
        smile = weights(pilot, "mouthSmileLeft")
    assert np.linalg.norm(head - head.mean(axis=0), axis=1).max() <= most
    assert turned(bodies, "l_elbow") <= 0.5 * most
    assert (smile.max() == 0.0) == (degree == 0)
