"""Faults of the server: messages, requests, connections and recordings."""

from reactive_realizer.errors import Fault


class BadJson(Fault):
    """A message that is not JSON."""

    code = "bad-json"
    template = "not valid JSON: {reason}"
    reason: str


class BinaryMessage(Fault):
    """A binary message of the socket."""

    code = "binary-message"
    template = "messages must be JSON text; binary messages are not read"


class UnknownMessage(Fault):
    """A message of a type that is not in the protocol."""

    code = "unknown-message"
    template = "there is no message type {type}; known: {known}"
    unknown = "type"
    type: str
    known: tuple[str, ...]


class BadMessage(Fault):
    """A field of a message that does not satisfy the schema."""

    code = "bad-message"
    template = "{place}: {reason}"
    place: str
    reason: str


class TooManyValues(Fault):
    """A message with more values than the limit allows."""

    code = "too-many-values"
    template = "the message has more than {limit} values: texts, numbers, lists and objects"
    limit: int


class BadRequest(Fault):
    """An HTTP request that cannot be read."""

    code = "bad-request"
    template = "the request cannot be read: {reason}"
    reason: str


class SlowRequest(Fault):
    """A request whose body does not arrive."""

    code = "slow-request"
    template = "the body of the request has not arrived within {limit:g} s"
    limit: float


class BadQuery(Fault):
    """A value in the query of an address."""

    code = "bad-query"
    template = "{name}={value} is not valid; expected {wanted}"
    name: str
    value: str
    wanted: str


class UnknownAnticipator(Fault):
    """No anticipator has the id."""

    code = "unknown-anticipator"
    template = "there is no anticipator '{anticipator}'; available: {known}"
    unknown = "anticipator"
    anticipator: str
    known: tuple[str, ...]


class NotMovable(Fault):
    """A character where a target is expected."""

    code = "not-movable"
    template = "'{target}' is a character; only targets can be moved"
    target: str


class NoDemo(Fault):
    """A server without a demo performance."""

    code = "no-demo"
    template = "this server has no demo performance"


class NoClip(Fault):
    """A sound that is not kept."""

    code = "no-clip"
    template = "there is no sound '{clip}', or it is no longer available"
    clip: str


class ForeignStream(Fault):
    """Sound for a stream that another client sends."""

    code = "foreign-stream"
    template = "another client sends the stream '{stream}'"
    stream: str


class NoPage(Fault):
    """A server without a built page."""

    code = "no-page"
    template = "the page has not been built; run `make page`"


class NothingThere(Fault):
    """An address without a route."""

    code = "nothing-there"
    template = "there is nothing at {path}"
    path: str


class WrongMethod(Fault):
    """A method that a route does not support."""

    code = "wrong-method"
    template = "{path} does not support {method}"
    path: str
    method: str


class WrongMediaType(Fault):
    """A document with the media type of no dialect."""

    code = "wrong-media-type"
    template = "a document must be sent as {known}, not as {type}"
    type: str
    known: tuple[str, ...]


class WrongCharset(Fault):
    """BML in an encoding that is not read."""

    code = "wrong-charset"
    template = "BML must be in UTF-8, UTF-16, ISO-8859-1 or US-ASCII, not in {charset}"
    charset: str


class NoToken(Fault):
    """A request without the token of the server."""

    code = "no-token"
    template = "the token of this server is required; it is missing or wrong"


class EmptyToken(Fault):
    """A token without characters, which anyone could present."""

    code = "empty-token"
    template = "the token is empty; give one that cannot be guessed, such as the output of `openssl rand -hex 16`"


class TokenRequired(Fault):
    """A server without a token that other machines can reach."""

    code = "token-required"
    template = (
        "{host} can be reached from other machines, so a token is required: --token-file FILE, or the environment "
        "variable REACTIVE_REALIZER_TOKEN"
    )
    host: str


class ForeignHost(Fault):
    """A host name that is not this server's."""

    code = "foreign-host"
    template = "the host {host} does not belong to this server"
    host: str


class ForeignOrigin(Fault):
    """A page of an origin that is not allowed."""

    code = "foreign-origin"
    template = "pages from {origin} are not allowed; allow them with --allow-origin"
    origin: str


class ForeignPage(Fault):
    """Something that a page of another site embeds."""

    code = "foreign-page"
    template = "a page of another site may not embed {path}; pages that --allow-origin allows can fetch it with CORS"
    path: str


class TooManyClients(Fault):
    """A client over the limit."""

    code = "too-many-clients"
    template = "the limit of {limit} connected clients is reached"
    limit: int


class TooSlow(Fault):
    """A client that does not read fast enough."""

    code = "too-slow"
    template = "the client reads too slowly; it can resume with after=SEQ, the number of the last feedback that it has"


class FeedbackGone(Fault):
    """Feedback that is no longer kept."""

    code = "feedback-gone"
    template = "feedback up to {seq} is no longer kept"
    seq: int


class GoingAway(Fault):
    """A server that shuts down."""

    code = "going-away"
    template = "the server is shutting down"


class StandsStill(Fault):
    """A session whose ticks have stopped."""

    code = "stands-still"
    template = "the session stands still: the last tick was {seconds:.1f} s ago"
    seconds: float


class BadRecording(Fault):
    """A line of a recording that cannot be read."""

    code = "bad-recording"
    template = "{file}, line {row}: {reason}"
    file: str
    row: int
    reason: str


class OldRecording(Fault):
    """A recording in a format that is not read any more."""

    code = "old-recording"
    template = "it is in format {format}, and this version reads format {known}; replay it with version {version}"
    format: int
    known: int
    version: str


class ForeignPart(Fault):
    """A file in the place of a part of a recording that is part of another one."""

    code = "foreign-part"
    template = "this file is part of another recording than the one before it"


class PartsOutOfOrder(Fault):
    """Parts of a recording in the wrong order."""

    code = "parts-out-of-order"
    template = "part {part} follows part {last}"
    part: int
    last: int


class NotRecorded(Fault):
    """A message that is not an input of a session."""

    code = "not-recorded"
    template = "a message of type {type} cannot be part of a recording"
    type: str


class LostInput(Fault):
    """A gap in the inputs of a recording."""

    code = "lost-input"
    template = "input {seq} follows where input {wanted} was expected"
    seq: int
    wanted: int


class TicksOutOfOrder(Fault):
    """Ticks of a recording in the wrong order."""

    code = "ticks-out-of-order"
    template = "tick {tick} follows tick {last}"
    tick: int
    last: int
