"""The worker of the voice, ``python -m`` of this module: answers requests until its input ends.

Its first message lists the voices. A request names one, and contains the tokens of a sentence; the reply contains its
audio, and the frames of each token.
"""

import os
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from reactive_realizer.engines.speech.kokoro.model import KokoroModel, UnusableWeights, read_styles
from reactive_realizer.engines.speech.worker_messages import WorkerMessage, WorkerPipe

FOLDER = "REACTIVE_REALIZER_KOKORO"
"""The environment variable that names a folder with weights or styles of the user."""


def main() -> None:
    """Answers the requests on standard input, in order, on standard output."""
    pipe = WorkerPipe()
    own = Path(os.environ[FOLDER]) if FOLDER in os.environ else None
    try:
        styles = read_styles([Path(str(files("reactive_realizer") / "assets/voices/kokoro")), *([own] if own else [])])
        model = KokoroModel(own)
    except (UnusableWeights, OSError, ValueError) as problem:
        pipe.send(WorkerMessage({"failed": str(problem)}).encode())
        return
    pipe.send(WorkerMessage({"voices": sorted(styles)}).encode())
    for request in pipe.requests():
        pipe.send(_answer(model, styles, request.header).encode())


def _answer(model: KokoroModel, styles: dict[str, npt.NDArray[np.float32]], request: dict[str, Any]) -> WorkerMessage:
    audio, durations = model.run(request["tokens"], styles[request["voice"]])
    return WorkerMessage({"durations": durations}, audio)


if __name__ == "__main__":
    main()
