"""The loop of a worker with networks, which answers requests until its input ends.

Its first message describes the networks. A request names a voice, and contains the tokens and the rate of a sentence.
The reply contains the frames of each token or, if the request names frames, the sound of these.
"""

import os
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import Any

from reactive_realizer.engines.speech.neural.network import Predicted, SpeakingNetwork, UnusableNetwork
from reactive_realizer.engines.speech.worker_messages import WorkerMessage, WorkerPipe

_REMEMBERED = 32
"""Sentences whose predictions are kept, of which a minute takes 5 MB."""
_NICENESS = 5
"""Added to the nice value of the worker, because the realizer has frames to show while the worker is busy."""


def run(load: Callable[[], Sequence[SpeakingNetwork]]) -> None:
    """Answers the requests on standard input, in order, on standard output.

    Args:
        load: loads the networks; if one cannot be used, the first message says why, and is the only one.
    """
    pipe = WorkerPipe()
    os.nice(_NICENESS)
    try:
        networks = load()
    except (UnusableNetwork, OSError, ValueError) as problem:
        pipe.send(WorkerMessage({"failed": str(problem)}).encode())
        return
    speaker = _Speaker(networks)
    pipe.send(WorkerMessage({"networks": [dict(network.hello) for network in networks]}).encode())
    for request in pipe.requests():
        pipe.send(speaker.answer(request.header).encode())


class _Speaker:
    """Networks, with their last predictions: requests for the sound of frames of the same sentences follow."""

    def __init__(self, networks: Sequence[SpeakingNetwork]) -> None:
        self._networks = {voice: network for network in networks for voice in network.hello["voices"]}
        self._predict = lru_cache(_REMEMBERED)(self._predicted)

    def answer(self, request: Mapping[str, Any]) -> WorkerMessage:
        """The reply to a request."""
        predicted = self._predict(tuple(request["tokens"]), request["voice"], request["rate"])
        if "frames" not in request:
            return WorkerMessage({"durations": predicted.durations})
        return WorkerMessage({}, self._networks[request["voice"]].speak(predicted, *request["frames"]))

    def _predicted(self, tokens: tuple[int, ...], voice: str, rate: float) -> Predicted:
        return self._networks[voice].predict(tokens, voice, rate)
