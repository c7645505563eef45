"""Writes the output of a session: feedback as JSON lines, warnings, explanations as JSON, frames as an npz file."""

import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import IO

import numpy as np

from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.feedback.feedback_manager import Report
from reactive_realizer.feedback.messages import WarningFeedback
from reactive_realizer.realizer.character import Character
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.scheduler.bml_block import BMLBlock


class FeedbackWriter:
    """Writes each message as a line of JSON."""

    def __init__(self, stream: IO[str]) -> None:
        self._stream = stream

    def __call__(self, report: Report) -> None:
        """Write a report."""
        line = {"time": round(report.time, 6), "xml": report.xml}
        try:
            self._stream.write(json.dumps(line, ensure_ascii=False) + "\n")
            self._stream.flush()
        except BrokenPipeError:
            # The reader has closed the pipe, as `head` does. The session continues without this output.
            os.dup2(os.open(os.devnull, os.O_WRONLY), self._stream.fileno())


def print_warning(report: Report) -> None:
    """Print a report to stderr if it is a warning."""
    if isinstance(report.message, WarningFeedback):
        print(f"{report.message.id}: {report.message.text}", file=sys.stderr)


class Explainer:
    """Collects the explanations of the times of all sync points."""

    def __init__(self, realizer: Realizer) -> None:
        self._scheduler = realizer.scheduler
        self._blocks: list[dict[str, object]] = []
        self._scheduler.listen(self._keep)

    def write(self, path: Path) -> None:
        """Write one JSON array: the blocks that ended, in order of ending, then the live ones."""
        for block in self._scheduler.blocks.alive:
            self._keep(block)
        path.write_text(json.dumps(self._blocks, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")

    def _keep(self, block: BMLBlock) -> None:
        self._blocks.append(self._scheduler.explain(block.key.character, block.key.block))


class FrameRecorder:
    """Collects the frames of all characters and writes them in the format of docs/cli.md, frames."""

    def __init__(self) -> None:
        self._frames: dict[str, list[Frame]] = {}

    def __call__(self, frames: Mapping[str, Frame]) -> None:
        """Keep the frames of a tick."""
        for id_, frame in frames.items():
            self._frames.setdefault(id_, []).append(frame)

    def write(self, path: Path, realizer: Realizer) -> None:
        """Write one npz file; with several characters, every name has the prefix ``ID/``."""
        arrays: dict[str, object] = {}
        for id_, character in realizer.characters.items():
            prefix = f"{id_}/" if len(realizer.characters) > 1 else ""
            arrays |= {prefix + name: array for name, array in self._arrays(character).items()}
        with path.open("wb") as file:
            np.savez(file, **arrays)  # type: ignore[arg-type]

    def _arrays(self, character: Character) -> dict[str, object]:
        frames = self._frames.get(character.id, [])
        avatar = character.humanoid.avatar
        skeleton = avatar.skeleton
        return {
            "time": np.array([frame.time for frame in frames]),
            "joints": np.array(skeleton.joints),
            "parents": np.array(skeleton.parents),
            "offsets": np.array(skeleton.offsets),
            "rotations": np.array([f.rotations for f in frames]).reshape(-1, len(skeleton.joints), 4),
            "root": np.array([frame.root for frame in frames]).reshape(-1, 3),
            "morphs": np.array(avatar.morphs),
            "weights": np.array([frame.weights for frame in frames]).reshape(-1, len(avatar.morphs)),
        }
