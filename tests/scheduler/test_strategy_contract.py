"""All strategies under the contract that plug-ins are tested by."""

from reactive_realizer.scheduler.smartbody_strategy import SmartBodyStrategy
from reactive_realizer.testing.strategy_contract import StrategyContract


class TestSmartBody(StrategyContract):
    strategy = SmartBodyStrategy()
