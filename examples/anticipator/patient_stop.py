"""A turn model for users who pause to think."""

from anticipators.speech_stop import SpeechStop
from anticipators.turn_model import Turn
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.anticipator import AnticipatorContext


class Patience:
    """The turn ends when the user says "over", or after a long silence."""

    def end(self, turn: Turn) -> Time:
        """The time at which the turn ends unless more is heard."""
        if turn.voice or turn.since is None:
            return None
        return GlobalTime(turn.since + (0.3 if turn.words.endswith("over.") else 5.0))


class PatientStop(SpeechStop):
    """The anticipator `speech_stop` with this model."""

    kind = "patient_stop"

    def __init__(self, context: AnticipatorContext) -> None:
        super().__init__(context, model=Patience())
