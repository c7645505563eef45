"""Runs benchmarks by name, prints their results, and compares them with the last ones."""

import importlib
import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

ROOT = Path(__file__).parents[2]
MODULES = sorted(path.stem for path in (ROOT / "benchmarks").glob("*.py") if not path.stem.startswith("_"))


@pytest.fixture
def frame(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> ModuleType:
    """The command, with its own history and an instant benchmark."""
    monkeypatch.syspath_prepend(ROOT)
    frame = importlib.import_module("benchmarks.__main__")
    values = iter(range(1, 9))
    quick = SimpleNamespace(AIMS={"a.b": 2}, measure=lambda: {"a": {"b": 2.0 * next(values)}, "c": None})
    monkeypatch.setattr(frame, "HISTORY", tmp_path / "history.jsonl")
    monkeypatch.setattr(frame, "import_module", lambda name: quick)
    monkeypatch.setattr(frame, "machine", lambda: {"cpu": "abacus", "load": 0.5})
    monkeypatch.setattr(frame, "commit", lambda: "1234567")
    return frame


def test_the_json_output_has_the_numbers_the_machine_and_the_commit(
    frame: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    frame.run("quick", None, as_json=True, keep=False)
    said = json.loads(capsys.readouterr().out.splitlines()[-1])
    assert said == {"a": {"b": 2.0}, "c": None, "machine": {"cpu": "abacus", "load": 0.5}, "commit": "1234567"}
    assert not frame.HISTORY.exists()


def test_the_table_shows_aims_and_ratios_to_the_last_result(
    frame: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    frame.run("other", None, as_json=True, keep=True)
    frame.run("quick", None, as_json=True, keep=True)
    frame.run("quick", None, as_json=False, keep=True)
    rows = capsys.readouterr().out.splitlines()[2:]
    assert [row.split() for row in rows] == [
        ["quick,", "commit", "1234567,", "load", "0.5,", "abacus"],
        ["a.b", "6", "aim", "2", "x", "1.50"],
        ["c", "-"],
    ]
    assert [json.loads(line)["a"]["b"] for line in frame.HISTORY.read_text().splitlines()] == [2.0, 4.0, 6.0]


def test_the_error_of_an_unknown_benchmark_lists_the_known_ones() -> None:
    command = [sys.executable, "-m", "benchmarks", "nonsense"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert f"no benchmark nonsense; there are {', '.join(MODULES)}" in done.stderr


def test_the_description_of_the_machine_is_complete(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(ROOT)
    machine = importlib.import_module("benchmarks.__main__").machine()
    assert list(machine) == ["cpu", "cores", "load", "python"]
    assert all(machine[key] for key in ("cpu", "cores", "python"))
