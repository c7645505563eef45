"""The skeletons of the package's avatars."""

from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.body import Skeleton


@pytest.fixture(scope="session", params=["female", "male"])
def skeleton(request: pytest.FixtureRequest) -> Skeleton:
    return Avatar.read(Path(str(files("reactive_realizer"))) / f"assets/avatars/{request.param}.glb").skeleton
