"""The worker of the voice, ``python -m`` of this module: answers requests until its input ends.

Its first message lists the voices. A request names one, and contains the tokens and the rate of a sentence. The reply
contains the frames of each token or, if the request names frames, the sound of these.
"""

import os
from collections.abc import Mapping
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from reactive_realizer.engines.speech.kokoro.model import (
    KokoroModel,
    Predicted,
    Style,
    UnusableWeights,
    read_styles,
)
from reactive_realizer.engines.speech.worker_messages import WorkerMessage, WorkerPipe

FOLDER = "REACTIVE_REALIZER_KOKORO"
"""The environment variable that names a folder with weights or styles of the user."""
_REMEMBERED = 32
"""Sentences whose predictions are kept, of which a minute takes 5 MB."""
_NICENESS = 5
"""How much the worker yields to the realizer, which has frames to show while it works."""
_A, _WARMING = 43, 20
"""A token, and the number of its frames that are spoken for nothing."""


def main() -> None:
    """Answers the requests on standard input, in order, on standard output."""
    pipe = WorkerPipe()
    os.nice(_NICENESS)
    own = Path(os.environ[FOLDER]) if FOLDER in os.environ else None
    try:
        styles = read_styles([Path(str(files("reactive_realizer") / "assets/voices/kokoro")), *([own] if own else [])])
        model = KokoroModel(own)
    except (UnusableWeights, OSError, ValueError) as problem:
        pipe.send(WorkerMessage({"failed": str(problem)}).encode())
        return
    speaker = _Speaker(model, styles)
    speaker.warm_up()
    pipe.send(WorkerMessage({"voices": sorted(styles)}).encode())
    for request in pipe.requests():
        pipe.send(speaker.answer(request.header).encode())


class _Speaker:
    """The network, with the last sentences that it has predicted, of which it will be asked to speak some frames."""

    def __init__(self, model: KokoroModel, styles: Mapping[str, Style]) -> None:
        self._model = model
        self._styles = styles
        self._predict = lru_cache(_REMEMBERED)(self._predicted)

    def answer(self, request: Mapping[str, Any]) -> WorkerMessage:
        """The reply to a request."""
        predicted = self._predict(tuple(request["tokens"]), request["voice"], request["rate"])
        if "frames" not in request:
            return WorkerMessage({"durations": predicted.durations})
        return WorkerMessage({}, self._model.speak(predicted, *request["frames"]))

    def warm_up(self) -> None:
        """Speak something: the first time takes longer."""
        predicted = self._predict((_A,), min(self._styles), 1.0)
        self._model.speak(predicted, 0, min(_WARMING, sum(predicted.durations)))

    def _predicted(self, tokens: tuple[int, ...], voice: str, rate: float) -> Predicted:
        return self._model.predict(tokens, self._styles[voice], rate)


if __name__ == "__main__":
    main()
