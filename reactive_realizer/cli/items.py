"""What ``realize`` is given: files, and when they enter."""

import re
from dataclasses import dataclass
from pathlib import Path

from reactive_realizer.bml.sync_ref import NUMBER
from reactive_realizer.clock.units import GlobalTime

_TIMED = re.compile(rf"(.+)@({NUMBER})")


@dataclass(frozen=True, slots=True)
class Item:
    """A file of BML, and the time (s) at which it enters."""

    path: Path
    time: GlobalTime


def seconds(text: str) -> GlobalTime:
    """A time on the command line.

    Raises:
        ValueError: not a number of seconds from now on.
    """
    time = float(text)
    if not 0.0 <= time < float("inf"):
        raise ValueError(text)
    return GlobalTime(time)


def item(text: str) -> Item:
    """``path`` or ``path@seconds``; only a suffix that is a number is a time.

    Raises:
        ValueError: a number beyond all times.
    """
    found = _TIMED.fullmatch(text)
    return Item(Path(found[1]), seconds(found[2])) if found else Item(Path(text), GlobalTime(0.0))
