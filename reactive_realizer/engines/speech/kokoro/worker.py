"""The worker of the voice, ``python -m`` of this module."""

import os
from importlib.resources import files
from pathlib import Path

from reactive_realizer.engines.speech.kokoro.model import KokoroModel, read_styles
from reactive_realizer.engines.speech.neural.network_worker import run

FOLDER = "REACTIVE_REALIZER_KOKORO"
"""The environment variable that names a folder with weights or styles of the user."""


def _load() -> list[KokoroModel]:
    own = Path(os.environ[FOLDER]) if FOLDER in os.environ else None
    packaged = Path(str(files("reactive_realizer") / "assets/voices/kokoro"))
    return [KokoroModel(own, read_styles([packaged, *([own] if own else [])]))]


if __name__ == "__main__":
    run(_load)
