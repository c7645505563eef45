"""The avatars and animations that ship with the realizer."""

from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Skeleton
from reactive_realizer.engines.animation.procedural.procedural_animation import ProceduralAnimation
from reactive_realizer.engines.animation.procedural.procedural_animation_reader import read_procedural_animation

ASSETS = Path(str(files("reactive_realizer"))) / "assets"


@pytest.fixture(scope="session", params=["female", "male"])
def avatar(request: pytest.FixtureRequest) -> Avatar:
    return Avatar.read(ASSETS / "avatars" / f"{request.param}.glb")


@pytest.fixture(scope="session")
def skeleton(avatar: Avatar) -> Skeleton:
    return avatar.skeleton


@pytest.fixture(scope="session")
def animations() -> Path:
    return ASSETS / "procanimation"


@pytest.fixture
def read(tmp_path: Path) -> Callable[..., ProceduralAnimation]:
    """Reads a ProcAnimation with this content and these attributes of duration."""

    def read_text(content: str, durations: str = 'prefDuration="1"') -> ProceduralAnimation:
        path = tmp_path / "some.xml"
        path.write_text(f"<ProcAnimation {durations}>\n{content}\n</ProcAnimation>")
        return read_procedural_animation(path)

    return read_text
