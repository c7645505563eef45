"""Piper voices in a worker process."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Final
from unicodedata import normalize

from reactive_realizer.engines.speech.neural.neural_voice import NetworkVoice, NeuralVoice
from reactive_realizer.engines.speech.neural.pronunciation import Alphabet
from reactive_realizer.engines.speech.neural.timed_sentence import FrameFormat

PLACE: Final = "REACTIVE_REALIZER_PIPER"
"""The environment variable that names a folder with voices, or the network of one."""
_LAG = 0.045
"""Start of a sound by the durations of a network, minus the time at which it is heard, s: by forced alignment of 42
words of one voice 0.053 (standard deviation 0.028), of which 0.008 are the bias of the aligner."""
_MARGIN = 12
"""Frames on each side that the sound of a frame depends on: with them, a piece equals its part of the sentence."""
_STOP = 0.2
"""Silence between two sentences, s: the networks make a pause of 0.1 s."""
_STOPS = {
    " ": " ",
    ".": ".",
    ",": ",",
    "?": "?",
    "!": "!",
    ":": ":",
    ";": ";",
    "\u2026": ";",
    "\u2013": ";",
    "\u2014": ";",
}
"""Characters between words, and how they are written for the networks, which learned the clauses of espeak-ng."""


class PiperVoice(NeuralVoice):
    """A `TTSBinding` with the Piper voices that the user provides, which are named after their files."""

    module: ClassVar = "reactive_realizer.engines.speech.piper.worker"
    packages: ClassVar = ("onnx", "onnxruntime")
    extra: ClassVar = "piper"

    def network_voices(self, networks: Sequence[Mapping[str, Any]]) -> Mapping[str, NetworkVoice]:
        """All voices; the speakers of a network sound different, but share an alphabet and a language."""
        voices = {}
        for network in networks:
            format_ = FrameFormat(network["rate"], network["frame"], _LAG, _MARGIN)
            voice = NetworkVoice(network["language"], alphabet(network["ids"]), format_, _STOP)
            voices.update(dict.fromkeys(network["voices"], voice))
        return voices


def alphabet(ids: Mapping[str, int]) -> Alphabet:
    """The characters of a network, which was trained with diacritics as separate characters.

    Args:
        ids: the number of each character.
    """
    letters = {each: number for each, number in ids.items() if normalize("NFD", each) == each}
    stops = {each: ids[known] for each, known in _STOPS.items() if known in ids}
    return Alphabet(letters, stops)
