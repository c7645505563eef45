"""The limits on all input."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits of one realizer. The human file sets them in ``[limits]``."""

    bml_bytes: int = 1_000_000
    """Size of a BML document, bytes."""
    xml_depth: int = 32
    """Nesting of elements in a BML document."""
    xml_attributes: int = 200
    """Attributes and namespace declarations of an element."""
    behaviors_per_block: int = 1_000
    """Behaviors in a block."""
    blocks_alive: int = 2_000
    """Accepted blocks that have not ended, of all characters; a client has at most half of what others leave."""
    behaviors_alive: int = 20_000
    """Behaviors of these blocks; a client has at most half of what others leave."""
    sync_points_per_block: int = 10_000
    """Sync points of a block, which fails if it has more; a nod has one for each repetition."""
    goals_per_behavior: int = 1_000
    """Goals of key poses, or values of key frames, of a behavior. Poses and frames after them are left out."""
    movements_per_gesture: int = 30
    """Movements of a gesture of MURML, one after another. Those after them are left out."""
    planning_per_tick: int = 700
    """Work of planning in a tick, counted in sync points that are made, placed or put on pegs. The rest waits."""
    procedures: int = 1_000
    """Defined procedures; a redefinition does not count again."""
    utterance_characters: int = 5_000
    """Length of the text of a speech."""
    event_characters: int = 5_000
    """Length of the content of an emitted event, as XML."""
    clients: int = 100
    """Open sockets and feedback streams."""
    connections: int = 256
    """Open connections. If no more fit, the one that has been unused for longest is closed for a new one."""
    connections_per_address: int = 64
    """Open connections from one other machine; those from this machine, also of a proxy on it, only count together."""
    idle_seconds: float = 75.0
    """Time within which a connection must send its next request, without the body, s."""
    body_seconds: float = 30.0
    """Time within which the body of a request must arrive, s."""
    reported_problems: int = 100
    """Problems of a block or procedure that are reported when it is read; the others are counted."""
    messages_per_second: int = 500
    """Socket messages that are read per second and client; further ones wait."""
    answered_warnings: int = 50
    """Warnings in the answer to a BML document; the others are counted."""
    message_bytes: int = 1_200_000
    """Size of a socket message, bytes: a BML document in JSON."""
    message_values: int = 50_000
    """Values in a socket message: texts, numbers, lists and objects."""
    queued_bytes: int = 8 * 1024 * 1024
    """Bytes queued for a slow client; its connection is closed if there are more for half a second."""
    queued_messages: int = 10_000
    """Messages queued for a slow client; its connection is closed if there are more for half a second."""
    predicted_points: int = 10_000
    """Points of anticipators on the peg board. Those that no behavior is tied to make room for new ones."""
    predictions_per_second: int = 10
    """Reports per second and block of predictions that have moved; the last one is always reported."""
    predicted_behaviors_per_second: int = 2_000
    """Behaviors in the reports of predictions that have moved, per second. Clients share them equally."""
    targets: int = 1_000
    """Objects in the world, including those added by clients."""
    sound_bytes: int = 64 * 1024 * 1024
    """Bytes of audio stored for clients to fetch."""
    sound_seconds: float = 300.0
    """Duration of a sound file, and of a streamed speech, s."""
    streams: int = 8
    """Streamed speeches at a time; the words of each are found in a process of its own."""
    stream_seconds: float = 20.0
    """Longest time in which no sound of a streamed speech arrives, before it begins or while it plays, s."""
    remembered_feedback: int = 10_000
    """Feedback messages stored for clients that reconnect."""
    remembered_feedback_bytes: int = 256 * 1024 * 1024
    """Bytes of feedback stored for clients that reconnect."""
    remembered_blocks: int = 10_000
    """Ended blocks whose id, state and end time are stored."""
    time_seconds: float = 86_400.0
    """Largest absolute value of an offset or duration in BML, s."""
