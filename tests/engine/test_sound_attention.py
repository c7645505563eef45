"""Which sounds an engine attends to when it plays: those that only wait cost nothing."""

import pytest

from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.bml.names import BML, Location
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.audio import Sound
from reactive_realizer.engine.player import Player
from reactive_realizer.engine.sound_attention import SoundAttention
from reactive_realizer.engine.sound_unit import SoundPart, SoundUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.pegboard.time_peg import AnticipatorPeg, OffsetPeg
from reactive_realizer.planunit.sync_point import SyncPoint
from reactive_realizer.planunit.timing import PhaseKind, timing_at
from reactive_realizer.reactive.graph import Graph

SECOND = Sound.from_pcm(b"\0\0" * 22_050, 22_050)


class Scene:
    """Sounds of a second that start at 1, 2 and 3 s, each at a time of its own from outside."""

    def __init__(self) -> None:
        self.graph = Graph()
        self.player = Player()
        self.attention = SoundAttention(self.player)
        self.starts = {id_: AnticipatorPeg(self.graph, id_, GlobalTime(time)) for time, id_ in enumerate("abc", 1)}
        self.units = {id_: self.unit(id_) for id_ in self.starts}
        for unit in self.units.values():
            self.attention.add(unit)
            self.player.add(unit)

    def unit(self, id_: str) -> SoundUnit:
        behavior = Wait(id=id_, namespace=BML, name="wait", location=Location(1, 1), order=0)
        timing = timing_at({"start": 0.0, "end": 1.0}, PhaseKind.RIGID)
        unit = SoundUnit(BlockKey("alice", "b"), behavior, timing, [SoundPart(0.0, SECOND)], self.graph)
        start = self.starts[id_]
        ends = (("start", 0.0), ("end", 1.0))
        unit.points = [SyncPoint(sync, OffsetPeg(self.graph, id_ + sync, start, later)) for sync, later in ends]
        unit.release()
        return unit

    def attended(self, number: int = 0) -> str:
        """The ids of the sounds that are attended to after a tick has played, in order."""
        self.player.play(Tick.on_time(number))
        self.attention.take()
        return "".join(unit.behavior.id for unit in self.attention.units)


@pytest.fixture
def scene() -> Scene:
    return Scene()


def test_sounds_are_attended_to_when_they_are_planned_in_this_order(scene: Scene) -> None:
    assert scene.attended() == "abc"


def test_sounds_that_only_wait_need_no_attention(scene: Scene) -> None:
    scene.attended()
    assert scene.attended(1) == scene.attended(2) == ""


def test_a_sound_that_waits_is_attended_to_when_its_start_moves(scene: Scene) -> None:
    scene.attended()
    with scene.graph.transaction("move"):
        scene.starts["c"].set(GlobalTime(5.0))
    assert scene.attended(1) == "c"
    assert scene.attended(2) == ""


def test_a_sound_is_attended_to_when_it_has_changed(scene: Scene) -> None:
    scene.attended()
    scene.player.note(scene.units["c"])
    scene.player.note(scene.units["b"])
    assert scene.attended(1) == "bc"


def test_a_sound_is_attended_to_while_it_plays_and_once_more_when_it_has_ended(scene: Scene) -> None:
    scene.attended()
    assert [scene.attended(number) for number in (99, 100, 150, 199)] == ["", "a", "a", "a"]
    assert scene.attended(200) == "ab", "b starts as a ends"
    assert scene.attended(201) == "b"


def test_a_sound_that_leaves_is_attended_to_once_more(scene: Scene) -> None:
    scene.attended()
    unit = scene.units["b"]
    unit.drop(GlobalTime(0.5))
    scene.player.remove(unit)
    assert scene.attended(1) == "b"
    with scene.graph.transaction("move"):
        scene.starts["b"].set(GlobalTime(5.0))
    assert scene.attended(2) == ""
