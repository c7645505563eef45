"""The avatars and animations that ship with the realizer."""

from importlib.resources import files
from pathlib import Path

import pytest

from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.skeleton import Skeleton

ASSETS = Path(str(files("reactive_realizer"))) / "assets"


@pytest.fixture(scope="session", params=["female", "male"])
def avatar(request) -> Avatar:
    return Avatar.read(ASSETS / "avatars" / f"{request.param}.glb")


@pytest.fixture(scope="session")
def skeleton(avatar) -> Skeleton:
    return avatar.skeleton


@pytest.fixture(scope="session")
def animations() -> Path:
    return ASSETS / "procanimation"
