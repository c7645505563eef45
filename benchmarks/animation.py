"""Measures the animation of a character: time for each frame, from its engine to rotations ready to be sent."""

import asyncio
from collections.abc import Callable, Coroutine, Sequence
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from reactive_realizer.assembly.scene import SceneOptions, open_scene
from reactive_realizer.clock.ticker import FRAME_EVERY, RATE, Tick, tick_time
from reactive_realizer.engine.guarded_engine import GuardedEngine
from reactive_realizer.realizer.character import Character
from reactive_realizer.server.live_scene import keep_from_ticks
from reactive_realizer.testing.pilot import RealizerPilot, block

AIMS = {"us_per_character_frame.1": 400, "us_per_character_frame.50": 250}

_CROWDS = (1, 10, 50, 100)
_FRAME_US = 1e6 * FRAME_EVERY / RATE

_CHARACTER = '[character.c{0}]\navatar = "avatars/female.glb"\nposition = [{0}, 0, 0]\n'
# Breathing is idle animation; all characters look at the first one.
_INSIDE = (
    '<gaze id="z" target="c0:l_wrist" start="0" end="6"/>'
    + "".join(
        f'<gesture id="g{i}" lexeme="BEAT" mode="BOTH_HANDS" start="{2 * i}" end="{2 * i + 2}"/>' for i in range(3)
    )
    + "".join(f'<head id="h{i}" lexeme="NOD" start="{2 * i}" end="{2 * i + 2}"/>' for i in range(3))
)
_WALK = '<locomotion id="w" target="0 12" start="0"/>'
_ALL_MOVE = (0.1, 5.5)
"""Times in the block between which all its behaviors play, s."""


def measure(most: int = 100) -> dict[str, object]:
    """The median time of a character's frame, us, and the number of characters that take all the time between frames.

    ``walk_us`` is how much longer a tick with a frame takes than one without while one character walks, us. A figure
    that walks moves with the frames of the realizer, so that its engine cannot be asked for others.

    Args:
        most: number of characters; larger crowds have no result.
    """
    times = {str(size): _microseconds(size, _perform) if size <= most else None for size in _CROWDS}
    largest = [time for time in times.values() if time is not None][-1]
    walk = _microseconds(1, _walk)
    return {"us_per_character_frame": times, "characters_at_50fps": int(_FRAME_US / largest), "walk_us": walk}


def _microseconds(size: int, perform: Callable[[Path], Coroutine[None, None, float]]) -> float:
    with TemporaryDirectory() as folder:
        human = Path(folder, "crowd.toml")
        human.write_text("".join(map(_CHARACTER.format, range(size))), encoding="utf-8")
        return round(asyncio.run(perform(human)), 1)


async def _perform(human: Path) -> float:
    async with open_scene(SceneOptions(human, "text")) as scene:
        pilot = RealizerPilot(scene)
        crowd = list(scene.realizer.characters.values())
        for character in crowd:
            pilot.perform(block(f"b-{character.id}", _INSIDE, characterId=character.id))
        begin, end = _ALL_MOVE
        await pilot.advance(begin)
        keep_from_ticks()  # as a server does
        return median([await _frame(pilot, crowd) for _ in range(round((end - begin) * RATE / FRAME_EVERY))])


async def _walk(human: Path) -> float:
    async with open_scene(SceneOptions(human, "text")) as scene:
        pilot = RealizerPilot(scene)
        pilot.perform(block("b", _WALK))
        begin, end = _ALL_MOVE
        await pilot.advance(begin)
        keep_from_ticks()
        times: dict[bool, list[float]] = {True: [], False: []}
        while pilot.now < end:
            has_frame = round(pilot.now * RATE) % FRAME_EVERY == 0
            start = perf_counter()
            await pilot.tick()
            times[has_frame].append(1e6 * (perf_counter() - start))
        return median(times[True]) - median(times[False])


async def _frame(pilot: RealizerPilot, crowd: Sequence[Character]) -> float:
    """Time for one frame of one character, us; the ticks between frames are not measured."""
    await pilot.advance(FRAME_EVERY / RATE)
    number = round(pilot.now * RATE)
    tick = Tick(number, tick_time(number - 1), frame=True)
    bodies = [(character, _animation(character)) for character in crowd]
    begin = perf_counter()
    shown = [(character, [engine.show(tick)]) for character, engine in bodies]
    for character, outputs in shown:
        character.move(tick.time, outputs)
    for character, outputs in shown:
        frame = character.look(outputs)
        character.humanoid.avatar.bone_rotations(frame.rotations)
    return 1e6 * (perf_counter() - begin) / len(crowd)


def _animation(character: Character) -> GuardedEngine:
    """The animation engine, guarded as in a realizer: its output is checked."""
    return GuardedEngine(next(engine for engine in character.engines if engine.name.endswith("/animation")))
