"""What engines ask for, done to blocks and behaviors (thesis 8.13-8.15)."""

from collections.abc import Iterable

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.effects import (
    ActivateBlock,
    BindParameter,
    EndUnit,
    InterruptBlock,
    Request,
    SetParameter,
    Warn,
)
from reactive_realizer.errors import Fault, RealizerError, error
from reactive_realizer.pegboard.pegboard import PegBoard
from reactive_realizer.planunit.parameter import spelled
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.scheduler.block_planner import BlockPlanner
from reactive_realizer.scheduler.blocks import Blocks
from reactive_realizer.scheduler.bml_block import BlockState, BMLBlock
from reactive_realizer.scheduler.endings import Endings
from reactive_realizer.scheduler.reporter import Reporter

_Timed = ActivateBlock | InterruptBlock | BindParameter | EndUnit


class Requests:
    """Does what is asked for, or warns the behavior that asked."""

    def __init__(
        self, board: PegBoard, blocks: Blocks, planner: BlockPlanner, endings: Endings, reporter: Reporter
    ) -> None:
        self._board = board
        self._blocks = blocks
        self._planner = planner
        self._endings = endings
        self._reporter = reporter

    def do(self, requests: Iterable[Request], now: GlobalTime) -> bool:
        """Do what is asked for, in order of time; whether more than parameters changed.

        Values come first: a change that ends as another one begins has reached its target by then.
        """
        for each in requests:
            if isinstance(each, SetParameter) and each.parameter.owner is each.unit:
                each.parameter.set(each.value)
            elif isinstance(each, Warn):
                self._reporter.warn_of(each.unit, each.fault)
        timed = [each for each in requests if not isinstance(each, SetParameter | Warn)]
        for request in sorted(timed, key=lambda each: _time(each, now)):
            self._do(request, now)
        return bool(timed)

    def activate(self, character: str, name: str, time: GlobalTime) -> Fault | None:
        """Have a preplanned block start at a time, or say why it cannot."""
        block = self._blocks.find(character, name)
        if block is None:
            return self._missing(character, name)
        if block.activation is None:
            return Fault("not-preplanned", {"block": name})
        if not block.asleep:
            return Fault("activated-already", {"block": name})
        with self._board.graph.transaction(f"activate {name}"):
            block.activate(time)
        return None

    def interrupt(self, block: BMLBlock, time: GlobalTime) -> None:
        """Cut a whole block, or give up what is prepared for it."""
        self._planner.cancel(block)
        self._endings.interrupt(block, time)

    def _do(self, request: _Timed, now: GlobalTime) -> None:
        character = request.unit.block.character
        match request:
            case ActivateBlock():
                self._activate(request, character)
            case InterruptBlock():
                self._refuse(request, self._interrupt(request, character))
            case BindParameter(unit):
                try:
                    self._bind(request, character)
                except RealizerError as problem:
                    self._endings.drop_unit(unit, problem.fault, now)
            case EndUnit(unit, time):
                self._endings.finish(unit, time)

    def _activate(self, request: ActivateBlock, character: str) -> None:
        """Who finds nothing to activate has done nothing, which fails its block if it is required."""
        fault = self.activate(character, request.target, request.time)
        self._refuse(request, fault)
        block = self._blocks.get(request.unit.block)
        if block is not None and fault is not None:
            block.failing |= request.unit.behavior.required

    def _refuse(self, request: ActivateBlock | InterruptBlock, fault: Fault | None) -> None:
        if fault is not None:
            self._reporter.warn_of(request.unit, fault)

    def _interrupt(self, request: InterruptBlock, character: str) -> Fault | None:
        """A block that has ended is interrupted enough."""
        block = self._blocks.find(character, request.target)
        if block is None:
            missing = self._missing(character, request.target)
            return missing if missing.code == "no-such-block" else None
        names = [behavior.id for behavior in block.description.behaviors]
        unknown = [name for name in (*request.include, *request.exclude) if name not in names]
        spared = {
            name for name in names if name in request.exclude or (request.include and name not in request.include)
        }
        if not spared:
            self._planner.cancel(block)
        if len(spared) < len(names):
            self._endings.interrupt(block, request.time, spared, gently=request.gently)
        return (
            Fault("no-such-behavior", {"block": block.key.block, "behavior": ", ".join(unknown)}) if unknown else None
        )

    def _bind(self, request: BindParameter, character: str) -> None:
        parameters = self._target(request, character).parameters
        parameter = parameters.get(spelled(request.parameter, parameters))
        if parameter is None:
            known = ", ".join(parameters) or "none"
            raise error("no-such-parameter", behavior=request.behavior, parameter=request.parameter, known=known)
        request.unit.bind(parameter)
        parameter.owner = request.unit

    def _target(self, request: BindParameter, character: str) -> PlanUnit:
        block = self._blocks.find(character, request.block)
        if block is None:
            raise RealizerError(self._missing(character, request.block))
        unit = next((unit for unit in block.units if unit.behavior.id == request.behavior), None)
        if unit is not None and unit.live:
            return unit
        if request.behavior not in [each.id for each in block.description.behaviors]:
            code = "no-such-behavior"
        else:
            code = "not-planned" if block.state is BlockState.IN_PREP else "behavior-ended"
        raise error(code, block=request.block, behavior=request.behavior)

    def _missing(self, character: str, name: str) -> Fault:
        code = "block-ended" if self._blocks.has_ended(character, name) else "no-such-block"
        return Fault(code, {"block": name})


def _time(request: _Timed, now: GlobalTime) -> GlobalTime:
    return now if isinstance(request, BindParameter) else request.time
