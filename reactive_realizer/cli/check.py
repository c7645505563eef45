"""``check``: what is wrong with a file, before anybody plays it."""

import argparse
import asyncio
import sys
from collections.abc import Iterator
from pathlib import Path

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions, open_scene
from reactive_realizer.bml.block import BehaviorBlock
from reactive_realizer.bml.document import parse
from reactive_realizer.bml.references import check_references
from reactive_realizer.embodiment.world import World
from reactive_realizer.errors import Fault, WarningType
from reactive_realizer.realizer.realizer import Realizer

_REALIZED_LATER = (WarningType.BEHAVIOR_TYPE_NOT_SUPPORTED, WarningType.CUSTOM_BEHAVIOUR_NOT_SUPPORTED)


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
        return [problem for path in options.files for problem in _problems(path, scene.realizer)]


def _problems(path: Path, realizer: Realizer) -> list[str]:
    found = []
    for parsed in parse(path.read_bytes(), realizer.limits):
        found += [problem.fault for problem in parsed.problems]
        if parsed.block is not None:
            found += [problem.fault for problem in check_references(parsed.block)]
            found += _unknown_targets(parsed.block, realizer.world)
            found += filter(None, [realizer.scheduler.refusal(parsed.block)])
    wrong = [fault for fault in found if fault.kind.warning not in _REALIZED_LATER]
    return [f"{path}:{fault.line or 1}:{fault.column or 1}: {fault.sentence}" for fault in sorted(wrong, key=_place)]


def _unknown_targets(block: BehaviorBlock, world: World) -> Iterator[Fault]:
    for behavior in block.behaviors:
        target = getattr(behavior, "target", None)
        if target is not None and world.position(target) is None:
            details = {"target": target, "known": ", ".join(world.targets)}
            yield Fault("no-target", details, behavior.location.line, behavior.location.column)


def _place(fault: Fault) -> tuple[int, int]:
    return fault.line or 1, fault.column or 1
