"""The behaviors of continuous interaction, which act on other blocks and behaviors (BMLA; thesis 6.6 and app. C).

BMLA and BMLT write them alike.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import ClassVar

from reactive_realizer.bml.attribute_types import BehaviorName, Name, Names, Number, Text, Word
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.behavior import Behavior, SyncPoints
from reactive_realizer.bml.names import BMLA, BMLT
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.words import InterruptSpeech

_EVENT_POINTS: SyncPoints = ("start", "end")


@dataclass(frozen=True, slots=True, kw_only=True)
class Activate(Behavior):
    """Starts a block that was planned ahead (thesis 6.6.1).

    Attributes:
        target: id of the block.
    """

    NAMESPACE = BMLA
    SYNC_POINTS = _EVENT_POINTS

    target: str = field(metadata=attribute(Name()))


@dataclass(frozen=True, slots=True, kw_only=True)
class Interrupt(Behavior):
    """Breaks off a block, or some of its behaviors (thesis 6.6.3).

    Attributes:
        target: id of the block.
        include: the behaviors that are interrupted; none means all.
        exclude: those that are not.
        speech: where a speech among them ends.
    """

    NAMESPACE = BMLA
    SYNC_POINTS = _EVENT_POINTS

    target: str = field(metadata=attribute(Name()))
    include: tuple[str, ...] = field(default=(), metadata=attribute(Names()))
    exclude: tuple[str, ...] = field(default=(), metadata=attribute(Names()))
    speech: InterruptSpeech = field(default=InterruptSpeech.NOW, metadata=attribute(Word(InterruptSpeech)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Trajectory:
    """How a parameter gets to its value.

    Attributes:
        type: by name: linear, instant, or one that somebody registered.
        target_value: where it ends, in the unit of the parameter.
        initial_value: where it begins; None is the value that the parameter has then.
    """

    type: str = field(metadata=attribute(Text()))
    target_value: float = field(metadata=attribute(Number()))
    initial_value: float | None = field(default=None, metadata=attribute(Number()))


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterValueChange(Behavior):
    """Changes a parameter of a behavior while it plays (thesis 6.6.6).

    The target value is reached at stroke, as BMLT calls it, which is its end.

    Attributes:
        target: the behavior, with its block before it where that is another one: ``b1:speech1``.
        parameter: name of the parameter, such as volume.
        trajectory: from value to value.
    """

    NAMESPACE = BMLA
    CHILDREN: ClassVar = ("trajectory",)
    SYNC_POINTS = ("start", "stroke", "end")

    target: str = field(metadata=attribute(BehaviorName()))
    parameter: str = field(metadata=attribute(Text(), "paramId"))
    trajectory: Trajectory

    @classmethod
    def tied(cls, syncs: Mapping[str, SyncRef], namespace: str) -> Mapping[str, SyncRef]:
        """BMLT's stroke and its end are one point: where only the end is tied, the stroke is tied with it."""
        if namespace != BMLT or "stroke" in syncs or "end" not in syncs:
            return syncs
        return MappingProxyType({**syncs, "stroke": syncs["end"]})

    @property
    def target_block(self) -> str | None:
        """Id of the block of the target; None for its own."""
        return self.target.rpartition(":")[0] or None

    @property
    def target_behavior(self) -> str:
        """Id of the target in its block."""
        return self.target.rpartition(":")[2]
