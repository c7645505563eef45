"""Runs the contract for anticipators on all built-in anticipators."""

from math import inf, nan

from anticipators.backchannel import Backchannel
from anticipators.conducting import Conducting
from anticipators.exercise import Exercise
from anticipators.metronome import Metronome
from anticipators.spacebar import Spacebar
from anticipators.speech_stop import SpeechStop
from anticipators.tap import Tap
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, AnticipatorEvent, Remote
from reactive_realizer.testing.anticipator_contract import AnticipatorContract


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

    def anticipator(self, context: AnticipatorContext) -> Anticipator:
        return Metronome(context)


class TestSpacebar(AnticipatorContract):
    points = ("press", "release")
    events = (AnticipatorEvent("press"), AnticipatorEvent("release"))
    refused = (AnticipatorEvent("press", text="Enter"),)

    def anticipator(self, context: AnticipatorContext) -> Anticipator:
        return Spacebar(context)


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

    def anticipator(self, context: AnticipatorContext) -> Anticipator:
        return SpeechStop(context)


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

    def anticipator(self, context: AnticipatorContext) -> Anticipator:
        return Exercise(context, ("down", "up"))


class TestConducting(AnticipatorContract):
    points = ("beat1", "beat2", "beat3", "beat4", "beat9")
    events = (*[AnticipatorEvent("beat")] * 5, AnticipatorEvent("start"))

    def anticipator(self, context: AnticipatorContext) -> Anticipator:
        return Conducting(context)


class TestTap(AnticipatorContract):
    points = ("beat", "offbeat")
    events = (*[AnticipatorEvent("tap")] * 5, AnticipatorEvent("start"))

    def anticipator(self, context: AnticipatorContext) -> Anticipator:
        return Tap(context)


class TestBackchannel(AnticipatorContract):
    points = ("backchannel",)
    events = (
        AnticipatorEvent("pitch", 200.0),
        AnticipatorEvent("pitch", 220.0),
        AnticipatorEvent("pitch", 90.0),
        AnticipatorEvent("pitch", 80.0),
        AnticipatorEvent("pitch", 0.0),
        AnticipatorEvent("start"),
    )
    refused = (
        AnticipatorEvent("pitch"),
        AnticipatorEvent("pitch", -1.0),
        AnticipatorEvent("pitch", 1001.0),
        AnticipatorEvent("pitch", nan),
    )

    def anticipator(self, context: AnticipatorContext) -> Anticipator:
        return Backchannel(context)


class TestRemote(AnticipatorContract):
    points = ("hit",)
    events = (
        AnticipatorEvent("hit", -1.0),
        AnticipatorEvent("hit", 0.5),
        AnticipatorEvent("hit", 2.0),
        AnticipatorEvent("hit", 7.0),
        AnticipatorEvent("hit"),
    )

    def anticipator(self, context: AnticipatorContext) -> Anticipator:
        return Remote(context)
