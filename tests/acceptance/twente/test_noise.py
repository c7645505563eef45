"""Noise in BML (thesis C.1.7)."""

import numpy as np

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .motions import angles


async def test_noise_moves_a_joint_while_it_plays(pilot: RealizerPilot) -> None:
    stir = '<bmlt:parameter name="basefreqx" value="0.5"/><bmlt:parameter name="baseamplitudex" value="0.3"/>'
    pilot.block("b", f'<bmlt:noise id="n" type="perlin" joint="vl5" start="1" end="9">{stir}</bmlt:noise>')
    await pilot.advance(10.5)
    assert not pilot.feedback.warnings
    shown = angles(pilot, "vl5")
    still = [angle for time, angle in shown.items() if time < 1.0 or time > 9.8]
    stirred = [angle for time, angle in shown.items() if 1.5 < time < 9.0]
    assert np.ptp(still) < 0.05 < 0.15 < np.ptp(stirred)
    assert np.abs(np.diff(list(shown.values()))).max() < 0.05


async def test_noise_grows_while_it_plays(pilot: RealizerPilot) -> None:
    pilot.block(
        "b",
        """
        <bmlt:noise id="n" type="perlin" joint="vl5" start="0" end="12">
          <bmlt:parameter name="baseamplitudex" value="0.02"/></bmlt:noise>
        <bmla:parametervaluechange id="more" target="n" paramId="baseamplitudex" start="4" end="6">
          <bmla:trajectory type="linear" targetValue="0.4"/></bmla:parametervaluechange>
        """,
    )
    await pilot.advance(12)
    assert not pilot.feedback.warnings
    shown = angles(pilot, "vl5")
    early, late = ([a for time, a in shown.items() if low < time < low + 4.0] for low in (0.0, 7.0))
    assert np.ptp(late) > 3.0 * np.ptp(early)


async def test_noise_is_equal_in_sessions_with_equal_seeds_and_differs_between_behaviors() -> None:
    async def session(id_: str) -> list[float]:
        async with open_pilot(SceneOptions(voice="text")) as pilot:
            pilot.watch()
            pilot.block(
                "b",
                f'<bmlt:noise id="{id_}" type="perlin" joint="vl5" start="0" end="3">'
                '<bmlt:parameter name="baseamplitudex" value="0.3"/></bmlt:noise>',
            )
            await pilot.advance(3)
            return list(angles(pilot, "vl5").values())

    assert await session("n") == await session("n") != await session("m")
