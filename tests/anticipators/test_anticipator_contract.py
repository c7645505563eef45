"""All anticipators under the contract that plug-ins are tested by."""

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
from reactive_realizer.testing.anticipator_stand import Told


class TestMetronome(AnticipatorContract):
    points = ("tick0", "tick1", "tick2", "tick3", "tick10", "tick100")
    events = (Told("tempo", 60), Told("tempo", 90.5), Told("tempo", 400), Told("tempo", 10), Told("start"))
    refused = (Told("tempo", 9.9), Told("tempo", 401), Told("tempo", -60), Told("tempo", nan), Told("tempo"))

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return Metronome(id, board)


class TestSpacebar(AnticipatorContract):
    points = ("press", "release")
    events = (Told("press"), Told("release"))
    refused = (Told("press", text="Enter"),)

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return Spacebar(id, board)


class TestSpeechStop(AnticipatorContract):
    points = ("stop",)
    events = (
        Told("voice", 1.0),
        Told("voice", 0.0),
        Told("voice", 0.4),
        Told("words", text="I live in a"),
        Told("words", text="I live in a house."),
        Told("words", text=""),
    )
    refused = (
        Told("voice", 1.1),
        Told("voice", -0.1),
        Told("voice", nan),
        Told("voice", inf),
        Told("voice"),
        Told("voice", text="I live"),
        Told("words"),
        Told("words", 1.0),
    )

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return SpeechStop(id, board)


class TestExercise(AnticipatorContract):
    points = ("1", "2", "3", "4", "9", "down", "up")
    events = (Told("sample", 9.81), Told("sample", 9.81), Told("sample", 20.0), Told("sample", 12.0), Told("start"))
    refused = (Told("sample"), Told("sample", -1.0), Told("sample", nan), Told("sample", inf), Told("sample", 1e7))

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return Exercise(id, board, ("down", "up"))


class TestConducting(AnticipatorContract):
    points = ("beat1", "beat2", "beat3", "beat4", "beat9")
    events = (*[Told("beat")] * 5, Told("start"))

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return Conducting(id, board)


class ToldByEvents(Anticipator):
    """Takes what others predict as events, which are what the contract tells."""

    events = ("hit",)

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        if name == "hit":
            self.predict(name, None if value is None else GlobalTime(value), now)


class TestRemote(AnticipatorContract):
    points = ("hit",)
    events = (Told("hit", -1.0), Told("hit", 0.5), Told("hit", 2.0), Told("hit", 7.0), Told("hit"))

    def anticipator(self, id: str, board: PegBoard) -> Anticipator:  # noqa: A002
        return ToldByEvents(id, board)
