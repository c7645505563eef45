"""Faults of scheduling: blocks that are refused, constraints and behaviors that are dropped."""

from reactive_realizer.errors import (
    CreationFault,
    Fault,
    ParsingFault,
    PlayingFault,
    SchedulingFault,
    TargetFault,
    WarningType,
)


class DuplicateBlock(ParsingFault):
    """A block with the id of one that has not ended."""

    code = "duplicate-block"
    template = "there is already a block '{block}' that has not ended; this one is refused"
    block: str


class TooManyBlocks(ParsingFault):
    """A block over the limit of live blocks."""

    code = "too-many-blocks"
    template = "the limit of {limit} live blocks is reached; this one is refused"
    limit: int


class TooManyProcedures(ParsingFault):
    """A procedure over the limit."""

    code = "too-many-procedures"
    template = "the limit of {limit} procedures is reached; this one is refused"
    limit: int


class UnknownCharacter(TargetFault):
    """No character has the id."""

    code = "unknown-character"
    template = "there is no character '{character}'; available: {known}"
    character: str
    known: tuple[str, ...]


class UnknownProcedure(TargetFault):
    """No procedure has the id."""

    code = "unknown-procedure"
    template = "there is no procedure '{procedure}'; available: {known}"
    procedure: str
    known: tuple[str, ...]


class NoSuchBlock(TargetFault):
    """No block ever had the id."""

    code = "no-such-block"
    template = "there has never been a block '{block}'"
    block: str


class BlockEnded(SchedulingFault):
    """A block that has ended."""

    code = "block-ended"
    template = "the block '{block}' has ended"
    block: str


class NoSuchBehavior(TargetFault):
    """No behavior of a block has the id."""

    code = "no-such-behavior"
    template = "the block '{block}' has no behavior '{behavior}'"
    block: str
    behavior: str


class BehaviorEnded(SchedulingFault):
    """A behavior that has ended."""

    code = "behavior-ended"
    template = "'{behavior}' of the block '{block}' has ended"
    block: str
    behavior: str


class NotPlanned(SchedulingFault):
    """A behavior without a plan."""

    code = "not-planned"
    template = "'{behavior}' of the block '{block}' is still being prepared"
    block: str
    behavior: str


class NoSuchParameter(TargetFault):
    """No parameter of a behavior has the name."""

    code = "no-such-parameter"
    template = "'{behavior}' has no parameter '{parameter}'; it has {known}"
    behavior: str
    parameter: str
    known: tuple[str, ...]


class UnknownTargetBlock(SchedulingFault):
    """An attribute that names a block that never existed."""

    code = "unknown-target-block"
    template = "{attribute}: there has never been a block '{block}'"
    attribute: str
    block: str


class NotAwaited(SchedulingFault):
    """A block with a behavior that has no end of its own."""

    code = "not-awaited"
    template = (
        "'{block}' has not ended, because {behaviors} lasts until something ends it; this block does not wait for that"
    )
    block: str
    behaviors: str


class StartedAlready(SchedulingFault):
    """A block put before one that has started."""

    code = "started-already"
    template = "'{block}' has already started, so nothing can be put before it; this block fails"
    block: str


class CyclicComposition(SchedulingFault):
    """A block put before one that it waits for."""

    code = "cyclic-composition"
    template = "'{block}' should come before '{other}' but also waits for it; it fails"
    block: str
    other: str


class NotPreplanned(SchedulingFault):
    """An activation of a block that is not preplanned."""

    code = "not-preplanned"
    template = "the block '{block}' is not preplanned, so it starts without activation"
    block: str


class ActivatedAlready(SchedulingFault):
    """A second activation of a block."""

    code = "activated-already"
    template = "the block '{block}' has already been activated"
    block: str


class CyclicReference(SchedulingFault):
    """A reference to a point that depends on the block itself."""

    code = "cyclic-reference"
    template = "{reference} depends on the block '{block}' itself"
    reference: str
    block: str


class MutualReference(SchedulingFault):
    """A reference to a block that refers back to this one."""

    code = "mutual-reference"
    template = (
        "{reference}: '{other}' is not planned before '{block}', because it refers to it directly or through "
        "other blocks"
    )
    reference: str
    other: str
    block: str


class ContradictoryTie(SchedulingFault):
    """A constraint that contradicts others; ``gap`` in s."""

    code = "contradictory-tie"
    template = "{tie} contradicts other constraints by {gap:g} s and is dropped"
    tie: str
    gap: float


class OuterTie(SchedulingFault):
    """A constraint between two times that are both set outside the block."""

    code = "outer-tie"
    template = "{tie} is dropped: both of its times are set elsewhere"
    tie: str


class Rigid(SchedulingFault):
    """A constraint on a point that cannot move; ``gap`` in s."""

    code = "rigid"
    template = "{tie} is dropped: {point} cannot be moved by the {gap:g} s that it requires"
    tie: str
    point: str
    gap: float


class BeforeBlock(SchedulingFault):
    """A behavior that would start before its block; ``early`` in s."""

    code = "before-block"
    template = "it would have to start {early:g} s before its block"
    early: float


class SelfContradictory(SchedulingFault):
    """A behavior whose own constraints contradict each other; ``gap`` in s."""

    code = "self-contradictory"
    template = "this behavior is dropped: {tie} contradicts its other constraints by {gap:g} s"
    tie: str
    gap: float


class OutOfOrder(SchedulingFault):
    """A behavior with sync points in the wrong order; ``gap`` in s."""

    code = "out-of-order"
    template = "this behavior is dropped: its {sync} would come {gap:g} s after its {later}"
    sync: str
    later: str
    gap: float


class NoOrder(SchedulingFault):
    """A before/after constraint under a strategy that does not keep them."""

    code = "no-order"
    template = "the strategy '{strategy}' does not support before/after constraints; '{text}' is dropped"
    strategy: str
    text: str


class Conflicting(SchedulingFault):
    """A constraint or behavior that conflicts with others; ``gap`` in s."""

    code = "clash"
    template = "{what} is dropped: it conflicts with {others} by {gap:g} s"
    what: str
    others: str
    gap: float


class NeverHolds(SchedulingFault):
    """A constraint or behavior that is impossible by itself; ``gap`` in s."""

    code = "never-holds"
    template = "{what} can never be satisfied and is dropped: it is off by {gap:g} s"
    what: str
    gap: float


class ConstraintLost(SchedulingFault):
    """A constraint that stopped holding after a change; ``gap`` in s."""

    code = "constraint-lost"
    template = "{constraint} no longer holds: it is off by {gap:g} s"
    constraint: str
    gap: float


class ConstraintBroken(SchedulingFault):
    """A constraint that a plan misses, found by ``--verify``; ``amount`` in s."""

    code = "constraint-broken"
    template = "'{text}' is missed by {amount:g} s ({points}; thesis {equation})"
    text: str
    amount: float
    points: str
    equation: str


class NamesDropped(SchedulingFault):
    """A constraint on a behavior that was dropped."""

    code = "names-dropped"
    template = "{constraint} refers to '{behavior}', which is dropped"
    constraint: str
    behavior: str


class DroppedTie(SchedulingFault):
    """A point whose behavior was dropped after others were tied to it."""

    code = "dropped-tie"
    template = "the behavior of {point} is dropped; this behavior keeps the last predicted time"
    point: str


class CutTie(SchedulingFault):
    """A point that was interrupted after others were tied to it."""

    code = "cut-tie"
    template = "{point} was interrupted; this behavior keeps the last predicted time"
    point: str


class NeverComes(SchedulingFault):
    """A behavior tied to a point without a time."""

    code = "never-comes"
    template = "it is dropped: it depends on {point}, which will never come"
    point: str


class AllPast(SchedulingFault):
    """A behavior that would end before its block starts; ``late`` in s."""

    code = "all-past"
    template = "it would have ended {late:g} s before its block starts"
    late: float


class NotSupported(Fault):
    """A behavior of BML that no engine plays."""

    code = "not-supported"
    template = "<{element}> is not supported and is left out"
    warning = WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED
    element: str


class ForeignNotSupported(Fault):
    """A behavior of another namespace that no engine plays."""

    code = "foreign-not-supported"
    template = "<{element}> of {namespace} is not supported and is left out"
    warning = WarningType.CUSTOM_BEHAVIOUR_NOT_SUPPORTED
    element: str
    namespace: str


class DescriptionLeftOut(CreationFault):
    """A description of a behavior that cannot be played."""

    code = "description-left-out"
    template = "one of its descriptions is replaced by the next: {reason}"
    reason: str


class WorkFailed(CreationFault):
    """An exception while a behavior was prepared."""

    code = "work-failed"
    template = "its preparation failed: {reason}"
    reason: str


class NeverMoves(SchedulingFault):
    """A block that would wait forever at the end of a session."""

    code = "never-moves"
    template = "it is still waiting for {waits}, but nothing more can happen"
    waits: str


class TooManyRounds(PlayingFault):
    """A tick in which engines keep requesting changes."""

    code = "too-many-rounds"
    template = "the tick did not settle within {limit} rounds"
    limit: int
