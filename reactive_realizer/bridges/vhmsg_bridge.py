"""Passes requests of the Virtual Human Toolkit on to a realizer, and reports their progress."""

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from lxml import etree

from reactive_realizer.bridges.vhmsg_feedback import FeedbackForm, feedback_message
from reactive_realizer.bridges.vhmsg_messages import Act
from reactive_realizer.bridges.vhmsg_pawns import Pawn
from reactive_realizer.client.vh_message import VhMessage
from reactive_realizer.errors import quoted

logger = logging.getLogger(__name__)

NAME: Final = "reactive-realizer"
"""The name of this component for the toolkit."""
_ALL: Final = "all"
_OUTCOMES: Final = {"DONE": "complete", "INTERRUPTED": "interrupted", "REVOKED": "interrupted", "FAILED": "error"}
"""Of a request, by the status with which its blocks end; the worst one counts."""
_WORST: Final = ("error", "interrupted", "complete")
_EVENT: Final = "{urn:reactive-realizer:1}event"
_BMLA: Final = "{http://www.asap-project.org/bmla}"

Request = dict[str, object]
"""A message to the realizer."""


@dataclass(slots=True)
class _Played:
    """A request whose blocks are not over.

    Attributes:
        act: the request.
        left: ids of its blocks that have not ended.
        started: whether one of them has started.
        outcomes: of the blocks that have ended.
    """

    act: Act
    left: set[str]
    started: bool = False
    outcomes: list[str] = field(default_factory=list)


class VhmsgBridge:
    """Translates between the toolkit and a realizer. It does no input or output itself.

    Args:
        characters: of the realizer, by the names of agents.
        send: sends a message to the toolkit.
        form: of feedback on behaviors.
        unit: of lengths in commands of the toolkit, m.
    """

    def __init__(
        self,
        characters: Mapping[str, str],
        send: Callable[[VhMessage], object],
        form: FeedbackForm = FeedbackForm.NONE,
        unit: float = 1.0,
    ) -> None:
        self._form = form
        self._unit = unit
        self._pawns: dict[str, Pawn] = {}
        self._characters = characters
        self._send = send
        self._played: dict[str, _Played] = {}
        self._unknown: set[str] = set()

    def announce(self) -> None:
        """Tell the toolkit that this component is there."""
        self._send(VhMessage("vrComponent", f"{NAME} {_ALL}"))

    def take(self, message: VhMessage) -> Request | None:
        """Take a message of the toolkit; what the realizer is to be sent, if anything."""
        if message.word == "vrAllCall":
            self.announce()
        try:
            pawn = Pawn.of(message)
        except ValueError as problem:
            logger.warning("a pawn cannot be placed: %s: %s", problem, quoted(message.argument))
            return None
        if pawn is not None:
            return self._place(pawn)
        act = Act.of(message)
        if act is None:
            if message.word == "vrSpeak":
                logger.warning("a vrSpeak needs an agent, a recipient, a name and BML: %s", quoted(message.argument))
            return None
        character = self._characters.get(act.agent)
        if character is None:
            self._note_unknown(act.agent)
            return None
        try:
            text, ids = act.document(character, self._played)
        except ValueError as problem:
            self._send(act.failed(str(problem)))
            return None
        self._played |= dict.fromkeys(ids, _Played(act, set(ids)))
        return {"type": "bml", "xml": text, "ref": ids[0]}

    def _place(self, pawn: Pawn) -> Request:
        self._pawns[pawn.name] = placed = pawn.after(self._pawns.get(pawn.name))
        return {"type": "world", "set": {pawn.name: placed.place(self._unit)}}

    def report(self, message: Mapping[str, Any]) -> None:
        """Take a message of the realizer, and report it."""
        match message:
            case {"type": "feedback", "xml": str(xml)}:
                self._report_feedback(etree.fromstring(xml))
            case {"type": "error", "ref": str(ref), "message": str(reason), **rest} if ref in self._played:
                self._report_failure(self._played[ref], reason, set(rest.get("blocks", ())))

    def _report_feedback(self, feedback: etree._Element) -> None:
        id_ = feedback.get("id") or next((block.get("id", "") for block in feedback), "")
        block, _, point = id_.partition(":")
        played = self._played.get(block)
        if played is None:
            return
        if (detail := feedback_message(self._form, feedback, played.act.agent)) is not None:
            self._send(detail)
        kind = etree.QName(feedback).localname
        if kind == "blockProgress" and point == "start" and not played.started:
            played.started = True
            self._send(played.act.started())
        elif kind == "blockProgress" and point == "end":
            played.outcomes.append(_OUTCOMES.get(feedback.get(f"{_BMLA}status", ""), "error"))
            self._end(played, {block})
        for event in feedback.iter(_EVENT):
            self._send(VhMessage(event.get("name", ""), event.text or ""))

    def _report_failure(self, played: _Played, reason: str, accepted: set[str]) -> None:
        self._send(played.act.failed(reason))
        self._end(played, played.left - accepted)

    def _end(self, played: _Played, blocks: set[str]) -> None:
        """Note that blocks have ended, or will not begin; the end of the last one is that of the request."""
        for block in blocks:
            del self._played[block]
        played.left -= blocks
        if not played.left and played.outcomes:
            self._send(played.act.ended(min(played.outcomes, key=_WORST.index)))

    def _note_unknown(self, agent: str) -> None:
        """Say once that requests to an agent are left to other components."""
        if agent not in self._unknown:
            self._unknown.add(agent)
            logger.warning("requests to the agent '%s' are ignored: the scene has no such character", agent)


def ends(message: VhMessage) -> bool:
    """Return whether a message asks this component to end."""
    return message.word == "vrKillComponent" and message.argument.strip() in (_ALL, NAME)
