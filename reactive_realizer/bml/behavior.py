"""The base class of behaviors."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar

from reactive_realizer.bml.attribute_types import Id, Integer, Text
from reactive_realizer.bml.attributes import attribute
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.bml.sync_ref import SyncRef

SyncPoints = tuple[str, ...]
"""Names of sync points, in the order of time."""

_PRIORITIES = 1_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Description:
    """A description level: another form of the same behavior, in a language that not all realizers support.

    Attributes:
        priority: the known one with the highest priority is played instead of the core behavior.
        type: name of its language, such as ``application/ssml+xml``.
        content: as XML.
        behavior: the behavior in the content, if its namespace is known.
    """

    priority: int = field(metadata=attribute(Integer(-_PRIORITIES, _PRIORITIES)))
    type: str = field(metadata=attribute(Text()))
    content: str
    behavior: "Behavior | None" = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Behavior:
    """One behavior of a block, as written.

    Attributes:
        id: unique in its block.
        namespace: of its element; BML 1.0's for documents without any.
        name: local name of its element.
        location: of its start tag.
        order: its index among the behaviors of its block, in document order.
        syncs: the reference of each constrained sync point, in the order of writing.
        required: whether the block fails without it.
        persistent: whether it lasts until it is interrupted or replaced: gazes, postures and noise of drafts,
            controllers, and loops can.
        descriptions: its description levels, as written.
        instead_of: in a description, the sync points of the core behavior, which it must have too; otherwise empty.
        extensions: attributes of other namespaces, (namespace, local name) to value.
        parameters: its ``bmlt:parameter`` elements (thesis C.1.1), name to value.
        source: its element as XML; empty if it was read from another language, unless it is long.
    """

    NAMESPACE: ClassVar[str] = BML
    CHILDREN: ClassVar[tuple[str, ...]] = ()
    SYNC_POINTS: ClassVar[SyncPoints] = ()
    OPEN_POINTS: ClassVar[bool] = False
    """Whether an engine may define further sync points; planning then checks references to them."""
    ANY_CONTENT: ClassVar[bool] = False
    """Whether its element may contain anything; then it has no descriptions and no parameters."""

    id: str = field(metadata=attribute(Id()))
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
        """All its sync points, in the order of time."""
        return self.SYNC_POINTS

    @property
    def open_points(self) -> bool:
        """Whether its engine may define further sync points."""
        return self.OPEN_POINTS

    @classmethod
    def complete_syncs(
        cls, syncs: Mapping[str, SyncRef], values: Mapping[str, object], namespace: str
    ) -> Mapping[str, SyncRef]:
        """The references of the sync points of a behavior, from those that are written.

        Args:
            syncs: as written.
            values: of its other attributes, by field.
            namespace: of its element.

        Raises:
            RealizerError: they contradict its other attributes.
        """
        return syncs

    @property
    def forms(self) -> "tuple[Behavior, ...]":
        """The behaviors that may be played for it, best first: its descriptions by priority, then itself."""
        if not self.descriptions:
            return (self,)
        described = sorted((each for each in self.descriptions if each.behavior), key=lambda each: -each.priority)
        return (*(self._described_by(each.behavior) for each in described if each.behavior), self)

    def _described_by(self, form: "Behavior") -> "Behavior":
        """A description with the id, the constraints and the place of the behavior itself."""
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
    """A behavior in a namespace other than BML's, for an engine that supports that namespace.

    Attributes:
        attributes: its attributes without a namespace, except its id and sync points.
        children: the content of its element as XML.
    """

    SYNC_POINTS = ("start", "ready", "strokeStart", "attackPeak", "stroke", "strokeEnd", "relax", "end")
    OPEN_POINTS = True

    attributes: Mapping[str, str] = field(default_factory=dict)
    children: str = ""

    @property
    def sync_points(self) -> SyncPoints:
        """Start, end, and the constrained ones; its engine may define more."""
        return tuple(name for name in self.SYNC_POINTS if name in {"start", "end", *self.syncs})
