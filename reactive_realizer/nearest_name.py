"""The known name that someone may have meant by an unknown one."""

from collections.abc import Iterable
from difflib import get_close_matches
from functools import lru_cache
from itertools import islice

_LEAST_LIKE = 0.72
"""Ratio of `SequenceMatcher` below which names are different words: BAET is like BEAT (0.75), nobody not like nod."""

_LONGEST = 60
"""Characters of a name that is compared; nobody mistypes longer ones by a letter, and comparing takes long."""

_MOST = 300
"""Known names that are compared."""


def nearest_name(name: str, known: Iterable[str]) -> str | None:
    """The known name that is most like an unknown one, ignoring case, ``-`` and ``_``; None if none is like it."""
    compared = tuple(islice(known, _MOST))
    return None if len(name) > _LONGEST or name in compared else _nearest(name, compared)


@lru_cache(2000)
def _nearest(name: str, known: tuple[str, ...]) -> str | None:
    by_form = {_form(each): each for each in reversed(known) if len(each) <= _LONGEST}
    close = get_close_matches(_form(name), by_form, n=1, cutoff=_LEAST_LIKE)
    return by_form[close[0]] if close else None


def _form(name: str) -> str:
    return name.strip().casefold().replace("_", "-")
