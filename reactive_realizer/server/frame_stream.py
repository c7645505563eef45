"""Frames of all characters, encoded once for everybody."""

from collections.abc import Callable
from itertools import count

from reactive_realizer.embodiment.frame import Frame
from reactive_realizer.realizer.character import Character
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.server.audience import Audience
from reactive_realizer.server.frame_codec import encode_frame


class FrameStream:
    """Watches a realizer as long as somebody looks: nothing is composed where nobody does."""

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._audience: Audience[bytes] = Audience()
        self._indices = {id_: index for index, id_ in enumerate(realizer.characters)}
        self._sequences = {id_: count() for id_ in realizer.characters}
        self._look_away: Callable[[], None] | None = None

    def join(self, listener: Callable[[bytes], None]) -> Callable[[], None]:
        """Send the frames to a listener; the returned call ends that."""
        leave = self._audience.join(listener)
        if self._look_away is None:
            self._look_away = self._realizer.watch(self._send)

        def leave_and_look_away() -> None:
            leave()
            if not self._audience and self._look_away is not None:
                self._look_away()
                self._look_away = None

        return leave_and_look_away

    def _send(self, character: Character, frame: Frame) -> None:
        index, sequence = self._indices[character.id], next(self._sequences[character.id])
        rotations = character.humanoid.avatar.bone_rotations(frame.rotations)
        self._audience.tell(encode_frame(index, sequence, frame.time, frame.root, rotations, frame.weights))
