"""Reports of clients on what is heard: one client leads each sound, so that several do not contradict each other."""

from dataclasses import dataclass

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import AudioHeard
from reactive_realizer.errors import RealizerError
from reactive_realizer.server.faults import NoClip
from reactive_realizer.server.live_scene import LiveScene

_SILENCE = 1.0
"""A client that has not reported for this time (s) leads no longer."""
_INTERVAL = 0.1
"""Reports that follow each other faster (s) are ignored."""


@dataclass(slots=True)
class _Leader:
    client: object
    reported: GlobalTime


class HeardReports:
    """Passes the reports on each sound from the client that reported it first, for as long as it continues to."""

    def __init__(self, live: LiveScene) -> None:
        self._live = live
        self._leaders: dict[str, _Leader] = {}

    def take(self, heard: AudioHeard, client: object) -> None:
        """Takes a report of a client. It has no effect if the sound has ended, or another client leads.

        Raises:
            RealizerError: there is no such sound, or the report cannot be true.
        """
        if self._live.sounds.wav(heard.id) is None:
            raise RealizerError(NoClip(clip=heard.id))
        if self._live.realizer.check_heard(heard) and self._leads(heard.id, client, self._live.now):
            self._live.realizer.put(heard)

    def _leads(self, clip: str, client: object, now: GlobalTime) -> bool:
        """Whether a report counts."""
        self._leaders = {id_: each for id_, each in self._leaders.items() if now - each.reported <= _SILENCE}
        leader = self._leaders.setdefault(clip, _Leader(client, GlobalTime(-1.0)))
        if leader.client is not client or now - leader.reported < _INTERVAL:
            return False
        leader.reported = now
        return True
