"""The anticipators satisfy their contract."""

from patient_stop import PatientStop
from turn_end import TurnEnd

from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.testing.anticipator_contract import AnticipatorContract
from reactive_realizer.testing.anticipator_harness import AnticipatorEvent


class TestTurnEnd(AnticipatorContract):
    points = ("end",)
    events = (AnticipatorEvent("pause"), AnticipatorEvent("voice"))

    def anticipator(self, id: str, board: PegBoard) -> TurnEnd:
        return TurnEnd(id, board)


class TestPatientStop(AnticipatorContract):
    points = ("stop",)
    events = (
        AnticipatorEvent("voice", 1.0),
        AnticipatorEvent("voice", 0.0),
        AnticipatorEvent("words", text="I have thought, over."),
    )
    refused = (AnticipatorEvent("voice", 2.0),)

    def anticipator(self, id: str, board: PegBoard) -> PatientStop:
        return PatientStop(id, board)
