"""The one table of what can go wrong: a code, where it shows, and its sentence for people.

Every refusal, warning and close reason of the realizer is a `Fault` with a code of this table; docs/errors.md is made
from it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from types import MappingProxyType


class WarningType(StrEnum):
    """Types of BML 1.0 warningFeedback, and EXECUTION_FAILURE as AsapRealizer sends it."""

    PARSING_FAILURE = "PARSING_FAILURE"
    NO_SUCH_TARGET = "NO_SUCH_TARGET"
    IMPOSSIBLE_TO_SCHEDULE = "IMPOSSIBLE_TO_SCHEDULE"
    BEHAVIOR_TYPE_NOT_SUPPORTED = "BEHAVIOR_TYPE_NOT_SUPPORTED"
    CUSTOM_BEHAVIOUR_NOT_SUPPORTED = "CUSTOM_BEHAVIOUR_NOT_SUPPORTED"
    CUSTOM_ATTRIBUTE_NOT_SUPPORTED = "CUSTOM_ATTRIBUTE_NOT_SUPPORTED"
    CANNOT_CREATE_BEHAVIOR = "CANNOT_CREATE_BEHAVIOR"
    EXECUTION_FAILURE = "EXECUTION_FAILURE"


@dataclass(frozen=True, slots=True)
class ErrorKind:
    """A row of the table.

    Attributes:
        warning: type of the warningFeedback that tells it, if one does.
        status: HTTP status that answers it, if a request can cause it.
        close: WebSocket close code, if it ends a connection.
        sentence: for people; fields in braces are filled from the details of the fault.
    """

    sentence: str
    warning: WarningType | None = None
    status: int | None = None
    close: int | None = None


_PARSING = WarningType.PARSING_FAILURE
_SCHEDULE = WarningType.IMPOSSIBLE_TO_SCHEDULE
_CREATE = WarningType.CANNOT_CREATE_BEHAVIOR
_PLAYING = WarningType.EXECUTION_FAILURE

ERRORS: Mapping[str, ErrorKind] = MappingProxyType(
    {
        # --- reading BML
        "bad-encoding": ErrorKind("not text in UTF-8, UTF-16, ISO-8859-1 or US-ASCII", _PARSING, 400),
        "malformed-xml": ErrorKind("not well-formed XML: {reason}", _PARSING, 400),
        "doctype": ErrorKind("a DOCTYPE is refused", _PARSING, 400),
        "too-many-bytes": ErrorKind("{size} bytes, the limit is {limit}", _PARSING, 413),
        "too-deep": ErrorKind("elements nested deeper than {limit}", _PARSING, 413),
        "too-many-attributes": ErrorKind("more than {limit} attributes of an element", _PARSING, 413),
        "too-many-roots": ErrorKind("more than {limit} blocks in a document; the rest is not read", _PARSING, 413),
        "too-many-behaviors": ErrorKind("{size} behaviors in a block, the limit is {limit}", _PARSING, 413),
        "unclosed-element": ErrorKind("not well-formed XML: the document ends inside <{element}>", _PARSING, 400),
        "not-bml": ErrorKind("<{element}> is no bml block, defineproc or useproc", _PARSING, 400),
        "no-block": ErrorKind("no bml block in the document", _PARSING, 400),
        "procedure-in-block": ErrorKind("<{element}> stands beside blocks, not in one", _PARSING),
        "no-block-id": ErrorKind("the bml block has no id; it is refused", _PARSING, 400),
        "missing-attribute": ErrorKind("<{element}> needs the attribute '{attribute}'", _PARSING),
        "unknown-attribute": ErrorKind("unknown attribute {attributes} of <{element}>; known are {known}", _PARSING),
        "bad-attribute": ErrorKind("{attribute}='{value}' of <{element}>: {reason}", _PARSING),
        "not-an-id": ErrorKind(
            "an id has 1 to 200 characters, no white space, control character, ':' or '+', and is not 'bml'"
        ),
        "not-a-number": ErrorKind("not a finite number"),
        "not-whole": ErrorKind("not a whole number"),
        "out-of-range": ErrorKind("not within {low} and {high}"),
        "unknown-word": ErrorKind("known are {known}"),
        "not-a-reference": ErrorKind("not a sync reference, [block:]behavior:sync[+seconds] or seconds"),
        "only-block-start": ErrorKind(
            "of its own block a reference may name the start, of another one start, relax and end"
        ),
        "external-reference": ErrorKind(
            "a behavior of another block; a draft has to say bmlt:allowexternalrefs='true'"
        ),
        "absurd-time": ErrorKind("more than {limit:g} s"),
        "unknown-element": ErrorKind("unknown {element} in <{parent}>; known are {known}", _PARSING),
        "missing-element": ErrorKind("<{element}> needs {children} in it", _PARSING),
        "repeated-element": ErrorKind("a second <{element}> in <{parent}>", _PARSING),
        "stray-text": ErrorKind("text '{text}' stands where none is read", _PARSING),
        "duplicate-id": ErrorKind("<{element}>: the id '{id}' is taken", _PARSING),
        "utterance-too-long": ErrorKind("a text of more than {limit} characters", _PARSING, 413),
        "more-problems": ErrorKind("{number} more problems in this block", _PARSING),
        "unknown-behavior": ErrorKind(
            "<{element}> is no behavior of BML 1.0; known are {known}", WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED
        ),
        "unknown-reference": ErrorKind("no behavior '{behavior}' for {reference}; there are {known}", _SCHEDULE),
        "unknown-sync": ErrorKind("'{behavior}' has no sync point '{sync}' for {reference}; it has {known}", _SCHEDULE),
        # --- scheduling a block
        "duplicate-block": ErrorKind("a block with id '{block}' has not ended yet; this one is refused", _PARSING, 409),
        "too-many-blocks": ErrorKind("{limit} blocks are alive; this one is refused", _PARSING, 429),
        "unknown-character": ErrorKind(
            "no character '{character}'; there are {known}", WarningType.NO_SUCH_TARGET, 404
        ),
        "unknown-block": ErrorKind("no block '{block}' for {reference}: it is unknown or has ended", _SCHEDULE),
        "unknown-owner": ErrorKind(
            "'{block}' for {reference} is no behavior here, and no block, or one that has ended; there are {known}",
            _SCHEDULE,
        ),
        "contradictory-tie": ErrorKind("{tie} contradicts other constraints by {gap:g} s; it is dropped", _SCHEDULE),
        "outer-tie": ErrorKind("{tie} ties two times that both come from elsewhere; it is dropped", _SCHEDULE),
        "rigid": ErrorKind("{point} cannot be where {tie} wants it, {gap:g} s away; that tie is dropped", _SCHEDULE),
        "cyclic-reference": ErrorKind("{reference} hangs on the block '{block}' itself", _SCHEDULE),
        "mutual-reference": ErrorKind(
            "{reference} is not planned before '{block}': '{other}' names this one, itself or by way of others",
            _SCHEDULE,
        ),
        "unknown-target-block": ErrorKind("{attribute}: there never was a block '{block}'", _SCHEDULE),
        "not-awaited": ErrorKind(
            "'{block}' is not over: {behaviors} goes on until it is ended; nothing waits for that", _SCHEDULE
        ),
        "started-already": ErrorKind("'{block}' has started, and nothing comes before it; this one fails", _SCHEDULE),
        "cyclic-composition": ErrorKind(
            "'{block}' is to come before '{other}' and waits for it too; it fails", _SCHEDULE
        ),
        "unknown-procedure": ErrorKind(
            "no procedure '{procedure}'; there are {known}", WarningType.NO_SUCH_TARGET, 404
        ),
        "too-many-procedures": ErrorKind("{limit} procedures are defined; this one is refused", _PARSING, 429),
        "no-such-block": ErrorKind("there never was a block '{block}'", WarningType.NO_SUCH_TARGET, 404),
        "block-ended": ErrorKind("the block '{block}' has ended", _SCHEDULE, 410),
        "not-preplanned": ErrorKind("the block '{block}' is not preplanned: it starts without", _SCHEDULE),
        "activated-already": ErrorKind("the block '{block}' is activated already", _SCHEDULE),
        "no-such-behavior": ErrorKind("the block '{block}' has no behavior '{behavior}'", WarningType.NO_SUCH_TARGET),
        "behavior-ended": ErrorKind("'{behavior}' of the block '{block}' has ended", _SCHEDULE),
        "not-planned": ErrorKind("'{behavior}' of the block '{block}' is still being prepared", _SCHEDULE),
        "no-such-parameter": ErrorKind(
            "'{behavior}' has no parameter '{parameter}'; it has {known}", WarningType.NO_SUCH_TARGET
        ),
        "before-block": ErrorKind("it would have to start {early:g} s before its block", _SCHEDULE),
        "self-contradictory": ErrorKind(
            "this behavior is dropped: {tie} contradicts what else is said of it by {gap:g} s", _SCHEDULE
        ),
        "out-of-order": ErrorKind("this behavior is dropped: its {sync} would come {gap:g} s after {later}", _SCHEDULE),
        "too-short": ErrorKind("no time is left between its start and its end", _SCHEDULE),
        "no-order": ErrorKind("the strategy '{strategy}' keeps no before/after; '{text}' is dropped", _SCHEDULE),
        "clash": ErrorKind(
            "{what} is dropped: it cannot be kept together with {others}, {gap:g} s are missing", _SCHEDULE
        ),
        "never-holds": ErrorKind("{what} can never hold, {gap:g} s are missing; it is dropped", _SCHEDULE),
        "constraint-lost": ErrorKind("{constraint} cannot be kept any more: {gap:g} s are missing", _SCHEDULE),
        "names-dropped": ErrorKind("{constraint} names '{behavior}', which is dropped", _SCHEDULE),
        "lost-with": ErrorKind(
            "{reference} never comes, because '{behavior}' is dropped; what hangs on it is dropped, too", _SCHEDULE
        ),
        "dropped-tie": ErrorKind(
            "the behavior of {point} is dropped; this one keeps the time predicted last", _SCHEDULE
        ),
        "cut-tie": ErrorKind("{point} was interrupted; this behavior keeps the time predicted last", _SCHEDULE),
        "never-comes": ErrorKind("it hangs on {point}, which never comes; it is dropped", _SCHEDULE),
        "all-past": ErrorKind("it would have ended {late:g} s before its block starts", _SCHEDULE),
        "resource-taken": ErrorKind("{behavior} is dropped: {other} has the {resource}", _SCHEDULE),
        "not-supported": ErrorKind(
            "<{element}> is not realized; it is left out", WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED
        ),
        "foreign-not-supported": ErrorKind(
            "<{element}> of {namespace} is not realized; it is left out", WarningType.CUSTOM_BEHAVIOUR_NOT_SUPPORTED
        ),
        "foreign-attribute": ErrorKind(
            "the attribute {attribute} of {namespace} means nothing here", WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED
        ),
        "description-left-out": ErrorKind("a description of it is not played, but what comes next: {reason}", _CREATE),
        "overtaken": ErrorKind(
            "its sync points lost their order when they were moved: {sync} is at {time:g} s, {later} at {late:g} s",
            _SCHEDULE,
        ),
        "work-failed": ErrorKind("its preparation failed: {reason}", _CREATE),
        "never-moves": ErrorKind("still waiting for {waits} when nothing more could happen", _SCHEDULE),
        # --- playing
        "target-lost": ErrorKind(
            "the {hand} hand cannot follow '{target}' any further and stays where it is: {reason}", _PLAYING
        ),
        "gaze-short": ErrorKind(
            "it stays {angle:.0f} degrees beside its target: that is too far aside for what takes part in it", _PLAYING
        ),
        "gaze-near": ErrorKind("its target is too near to be looked at: the eyes go straight ahead", _PLAYING),
        "joints-left-out": ErrorKind(
            "{joints} are left out: what plays <{element}> does not turn them, or the figure cannot", _PLAYING
        ),
        "not-reachable": ErrorKind(
            "{joint} does not reach where {animation} wants it at phase {phase:.2f}: {distance:.2f} m are missing",
            _PLAYING,
        ),
        "unit-failed": ErrorKind("it failed while playing: {reason}", _PLAYING),
        "engine-failed": ErrorKind("the engine {engine} failed: {reason}", _PLAYING),
        "constraint-broken": ErrorKind("'{text}' is missed by {amount:g} s ({points}; thesis {equation})", _SCHEDULE),
        "too-many-rounds": ErrorKind("it did not come to rest within {limit} rounds of a tick", _PLAYING),
        # --- voices
        "voice-not-installed": ErrorKind("speech needs espeak-ng: pip install 'reactive-realizer[espeak]'", _CREATE),
        "unknown-voice": ErrorKind("no voice '{voice}'; there are en-us, en-gb, fr, nl ..., also en-us+f3", _CREATE),
        "nothing-to-say": ErrorKind("there is no word in its text", _CREATE),
        "voice-failed": ErrorKind("the process that speaks failed before it had spoken: {reason}", _CREATE),
        # --- assembling a scene
        "bad-human-file": ErrorKind("{file}: {key}: {reason}"),
        "no-plugin": ErrorKind("no '{name}' among the {group}; there are {known}"),
        "two-plugins": ErrorKind("'{name}' among the {group} is claimed by {known}"),
        "no-folder": ErrorKind("no folder {folder}"),
        "forbidden-path": ErrorKind("'{name}' is no name of an asset: it may not leave the folders", _CREATE, 400),
        "no-asset": ErrorKind("no file '{name}' among the assets", _CREATE, 404),
        "two-assets": ErrorKind("'{name}' is the name of several files among the assets: {known}", _CREATE, 409),
        "bad-number": ErrorKind("{name}={value} is not within {low:g} and {high:g}", None, 400),
        "bad-peak-name": ErrorKind(
            "'{name}' cannot name a peak: wanted is a letter, then letters, digits, '_', each name once"
        ),
        # --- making a behavior
        "no-motion-for": ErrorKind("nothing in the binding plays <{element}>{said}", _CREATE),
        "no-unit": ErrorKind("there is no motion unit '{unit}'", _CREATE),
        "no-file": ErrorKind("<{element}> needs a file, or the name of one", _CREATE),
        "wrong-element": ErrorKind("the motion unit '{unit}' does not play <{element}>", _CREATE),
        "not-a-flag": ErrorKind("{name}='{value}' is neither true nor false", _CREATE),
        "no-posture": ErrorKind("no pose '{lexeme}' of the {part} for one who is {stance}; there are {known}", _CREATE),
        "no-transition": ErrorKind("no transition is called '{kind}'; known are {known}", _CREATE),
        "no-face": ErrorKind("no face for the lexeme '{lexeme}'; known are {known}", _CREATE),
        "no-target": ErrorKind("no target '{target}' in the world; there are {known}", WarningType.NO_SUCH_TARGET),
        "bad-parameter": ErrorKind(
            "the parameter {name} is a number from {low:g} to {high:g}, which '{value}' is not", _CREATE
        ),
        "unknown-parameter": ErrorKind(
            "unknown parameter {names} of <{element}>; what plays it knows {known}",
            WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED,
        ),
        "not-pointable": ErrorKind("the {hand} hand cannot point at '{target}': {reason}", _CREATE),
        "no-joints": ErrorKind("this figure has no {joints}, which <{element}> needs", _CREATE),
        # --- avatars, bindings, animations
        "bad-avatar": ErrorKind("{file} is no usable avatar: {reason}"),
        "bad-asset": ErrorKind("{file}, line {row}, <{element}>: {reason}", _CREATE),
        "asset-too-big": ErrorKind("{file} has {size} bytes, the limit is {limit}", _CREATE),
        "bad-expression": ErrorKind("{reason} at character {at} of '{expression}'", _CREATE),
        "bad-capture": ErrorKind("{file}, line {row}: {reason}", _CREATE),
        "bad-keys": ErrorKind("{animation}: {reason}", _CREATE),
        "no-motion": ErrorKind("{animation} gives no pose at phase {phase:g}: {reason}", _PLAYING),
        "none-turned": ErrorKind("{animation} turns none of {joints}; it turns {known}", _CREATE),
        "bad-pose": ErrorKind("its motion asks {what} for {value}, which cannot be", _PLAYING),
        # --- the peg board
        "no-point": ErrorKind("there is no point {point}", None, 404),
        "point-pinned": ErrorKind("{point} stays at {time}: it has been reached, or hangs on nothing", None, 409),
        "no-single-source": ErrorKind("{point} is moved by several points together: {rule}", None, 409),
        "out-of-reach": ErrorKind(
            "{point} does not come to {time:g} s by {source}: it would be at {reached}", None, 409
        ),
        # --- changing parameters
        "no-trajectory": ErrorKind("no trajectory '{trajectory}'; known are {known}", _CREATE),
        "parameter-range": ErrorKind(
            "the {parameter} of '{behavior}' is from {low:g} to {high:g}, and {value:g} is not within", _PLAYING
        ),
        # --- sessions and their recordings
        "never-enters": ErrorKind("{file} does not enter: the session ended at {end:g} s, before {time:g} s"),
        "bad-recording": ErrorKind("{file}, line {row}: {reason}"),
        "not-recorded": ErrorKind("a message of type {type} is no input of a recorded session"),
        "lost-input": ErrorKind("input {seq} stands where input {wanted} was to come"),
        "ticks-out-of-order": ErrorKind("tick {tick} stands after tick {last}"),
        "replay-differs": ErrorKind(
            "at {time:g} s the recording goes on with work {request}, which is not there in this replay: files or "
            "versions are others than they were"
        ),
        # --- trying a realizer
        "not-reached": ErrorKind("no realizer at {url}: {reason}"),
        "other-protocol": ErrorKind("{url} does not speak protocol {protocol}: its first message is {message}"),
        # --- the server
        "bad-json": ErrorKind("not JSON: {reason}", None, 400),
        "binary-message": ErrorKind("messages are JSON text; binary data are not read", None, 400),
        "unknown-message": ErrorKind("no message has the type {type}; known are {known}", None, 400),
        "bad-message": ErrorKind("{place}: {value} does not keep to {rule}", None, 400),
        "bad-request": ErrorKind("not a request that is understood here: {reason}", None, 400),
        "bad-query": ErrorKind("{name}={value} is not read; wanted is {wanted}", None, 400),
        "unknown-event": ErrorKind("'{anticipator}' knows no event {event}; known are {known}", None, 400),
        "unknown-anticipator": ErrorKind("no anticipator '{anticipator}'; there are {known}", None, 404),
        "predicts-itself": ErrorKind(
            "'{anticipator}' is a {kind}, which makes its own predictions and takes none", None, 409
        ),
        "not-movable": ErrorKind("'{target}' is a character, not a target that is moved", None, 400),
        "too-many-names": ErrorKind("there are {limit} {things}, and no more are made", None, 429),
        "no-demo": ErrorKind("there is no performance here", None, 404),
        "no-clip": ErrorKind("no sound '{clip}', or not any more", None, 404),
        "no-page": ErrorKind("the page has not been built: make page", None, 503),
        "nothing-there": ErrorKind("there is nothing at {path}", None, 404),
        "wrong-method": ErrorKind("{path} does not take {method}", None, 405),
        "wrong-media-type": ErrorKind("BML comes as application/xml or text/xml, not as {type}", None, 415),
        "wrong-charset": ErrorKind("BML comes in UTF-8, UTF-16, ISO-8859-1 or US-ASCII, not in {charset}", None, 415),
        "no-token": ErrorKind("the token of the server is wanted, and was not given or is another", None, 401),
        "foreign-host": ErrorKind("the host {host} is not one of this server", None, 403),
        "foreign-origin": ErrorKind("pages from {origin} are not let in; --allow-origin does that", None, 403),
        "too-many-clients": ErrorKind("{limit} clients are connected, and no more are let in", None, 503),
        "too-many-messages": ErrorKind("more than {limit} messages a second", None, 429, 1008),
        "too-slow": ErrorKind("too much has piled up for this client; it may resume by after={seq}", close=1013),
        "feedback-gone": ErrorKind("feedback up to {seq} is not kept any more"),
        "going-away": ErrorKind("the server ends", close=1001),
    }
)


@dataclass(frozen=True, slots=True)
class Fault:
    """One thing that went wrong, as data.

    Attributes:
        code: a key of `ERRORS`.
        details: what its sentence mentions.
        line: 1-based line of the element in its document, None where there is no document.
        column: 1-based column of the element's start tag.
    """

    code: str
    details: Mapping[str, object] = field(default_factory=dict)
    line: int | None = None
    column: int | None = None

    @property
    def kind(self) -> ErrorKind:
        """The row of the table."""
        return ERRORS[self.code]

    @property
    def sentence(self) -> str:
        """What happened, for people, without the place."""
        return self.kind.sentence.format(**self.details)

    def located(self, line: int, column: int) -> "Fault":
        """This fault with a place, unless it has one."""
        return self if self.line is not None else replace(self, line=line, column=column)

    def __str__(self) -> str:
        place = "" if self.line is None else f"line {self.line}, column {self.column}: "
        return place + self.sentence


class RealizerError(Exception):
    """Carries a fault to whoever reports it."""

    def __init__(self, fault: Fault) -> None:
        super().__init__(str(fault))
        self.fault = fault


def error(code: str, *, line: int | None = None, column: int | None = None, **details: object) -> RealizerError:
    """A `RealizerError` for a code of the table."""
    return RealizerError(Fault(code, details, line, column))
