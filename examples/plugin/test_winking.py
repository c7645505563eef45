"""The plug-ins satisfy their contracts."""

from beep_voice import BeepVoice
from earliest import Earliest
from wink_engine import WinkEngine

from reactive_realizer.engine.context import EngineContext
from reactive_realizer.testing.engine_contract import EngineContract
from reactive_realizer.testing.strategy_contract import StrategyContract
from reactive_realizer.testing.tts_contract import TTSContract


class TestWinkEngine(EngineContract):
    elements = (
        '<wink xmlns="urn:example:wink" id="w" eye="right"/>',
        '<wink xmlns="urn:example:wink" id="w" start="1" end="2"/>',
    )
    refused = ('<wink xmlns="urn:example:wink" id="w" eye="third"/>',)

    def engine(self, context: EngineContext) -> WinkEngine:
        return WinkEngine(context)


class TestBeepVoice(TTSContract):
    def tts(self) -> BeepVoice:
        return BeepVoice()


class TestEarliest(StrategyContract):
    strategy = Earliest()
