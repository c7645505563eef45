"""The mouth of an utterance over time."""

from collections.abc import Mapping

from reactive_realizer.binding.mouth_shapes import SILENCE
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.engine.tts import Utterance
from reactive_realizer.engines.speech.lip_sync.coarticulation import Coarticulation
from reactive_realizer.engines.speech.lip_sync.contacts import APPROACH, Contacts
from reactive_realizer.engines.speech.lip_sync.timed_visemes import timed_visemes

_SHORTEST = 2 * APPROACH
"""Duration of an utterance below which the mouth does not open, s."""


class LipSyncTrack:
    """Weights of the morph targets of a mouth during an utterance.

    An utterance without phonemes, or too short to open the mouth and close it again, leaves the mouth at rest.

    Attributes:
        utterance: whose sounds these are.
    """

    def __init__(self, utterance: Utterance, binding: VisemeBinding) -> None:
        self.utterance = utterance
        self._binding = binding
        visemes = timed_visemes(utterance, binding)
        self._contacts = Contacts(visemes, binding.shapes)
        self._coarticulation = Coarticulation(visemes, binding.shapes, binding.articulators)

    def weights(self, time: float) -> Mapping[str, float]:
        """Weights of morph targets, 0..1, at a time from the start of the utterance, s; without those that are 0."""
        duration = self.utterance.duration
        if not 0.0 < time < duration or duration < _SHORTEST:
            return {}
        contacts = self._contacts.at(time)
        weights: dict[str, float] = {}
        for name in self._binding.articulators:
            weights |= self._articulated(name, time, contacts)
        return weights

    def _articulated(self, name: str, time: float, contacts: Mapping[str, float]) -> dict[str, float]:
        """Weights of the morph targets of an articulator: those of contacts that hold it, and of the sounds around."""
        shapes = self._binding.shapes
        held = {viseme: share for viseme, share in contacts.items() if name in shapes[viseme].contact}
        free = 1.0 - sum(held.values()) - contacts.get(SILENCE, 0.0)
        around = self._coarticulation.weights(name, time) if free > 0.0 else {}
        weights = {morph: free * weight for morph, weight in around.items()}
        for viseme, share in held.items():
            for morph, weight in shapes[viseme].morphs.items():
                if morph in self._binding.articulators[name].morphs:
                    weights[morph] = weights.get(morph, 0.0) + share * weight
        return weights
