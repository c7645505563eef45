"""``check``: what is wrong with a file, before anybody plays it."""

import argparse
import asyncio
import sys
from collections.abc import Collection, Iterator
from contextlib import suppress
from pathlib import Path

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions, open_scene
from reactive_realizer.bml.attribute_types import Names, Target
from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.continuous import ParameterValueChange
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.names import ANTICIPATORS
from reactive_realizer.bml.procedure import DefineProc
from reactive_realizer.bml.references import check_references, references_of, standard_points, unknown_block
from reactive_realizer.embodiment.world import World
from reactive_realizer.errors import Fault, RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.realizer.realizer import Realizer

_NOWHERE = BlockKey("", "")


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """The options of ``check``."""
    parser = commands.add_parser(
        "check", help="say what is wrong with BML files", epilog="example: reactive-realizer check hello.xml"
    )
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE")
    parser.add_argument("--human", type=Path, default=DEFAULT_HUMAN, metavar="FILE", help="who and what is there")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 1 if anything is wrong, 2 if a file is not there."""
    missing = [str(path) for path in (*options.files, options.human) if not path.is_file()]
    if missing:
        print(f"no such file: {', '.join(missing)}", file=sys.stderr)
        return 2
    problems = asyncio.run(_check(options))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


async def _check(options: argparse.Namespace) -> list[str]:
    async with open_scene(SceneOptions(options.human, voice="text")) as scene:
        checker = _Checker(scene.realizer)
        return [problem for path in options.files for problem in checker.problems(path)]


class _Checker:
    """Reads files one after the other; a block may refer to those before it, in its file or an earlier one."""

    def __init__(self, realizer: Realizer) -> None:
        self._realizer = realizer
        self._earlier: set[str] = set()
        self._procedures: dict[str, None] = {}

    def problems(self, path: Path) -> list[str]:
        """What is wrong with a file, line by line."""
        faults = sorted(self._faults(path.read_bytes()), key=_place)
        return [f"{path}:{fault.line or 1}:{fault.column or 1}: {fault.sentence}" for fault in faults]

    def _faults(self, text: bytes) -> Iterator[Fault]:
        admission = self._realizer.scheduler.admission()
        for parsed in parse(text, self._realizer.limits):
            yield from (problem.fault for problem in parsed.problems)
            if parsed.procedure is not None:
                yield from self._inside(parsed.procedure)
                self._procedures[parsed.procedure.id] = None
            if parsed.block is not None:
                yield from filter(None, [admission.take(parsed.block, parsed.failed)])
                yield from self._unknown_procedure(parsed.block)
                yield from self._unknown_others(parsed.block)
                yield from self._inside(parsed.block)
                self._earlier.add(parsed.block.id)

    def _inside(self, block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
        yield from (problem.fault for problem in check_references(block, self._points))
        yield from self._unknown_blocks(block)
        yield from _unknown_targets(block, self._realizer.world)
        yield from _unknown_behaviors(block)
        yield from self._unknown_points(block)

    def _points(self, behavior: Behavior) -> Collection[str] | None:
        """Its sync points, those of what would play it among them; None where nothing would."""
        characters = self._realizer.characters.values()
        engines = (engine for character in characters for engine in character.engines if engine.supports(behavior))
        known = standard_points(behavior)
        if known is None and (engine := next(engines, None)):
            with suppress(RealizerError):
                known = engine.plan(_NOWHERE, behavior, None).timing.points
        return known

    def _unknown_points(self, block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
        """Attributes that tie points which what plays their behavior has not."""
        for behavior in block.behaviors:
            known = self._points(behavior) if behavior.OPEN_POINTS else None
            for sync, ref in behavior.syncs.items():
                if known is not None and sync not in known:
                    details = {"behavior": behavior.id, "sync": sync, "reference": str(ref), "known": ", ".join(known)}
                    yield Fault("unknown-sync", details, behavior.location.line, behavior.location.column)

    def _unknown_procedure(self, block: BehaviorBlock) -> Iterator[Fault]:
        if block.procedure not in {None, *self._procedures}:
            details = {"procedure": block.procedure, "known": ", ".join(self._procedures) or "none"}
            yield Fault("unknown-procedure", details, block.location.line, block.location.column)

    def _unknown_others(self, block: BehaviorBlock) -> Iterator[Fault]:
        """Blocks that it joins, interrupts or starts."""
        for attribute in attributes_of(BehaviorBlock):
            names = getattr(block, attribute.field) if isinstance(attribute.type, Names) else ()
            for name in names:
                if name not in self._earlier:
                    details = {"attribute": attribute.name, "block": name}
                    yield Fault("unknown-target-block", details, block.location.line, block.location.column)

    def _unknown_blocks(self, block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
        known = {None, ANTICIPATORS, block.id, *self._earlier}
        for _, location, ref in references_of(block):
            if ref.block not in known:
                yield unknown_block(ref, block).located(location.line, location.column)


def _unknown_targets(block: BehaviorBlock | DefineProc, world: World) -> Iterator[Fault]:
    for behavior in block.behaviors:
        for target in _targets(behavior):
            if world.position(target) is None:
                details = {"target": target, "known": ", ".join(world.targets)}
                yield Fault("no-target", details, behavior.location.line, behavior.location.column)


def _unknown_behaviors(block: BehaviorBlock | DefineProc) -> Iterator[Fault]:
    """Behaviors of the block itself of which something is to be changed."""
    known = {behavior.id for behavior in block.behaviors}
    changes = (each for each in block.behaviors if isinstance(each, ParameterValueChange))
    for change in changes:
        if change.target_block in {None, block.id} and change.target_behavior not in known:
            details = {"block": block.id, "behavior": change.target_behavior}
            yield Fault("no-such-behavior", details, change.location.line, change.location.column)


def _targets(behavior: Behavior) -> Iterator[str]:
    """Those in the world: others are blocks and behaviors."""
    attributes = (each for each in attributes_of(type(behavior)) if isinstance(each.type, Target))
    return (getattr(behavior, each.field) for each in attributes)


def _place(fault: Fault) -> tuple[int, int]:
    return fault.line or 1, fault.column or 1
