"""The names by which behaviors ask for motions of a library, a file with many of them."""

from collections.abc import Callable, Iterator
from typing import TypeVar

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import REFERENCE, Posture
from reactive_realizer.engines.animation.faults import NoFile
from reactive_realizer.engines.animation.motion_maker import MotionRequest
from reactive_realizer.engines.animation.motion_unit import NAME
from reactive_realizer.errors import RealizerError

T = TypeVar("T")


def from_library(request: MotionRequest, find: Callable[[str], T]) -> T:
    """Return what a request names: by its reference, or else by its parameter `name` or its lexeme.

    Args:
        request: of a behavior.
        find: returns what has a name; raises `RealizerError` if nothing has it.

    Raises:
        RealizerError: "no-file": the behavior has no name; the error for its last one.
    """
    names = list(_names(request))
    if not names:
        raise RealizerError(NoFile(element=request.behavior.name))
    for name in names[:-1]:
        try:
            return find(name)
        except RealizerError:
            continue
    return find(names[-1])


def _names(request: MotionRequest) -> Iterator[str]:
    names = (request.behavior.extensions.get(REFERENCE), request.parameters.get(NAME) or _lexeme(request.behavior))
    return filter(None, names)


def _lexeme(behavior: Behavior) -> str | None:
    """Return the lexeme of a behavior, or of the pose of a posture."""
    if isinstance(behavior, Posture):
        return behavior.poses[0].lexeme if behavior.poses else None
    lexeme: str | None = getattr(behavior, "lexeme", None)
    return lexeme
