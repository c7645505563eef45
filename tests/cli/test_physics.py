"""The command `physics`."""

from collections.abc import Callable
from pathlib import Path

import mujoco
import pytest

from reactive_realizer.__main__ import main

HUMAN = """
[character.alice]
[character.bert]
avatar = "avatars/male.glb"
weight = 95
"""


@pytest.fixture
def human(bml: Callable[..., str]) -> str:
    return bml(HUMAN, "human.toml")


def mass(path: Path) -> float:
    return float(mujoco.MjModel.from_xml_path(str(path)).body_subtreemass[1])


def test_it_writes_the_model_of_the_first_character(tmp_path: Path, human: str) -> None:
    assert main(["physics", str(tmp_path / "a.xml"), "--human", human]) == 0
    assert mass(tmp_path / "a.xml") == pytest.approx(63.7, abs=0.1)


def test_it_writes_the_model_of_a_character_with_its_weight(tmp_path: Path, human: str) -> None:
    assert main(["physics", str(tmp_path / "b.xml"), "--human", human, "--character", "bert"]) == 0
    assert mass(tmp_path / "b.xml") == pytest.approx(95.0, rel=1e-5)


def test_a_character_that_is_not_in_the_file_is_named(
    tmp_path: Path, human: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["physics", str(tmp_path / "c.xml"), "--human", human, "--character", "bart"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line == "human.toml has no character 'bart'; available: alice, bert; did you mean 'bert'?"


@pytest.mark.parametrize("weight", ["0", "-3", "1e9", '"heavy"', "true"])
def test_an_impossible_weight_is_refused(
    tmp_path: Path, bml: Callable[..., str], weight: str, capsys: pytest.CaptureFixture[str]
) -> None:
    human = bml(f"[character.alice]\nweight = {weight}\n", "human.toml")
    assert main(["physics", str(tmp_path / "d.xml"), "--human", human]) == 2
    assert "human.toml: character.alice.weight: " in capsys.readouterr().err
    assert not (tmp_path / "d.xml").exists()


@pytest.mark.parametrize("steps", ["1", "21", "2.5", '"many"'])
def test_steps_of_a_simulation_that_are_too_few_or_too_many_are_refused(
    tmp_path: Path, bml: Callable[..., str], steps: str, capsys: pytest.CaptureFixture[str]
) -> None:
    human = bml(f"[character.alice]\nsimulation_steps = {steps}\n", "human.toml")
    assert main(["physics", str(tmp_path / "e.xml"), "--human", human]) == 2
    assert "human.toml: character.alice.simulation_steps: " in capsys.readouterr().err
