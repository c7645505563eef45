"""``realize``: files in, feedback and frames out."""

import argparse
import asyncio
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from reactive_realizer.assembly.scene import DEFAULT_HUMAN, SceneOptions, open_scene
from reactive_realizer.cli.items import Item, item, seconds
from reactive_realizer.cli.output import FeedbackWriter, FrameRecorder
from reactive_realizer.clock.clock import ManualClock, SystemClock
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.realizer.session import run_until_done

_UNTIL = 600.0


def add_parser(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """The options of ``realize``."""
    parser = commands.add_parser(
        "realize",
        help="play BML files and write what comes out",
        epilog="example: reactive-realizer realize hello.xml more.xml@2.5 --voice text --feedback - --frames out.npz",
    )
    parser.add_argument("items", nargs="+", type=item, metavar="ITEM", help="a file, or file@seconds")
    parser.add_argument("--clock", choices=("virtual", "real"), default="virtual")
    parser.add_argument("--human", type=Path, default=DEFAULT_HUMAN, metavar="FILE")
    parser.add_argument("--voice", choices=("espeak", "text"), default="espeak")
    parser.add_argument("--feedback", metavar="FILE|-", help="JSON lines")
    parser.add_argument("--frames", type=Path, metavar="FILE.npz")
    parser.add_argument("--until", type=seconds, default=_UNTIL, metavar="SECONDS")
    parser.add_argument("--assets", type=Path, action="append", default=[], metavar="DIR")
    parser.add_argument("--seed", type=int, default=0, metavar="N")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """The exit status: 1 if something could not be read, was refused or failed; 2 if a file is not there."""
    missing = [str(entry.path) for entry in options.items if not entry.path.is_file()]
    missing += [] if options.human.is_file() else [str(options.human)]
    outputs = [Path(name) for name in (options.feedback, options.frames) if name]
    missing += [str(output.parent) for output in outputs if not output.parent.is_dir()]
    if missing:
        print(f"no such file: {', '.join(missing)}", file=sys.stderr)
        return 2
    return asyncio.run(_realize(options))


async def _realize(options: argparse.Namespace) -> int:
    scene_options = SceneOptions(options.human, options.voice, tuple(options.assets), options.seed)
    async with open_scene(scene_options) as scene:
        realizer = scene.realizer
        unread = sum(not _put(realizer, entry) for entry in sorted(options.items, key=lambda e: e.time))
        recorder = FrameRecorder()
        if options.frames:
            realizer.watch(recorder)
        with _feedback(options.feedback) as stream:
            if stream is not None:
                realizer.feedback.listen(FeedbackWriter(stream))
            clock = ManualClock() if options.clock == "virtual" else SystemClock()
            await run_until_done(realizer, clock, options.until)
        if options.frames:
            recorder.write(options.frames, realizer)
        return 1 if unread or realizer.scheduler.refused or realizer.scheduler.failed else 0


def _put(realizer: Realizer, entry: Item) -> bool:
    """Have a file enter at its time; whether it could be read."""
    try:
        realizer.put(BmlText(entry.path.read_bytes()), entry.time)
    except OSError as problem:
        print(problem, file=sys.stderr)
        return False
    return True


@contextmanager
def _feedback(target: str | None) -> Iterator[IO[str] | None]:
    if target is None:
        yield None
    elif target == "-":
        yield sys.stdout
    else:
        with Path(target).open("w", encoding="utf-8") as file:
            yield file
