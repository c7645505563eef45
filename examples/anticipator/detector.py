"""An anticipator that is fed by another program."""

import asyncio

from reactive_realizer.pegboard.anticipator import Anticipator, AnticipatorContext, Predictions


class Detector(Anticipator):
    """A detector of claps on this machine sends lines over TCP: the seconds until the next clap.

    Args:
        port: of the detector.
    """

    kind = "detector"
    points = ("clap",)

    def __init__(self, context: AnticipatorContext, port: float = 9000) -> None:
        super().__init__(context)
        self._port = round(port)

    async def predictions(self) -> Predictions:
        """Each line predicts the next clap."""
        lines, connection = await asyncio.open_connection("127.0.0.1", self._port)
        try:
            async for line in lines:
                yield "clap", self.clock.now() + float(line)
        finally:
            connection.close()
