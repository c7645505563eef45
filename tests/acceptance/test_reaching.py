"""A hand with a goal in a file stays there under additive motion of the trunk."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.vector import distance
from reactive_realizer.testing.pilot import open_pilot

PLACE = (0.2, 1.15, 0.3)
"""m, in the figure's frame."""

NOISE = """<bmlt:noise id="n" type="perlin" joint="vl5" start="0" end="7">
    <bmlt:parameter name="baseamplitudex" value="0.2"/></bmlt:noise>"""


async def furthest(folder: Path, tracks: str, more: str, seed: int = 0) -> float:
    """How far from the place the wrist gets while it is to be there, m."""
    (folder / "reach.xml").write_text(f'<ProcAnimation prefDuration="6">{tracks}</ProcAnimation>')
    async with open_pilot(SceneOptions(voice="text", assets=(folder,), seed=seed)) as pilot:
        pilot.watch()
        pilot.block("b", f'<bmlt:procanimation id="r" name="reach"/>{more}')
        await pilot.advance(6)
        assert pilot.feedback.warnings == []
        # The figure stands in the middle of the world and faces +z: its frame is the world's.
        return max(distance(body.transform("l_wrist").position, PLACE) for body in pilot.bodies()[75:290])


REACH = '<EndEffector target="l_wrist" local="false" translation="0.2;1.15;0.3"/>'
LEAN = '<Rotation target="vl5" local="true" rotation="0.2*sin(6*t);0;0"/>'


@pytest.mark.parametrize("seed", [0, 1])
async def test_breath_and_sway_do_not_move_a_hand_off_its_goal(tmp_path: Path, seed: int) -> None:
    assert await furthest(tmp_path, REACH, "", seed) < 0.001


async def test_a_trunk_that_the_file_turns_does_not_move_a_hand_off_its_goal(tmp_path: Path) -> None:
    assert await furthest(tmp_path, LEAN + REACH, "") < 0.001


async def test_noise_moves_a_hand_off_its_goal_by_no_more_than_a_frame(tmp_path: Path) -> None:
    assert await furthest(tmp_path, REACH, NOISE) < 0.005
