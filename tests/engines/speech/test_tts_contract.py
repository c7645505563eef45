"""Runs the contract for voices on the light built-in voices."""

import pytest

from reactive_realizer.engine.tts import TTSBinding
from reactive_realizer.engines.speech.caption_voice import CaptionVoice
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.testing.tts_contract import TTSContract


class TestTextVoice(TTSContract):
    def tts(self) -> TTSBinding:
        return TextVoice()


class TestCaptionVoice(TTSContract):
    def tts(self) -> TTSBinding:
        return CaptionVoice()


@pytest.mark.speech
class TestEspeakVoice(TTSContract):
    def tts(self) -> TTSBinding:
        return EspeakVoice()
