"""What all behaviors have in common."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar

from reactive_realizer.bml.attribute_types import Integer, Name, Text
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.bml.sync_ref import SyncRef

SyncPoints = tuple[str, ...]
"""Names of sync points, in the order in which they are reached."""

_PRIORITIES = 1_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Description:
    """Another form of the same behavior, in the language of some realizer.

    Attributes:
        priority: the highest one whose type is known is played in place of the core behavior.
        type: name of its language, such as ``application/ssml+xml``.
        content: what stands inside, as XML.
        behavior: what that says, if it is a behavior of a namespace that is known here.
    """

    priority: int = field(metadata=attribute(Integer(-_PRIORITIES, _PRIORITIES)))
    type: str = field(metadata=attribute(Text()))
    content: str
    behavior: "Behavior | None" = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Behavior:
    """One behavior of a block, as it was written.

    Attributes:
        id: unique in its block.
        namespace: that of its element; the core's for documents without any.
        name: local name of its element.
        location: of its start tag.
        order: its place among the behaviors of its block, in document order, from 0.
        syncs: the constrained sync points and what they are tied to, in order of writing.
        required: whether the block fails without it.
        persistent: whether it goes on until another one takes its place; only in drafts, and not of every kind.
        descriptions: its other forms, as written.
        instead_of: of a form that describes another behavior, the sync points of that one, which it must have too.
        extensions: attributes of other namespaces, (namespace, local name) to value.
        parameters: what else it says to what plays it, by ``bmlt:parameter`` (thesis C.1.1): name to value.
        source: its own element as XML.
    """

    NAMESPACE: ClassVar[str] = BML
    CHILDREN: ClassVar[tuple[str, ...]] = ()
    SYNC_POINTS: ClassVar[SyncPoints] = ()
    OPEN_POINTS: ClassVar[bool] = False
    """Whether what plays it may know further sync points: references to those are judged when it is planned."""

    id: str = field(metadata=attribute(Name()))
    namespace: str
    name: str
    location: Location
    order: int
    syncs: Mapping[str, SyncRef] = field(default_factory=dict)
    required: bool = False
    persistent: bool = False
    descriptions: tuple[Description, ...] = ()
    instead_of: SyncPoints = ()
    extensions: Mapping[tuple[str, str], str] = field(default_factory=dict)
    parameters: Mapping[str, str] = field(default_factory=dict)
    source: str = ""

    @property
    def sync_points(self) -> SyncPoints:
        """All its sync points, in the order in which they are reached."""
        return self.SYNC_POINTS

    @classmethod
    def tied_by(cls, values: Mapping[str, object]) -> SyncPoints:
        """Of one with these values, by field: the sync points that attributes of its element may tie."""
        return cls.SYNC_POINTS

    @classmethod
    def tied(cls, syncs: Mapping[str, SyncRef], namespace: str) -> Mapping[str, SyncRef]:
        """What the points of one of a namespace are tied to, if that is what is written of them."""
        return syncs

    @property
    def forms(self) -> "tuple[Behavior, ...]":
        """What may be played for it, the best first: its descriptions by priority, then itself."""
        if not self.descriptions:
            return (self,)
        described = sorted((each for each in self.descriptions if each.behavior), key=lambda each: -each.priority)
        return (*(self._told_by(each.behavior) for each in described if each.behavior), self)

    def _told_by(self, form: "Behavior") -> "Behavior":
        """A form of it: when it is and what hangs on it, the behavior itself says."""
        return replace(
            form,
            id=self.id,
            location=self.location,
            order=self.order,
            syncs=self.syncs,
            required=self.required,
            instead_of=self.sync_points,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class ForeignBehavior(Behavior):
    """A behavior of another namespace than BML's; whoever realizes that namespace knows what it means.

    Attributes:
        attributes: un-namespaced ones other than its id and sync points, as written.
        children: what stands inside its element, as XML.
    """

    SYNC_POINTS = ("start", "ready", "strokeStart", "attackPeak", "stroke", "strokeEnd", "relax", "end")
    OPEN_POINTS = True

    attributes: Mapping[str, str] = field(default_factory=dict)
    children: str = ""

    @property
    def sync_points(self) -> SyncPoints:
        """Start, end, and those that are constrained; its realizer may know more."""
        return tuple(name for name in self.SYNC_POINTS if name in {"start", "end", *self.syncs})
