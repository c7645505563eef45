"""POSIX times in feedback: what planners without a realizer clock compare with (BMLA, AsapRealizer)."""

from lxml import etree

from reactive_realizer.bml.names import BML, BMLA
from reactive_realizer.feedback.feedback_manager import Report

etree.register_namespace("bmla", BMLA)  # what lxml calls it where the document does not say

_STAMPS = {"globalTime": "posixTime", "globalStart": "posixStartTime", "globalEnd": "posixEndTime"}
"""A global time (s) -> the attribute that says the same as POSIX time (ms)."""


def with_posix_times(report: Report, epoch: float) -> str:
    """The XML of a report with the POSIX time beside every global time that it names.

    Args:
        report: what is told.
        epoch: POSIX time (s) of global time 0.
    """
    element = etree.fromstring(report.xml)
    for part in (element, *element.iterchildren(f"{{{BML}}}bml")):
        for seconds, stamp in _STAMPS.items():
            time = part.get(seconds)
            if time is not None:
                part.set(f"{{{BMLA}}}{stamp}", str(round(1000 * (epoch + float(time)))))
    return etree.tostring(element, encoding="unicode")
