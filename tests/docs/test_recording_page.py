"""docs/cli.md: the recording that it shows is valid and can be replayed."""

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.__main__ import main

from .conftest import fences, page


def test_the_recording_on_the_page_is_replayed_with_the_feedback_on_the_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (session,) = fences("docs/cli.md", "jsonl")
    Path("session.jsonl").write_text(session.text, "utf-8")
    (command,) = re.findall(r"^    reactive-realizer (realize --replay .*)$", page("docs/cli.md"), re.MULTILINE)
    assert main(shlex.split(command)) == 0
    told = [json.loads(line) for line in Path("again.jsonl").read_text("utf-8").splitlines()]
    assert {line["time"] for line in told} == {0.03, 0.13}
    assert 'id="b:end"' in told[-1]["xml"]
    assert np.load("again.npz")["time"] == pytest.approx(np.arange(0.0, 0.15, 0.02))
