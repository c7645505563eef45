"""Utterances that are made of sounds, and the binding of the default avatar."""

from pathlib import Path

import pytest

from reactive_realizer.assembly.assets import Assets
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.engine.tts import Phoneme, Utterance

ASSETS = Assets()
ARKIT = Avatar.read(ASSETS("avatars/female.glb")).morphs
OCULUS = tuple(
    f"viseme_{name}" for name in ("sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "I", "O", "U")
)


def bound(*files: Path, morphs: tuple[str, ...] = ARKIT) -> VisemeBinding:
    """The binding of an avatar with some morph targets."""
    return VisemeBinding.read(files, morphs, ASSETS)


@pytest.fixture(scope="session")
def binding() -> VisemeBinding:
    return bound()


def said(*sounds: tuple[str, float], pause: float = 0.3) -> Utterance:
    """An utterance of sounds with their durations, s, and a pause at its end."""
    phonemes, time = [], 0.0
    for symbol, duration in [*sounds, ("", pause)]:
        phonemes.append(Phoneme(symbol, time, duration))
        time += duration
    return Utterance("", time, (), {}, tuple(phonemes))
