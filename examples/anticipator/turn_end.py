"""An anticipator that predicts the end of the user's turn."""

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.pegboard.pegboard import PegBoard


class TurnEnd(Anticipator):
    """The turn ends some time after a pause began, unless the user continues.

    Args:
        patience: this time, s.
    """

    kind = "turn_end"
    events = ("pause", "voice")
    points = ("end",)

    def __init__(self, id: str, board: PegBoard, patience: float = 0.7) -> None:
        super().__init__(id, board)
        self._patience = patience

    def event(self, name: str, value: float | None, now: GlobalTime) -> None:
        """``pause`` predicts the end of the turn; ``voice`` withdraws the prediction."""
        if name == "pause":
            self.predict("end", GlobalTime(now + self._patience), now)
        elif name == "voice":
            self.predict("end", None, now)
