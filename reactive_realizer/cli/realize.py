"""The command ``realize``: plays BML files and writes feedback and frames."""

import argparse
import asyncio
import re
import sys
from collections.abc import AsyncIterator, Callable, Iterable, Iterator
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import IO

from reactive_realizer import __version__
from reactive_realizer.assembly.scene import Scene, open_scene
from reactive_realizer.bml.sync_ref import NUMBER
from reactive_realizer.cli.output import Explainer, FeedbackWriter, WarningPrinter, complain_of_inputs
from reactive_realizer.cli.scene_options import add_scene_options, scene_options
from reactive_realizer.clock.clock import Clock, ManualClock, SystemClock
from reactive_realizer.clock.units import GlobalTime, is_due
from reactive_realizer.embodiment.sound_track import SoundTrack
from reactive_realizer.errors import Fault
from reactive_realizer.export.bvh import write_bvh
from reactive_realizer.export.glb import write_glb
from reactive_realizer.export.npz import write_npz
from reactive_realizer.export.recorded_motion import MotionRecorder
from reactive_realizer.export.text_grid import PlayedLog
from reactive_realizer.realizer.inputs import BmlText
from reactive_realizer.realizer.realizer import Realizer
from reactive_realizer.realizer.session import AfterTick, no_wait, replay, run_until_done
from reactive_realizer.server.recording import read_recording

_TIMED = re.compile(rf"(.+)@({NUMBER})")


@dataclass(frozen=True, slots=True)
class InputFile:
    """A file of BML, and the time (s) at which it enters."""

    path: Path
    time: GlobalTime


def seconds(text: str) -> GlobalTime:
    """A time on the command line.

    Raises:
        ValueError: not a number of seconds from now on.
    """
    time = float(text)
    if not 0.0 <= time < float("inf"):
        raise ValueError(text)
    return GlobalTime(time)


def input_file(text: str) -> InputFile:
    """Parse ``path`` or ``path@seconds``; only a suffix that is a number is a time.

    Raises:
        ValueError: a number beyond all times.
    """
    found = _TIMED.fullmatch(text)
    return InputFile(Path(found[1]), seconds(found[2])) if found else InputFile(Path(text), GlobalTime(0.0))


def video_size(text: str) -> tuple[int, int]:
    """Parse ``1280x720``.

    Raises:
        ValueError: not two even numbers of pixels.
    """
    width, height = (int(part) for part in text.split("x"))
    if not all(0 < each <= _MOST_PIXELS and each % 2 == 0 for each in (width, height)):
        raise ValueError(text)
    return width, height


_UNTIL = 600.0
_MOST_PIXELS = 4096
_SIZE = (1280, 720)
_SHOTS = ("face", "bust", "upper", "full")
_OUTPUTS = ("feedback", "frames", "bvh", "glb", "audio", "textgrid", "video", "explain")
_MOTION_WRITERS = {"frames": write_npz, "bvh": write_bvh, "glb": write_glb}
_WITH_REPLAY = ("replay", *_OUTPUTS, "shot", "video_size", "verbose", "log_format", "run")
"""The options that ``--replay`` allows; all others are in the recording."""


class NeverEnters(Fault):
    """A file for a time after the end of the session."""

    code = "never-enters"
    template = "{file} was not played: the session ended at {end} s, before its time of {time} s"
    compared = ("end", "time")
    file: str
    end: float
    time: float


class CutShort(Fault):
    """Blocks that are alive at the end of the session."""

    code = "cut-short"
    template = "the session ended at {end} s (--until), before the end of {blocks}"
    end: float
    blocks: tuple[str, ...]


def add_options(parser: argparse.ArgumentParser) -> None:
    """Give a parser the options of ``realize``."""
    parser.epilog = (
        "example: reactive-realizer realize hello.xml more.xml@2.5 --voice text --feedback - --frames out.npz"
    )
    parser.add_argument("items", nargs="*", type=input_file, metavar="ITEM", help="a file, or file@seconds")
    parser.add_argument(
        "--clock", choices=("virtual", "real"), default="virtual", help="virtual is as fast as possible"
    )
    parser.add_argument(
        "--until", type=seconds, default=_UNTIL, metavar="SECONDS", help="the latest end of the session"
    )
    parser.add_argument("--replay", type=Path, metavar="FILE", help="replay a recording of serve --record")
    add_scene_options(parser)
    _add_output_options(parser)
    parser.set_defaults(run=partial(run, parser))


def _add_output_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--feedback", metavar="FILE|-", help="write the feedback, JSON lines; - is stdout")
    parser.add_argument("--frames", type=Path, metavar="FILE.npz", help="write all poses, a NumPy archive")
    parser.add_argument(
        "--bvh", type=Path, metavar="FILE.bvh", help="write the motion of the bodies, for animation tools"
    )
    parser.add_argument(
        "--glb", type=Path, metavar="FILE.glb", help="write the avatars with their motion, for 3D tools"
    )
    parser.add_argument("--audio", type=Path, metavar="FILE.wav", help="write the sound of all characters, 48 kHz")
    parser.add_argument(
        "--textgrid",
        type=Path,
        metavar="FILE.TextGrid",
        help="write when which word and behavior played, for Praat and ELAN",
    )
    parser.add_argument(
        "--video", type=Path, metavar="FILE.mp4", help="film the page, 25 pictures a second, with the sound"
    )
    parser.add_argument("--shot", choices=_SHOTS, default="upper", help="what a video shows of the characters")
    parser.add_argument(
        "--video-size", type=video_size, default=_SIZE, metavar="WIDTHxHEIGHT", help="the size of a video, pixels"
    )
    parser.add_argument("--explain", type=Path, metavar="FILE", help="write why each sync point has its time, JSON")


def run(parser: argparse.ArgumentParser, options: argparse.Namespace) -> int:
    """The exit status: 1 if a file could not be read, or a block was rejected or failed; 2 if a file does not exist."""
    _check_combination(parser, options)
    inputs = [options.replay] if options.replay else [*(entry.path for entry in options.items), options.human]
    outputs = [Path(name) for output in _OUTPUTS if (name := getattr(options, output))]
    missing = [str(output.parent) for output in outputs if not output.parent.is_dir()]
    folders = [str(output) for output in outputs if output.is_dir()]
    if folders:
        print(f"cannot write a file over a folder: {', '.join(folders)}", file=sys.stderr)
        return 2
    if missing:
        print(f"no such folder: {', '.join(missing)}", file=sys.stderr)
    if complain_of_inputs(inputs) or missing:
        return 2
    return asyncio.run(_replay(options) if options.replay else _realize(options))


def _check_combination(parser: argparse.ArgumentParser, options: argparse.Namespace) -> None:
    if not options.replay and not options.items:
        parser.error("the following arguments are required: ITEM, or --replay")
    fixed = [name for name in vars(options) if name not in _WITH_REPLAY and _is_given(parser, options, name)]
    if options.replay and fixed:
        parser.error(f"--replay does not allow {', '.join(fixed)}: the recording sets them")
    if options.video and options.clock == "real":
        parser.error("--video requires --clock virtual: pictures take longer than they last")


def _is_given(parser: argparse.ArgumentParser, options: argparse.Namespace, name: str) -> bool:
    given = getattr(options, name)
    return bool(given) and given != parser.get_default(name)


async def _realize(options: argparse.Namespace) -> int:
    warnings = WarningPrinter()
    async with open_scene(scene_options(options)) as scene:
        unread = sum(not _put(scene.realizer, entry, warnings) for entry in sorted(options.items, key=lambda e: e.time))
        clock = ManualClock() if options.clock == "virtual" else SystemClock()
        with _written(options, scene.realizer, warnings):
            async with _filmed(options, scene, clock) as after_tick:
                await run_until_done(scene.realizer, clock, options.until, after_tick)
        _report_left_out(options.items, scene.realizer.time)
        _report_cut_short(scene.realizer, options.until)
        return 1 if unread else _status(scene.realizer)


def _report_left_out(items: Iterable[InputFile], end: GlobalTime) -> None:
    for entry in items:
        if not is_due(entry.time, end):
            print(NeverEnters(file=str(entry.path), end=end, time=entry.time).sentence, file=sys.stderr)


def _report_cut_short(realizer: Realizer, until: GlobalTime) -> None:
    blocks = tuple(block.key.block for block in realizer.scheduler.blocks.asked_for)
    if blocks and is_due(until, realizer.time):
        print(CutShort(end=realizer.time, blocks=blocks).sentence, file=sys.stderr)


async def _replay(options: argparse.Namespace) -> int:
    recording = read_recording(options.replay)
    if recording.version != __version__:
        print(f"recorded by version {recording.version}, this is {__version__}", file=sys.stderr)
    with TemporaryDirectory() as folder:
        async with open_scene(recording.options(Path(folder))) as scene:
            with _written(options, scene.realizer, WarningPrinter()):
                async with _filmed(options, scene, ManualClock()) as after_tick:
                    await replay(scene.realizer, recording.ticks, after_tick)
            return _status(scene.realizer)


def _status(realizer: Realizer) -> int:
    return 1 if realizer.scheduler.refused or realizer.scheduler.failed else 0


@contextmanager
def _written(options: argparse.Namespace, realizer: Realizer, warnings: WarningPrinter) -> Iterator[None]:
    """Writes the output of the session to the files of the options, or its warnings if no option asks for feedback."""
    explainer = Explainer(realizer) if options.explain else None
    track, log = SoundTrack(), PlayedLog()
    recorder = MotionRecorder({id_: character.humanoid.avatar for id_, character in realizer.characters.items()})
    wanted = {write: path for output, write in _MOTION_WRITERS.items() if (path := getattr(options, output))}
    if wanted:
        realizer.watch(recorder)
    if options.audio:
        realizer.hear(track.take)
    if options.textgrid:
        realizer.feedback.listen(log.report)
        realizer.hear(log.hear)
    with _feedback(options.feedback) as stream:
        writer = None if stream is None else FeedbackWriter(stream)
        realizer.feedback.listen(writer or warnings)
        yield
    writes: list[tuple[Path, Callable[[], None]]] = [
        (path, partial(write, path, recorder.motions())) for write, path in wanted.items()
    ]
    if options.audio:
        writes.append((options.audio, partial(track.write, options.audio, realizer.time)))
    if options.textgrid:
        writes.append((options.textgrid, partial(log.write, options.textgrid, realizer.time)))
    if explainer is not None:
        writes.append((options.explain, partial(explainer.write, options.explain)))
    _write_all(writes, None if writer is None else writer.problem)


def _write_all(writes: Iterable[tuple[Path, Callable[[], None]]], before: OSError | None) -> None:
    """Write all files that can be written.

    Raises:
        OSError: why the others cannot, and what has failed before.
    """
    problems = [] if before is None else [str(before)]
    for path, write in writes:
        try:
            write()
        except OSError as problem:
            problems.append(f"{path} cannot be written: {problem.strerror or problem}")
    if problems:
        raise OSError("\n".join(problems))


@asynccontextmanager
async def _filmed(options: argparse.Namespace, scene: Scene, clock: Clock) -> AsyncIterator[AfterTick]:
    """Films the session, if the options ask for it."""
    if not options.video:
        yield no_wait
        return
    from reactive_realizer.export.video import Picture, filmed  # it needs the server

    async with filmed(scene, clock, options.video, Picture(options.shot, options.video_size)) as after_tick:
        yield after_tick


def _put(realizer: Realizer, entry: InputFile, warnings: WarningPrinter) -> bool:
    """Puts a file into the realizer at its time, whose warnings are expected; returns whether it could be read."""
    try:
        document = realizer.read(BmlText(entry.path.read_bytes()))
    except OSError as problem:
        print(problem, file=sys.stderr)
        return False
    warnings.expect(entry.path, document)
    realizer.put(document, entry.time)
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
