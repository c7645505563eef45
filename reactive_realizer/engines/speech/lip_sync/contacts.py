"""Sounds for which lips or teeth touch: the times of contact, whatever the rate of speech.

Dominance functions alone leave the lips apart in a short p between open vowels (Cohen and Massaro 1993). Therefore
contacts have precedence over them: each is held for at least `SHORTEST`, so that a frame shows it, and neighboring
sounds only have what is left.
"""

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from reactive_realizer.binding.mouth_shapes import SILENCE, MouthShape
from reactive_realizer.engines.speech.lip_sync.timed_visemes import TimedViseme

SHORTEST = 0.025
"""The shortest time for which a contact is held, s: longer than from a frame to the next."""

APPROACH = 0.07
"""Time in which the mouth moves from a sound to a contact, or from a contact to a sound, s."""

ENDS = 0.05
"""The shortest time from the start of an utterance to a contact, and from a contact to the end, s."""

_OPENING = 1.2 * APPROACH
"""The time between two equal contacts in which a sound between them is seen, s."""

_CHANGE = 0.02
"""The shortest time between two different contacts, s."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A viseme that is held from `start` to `end`, s from the start of the utterance."""

    viseme: str
    start: float
    end: float

    @property
    def spare(self) -> float:
        """The time by which it can be shortened, s."""
        return max(0.0, self.end - self.start - SHORTEST)


class Contacts:
    """The contacts of an utterance.

    Args:
        visemes: of the utterance, in order.
        shapes: by viseme.
    """

    def __init__(self, visemes: Sequence[TimedViseme], shapes: Mapping[str, MouthShape]) -> None:
        wanted = [Contact(each.name, each.start, each.end) for each in visemes if shapes[each.name].contact]
        end = visemes[-1].end
        rest = Contact(SILENCE, 0.0, 0.0), Contact(SILENCE, end, end)
        self._contacts = [rest[0], *_shared_out(_in_time(wanted, end)), rest[1]]
        self._starts = [contact.start for contact in self._contacts]

    def at(self, time: float) -> dict[str, float]:
        """The share of each contact in the mouth at a time within the utterance, s: 1 while it is held.

        Silence stands for the rest before and after the utterance. The sum is at most 1; sounds have what is left.
        """
        number = bisect_right(self._starts, time)
        before, after = self._contacts[number - 1], self._contacts[number]
        approach = _approach(before, after)
        shares = {before.viseme: _share(time - before.end, approach)}
        shares[after.viseme] = max(_share(after.start - time, approach), shares.get(after.viseme, 0.0))
        return {viseme: share for viseme, share in shares.items() if share > 0.0}


def _share(away: float, approach: float) -> float:
    """The share of a contact at a time away from it, s."""
    return 1.0 if away <= 0.0 else max(0.0, 1.0 - away / approach)


def _approach(before: Contact, after: Contact) -> float:
    """The time in which the mouth moves to or from a contact, s: between different ones, at most the time between."""
    between = APPROACH if before.viseme == after.viseme else after.start - before.end
    return max(1e-6, min(APPROACH, between))


def _in_time(wanted: Iterable[Contact], duration: float) -> list[Contact]:
    """Contacts of at least the shortest duration, one after the other, within the utterance."""
    placed: list[Contact] = []
    for contact in wanted:
        earliest = placed[-1].end + _apart(placed[-1], contact) if placed else ENDS
        start = max(contact.start, earliest)
        placed.append(replace(contact, start=start, end=max(contact.end, start + SHORTEST)))
    latest = duration - ENDS
    for rank, contact in reversed(list(enumerate(placed))):
        end = min(contact.end, latest)
        placed[rank] = replace(contact, start=min(contact.start, end - SHORTEST), end=end)
        latest = placed[rank].start - (_apart(placed[rank - 1], contact) if rank else 0.0)
    return placed


def _apart(one: Contact, other: Contact) -> float:
    return 0.0 if one.viseme == other.viseme else _CHANGE


def _shared_out(contacts: Sequence[Contact]) -> list[Contact]:
    """Contacts that leave time to the sounds between them, as far as they last longer than the shortest time."""
    shared = list(contacts)
    for rank, (_, after) in enumerate(pairwise(contacts)):
        before = shared[rank]
        wanted = _OPENING if before.viseme == after.viseme else APPROACH
        missing = wanted - (after.start - before.end)
        if missing <= 0.0:
            continue
        early = min(before.spare, max(missing / 2, missing - after.spare))
        late = min(after.spare, missing - early)
        shared[rank] = replace(before, end=before.end - early)
        shared[rank + 1] = replace(after, start=after.start + late)
    return shared
