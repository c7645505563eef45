"""What a worker with a network does: it answers requests until its input ends.

Its first message tells of the network. A request names a voice, and contains the tokens and the rate of a sentence. The
reply contains the frames of each token or, if the request names frames, the sound of these.
"""

import os
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

from reactive_realizer.engines.speech.neural.network import SpeakingNetwork, UnusableNetwork
from reactive_realizer.engines.speech.worker_messages import WorkerMessage, WorkerPipe

_REMEMBERED = 32
"""Sentences whose predictions are kept, of which a minute takes 5 MB."""
_NICENESS = 5
"""How much the worker yields to the realizer, which has frames to show while it works."""
_WARMING = 20
"""Frames that are spoken for nothing."""


def run(load: Callable[[], SpeakingNetwork]) -> None:
    """Answers the requests on standard input, in order, on standard output.

    Args:
        load: loads the network; if it cannot be used, the first message says why, and is the only one.
    """
    pipe = WorkerPipe()
    os.nice(_NICENESS)
    try:
        network = load()
    except (UnusableNetwork, OSError, ValueError) as problem:
        pipe.send(WorkerMessage({"failed": str(problem)}).encode())
        return
    speaker = _Speaker(network)
    speaker.warm_up()
    pipe.send(WorkerMessage(dict(network.hello)).encode())
    for request in pipe.requests():
        pipe.send(speaker.answer(request.header).encode())


class _Speaker:
    """The network, with the last sentences that it has predicted, of which it will be asked to speak some frames."""

    def __init__(self, network: SpeakingNetwork) -> None:
        self._network = network
        self._predict = lru_cache(_REMEMBERED)(network.predict)

    def answer(self, request: Mapping[str, Any]) -> WorkerMessage:
        """The reply to a request."""
        predicted = self._predict(tuple(request["tokens"]), request["voice"], request["rate"])
        if "frames" not in request:
            return WorkerMessage({"durations": predicted.durations})
        return WorkerMessage({}, self._network.speak(predicted, *request["frames"]))

    def warm_up(self) -> None:
        """Speak something: the first time takes longer."""
        predicted = self._network.predict((self._network.vowel,), self._network.voices[0], 1.0)
        self._network.speak(predicted, 0, min(_WARMING, sum(predicted.durations)))
