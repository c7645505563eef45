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
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
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
        if request.unit.state is UnitState.DROPPED:
            return  # by what was asked for before
        character = request.unit.block.character
        match request:
            case ActivateBlock(unit, target, time):
                fault = self.activate(character, target, time)
                if fault is None:
                    self._endings.begin(unit, now)
                else:
                    self._refuse(unit, fault, now)
            case InterruptBlock():
                self._interrupt(request, character, now)
            case BindParameter(unit):
                try:
                    self._bind(request, character)
                except RealizerError as problem:
                    self._endings.drop_unit(unit, problem.fault, now)
            case EndUnit(unit, time):
                self._endings.finish(unit, time)

    def _refuse(self, unit: PlanUnit, fault: Fault, now: GlobalTime) -> None:
        """There is nothing to do: who asked is dropped with a warning, or plays on with it."""
        if unit.begun:
            self._reporter.warn_of(unit, fault)
        else:
            self._endings.drop_unit(unit, fault, now)

    def _interrupt(self, request: InterruptBlock, character: str, now: GlobalTime) -> None:
        block = self._blocks.find(character, request.target)
        if block is None:
            self._interrupt_nobody(request, character, now)
            return
        names = {behavior.id for behavior in block.description.behaviors}
        spared = names.intersection(request.exclude) | (names.difference(request.include) if request.include else set())
        unknown = [name for name in (*request.include, *request.exclude) if name not in names]
        fault = Fault("no-such-behavior", {"block": block.key.block, "behavior": ", ".join(unknown)})
        if unknown and spared == names:
            self._refuse(request.unit, fault, now)
            return
        # It begins before anything is cut: it may hang on that, and may be of the same block.
        self._endings.begin(request.unit, now)
        if unknown:
            self._reporter.warn_of(request.unit, fault)
        if not spared:
            self._planner.cancel(block)
        self._endings.interrupt(block, request.time, spared, gently=request.gently)

    def _interrupt_nobody(self, request: InterruptBlock, character: str, now: GlobalTime) -> None:
        """A block that has ended is interrupted enough; one that never was is so too, but that is told."""
        self._endings.begin(request.unit, now)
        missing = self._missing(character, request.target)
        if missing.code == "no-such-block":
            self._reporter.warn_of(request.unit, missing)

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
