"""Plug-ins that are broken: what needs one says which it is, from which distribution, and why."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.errors import RealizerError

OWN = "own_plugin"


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ("nowhere:THING", "ModuleNotFoundError: No module named 'nowhere'"),
        (f"{OWN}:NUMBER", "it is of the type int, not {kind}"),
    ],
)
@pytest.mark.parametrize(
    ("group", "kind", "options", "scene"),
    [
        ("tts", "Callable", {"voice": "own"}, ""),
        ("strategies", "Callable", {"strategy": "own"}, ""),
        ("engines", "Callable", {}, "engines = ['own']"),
        ("anticipators", "Callable", {}, "[anticipator.a]\nkind = 'own'"),
        ("dialects", "Dialect", {}, ""),
        ("functions", "Callable", {}, ""),
        ("motions", "Callable", {}, ""),
        ("trajectories", "Callable", {}, ""),
    ],
)
async def test_a_scene_with_a_broken_plug_in_says_which_it_is(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    group: str,
    kind: str,
    options: dict[str, str],
    scene: str,
    value: str,
    reason: str,
) -> None:
    about = tmp_path / "acme-1.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: acme\nVersion: 1\n")
    (about / "entry_points.txt").write_text(f"[reactive_realizer.{group}]\nown = {value}\n")
    (tmp_path / f"{OWN}.py").write_text("NUMBER = 5\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    human = tmp_path / "human.toml"
    human.write_text(f"[character.alice]\n{scene}\n")
    with pytest.raises(RealizerError) as raised:
        async with open_scene(SceneOptions(human, **{"voice": "text", **options})):  # type: ignore[arg-type]
            pass
    expected = f"'own' in the plug-in group {group} cannot be used: acme ({value}): {reason.format(kind=kind)}"
    assert str(raised.value) == expected
