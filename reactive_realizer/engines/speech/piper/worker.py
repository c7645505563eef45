"""The worker of the voices, ``python -m`` of this module."""

import os
from pathlib import Path

from reactive_realizer.engines.speech.neural.network import UnusableNetwork
from reactive_realizer.engines.speech.neural.network_worker import run
from reactive_realizer.engines.speech.piper.model import PiperModel
from reactive_realizer.engines.speech.piper.voice import PLACE
from reactive_realizer.engines.speech.piper.voice_file import voice_files


def _load() -> list[PiperModel]:
    if not os.environ.get(PLACE):
        raise UnusableNetwork(f"set {PLACE} to a folder with Piper voices, each NAME.onnx and NAME.onnx.json")
    return [PiperModel(file) for file in voice_files(Path(os.environ[PLACE]))]


if __name__ == "__main__":
    run(_load)
