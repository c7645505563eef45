"""What acceptance tests share: BML goes in, feedback comes out."""

from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

OpenStill = Callable[..., AbstractAsyncContextManager[RealizerPilot]]


@pytest.fixture
async def pilot() -> AsyncIterator[RealizerPilot]:
    """Every plan is verified while it plays: a violation is a warning that the test does not expect."""
    async with open_pilot(SceneOptions(voice="text", verify=True)) as pilot:
        yield pilot


@pytest.fixture(params=["convex", "embr", "smartbody"])
async def any_strategy(request: pytest.FixtureRequest) -> AsyncIterator[RealizerPilot]:
    """As `pilot`, with each strategy in turn."""
    async with open_pilot(SceneOptions(voice="text", strategy=request.param, verify=True)) as pilot:
        yield pilot


@pytest.fixture
def open_still(tmp_path: Path) -> OpenStill:
    """Opens a pilot of Alice without idle animation, and keeps her frames."""

    @asynccontextmanager
    async def opened(
        *assets: Path, avatar: str = "female", scene: str = "", strategy: str = "convex"
    ) -> AsyncIterator[RealizerPilot]:
        human = tmp_path / "still.toml"
        human.write_text(f'[character.alice]\navatar = "avatars/{avatar}.glb"\nidle = false\n{scene}')
        async with open_pilot(SceneOptions(human, "text", assets, strategy=strategy, verify=True)) as pilot:
            pilot.watch()
            yield pilot

    return opened


@pytest.fixture
async def still(open_still: OpenStill) -> AsyncIterator[RealizerPilot]:
    """A pilot of a character without idle animation, in front of a target on the floor."""
    async with open_still(scene="[target.floor]\nposition = [0, 0.2, 0.8]") as pilot:
        yield pilot
