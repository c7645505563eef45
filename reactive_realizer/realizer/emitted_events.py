"""The events that behaviors emit, as points of an anticipator."""

from reactive_realizer.bml.attribute_types import EventName
from reactive_realizer.bml.value_faults import NotAnEvent
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits
from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, Predictions


class EmittedEvents(Anticipator):
    """Every event is a point that recurs; clients can emit events as behaviors do."""

    kind = "events"

    def __init__(self, context: AnticipatorContext, limits: Limits) -> None:
        super().__init__(context)
        self._limits = limits

    async def predictions(self) -> Predictions:
        """The events of clients, as they enter; those of behaviors are written when they are emitted."""
        async for event in self.inputs:
            yield event.name, event.time

    def check(self, name: str, value: float | None) -> None:
        """Check the name of an event.

        Raises:
            RealizerError: "not-an-event".
        """
        if EventName().read(name, self._limits) != name:
            raise RealizerError(NotAnEvent())

    def recurs(self, point: str) -> bool:
        """Each event may be emitted again."""
        return True
