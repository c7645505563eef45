"""Hands that hurry between places far away and near to the body, while the trunk leans for them and comes back."""

from collections.abc import Iterator
from random import Random

import pytest

from reactive_realizer.bml.names import BML, BMLA
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import Vec3, add, scale, subtract, unit
from reactive_realizer.testing.motion_laws import accelerations
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

_SPACES = f'xmlns="{BML}" xmlns:rr="urn:reactive-realizer:1" xmlns:bmla="{BMLA}"'
_GROUPS = {"l": "LEFT_ARM", "r": "RIGHT_ARM"}


def place(random: Random, body: Body, side: str) -> Vec3:
    """A place in front of an upright figure, up to 25 cm beyond the reach of an arm, from the pelvis."""
    outward = 1.0 if side == "l" else -1.0
    way = unit((outward * random.uniform(-0.6, 0.6), random.uniform(-1.0, 0.3), random.uniform(0.5, 1.0)))
    far = Arm.of(body.skeleton, side).reach + random.uniform(-0.15, 0.25)
    found = add(body.transform(f"{side}_shoulder").position, scale(way, far))
    return subtract(found, body.transform("HumanoidRoot").position)


def key_poses(random: Random, body: Body, side: str) -> str:
    """One or two places to which a hand goes within less than a second each."""
    poses, time = "", 0.0
    for _ in range(random.choice((1, 1, 2))):
        time += random.uniform(0.3, 1.0)
        x, y, z = place(random, body, side)
        hold = random.uniform(0.0, 0.3)
        target = f'<rr:position target="{x:.3f} {y:.3f} {z:.3f}"/>'
        poses += f'<rr:keyPose time="{time:.2f}" hold="{hold:.2f}">{target}</rr:keyPose>'
        time += hold
    fade = random.uniform(0.4, 1.0)
    return f'<rr:keyPoses id="{side}" group="{_GROUPS[side]}" fadeOut="{fade:.2f}">{poses}</rr:keyPoses>'


def blocks(random: Random, body: Body) -> Iterator[tuple[float, str]]:
    """Blocks that merge with, replace and interrupt each other, each with the time before it, s."""
    for number in range(6):
        reaches = "".join(key_poses(random, body, side) for side in random.choice(("l", "r", "lr")))
        composition = random.choice(("MERGE", "REPLACE"))
        yield (
            random.uniform(0.3, 1.4),
            f'<bml {_SPACES} id="b{number}" composition="{composition}">{reaches}</bml>',
        )
        if random.random() < 0.3:
            interrupt = f'<bmla:interrupt id="i" target="b{number}"/>'
            yield random.uniform(0.2, 0.6), f'<bml {_SPACES} id="i{number}">{interrupt}</bml>'


async def reaching(seed: int, pilot: RealizerPilot) -> list[Body]:
    pilot.watch()
    await pilot.advance(0.1)
    upright = pilot.bodies()[-1]
    for pause, block in blocks(Random(seed), upright):
        await pilot.advance(pause)
        pilot.perform(block)
    await pilot.advance(3)
    return pilot.bodies()


@pytest.mark.parametrize("seed", range(10))
async def test_no_wrist_jerks_in_hurried_reaches(seed: int) -> None:
    async with open_pilot() as pilot:
        bodies = await reaching(seed, pilot)
    assert max(accelerations(bodies, wrist).max() for wrist in ("l_wrist", "r_wrist")) < 60.0
