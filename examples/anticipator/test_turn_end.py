"""The anticipators satisfy their contract."""

from patient_stop import PatientStop
from turn_end import TurnEnd

from reactive_realizer.pegboard.anticipator import AnticipatorContext, AnticipatorEvent
from reactive_realizer.testing.anticipator_contract import AnticipatorContract


class TestTurnEnd(AnticipatorContract):
    points = ("end",)
    events = (AnticipatorEvent("pause"), AnticipatorEvent("voice"))

    def anticipator(self, context: AnticipatorContext) -> TurnEnd:
        return TurnEnd(context)


class TestPatientStop(AnticipatorContract):
    points = ("stop",)
    events = (
        AnticipatorEvent("voice", 1.0),
        AnticipatorEvent("voice", 0.0),
        AnticipatorEvent("words", text="I have thought, over."),
    )
    refused = (AnticipatorEvent("voice", 2.0),)

    def anticipator(self, context: AnticipatorContext) -> PatientStop:
        return PatientStop(context)
