"""Lanes: the work that one client asks of one character. They take turns, so that no client holds another one up."""

from collections.abc import Iterator
from typing import Final, NamedTuple

ACCOMPANIST: Final = "accompanist"
"""The client of the blocks that the realizer itself sends: movements with words, and fillers.

They have no part in the limits on blocks, and are planned when no other lane has work.
"""


class Lane(NamedTuple):
    """The blocks and procedures of one client for one character.

    Attributes:
        client: that sent them; empty for those of the session itself.
        character: id of the character.
    """

    client: str
    character: str


class LaneTurns:
    """The order in which lanes take turns: clients in turn, and the characters of each client in turn."""

    def __init__(self) -> None:
        self._characters: dict[str, dict[str, None]] = {}
        """By client; the turn of the first client, and of its first character, was longest ago."""

    def __iter__(self) -> Iterator[Lane]:
        """Iterate over the lanes, those whose turn was longest ago first."""
        for client, characters in self._characters.items():
            for character in characters:
                yield Lane(client, character)

    def add(self, lane: Lane) -> None:
        """Add a lane, if it is not among them."""
        self._characters.setdefault(lane.client, {}).setdefault(lane.character)

    def take(self, lane: Lane) -> None:
        """Note that a lane takes its turn."""
        characters = self._characters.pop(lane.client, {})
        characters.pop(lane.character, None)
        characters[lane.character] = None
        self._characters[lane.client] = characters

    def remove(self, lane: Lane) -> None:
        """Remove a lane."""
        characters = self._characters.get(lane.client, {})
        characters.pop(lane.character, None)
        if not characters:
            self._characters.pop(lane.client, None)
