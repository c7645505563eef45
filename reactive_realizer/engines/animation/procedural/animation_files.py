"""Animations by the name of their file."""

from functools import lru_cache
from pathlib import Path

from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.engines.animation.procedural.proc_animation_reader import read_proc_animation
from reactive_realizer.errors import error


def wanted_animation(actor: Actor, wanted: Wanted) -> ProcAnimation:
    """The animation that is wanted, in a mirror if that is wanted; a file that was saved anew is read anew.

    Raises:
        RealizerError: there is no such file, or it cannot be read.
    """
    if wanted.file is None:
        raise error("no-unit", unit="an animation without a file")
    path = actor.asset(wanted.file)
    return _animation_in(path, path.stat().st_mtime_ns, wanted.parameters.get("mirror") == "true")


@lru_cache
def _animation_in(path: Path, changed: int, mirror: bool) -> ProcAnimation:
    """Read once for all characters: it takes some milliseconds, which a tick hardly has."""
    return _animation_in(path, changed, False).mirrored() if mirror else read_proc_animation(path)
