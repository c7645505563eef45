"""Feedback on behaviors as messages of the Virtual Human Toolkit."""

from enum import StrEnum
from types import MappingProxyType
from typing import Final

from lxml import etree

from reactive_realizer.client.vh_message import VhMessage


class FeedbackForm(StrEnum):
    """The form in which a bridge sends feedback on behaviors: none, that of BML 1.0, or that of SmartBody."""

    NONE = "none"
    BML = "bml"
    SMARTBODY = "smartbody"


_POINTS: Final = MappingProxyType({"strokeStart": "stroke_start", "strokeEnd": "stroke_end"})
"""SmartBody's names of sync points, where they differ."""


def feedback_message(form: FeedbackForm, feedback: etree._Element, agent: str) -> VhMessage | None:
    """The message for feedback of a request to an agent; None if this form has none."""
    match form:
        case FeedbackForm.BML:
            return VhMessage(etree.tostring(feedback, encoding="unicode"))
        case FeedbackForm.SMARTBODY:
            return _as_smartbody(feedback, agent)
        case FeedbackForm.NONE:
            return None


def _as_smartbody(feedback: etree._Element, agent: str) -> VhMessage | None:
    id_, _, point = feedback.get("id", "").rpartition(":")
    match etree.QName(feedback).localname:
        case "blockProgress" if point in ("start", "end"):
            kind = f"block{point}"
        case "syncPointProgress":
            kind, id_ = "syncpointprogress", f"{id_}:{_POINTS.get(point, point)}"
        case _:
            return None
    element = etree.Element(kind, characterId=agent, id=id_, time=feedback.get("globalTime", ""))
    return VhMessage(etree.tostring(element, encoding="unicode"))
