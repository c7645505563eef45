"""Every bound on what the realizer accepts from outside, in one place."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Limits:
    """What one realizer accepts; the human file may set each of these in ``[limits]``."""

    bml_bytes: int = 1_000_000
    """Size of one BML document."""
    xml_depth: int = 32
    """Nesting of elements in a BML document."""
    xml_attributes: int = 200
    """Attributes and namespace declarations of one element."""
    behaviors_per_block: int = 1_000
    blocks_alive: int = 1_000
    """Blocks accepted and not yet ended, all characters together."""
    procedures: int = 1_000
    """Procedures defined; one that is defined anew counts once."""
    utterance_characters: int = 5_000
    """Length of the text of one speech."""
    clients: int = 100
    """Sockets and feedback streams open at once."""
    messages_per_second: int = 500
    """Socket messages of one client."""
    message_bytes: int = 1_200_000
    """Size of one socket message: a BML document and its JSON escape."""
    queued_bytes: int = 8 * 1024 * 1024
    """What may pile up for one slow client before it is closed."""
    queued_messages: int = 10_000
    predicted_points: int = 10_000
    """Points of anticipators that clients name in predictions."""
    targets: int = 1_000
    """Things in the world, those that clients put there among them."""
    sound_bytes: int = 64 * 1024 * 1024
    """Sounds kept for clients to fetch."""
    remembered_feedback: int = 10_000
    """Feedback messages kept for clients that resume."""
    remembered_feedback_bytes: int = 256 * 1024 * 1024
    remembered_blocks: int = 10_000
    """Ended blocks of which id, state and end time are kept."""
    time_seconds: float = 86_400.0
    """Largest offset or duration, in absolute value, that a description may name."""
