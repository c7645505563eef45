"""Ties to moments that passed before their block was meant, and that do not come again."""

from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.units import has_passed
from reactive_realizer.errors import Fault, SchedulingFault
from reactive_realizer.pegboard.time_peg import AnticipatorPeg
from reactive_realizer.scheduler.bml_block import Meant
from reactive_realizer.scheduler.faults import NamesDropped
from reactive_realizer.scheduler.late_ties import OuterTie, outer_ties
from reactive_realizer.scheduler.problem import Point, Precedence, Tie
from reactive_realizer.scheduler.solution import Loss, lost_behavior, lost_constraint


class PassedMoment(SchedulingFault):
    """A tie to a moment that passed before the block was meant; times in s."""

    code = "passed-moment"
    template = "{tie}: that came at {time} s, before the block {how} at {since} s, and does not come again"
    compared = ("time", "since")
    tie: str
    time: float
    how: str
    since: float


class Possible(NamedTuple):
    """The constraints of a block that can still be met.

    Attributes:
        ties: between behaviors that are not lost.
        orders: likewise.
        losses: the behaviors and constraints that cannot be met.
        gone: ids of the behaviors that are lost.
    """

    ties: Sequence[Tie]
    orders: Sequence[Precedence]
    losses: Sequence[Loss] = ()
    gone: Container[str] = ()


def without_passed(
    behaviors: Mapping[str, Behavior], ties: Sequence[Tie], orders: Sequence[Precedence], meant: Meant | None
) -> Possible:
    """The constraints of a block, without the behaviors that are tied to passed moments, and those that name these.

    A tie may lie ahead although its moment has passed, as two seconds after it may.

    Args:
        behaviors: of the block, by id.
        ties: its `at` constraints.
        orders: its before/after constraints.
        meant: None while the block waits for its activation.
    """
    passed = {} if meant is None else {id(each.tie): _fault(each, meant) for each in _passed(ties, meant)}
    if not passed:
        return Possible(ties, orders)
    faults = _faults(ties, passed)
    losses = [lost_behavior(behaviors[id_], fault) for id_, fault in faults.items()]
    kept: list[Tie | Precedence] = []
    constraints: list[Tie | Precedence] = [*ties, *orders]
    for each in constraints:
        owner = each.owner if isinstance(each, Tie) else None
        if id(each) in passed and owner is None:
            losses.append(lost_constraint(each, passed[id(each)]))
        elif not each.names(faults):
            kept.append(each)
        elif owner is None:
            losses.append(lost_constraint(each, _names_dropped(each, faults)))
    left = [each for each in kept if isinstance(each, Tie)], [each for each in kept if isinstance(each, Precedence)]
    return Possible(*left, losses, faults)


def _passed(ties: Iterable[Tie], meant: Meant) -> Iterator[OuterTie]:
    for each in outer_ties(ties):
        time = each.cell.value if isinstance(each.cell, AnticipatorPeg) else None
        if time is not None and has_passed(max(time, time + each.offset), meant.time):
            yield each


def _faults(ties: Iterable[Tie], passed: Mapping[int, Fault]) -> dict[str, Fault]:
    """The faults of the behaviors that state passed ties, and of those that name these behaviors, by id."""
    stated = [tie for tie in ties if tie.owner is not None]
    faults = {tie.owner or "": passed[id(tie)] for tie in reversed(stated) if id(tie) in passed}
    while new := {tie.owner or "": tie for tie in stated if tie.owner not in faults and tie.names(faults)}:
        faults |= {owner: _names_dropped(tie, faults) for owner, tie in new.items()}
    return faults


def _names_dropped(constraint: Tie | Precedence, gone: Container[str]) -> Fault:
    behaviors = (node.behavior for node in constraint.nodes if isinstance(node, Point))
    return NamesDropped(constraint=constraint.text, behavior=next(id_ for id_ in behaviors if id_ in gone))


def _fault(outer: OuterTie, meant: Meant) -> Fault:
    return PassedMoment(tie=outer.tie.text, time=outer.cell.value or 0.0, how=meant.how, since=meant.time)
