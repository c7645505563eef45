"""Installs plug-ins for a test, as pip would."""

import shutil
import tomllib
from pathlib import Path

import pytest


def install(plugin: Path, site: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Put a plug-in on the path for a test: in ``site`` its modules and the metadata that name its entry points."""
    settings = tomllib.loads((plugin / "pyproject.toml").read_text(encoding="utf-8"))
    project = settings["project"]
    name, version = project["name"], project["version"]
    metadata = site / f"{name.replace('-', '_')}-{version}.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n", encoding="utf-8")
    groups = project["entry-points"].items()
    lines = [line for group, own in groups for line in (f"[{group}]", *(f"{id_} = {of}" for id_, of in own.items()))]
    (metadata / "entry_points.txt").write_text("\n".join(lines), encoding="utf-8")
    for module in settings["tool"]["setuptools"]["py-modules"]:
        shutil.copy(plugin / f"{module}.py", site)
    monkeypatch.syspath_prepend(str(site))
