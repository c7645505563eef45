"""The anticipators do what all of their kind have to do."""

from patient_stop import PatientStop
from turn_end import TurnEnd

from reactive_realizer.testing.anticipator_contract import AnticipatorContract
from reactive_realizer.testing.anticipator_stand import Told


class TestTurnEnd(AnticipatorContract):
    points = ("end",)
    events = (Told("pause"), Told("voice"))

    def anticipator(self, id, board):
        return TurnEnd(id, board)


class TestPatientStop(AnticipatorContract):
    points = ("stop",)
    events = (Told("voice", 1.0), Told("voice", 0.0), Told("words", text="I have thought, over."))
    refused = (Told("voice", 2.0),)

    def anticipator(self, id, board):
        return PatientStop(id, board)
