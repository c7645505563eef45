"""The frames of `realize`, and the repeatability of frames and feedback."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from reactive_realizer.__main__ import main

from .conftest import HELLO


def frames_of(bml: Callable[..., str], tmp_path: Path, *options: str) -> Any:
    file = tmp_path / "frames.npz"
    assert main(["realize", bml(HELLO), "--voice", "text", "--frames", str(file), *options]) == 0
    return np.load(file)


def test_frames_have_the_documented_names_shapes_and_times(bml: Callable[..., str], tmp_path: Path) -> None:
    frames = frames_of(bml, tmp_path)
    assert set(frames) == {"time", "joints", "parents", "offsets", "rotations", "root", "morphs", "weights"}
    count, joints, morphs = len(frames["time"]), len(frames["joints"]), len(frames["morphs"])
    assert frames["parents"].shape == (joints,)
    assert np.issubdtype(frames["parents"].dtype, np.integer)
    assert frames["offsets"].shape == (joints, 3)
    assert frames["rotations"].shape == (count, joints, 4)
    assert frames["root"].shape == (count, 3)
    assert frames["weights"].shape == (count, morphs)
    assert np.allclose(frames["time"], np.arange(count) * 0.02, atol=1e-12)
    assert frames["time"][-1] > 1.5
    assert np.allclose(np.linalg.norm(frames["rotations"], axis=-1), 1)
    assert ((frames["weights"] >= 0) & (frames["weights"] <= 1)).all()
    assert {"r_wrist", "skullbase"} <= set(frames["joints"])


def test_names_have_the_character_as_a_prefix_if_there_are_two(
    bml: Callable[..., str], tmp_path: Path, tests_data: Path
) -> None:
    frames = frames_of(bml, tmp_path, "--human", str(tests_data / "humans" / "two.toml"))
    assert {name.partition("/")[0] for name in frames} == {"alice", "bob"}
    assert np.array_equal(frames["alice/time"], frames["bob/time"])


# --- the same every time


def session(bml: Callable[..., str], tmp_path: Path, name: str, seed: str, *voice: str) -> tuple[Any, dict[Any, Any]]:
    feedback, frames = tmp_path / f"{name}.jsonl", tmp_path / f"{name}.npz"
    command = [sys.executable, "-m", "reactive_realizer", "realize", bml(HELLO), *voice]
    command += ["--feedback", str(feedback), "--frames", str(frames)]
    subprocess.run(command, check=True, env={**os.environ, "PYTHONHASHSEED": seed}, timeout=50)
    arrays = np.load(frames)
    return feedback.read_bytes(), {key: arrays[key].tobytes() for key in arrays}


@pytest.mark.parametrize("voice", ["text", pytest.param("espeak", marks=pytest.mark.speech)])
def test_the_same_input_gives_the_same_bytes_with_any_hash_seed(
    bml: Callable[..., str], tmp_path: Path, voice: str
) -> None:
    one = session(bml, tmp_path, "one", "0", "--voice", voice)
    assert session(bml, tmp_path, "two", "1", "--voice", voice) == one
    assert len(one[0].splitlines()) > 10
