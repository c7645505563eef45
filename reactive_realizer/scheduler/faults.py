"""Faults of the strategies and of starting blocks; the other faults of scheduling are defined where they arise."""

from reactive_realizer.errors import CreationFault, SchedulingFault


class NotAwaited(SchedulingFault):
    """A block with a behavior that has no end of its own."""

    code = "not-awaited"
    template = (
        "'{block}' has not ended, because {behaviors} lasts until something ends it; this block does not wait for that"
    )
    block: str
    behaviors: str


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


class ContradictoryTie(SchedulingFault):
    """A constraint that contradicts others; ``gap`` in s."""

    code = "contradictory-tie"
    template = "{tie} contradicts other constraints by {gap} s and is dropped"
    tie: str
    gap: float


class OuterTieDropped(SchedulingFault):
    """A constraint between two times that are both set outside the block."""

    code = "outer-tie"
    template = "{tie} is dropped: both of its times are set elsewhere"
    tie: str


class Rigid(SchedulingFault):
    """A constraint on a point that cannot move; ``gap`` in s."""

    code = "rigid"
    template = "{tie} is dropped: {point} cannot be moved by the {gap} s that it requires"
    tie: str
    point: str
    gap: float


class BeforeBlock(SchedulingFault):
    """A behavior that would start before its block; ``early`` in s."""

    code = "before-block"
    template = "it would have to start {early} s before its block"
    early: float


class Conflicting(SchedulingFault):
    """A constraint or behavior that conflicts with others; ``gap`` in s."""

    code = "clash"
    template = "{what} is dropped: it conflicts with {others} by {gap} s"
    what: str
    others: str
    gap: float


class TooHurried(SchedulingFault):
    """A constraint or behavior that leaves phases of behaviors less time than the body needs; times in s."""

    code = "too-hurried"
    template = "{what} is dropped: there is too little time for {phases}: needs {need} s, has {room} s"
    compared = ("need", "room")
    what: str
    phases: tuple[str, ...]
    need: float
    room: float


class NeverHolds(SchedulingFault):
    """A constraint or behavior that is impossible by itself; ``gap`` in s."""

    code = "never-holds"
    template = "{what} can never be satisfied and is dropped: it is off by {gap} s"
    what: str
    gap: float


class NamesDropped(SchedulingFault):
    """A constraint on a behavior that was dropped."""

    code = "names-dropped"
    template = "{constraint} refers to '{behavior}', which is dropped"
    constraint: str
    behavior: str


class WorkFailed(CreationFault):
    """An exception while a behavior was prepared."""

    code = "work-failed"
    template = "its preparation failed: {reason}"
    reason: str


class NoOrder(SchedulingFault):
    """A before/after constraint under a strategy that does not keep it."""

    code = "no-order"
    template = "the strategy '{strategy}' does not keep the before/after constraint '{text}'"
    strategy: str
    text: str
