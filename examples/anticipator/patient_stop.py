"""The end of a turn, for users who think for a long time."""

from anticipators.speech_stop import SpeechStop
from anticipators.turn_model import Turn
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.pegboard.pegboard import PegBoard


class Patience:
    """A turn is over when the user said so, or after a long silence."""

    def end(self, turn: Turn) -> Time:
        """When a turn ends if nothing more is heard."""
        if turn.voice or turn.since is None:
            return None
        return GlobalTime(turn.since + (0.3 if turn.words.endswith("over.") else 5.0))


class PatientStop(SpeechStop):
    """Like `speech_stop`, with patience."""

    kind = "patient_stop"

    def __init__(self, id: str, board: PegBoard) -> None:
        super().__init__(id, board, model=Patience())
