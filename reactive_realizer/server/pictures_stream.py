"""The pictures that show characters in place of their bodies, for clients that ask for them."""

from collections.abc import Callable, Mapping

from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.server.frame_watch import FrameWatch
from reactive_realizer.server.protocol import encode


class PicturesStream:
    """Sends the pictures of characters that have changed. Without subscribers, it is idle."""

    def __init__(self, realizer: Realizer) -> None:
        self._watch: FrameWatch[str] = FrameWatch(realizer, self._publish)
        self._sent: dict[str, tuple[str, ...]] = {}

    def subscribe(self, listener: Callable[[str], None]) -> Callable[[], None]:
        """Gives a listener the messages, first about all characters. The returned function ends that."""
        self._sent.clear()
        return self._watch.subscribe(listener)

    def _publish(self, frames: Mapping[str, Frame]) -> None:
        for id_, frame in frames.items():
            if frame.pictures != self._sent.get(id_):
                self._sent[id_] = frame.pictures
                message = {"type": "pictures", "time": round(frame.time, 6), "character": id_, "files": frame.pictures}
                self._watch.publish(encode(message))
