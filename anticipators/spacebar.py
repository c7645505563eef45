"""A key (thesis 8.5.1): it predicts nothing, but behaviors start at once when it is pressed or released.

In a Wizard of Oz experiment, it replaces the detection of an event (thesis 10.4).
"""

from reactive_realizer.pegboard.anticipator import Anticipator, Predictions


class Spacebar(Anticipator):
    """Its points are ``press`` and ``release``, each of which is the next such event.

    When the event occurs, behaviors that depend on the point get the time of its tick, plus their offset; behaviors
    that come later wait for the next event. It assumes that auto-repeated key events are not reported.
    """

    kind = "spacebar"
    events = ("press", "release")
    points = events

    async def predictions(self) -> Predictions:
        """Each event, as it occurs."""
        async for event in self.inputs:
            yield event.name, event.time
