"""The viseme binding of an avatar (thesis 8.10, VisemeBinding): its mouth shape for each sound.

The format is documented in docs/lipsync.md; assets/visemes contains the bindings for ARKit's blend shapes, the
visemes of Oculus and the vowels of VRM.
"""

import re
from collections import ChainMap
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Self

from reactive_realizer.binding.mouth_shapes import SILENCE, VISEMES, Articulator, MouthShape
from reactive_realizer.binding.viseme_file import MouthTables, read_binding_file
from reactive_realizer.embodiment.face_map import FaceMap

_ARKIT, _PHONEMES = "visemes/arkit.toml", "visemes/phonemes.toml"
_RECOGNIZED = {
    _ARKIT: {"jawOpen", "mouthPucker"},
    "visemes/oculus.toml": {"viseme_aa", "viseme_U"},
    "visemes/vrm.toml": {"aa", "ou"},
}
"""The package's files, in order of precedence, and the weights by which it is recognized that an avatar has a set."""


@dataclass(frozen=True)
class VisemeBinding:
    """The mouth shapes of an avatar.

    Attributes:
        phonemes: viseme of each letter or pair of letters of the International Phonetic Alphabet.
        shapes: the mouth shape of each viseme.
        articulators: the parts of the mouth by name.
    """

    phonemes: Mapping[str, str]
    shapes: Mapping[str, MouthShape]
    articulators: Mapping[str, Articulator]

    @classmethod
    def of(
        cls,
        face: FaceMap,
        files: Sequence[Path],
        asset: Callable[[str], Path],
        first: MouthTables | None = None,
    ) -> Self:
        """The binding of a face; otherwise as `read`."""
        return cls.read(files, face.own, asset, face.joints, tuple(face.stand_ins), first)

    @classmethod
    def read(
        cls,
        files: Sequence[Path],
        morphs: Collection[str],
        asset: Callable[[str], Path],
        joints: Collection[str] = (),
        stand_ins: Collection[str] = (),
        first: MouthTables | None = None,
    ) -> Self:
        """Reads the binding of an avatar.

        Entries of earlier files take precedence. The last files are those in assets/visemes: for the face of
        the avatar, and for phonemes. What they say of morph targets that the avatar does not have is left out. A file
        with articulators describes all visemes: of the files after it, only the phonemes count.

        Args:
            files: of the character and of the avatar, in order of precedence.
            morphs: names of the weights of the avatar's face (`FaceMap.own`).
            asset: finds an asset by name.
            joints: of its skeleton.
            stand_ins: names of weights that it shows by others (`FaceMap.stand_ins`).
            first: what takes precedence over all files; None for nothing.

        Raises:
            RealizerError: "bad-visemes": a file cannot be used, or names something that the avatar does not have.
            OSError: a file cannot be read.
        """
        standard = standard_binding(morphs)
        shown = (*morphs, *stand_ins)
        read = [] if first is None else [first]
        read += [read_binding_file(file, shown, joints) for file in files]
        read += [read_binding_file(asset(name), shown, joints, shared=True) for name in (standard, _PHONEMES)]
        complete = next(rank for rank, file in enumerate(read) if file.articulators)
        articulators = read[complete].articulators
        shapes = dict.fromkeys(VISEMES, MouthShape())
        for file in reversed(read[: complete + 1]):
            file.check(articulators)
            shapes |= file.shapes
        phonemes = dict(ChainMap(*(dict(file.phonemes) for file in read)))
        return cls(phonemes, shapes, articulators)

    def visemes(self, symbol: str) -> tuple[str, ...]:
        """The visemes of a phoneme, in order: two for a diphthong, silence for a pause, none for an unknown sound.

        The symbol is read from left to right, pairs of letters first. Letters that are not bound (stress, length and
        other diacritics) have none.
        """
        if not symbol:
            return (SILENCE,)
        return tuple(self.phonemes[letters] for letters in self._letters.findall(symbol))

    @cached_property
    def _letters(self) -> re.Pattern[str]:
        longest_first = sorted(self.phonemes, key=len, reverse=True)
        return re.compile("|".join(map(re.escape, longest_first)) or r"(?!)")


def standard_binding(morphs: Collection[str]) -> str:
    """The package's file for a face with weights of some names (`FaceMap.own`)."""
    return next((file for file, needed in _RECOGNIZED.items() if needed.issubset(morphs)), _ARKIT)
