"""Runs the contract for anticipators on all built-in anticipators."""

from math import inf, nan

from anticipators.conducting import Conducting
from anticipators.exercise import Exercise
from anticipators.metronome import Metronome
from anticipators.spacebar import Spacebar
from anticipators.speech_stop import SpeechStop
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.testing.anticipator_contract import AnticipatorContract
from reactive_realizer.testing.anticipator_harness import AnticipatorEvent


class TestMetronome(AnticipatorContract):
    points = ("tick0", "tick1", "tick2", "tick3", "tick10", "tick100")
    events = (
        AnticipatorEvent("tempo", 60),
        AnticipatorEvent("tempo", 90.5),
        AnticipatorEvent("tempo", 400),
        AnticipatorEvent("tempo", 10),
        AnticipatorEvent("start"),
    )
    refused = (
        AnticipatorEvent("tempo", 9.9),
        AnticipatorEvent("tempo", 401),
        AnticipatorEvent("tempo", -60),
        AnticipatorEvent("tempo", nan),
        AnticipatorEvent("tempo"),
    )

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return Metronome(id, board)


class TestSpacebar(AnticipatorContract):
    points = ("press", "release")
    events = (AnticipatorEvent("press"), AnticipatorEvent("release"))
    refused = (AnticipatorEvent("press", text="Enter"),)

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return Spacebar(id, board)


class TestSpeechStop(AnticipatorContract):
    points = ("stop",)
    events = (
        AnticipatorEvent("voice", 1.0),
        AnticipatorEvent("voice", 0.0),
        AnticipatorEvent("voice", 0.4),
        AnticipatorEvent("words", text="I live in a"),
        AnticipatorEvent("words", text="I live in a house."),
        AnticipatorEvent("words", text=""),
    )
    refused = (
        AnticipatorEvent("voice", 1.1),
        AnticipatorEvent("voice", -0.1),
        AnticipatorEvent("voice", nan),
        AnticipatorEvent("voice", inf),
        AnticipatorEvent("voice"),
        AnticipatorEvent("voice", text="I live"),
        AnticipatorEvent("words"),
        AnticipatorEvent("words", 1.0),
    )

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return SpeechStop(id, board)


class TestExercise(AnticipatorContract):
    points = ("1", "2", "3", "4", "9", "down", "up")
    events = (
        AnticipatorEvent("sample", 9.81),
        AnticipatorEvent("sample", 9.81),
        AnticipatorEvent("sample", 20.0),
        AnticipatorEvent("sample", 12.0),
        AnticipatorEvent("start"),
    )
    refused = (
        AnticipatorEvent("sample"),
        AnticipatorEvent("sample", -1.0),
        AnticipatorEvent("sample", nan),
        AnticipatorEvent("sample", inf),
        AnticipatorEvent("sample", 1e7),
    )

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return Exercise(id, board, ("down", "up"))


class TestConducting(AnticipatorContract):
    points = ("beat1", "beat2", "beat3", "beat4", "beat9")
    events = (*[AnticipatorEvent("beat")] * 5, AnticipatorEvent("start"))

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return Conducting(id, board)


class ToldByEvents(Anticipator):
    """Takes predictions as events, because the contract sends events."""

    events = ("hit",)

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        if name == "hit":
            self.predict(name, None if value is None else GlobalTime(value), now)


class TestRemote(AnticipatorContract):
    points = ("hit",)
    events = (
        AnticipatorEvent("hit", -1.0),
        AnticipatorEvent("hit", 0.5),
        AnticipatorEvent("hit", 2.0),
        AnticipatorEvent("hit", 7.0),
        AnticipatorEvent("hit"),
    )

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return ToldByEvents(id, board)
