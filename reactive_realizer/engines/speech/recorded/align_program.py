"""The program that aligns a recorded speech with its text, run as a process of its own.

It reads a line of JSON, the words of the text, and then samples: mono, 16 kHz, int16 in the order of the machine. It
prints a line of JSON: for each word, its phones as (name, first frame, number of frames).
"""

import json
import sys
from collections.abc import Sequence

from pocketsphinx import Decoder

from reactive_realizer.engines.speech.recorded.phones import spelled

Phone = tuple[str, int, int]

_BEAMS = {"beam": 1e-100, "pbeam": 1e-100, "wbeam": 1e-80}
"""How unlikely a hypothesis may be, relative to the best. With the defaults, one of twenty sentences was not found."""


def align(words: Sequence[str], samples: bytes) -> list[list[Phone]]:
    """The phones of each word.

    Raises:
        ValueError, RuntimeError: the words do not fit the sound.
    """
    return align_with(new_decoder(words), words, samples)


def new_decoder(words: Sequence[str]) -> Decoder:
    """A decoder that knows some words."""
    decoder = Decoder(loglevel="FATAL", bestpath=False, **_BEAMS)
    for word in words:
        if decoder.lookup_word(word) is None:
            decoder.add_word(word, _pronunciation(word, decoder), True)
    return decoder


def align_with(decoder: Decoder, words: Sequence[str], samples: bytes) -> list[list[Phone]]:
    """As `align`, with a decoder that knows the words."""
    decoder.set_align_text(" ".join(words))
    _decode(decoder, samples)
    decoder.set_alignment()
    _decode(decoder, samples)
    alignment = decoder.get_alignment()  # its words are in its memory
    spoken = [
        [(phone.name, phone.start, phone.duration) for phone in word]
        for word in alignment
        if word.name[0] not in "<["  # silence and noise
    ]
    if len(spoken) != len(words):
        raise ValueError("not all words were found")
    return spoken


def _pronunciation(word: str, decoder: Decoder) -> str:
    """The phones of a word that is not in the dictionary: those of its parts that are, and of the letters of others."""
    parts = (decoder.lookup_word(part) or " ".join(spelled(part)) for part in word.split("-") if part)
    return " ".join(parts)


def _decode(decoder: Decoder, samples: bytes) -> None:
    decoder.start_utt()
    decoder.process_raw(samples, full_utt=True)
    decoder.end_utt()


if __name__ == "__main__":
    text = json.loads(sys.stdin.buffer.readline())
    sys.stdout.write(json.dumps(align(text, sys.stdin.buffer.read())))
