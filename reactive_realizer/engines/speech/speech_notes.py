"""Warnings about speeches that play, but not entirely as they were requested."""

from reactive_realizer.engine.effects import Warn
from reactive_realizer.engines.speech.speech_unit import SpeechUnit
from reactive_realizer.errors import CreationFault, Fault


class MarkupLeftOut(CreationFault):
    """Markup of a speech that its voice cannot follow."""

    code = "markup-left-out"
    template = "the voice cannot do {markup}; the rest of the SSML is followed"
    markup: tuple[str, ...]


class OtherScript(CreationFault):
    """Letters that the voice does not read."""

    code = "other-script"
    template = "the voice does not read {scripts} letters: it spells or skips them"
    scripts: tuple[str, ...]


class SpeechNotes:
    """Collects the warnings about the speeches of a character: each once, but one about markup for each speech."""

    def __init__(self) -> None:
        self._notes: list[Warn] = []
        self._told: set[Fault] = set()

    def add(self, unit: SpeechUnit) -> None:
        """Note the warnings about a speech that is planned."""
        self.tell(unit, unit.note)
        self.tell(unit, OtherScript(scripts=unit.utterance.unread) if unit.utterance.unread else None)

    def tell(self, unit: SpeechUnit, fault: Fault | None) -> None:
        """Note a fault, if there is one."""
        if fault is not None and (fault not in self._told or isinstance(fault, MarkupLeftOut)):
            self._told.add(fault)
            self._notes.append(Warn(unit, fault))

    def take(self) -> tuple[Warn, ...]:
        """What was noted since the last call."""
        notes, self._notes = tuple(self._notes), []
        return notes
