"""An anticipator that predicts the end of the user's turn."""

from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, Predictions


class TurnEnd(Anticipator):
    """The turn ends some time after a pause began, unless the user continues.

    Args:
        patience: this time, s.
    """

    kind = "turn_end"
    events = ("pause", "voice")
    points = ("end",)

    def __init__(self, context: AnticipatorContext, patience: float = 0.7) -> None:
        super().__init__(context)
        self._patience = patience

    async def predictions(self) -> Predictions:
        """``pause`` predicts the end of the turn; ``voice`` withdraws the prediction."""
        async for event in self.inputs:
            yield "end", event.time + self._patience if event.name == "pause" else None
