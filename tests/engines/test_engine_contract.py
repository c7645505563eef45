"""Runs the contract for engines on all built-in engines."""

from collections.abc import AsyncIterator
from dataclasses import replace
from pathlib import Path

from reactive_realizer.assembly.assets import PACKAGE_ASSETS
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import Engine
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.animation.animation_engine import AnimationEngine
from reactive_realizer.engines.audio_engine import AudioEngine
from reactive_realizer.engines.block_control import ActivateEngine, InterruptEngine
from reactive_realizer.engines.face.face_engine import FaceEngine
from reactive_realizer.engines.parameter_value_change import ParameterValueChangeEngine
from reactive_realizer.engines.picture.picture_engine import PictureEngine
from reactive_realizer.engines.speech.speech_engine import SpeechEngine
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.engines.wait_engine import WaitEngine
from reactive_realizer.testing.engine_contract import EngineContract
from reactive_realizer.testing.engine_harness import minimal_context

SOUNDS = PACKAGE_ASSETS / "sounds"


class SlowVoice(TextVoice):
    """A voice that synthesizes asynchronously, with audio (silence)."""

    async def synthesize(  # type: ignore[override]  # a voice may be asynchronous
        self, text: str, marks: tuple[tuple[str, int], ...], voice: str | None = None
    ) -> AsyncIterator[Utterance]:
        utterance = super().synthesize(text, marks, voice)
        yield replace(utterance, audio=bytes(2 * round(utterance.duration * 8000)), sample_rate=8000)


class TestAnimation(EngineContract):
    elements = (
        '<gesture id="g" lexeme="BEAT" mode="RIGHT_HAND"/>',
        '<gesture id="g" lexeme="OFFER" mode="BOTH_HANDS" stroke="2"/>',
        '<head id="h" lexeme="NOD" repetition="3" amount="1"/>',
        '<gaze id="z" target="viewer"/>',
    )
    refused = ('<gesture id="g" lexeme="NO_SUCH"/>', '<gaze id="z" target="nobody"/>')

    def engine(self, context: EngineContext) -> Engine:
        return AnimationEngine(context)


class TestFace(EngineContract):
    elements = (
        '<faceLexeme id="f" lexeme="RAISE_MOUTH_CORNERS"/>',
        '<faceLexeme id="f" lexeme="RAISE_BROWS" amount="1" overshoot="0.5"/>',
    )
    refused = ('<faceLexeme id="f" lexeme="SMIRK"/>',)

    def engine(self, context: EngineContext) -> Engine:
        return FaceEngine(context)


class TestPicture(EngineContract):
    elements = (
        '<p:addImage xmlns:p="http://hmi.ewi.utwente.nl/pictureengine" id="i" fileName="face.png" start="1" end="3"/>',
        '<p:setImage xmlns:p="http://hmi.ewi.utwente.nl/pictureengine" id="i" fileName="face.png"/>',
    )
    refused = ('<p:addImage xmlns:p="http://hmi.ewi.utwente.nl/pictureengine" id="i" fileName="face.txt"/>',)

    def engine(self, context: EngineContext) -> Engine:
        bindings = {"picture": (PACKAGE_ASSETS / "picturebinding.xml",)}
        return PictureEngine(replace(context, bindings=bindings, asset=Path))


class TestSpeech(EngineContract):
    elements = (
        '<speech id="s"><text>Hello there.</text></speech>',
        '<speech id="s"><text>Put it <sync id="m"/>here, <sync id="n"/>please.<sync id="o"/></text></speech>',
    )
    refused = ('<speech id="s"><text>...</text></speech>',)
    lacking = frozenset({"rate", "pitch"})

    def engine(self, context: EngineContext) -> Engine:
        return SpeechEngine(context)


class TestSpeechWithAudio(TestSpeech):
    lacking = frozenset()

    def context(self) -> EngineContext:
        return minimal_context(SlowVoice())


class TestAudio(EngineContract):
    elements = ('<bmlt:audiofile id="a" filename="knock.wav"/>',)
    refused = ('<bmlt:audiofile id="a" filename="nowhere.wav"/>', '<bmlt:audiofile id="a" filename="../knock.wav"/>')

    def context(self) -> EngineContext:
        return minimal_context(None, SOUNDS)

    def engine(self, context: EngineContext) -> Engine:
        return AudioEngine(context)


class TestWait(EngineContract):
    elements = (
        '<wait id="w" duration="1.25"/>',
        '<wait id="w" max-wait="2"/>',
        '<wait id="w"/>',
        '<wait id="w" start="0" end="1"/>',
        '<wait id="w" event="go" max-wait="2"/>',
        '<bmla:emit id="e" event="go">content</bmla:emit>',
    )

    def engine(self, context: EngineContext) -> Engine:
        return WaitEngine(context)


class TestActivate(EngineContract):
    elements = ('<bmla:activate id="a" target="c"/>',)

    def engine(self, context: EngineContext) -> Engine:
        return ActivateEngine(context)


class TestInterrupt(EngineContract):
    elements = ('<bmla:interrupt id="i" target="c"/>', '<bmlt:interrupt id="i" target="c" include="g" speech="word"/>')

    def engine(self, context: EngineContext) -> Engine:
        return InterruptEngine(context)


def change(prefix: str, trajectory: str, syncs: str = "") -> str:
    said = f'<{prefix}:trajectory type="{trajectory}" targetValue="80" initialValue="0"/>'
    name = f"{prefix}:parametervaluechange"
    return f'<{name} id="p" target="s" paramId="volume" {syncs}>{said}</{name}>'


class TestParameterValueChange(EngineContract):
    elements = (
        change("bmla", "linear", 'start="0" end="2"'),
        change("bmla", "instant"),
        change("bmlt", "ease-in-ease-out"),
    )
    refused = (change("bmla", "zigzag"),)

    def engine(self, context: EngineContext) -> Engine:
        return ParameterValueChangeEngine(context)
