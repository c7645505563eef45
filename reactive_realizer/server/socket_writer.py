"""Writes messages that all sockets share: they are put into their form once, and leave past the queues of clients."""

import struct
from asyncio import WriteTransport

_BINARY = 0x82
"""A binary message in one piece (RFC 6455, 5.2)."""
_TWO_BYTES, _EIGHT_BYTES = 126, 127
"""Instead of a length: it follows in as many bytes."""


def binary_message(payload: bytes) -> bytes:
    """A binary message of a server, with its header (RFC 6455, 5.2): it is not masked, so it is the same for all."""
    size = len(payload)
    if size < _TWO_BYTES:
        return struct.pack("!BB", _BINARY, size) + payload
    if size < 1 << 16:
        return struct.pack("!BBH", _BINARY, _TWO_BYTES, size) + payload
    return struct.pack("!BBQ", _BINARY, _EIGHT_BYTES, size) + payload


def write_at_once(transport: WriteTransport, message: bytes) -> None:
    """Writes a message to a socket if everything before it has left; otherwise, a newer message will replace it."""
    if not transport.is_closing() and transport.get_write_buffer_size() == 0:
        transport.write(message)
