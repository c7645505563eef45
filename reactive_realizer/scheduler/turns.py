"""Whose turn it is: one comes after those that it names."""

from collections.abc import Callable, Hashable, Iterable
from typing import TypeVar

T = TypeVar("T", bound=Hashable)


def in_turn(waiting: Iterable[T], named: Callable[[T], Iterable[T]]) -> list[T]:
    """All that wait, and all that these name in any number of steps: each after those that it names.

    Else they stay in the order given. Of some that name each other in a circle one has to be first: the one that names
    the one that was come upon first.

    Args:
        waiting: in order.
        named: what one of them names itself, in order.
    """
    done: dict[T, None] = {}
    for each in waiting:
        path = {} if each in done else {each: iter(named(each))}
        while path:
            last, ahead = next(reversed(path.items()))
            following = next((other for other in ahead if other not in done and other not in path), None)
            if following is None:
                done[last] = None
                del path[last]
            else:
                path[following] = iter(named(following))
    return list(done)
