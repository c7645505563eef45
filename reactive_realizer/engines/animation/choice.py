"""A motion that could play a behavior."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from reactive_realizer.engines.animation.motion_unit import MotionUnit


@dataclass(frozen=True, slots=True)
class Choice:
    """One motion that could play a behavior; the binding may know several.

    Attributes:
        motion: not begun.
        names: name of a parameter in BML -> the motion's own, of those that may be changed.
        group: the replacement group that the behavior or the binding names, None for the motion's own.
        yields: whether others of its group may take its place while it plays.
    """

    motion: MotionUnit
    names: Mapping[str, str] = field(default_factory=dict)
    group: str | None = None
    yields: bool = False
