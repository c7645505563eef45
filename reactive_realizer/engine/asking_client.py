"""The client for which slow work is done, such as synthesis, so that the clients can take turns."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_CLIENT: ContextVar[str] = ContextVar("client", default="")


def asking_client() -> str:
    """The client for which the present task works; empty for the session itself."""
    return _CLIENT.get()


@contextmanager
def asked_by(client: str) -> Iterator[None]:
    """Have the tasks that begin in the context work for a client."""
    before = _CLIENT.set(client)
    try:
        yield
    finally:
        _CLIENT.reset(before)
