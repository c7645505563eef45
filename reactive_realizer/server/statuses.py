"""HTTP statuses and WebSocket close codes of the faults that end a request or a connection."""

from collections.abc import Mapping
from http import HTTPStatus
from typing import Final

from aiohttp import WSCloseCode

from reactive_realizer.assembly.faults import TwoAssets
from reactive_realizer.binding.faults import NoAsset
from reactive_realizer.bml.faults import TooDeep, TooManyAttributes, TooManyBehaviors, TooManyBytes, TooManyRoots
from reactive_realizer.bml.speech_faults import UtteranceTooLong
from reactive_realizer.errors import Fault
from reactive_realizer.pegboard.anticipator import PredictsItself
from reactive_realizer.pegboard.pegboard import NoPoint
from reactive_realizer.realizer.inbox import TooManyNames
from reactive_realizer.scheduler.admission import (
    DuplicateBlock,
    TooManyBlocks,
    TooManyLiveBehaviors,
    TooManyOfOne,
    TooManyProcedures,
    UnknownCharacter,
    UnknownProcedure,
)
from reactive_realizer.scheduler.blocks import BlockEnded, NoSuchBlock
from reactive_realizer.server.faults import (
    ForeignHost,
    ForeignOrigin,
    ForeignPage,
    GoingAway,
    NoClip,
    NoDemo,
    NoPage,
    NothingThere,
    NoToken,
    SlowRequest,
    StandsStill,
    TooManyClients,
    TooManyValues,
    TooSlow,
    UnknownAnticipator,
    WrongCharset,
    WrongMediaType,
    WrongMethod,
)

STATUSES: Final[Mapping[HTTPStatus, tuple[type[Fault], ...]]] = {
    HTTPStatus.UNAUTHORIZED: (NoToken,),
    HTTPStatus.FORBIDDEN: (ForeignHost, ForeignOrigin, ForeignPage),
    HTTPStatus.NOT_FOUND: (
        NothingThere,
        NoAsset,
        NoClip,
        NoDemo,
        NoPoint,
        NoSuchBlock,
        UnknownAnticipator,
        UnknownCharacter,
        UnknownProcedure,
    ),
    HTTPStatus.METHOD_NOT_ALLOWED: (WrongMethod,),
    HTTPStatus.REQUEST_TIMEOUT: (SlowRequest,),
    HTTPStatus.CONFLICT: (DuplicateBlock, PredictsItself, TwoAssets),
    HTTPStatus.GONE: (BlockEnded,),
    HTTPStatus.REQUEST_ENTITY_TOO_LARGE: (
        TooManyBytes,
        TooDeep,
        TooManyAttributes,
        TooManyRoots,
        TooManyBehaviors,
        TooManyValues,
        UtteranceTooLong,
    ),
    HTTPStatus.UNSUPPORTED_MEDIA_TYPE: (WrongMediaType, WrongCharset),
    HTTPStatus.TOO_MANY_REQUESTS: (
        TooManyBlocks,
        TooManyLiveBehaviors,
        TooManyNames,
        TooManyOfOne,
        TooManyProcedures,
    ),
    HTTPStatus.SERVICE_UNAVAILABLE: (GoingAway, NoPage, StandsStill, TooManyClients),
}
"""The kinds of fault by the status that answers a request; for all others, it is 400."""

CLOSE_CODES: Final[Mapping[type[Fault], WSCloseCode]] = {
    GoingAway: WSCloseCode.GOING_AWAY,
    TooSlow: WSCloseCode.TRY_AGAIN_LATER,
}
"""The close codes of the faults that end the connection of a socket."""

_STATUS_OF: Final = {kind: status for status, kinds in STATUSES.items() for kind in kinds}


def status_of(fault: Fault) -> HTTPStatus:
    """The status that answers a request that caused a fault."""
    return _STATUS_OF.get(type(fault), HTTPStatus.BAD_REQUEST)
