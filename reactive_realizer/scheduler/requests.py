"""Carries out the requests of engines to activate, interrupt and change blocks and behaviors (thesis 8.13-8.15)."""

from collections.abc import Collection, Iterable

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import (
    ActivateBlock,
    BindParameter,
    Dropped,
    EndUnit,
    FollowCell,
    InterruptBlock,
    MovePoints,
    ReportFall,
    Request,
    SetParameter,
    Warn,
)
from reactive_realizer.errors import Fault, RealizerError, SchedulingFault, TargetFault
from reactive_realizer.planunit.parameter import spelled
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.scheduler.block_feedback import BlockFeedback
from reactive_realizer.scheduler.block_lifecycle import BlockLifecycle
from reactive_realizer.scheduler.block_state import BlockState
from reactive_realizer.scheduler.blocks import Blocks, NoSuchBlock

_Timed = ActivateBlock | InterruptBlock | BindParameter | EndUnit | MovePoints


class NoSuchBehavior(TargetFault):
    """No behavior of a block has the id."""

    code = "no-such-behavior"
    template = "the block '{block}' has no behavior {behaviors}; it has {known}"
    unknown = "behaviors"
    block: str
    behaviors: tuple[str, ...]
    known: tuple[str, ...]


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
    unknown = "parameter"
    behavior: str
    parameter: str
    known: tuple[str, ...]


class EngineRequests:
    """Carries out requests, or warns of the behaviors that made them."""

    def __init__(self, blocks: Blocks, lifecycle: BlockLifecycle, feedback: BlockFeedback) -> None:
        self._blocks = blocks
        self._lifecycle = lifecycle
        self._feedback = feedback

    def carry_out(self, requests: Iterable[Request], now: GlobalTime) -> bool:
        """Carry out requests in order of time; whether anything but parameters changed.

        Values are set first, so that a change that ends as another one begins has reached its target.
        """
        for each in requests:
            match each:
                case SetParameter(unit, parameter, value) if parameter.owner is unit:
                    parameter.set(value)
                case FollowCell(unit, parameter, cell) if parameter.owner is unit:
                    parameter.follow(cell)
                case Warn(unit, fault):
                    self._feedback.warn_behavior(unit, fault)
                case ReportFall(unit, time):
                    self._feedback.fall(unit, time)
                case _:
                    pass
        timed = [each for each in requests if not isinstance(each, SetParameter | FollowCell | Warn | ReportFall)]
        rejected: dict[PlanUnit, Dropped] = {}
        for request in sorted(timed, key=lambda each: now if isinstance(each, BindParameter) else each.time):
            unit = request.unit
            if unit.state is not UnitState.DROPPED and unit not in rejected:
                refusal = self._carry_out(request, now)
                if refusal is not None:
                    rejected[unit] = Dropped(unit, refusal)
        self._drop(rejected.values(), now)
        return bool(timed)

    def _drop(self, rejected: Collection[Dropped], now: GlobalTime) -> None:
        """Drop behaviors; of one that another request has ended, only warn."""
        for unit, fault in rejected:
            if not unit.live:
                self._feedback.warn_behavior(unit, fault)
        self._lifecycle.drop_behaviors([each for each in rejected if each.unit.live], now)

    def _carry_out(self, request: _Timed, now: GlobalTime) -> Fault | None:
        """Carry out a request; a fault if its behavior is to be dropped, because it cannot be carried out."""
        character = request.unit.block.character
        match request:
            case ActivateBlock(unit, target, time):
                fault = self._lifecycle.activate(character, target, time)
                if fault is not None:
                    return self._reject(unit, fault)
                self._lifecycle.begin_behavior(unit, now)
            case InterruptBlock():
                return self._interrupt(request, character, now)
            case BindParameter():
                try:
                    self._bind(request, character)
                except RealizerError as problem:
                    return problem.fault
            case EndUnit(unit, time):
                self._lifecycle.finish_behavior(unit, time)
            case MovePoints(unit, times):
                self._lifecycle.move_points(unit, times)
        return None

    def _reject(self, unit: PlanUnit, fault: Fault) -> Fault | None:
        """The fault of a request, unless its behavior plays: then it only warns."""
        if not unit.begun:
            return fault
        self._feedback.warn_behavior(unit, fault)
        return None

    def _interrupt(self, request: InterruptBlock, character: str, now: GlobalTime) -> Fault | None:
        block = self._blocks.find(character, request.target)
        if block is None:  # nothing happens, and a block that never existed gives a warning
            self._lifecycle.begin_behavior(request.unit, now)
            missing = self._blocks.missing(character, request.target)
            if isinstance(missing, NoSuchBlock):
                self._feedback.warn_behavior(request.unit, missing)
            return None
        known = tuple(behavior.id for behavior in block.description.behaviors)
        names = set(known)
        spared = names.intersection(request.exclude) | (names.difference(request.include) if request.include else set())
        unknown = [name for name in (*request.include, *request.exclude) if name not in names]
        fault = NoSuchBehavior(block=block.key.block, behaviors=tuple(unknown), known=known)
        if unknown and spared == names:
            return self._reject(request.unit, fault)
        # The requesting behavior begins first, because it may depend on the block that is cut, or belong to it.
        self._lifecycle.begin_behavior(request.unit, now)
        if unknown:
            self._feedback.warn_behavior(request.unit, fault)
        self._lifecycle.interrupt(block, request.time, spared, request.speech)
        return None

    def _bind(self, request: BindParameter, character: str) -> None:
        target = self._target(request, character)
        parameters = target.parameters
        parameter = parameters.get(spelled(request.parameter, parameters))
        if parameter is None:
            known = tuple(parameters)
            raise RealizerError(NoSuchParameter(behavior=request.behavior, parameter=request.parameter, known=known))
        request.unit.bind(target, parameter)
        parameter.owner = request.unit

    def _target(self, request: BindParameter, character: str) -> PlanUnit:
        block = self._blocks.find(character, request.block)
        if block is None:
            raise RealizerError(self._blocks.missing(character, request.block))
        unit = next((unit for unit in block.units if unit.behavior.id == request.behavior), None)
        if unit is not None and unit.live:
            return unit
        known = tuple(each.id for each in block.description.behaviors)
        if request.behavior not in known:
            raise RealizerError(NoSuchBehavior(block=request.block, behaviors=(request.behavior,), known=known))
        kind = NotPlanned if block.state is BlockState.IN_PREP else BehaviorEnded
        raise RealizerError(kind(block=request.block, behavior=request.behavior))
