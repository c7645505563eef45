"""Finds the sounds of speech without knowing its words: any may follow any other, some more often (pocketsphinx).

Where a text is known, its words say more. In English and other languages, the sounds that are found are those of
American English.
"""

from pathlib import Path

from pocketsphinx import Decoder, get_model_path

_SEQUENCES = "en-us/en-us-phone.lm.bin"
"""How often sounds follow each other, among the models of pocketsphinx."""
_LANGUAGE_WEIGHT = 0.3
"""How much that counts beside what is heard; with 2, fewer sounds are right."""
_BEAMS = {"beam": 1e-20, "pbeam": 1e-20}
"""How unlikely a hypothesis may be, relative to the best; with the defaults, some short sounds are not found."""
_UNSETTLED = 30
"""Frames before the end of what is heard in which a sound may still change."""

Sound = tuple[str, float, float]
"""The name of a phone, and its start and end, s."""


class PhoneLoop:
    """Finds sounds in speech that arrives."""

    def __init__(self) -> None:
        sequences = str(Path(get_model_path()) / _SEQUENCES)
        self._decoder = Decoder(loglevel="FATAL", allphone=sequences, lm=None, dict=None, lw=_LANGUAGE_WEIGHT, **_BEAMS)
        self._decoder.start_utt()
        self._settled = 0

    def hear(self, samples: bytes, *, last: bool) -> list[Sound]:
        """The sounds that are not settled in what was heard before; they replace those from the start of the first.

        Args:
            samples: at 16 kHz.
            last: whether none follow.
        """
        self._decoder.process_raw(samples)
        if last:
            self._decoder.end_utt()
        found = [(each.word, each.start_frame, each.end_frame + 1) for each in self._decoder.seg() or ()]
        new = [each for each in found if each[2] > self._settled]
        if found:
            until = found[-1][2] - _UNSETTLED
            self._settled = max((end for _, _, end in found if end <= until), default=self._settled)
        return [(name, first / 100, end / 100) for name, first, end in new]
