"""An anticipator of one's own: it predicts when somebody stops speaking."""

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard


class TurnEnd(Anticipator):
    """The turn ends some seconds after a pause began, unless the voice comes back.

    Args:
        patience: those seconds.
    """

    kind = "turn_end"
    events = ("pause", "voice")
    points = ("end",)

    def __init__(self, id: str, board: PegBoard, patience: float = 0.7) -> None:
        super().__init__(id, board)
        self._patience = patience

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """``pause`` predicts the end of the turn; ``voice`` takes the prediction back."""
        if name == "pause":
            self.predict("end", GlobalTime(now + self._patience), now)
        elif name == "voice":
            self.predict("end", None, now)
