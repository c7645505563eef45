"""Sequences of motions."""

import threading
from pathlib import Path

import numpy as np
import pytest

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.pose import ComposedBody, Layer, LayerKind, compose
from reactive_realizer.embodiment.quaternion import angle, from_axis_angle
from reactive_realizer.embodiment.vector import UP, Vec3
from reactive_realizer.engines.animation.keyframe import capture_words
from reactive_realizer.engines.animation.monotone_curve import MonotoneCurve
from reactive_realizer.engines.animation.motion_unit import Moment, MotionPose, MotionUnit, layer_of
from reactive_realizer.engines.animation.motions.sequence import SequenceMotionUnit, SequencePart
from reactive_realizer.planunit.parameter import Range
from reactive_realizer.testing.pilot import RealizerPilot, open_pilot

from .capturing import bvh


class Turning(MotionUnit):
    """Turns joints to the left at a constant speed from 0 to an angle, rad."""

    preferred_duration = 1.0
    key_positions = {"start": 0.0, "stroke": 0.5, "end": 1.0}  # noqa: RUF012

    def __init__(
        self,
        radians: float,
        *joints: str,
        kind: LayerKind = LayerKind.GESTURE,
        root: Vec3 | None = None,
        **parameters: float,
    ) -> None:
        self.kind = kind
        self.joints = frozenset(joints)
        self.parameters = parameters
        self.ranges = dict.fromkeys(parameters, Range(0.0, 1.0))
        self.begun: list[Body] = []
        self._radians, self._root = radians, root

    def start(self, body: Body) -> None:
        self.begun.append(body)

    def pose(self, moment: Moment) -> MotionPose:
        return MotionPose(
            dict.fromkeys(self.joints, from_axis_angle(UP, self._radians * moment.phase)), root=self._root
        )


class Shown:
    """Parts over a body whose joints are turned by 0.4 rad."""

    def __init__(self, skeleton: Skeleton) -> None:
        self.skeleton = skeleton

    def __call__(self, parts: list[SequencePart], time: float, joint: str = "skullbase") -> float:
        """The angle of a joint, rad, at a time, s."""
        return angle(self.composed(parts, time).shown.pose[joint])

    def composed(self, parts: list[SequencePart], time: float) -> ComposedBody:
        whole = SequenceMotionUnit(parts, {})
        below = Layer(LayerKind.BASE, dict.fromkeys(("skullbase", "vc4", "vl5"), from_axis_angle(UP, 0.4)))
        body = Body(self.skeleton)
        whole.start(body)
        moment = Moment(time / whole.preferred_duration, GlobalTime(time), body)
        return compose(self.skeleton, [below, layer_of(whole, moment)])


@pytest.fixture
def shown(skeleton: Skeleton) -> Shown:
    return Shown(skeleton)


def test_a_part_is_shifted_to_its_start_and_stretched_to_its_end(
    shown: Shown,
) -> None:
    parts = [SequencePart(Turning(1.0, "skullbase"), 1.0, 3.0), SequencePart(Turning(1.0, "vl5"), 0.0, 4.0)]
    assert shown(parts, 0.5) == pytest.approx(0.4), "what lies below"
    assert shown(parts, 1.5) == pytest.approx(0.25)
    assert shown(parts, 3.0) == pytest.approx(1.0)
    assert shown(parts, 3.5) == pytest.approx(0.4)


def test_a_part_fades_in_and_out_over_the_layers_below(
    shown: Shown,
) -> None:
    parts = [SequencePart(Turning(0.0, "skullbase"), 0.0, 2.0, ease_in=1.0, ease_out=0.5)]
    assert shown(parts, 0.0) == pytest.approx(0.4)
    assert shown(parts, 0.5) == pytest.approx(0.2)
    assert shown(parts, 1.2) == pytest.approx(0.0)
    assert shown(parts, 1.75) == pytest.approx(0.2)
    assert shown(parts, 2.0) == pytest.approx(0.4)


def test_later_parts_lie_over_earlier_ones_by_their_weights(
    shown: Shown,
) -> None:
    low, high = Turning(0.0, "skullbase"), Turning(1.6, "skullbase")
    assert shown([SequencePart(low, 0.0, 1.0), SequencePart(high, 0.0, 1.0, ease_in=1.0)], 0.5) == pytest.approx(0.4)
    # Three quarters of both, of which two thirds the upper one.
    both = [SequencePart(low, 0.0, 1.0, ease_in=1.0), SequencePart(high, 0.0, 1.0, ease_in=1.0)]
    assert shown(both, 0.5) == pytest.approx(0.5 * 0.8 + 0.25 * 0.0 + 0.25 * 0.4)


def test_joints_of_parts_are_weighted_separately(shown: Shown) -> None:
    parts = [
        SequencePart(Turning(0.0, "skullbase"), 0.0, 1.0),
        SequencePart(Turning(0.0, "vc4"), 0.0, 1.0, ease_in=1.0),
    ]
    assert shown(parts, 0.5, "skullbase") == pytest.approx(0.0)
    assert shown(parts, 0.5, "vc4") == pytest.approx(0.2)


def test_a_part_has_the_phase_of_its_curve_and_may_go_back(shown: Shown) -> None:
    there_and_back = MonotoneCurve([(0.0, 0.0), (1.0, 1.0), (3.0, 0.0)])
    parts = [SequencePart(Turning(1.0, "skullbase"), 1.0, 4.0, phases=there_and_back)]
    assert shown(parts, 1.5) == pytest.approx(there_and_back(0.5))
    assert shown(parts, 2.0) == pytest.approx(1.0)
    assert shown(parts, 4.0) == pytest.approx(0.0)
    assert parts[0].time("stroke") == pytest.approx(1.0 + there_and_back.first_time(0.5))


def test_a_part_has_the_weight_of_its_curve(shown: Shown) -> None:
    parts = [SequencePart(Turning(0.0, "skullbase"), 1.0, 3.0, weights=MonotoneCurve([(0.0, 0.0), (1.0, 0.5)]))]
    assert shown(parts, 1.5) == pytest.approx(0.75 * 0.4)
    assert shown(parts, 2.5) == pytest.approx(0.5 * 0.4)


def test_additive_parts_add_up(shown: Shown) -> None:
    parts = [
        SequencePart(Turning(0.2, "skullbase", kind=LayerKind.ADDITIVE), 0.0, 1.0),
        SequencePart(Turning(0.4, "skullbase", kind=LayerKind.ADDITIVE), 0.0, 1.0, ease_out=1.0),
    ]
    assert shown(parts, 0.5) == pytest.approx(0.4 + 0.1 + 0.1)


def test_the_root_is_weighted_with_the_part_that_moves_it(
    shown: Shown,
) -> None:
    parts = [
        SequencePart(Turning(0.0, "skullbase"), 0.0, 1.0),
        SequencePart(Turning(0.0, root=(0.0, -0.2, 0.0)), 0.0, 1.0, ease_in=1.0),
    ]
    assert shown.composed(parts, 0.5).shown.root == pytest.approx((0.0, -0.1, 0.0))


def test_each_part_starts_once_from_the_body_at_its_time(skeleton: Skeleton) -> None:
    first, second = Turning(1.0, "skullbase"), Turning(1.0, "vc4")
    whole = SequenceMotionUnit([SequencePart(first, 0.0, 1.0), SequencePart(second, 1.0, 2.0)], {})
    bodies = [Body(skeleton) for _ in range(5)]
    whole.start(bodies[0])
    for phase, body in zip((0.0, 0.3, 0.6, 0.9), bodies[1:], strict=True):
        whole.pose(Moment(phase, GlobalTime(phase), body))
    assert [len(part.begun) for part in (first, second)] == [1, 1]
    assert second.begun[0] is bodies[3]


def test_a_parameter_with_equal_values_in_all_parts_is_a_parameter_of_the_sequence(skeleton: Skeleton) -> None:
    first, second = Turning(1.0, "vc4", amount=1.0, a=0.2), Turning(1.0, "vl5", amount=1.0, a=0.3)
    whole = SequenceMotionUnit([SequencePart(first, 0.0, 1.0), SequencePart(second, 0.0, 1.0)], {})
    assert whole.parameters == {"amount": 1.0}
    assert list(whole.ranges) == ["amount"]
    whole.parameters = {**whole.parameters, "amount": 0.5}
    whole.pose(Moment(0.5, GlobalTime(0.5), Body(skeleton)))
    assert first.parameters == {"amount": 0.5, "a": 0.2}
    assert second.parameters == {"amount": 0.5, "a": 0.3}


def test_a_sequence_has_only_its_named_points_in_order() -> None:
    keys = SequenceMotionUnit([SequencePart(Turning(1.0, "vc4"), 0.0, 4.0)], {"late": 3.0, "early": 1.0}).key_positions
    assert list(keys.items()) == [("start", 0.0), ("early", 0.25), ("late", 0.75), ("end", 1.0)]


# --- files

LIFT = '<ProcAnimation prefDuration="2"><Rotation target="r_elbow" rotation="0 - sin(t*pi);0;0"/></ProcAnimation>'
TURN = '<ProcAnimation prefDuration="2"><Rotation target="r_elbow" rotation="0 - t;0;0"/></ProcAnimation>'
TWO = """
<Sequence>
  <Motion id="low" type="ProcAnimation" file="lift.xml" start="0"/>
  <Motion id="both" type="Gesture" file="procanimation/beat_both.xml" start="1.5" easeIn="0.2">
    <parameter name="amount" value="0.5"/>
  </Motion>
  <KeyPosition id="stroke" ref="both:stroke"/>
  <KeyPosition id="lifted" ref="low:end"/>
</Sequence>
"""
BINDING = """
<gesturebinding>
  <MotionUnitSpec type="gesture">
    <constraints><constraint name="lexeme" value="TWO"/></constraints>
    <MotionUnit type="Sequence" file="two.xml"/>
  </MotionUnitSpec>
</gesturebinding>
"""


def part(attributes: str, more: str = "") -> str:
    return f'<Sequence><Motion id="p" type="ProcAnimation" file="lift.xml" start="0" {attributes}/>{more}</Sequence>'


async def perform(folder: Path, sequence: str, seconds: float) -> RealizerPilot:
    files = {"gesturebinding.xml": BINDING, "lift.xml": LIFT, "turn.xml": TURN, "two.xml": sequence}
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    async with open_pilot(SceneOptions(voice="text", assets=(folder,))) as pilot:
        pilot.watch()
        pilot.block("b", '<gesture id="g" lexeme="TWO"/>')
        await pilot.advance(seconds)
        return pilot


async def test_a_sequence_of_a_file_plays_as_one_behavior_with_its_parts_points(tmp_path: Path) -> None:
    pilot = await perform(tmp_path, TWO, 8)
    assert pilot.feedback.warnings == []
    assert pilot.feedback.time("b:g:lifted") == 2.0
    assert pilot.feedback.time("b:g:stroke") > 1.8
    assert pilot.feedback.time("b:g:end") > pilot.feedback.time("b:g:stroke") + 0.5
    right, left = (np.ptp(pilot.path(f"{side}_wrist"), axis=0).max() for side in "rl")
    assert min(right, left) > 0.1
    still = pilot.path("l_wrist")[:70]
    assert np.ptp(still, axis=0).max() < 0.02


@pytest.mark.parametrize(
    ("sequence", "said"),
    [
        ("<Sequence/>", "one or more parts, all of one kind"),
        ('<Sequence><Motion type="Dance" file="lift.xml" start="0"/></Sequence>', "type='Dance': a part may be"),
        ('<Sequence><Motion type="gaze" start="0"/></Sequence>', "type='gaze': a part may be"),
        ('<Sequence><Motion type="transition" start="0"/></Sequence>', "type='transition': a part may be"),
        ('<Sequence><Motion type="ProcAnimation" file="lift.xml" start="2" end="1"/></Sequence>', "start < end"),
        ('<Sequence><Motion type="ProcAnimation" file="lift.xml" start="0" easeIn="9"/></Sequence>', "between them"),
        ('<Sequence><Motion type="ProcAnimation" file="lift.xml" start="now"/></Sequence>', "is not a number"),
        ('<Sequence><Motion type="ProcAnimation" file="none.xml" start="0"/></Sequence>', "no asset named 'none.xml'"),
        ('<Sequence><Motion type="Sequence" file="two.xml" start="0"/></Sequence>', "contains itself"),
        (part('phases="0 0"'), "phases='0 0': it must be two or more times"),
        (part('phases="0 0, 0 1"'), "from 0 on and increasing"),
        (part('phases="0 0, 1 2"'), "a value from 0 to 1"),
        (part('phases="0 0, 1"'), "0 0, 0.5 1"),
        (part('phases="0 0, 1 1" end="2"'), "phases replaces end"),
        (part('phases="0 0, 1e300 1"'), "phases='0 0, 1e300 1': it must be"),
        (part('weights="0 0, nan 1"'), "weights='0 0, nan 1': it must be"),
        (part('weights="0 0, 1 1" easeIn="0.2"'), "weights replaces easeIn"),
        (part('phases="0 0, 1 0.2"', '<KeyPosition id="x" ref="p:end"/>'), "no point 'p:end'"),
        (TWO.replace("low:end", "high:end"), "no point 'high:end'"),
        (TWO.replace('id="both"', 'id="low"'), "there is already a part 'low'"),
        (TWO.replace('id="lifted"', 'id="end"'), "reserved for the whole"),
        (TWO.replace('id="lifted"', 'id="lifted up"'), "cannot name a sync point"),
        (TWO.replace("KeyPosition", "Point"), "known are Motion, KeyPosition"),
    ],
)
async def test_an_invalid_sequence_file_is_refused_with_the_reason(sequence: str, said: str, tmp_path: Path) -> None:
    pilot = await perform(tmp_path, sequence, 0.2)
    assert [warning for _, warning in pilot.feedback.warnings] == ["CANNOT_CREATE_BEHAVIOR"]
    assert said in pilot.feedback.of("warningFeedback")[0].text


async def test_a_part_of_a_file_plays_backward_and_its_points_are_where_it_is_then(tmp_path: Path) -> None:
    forward = part('phases="0 0, 2 1"', '<KeyPosition id="end_of_it" ref="p:end"/>')
    backward = part('phases="0 1, 2 0"', '<KeyPosition id="end_of_it" ref="p:end"/>')
    paths = []
    for name, text in (("forward", forward), ("backward", backward)):
        (tmp_path / name).mkdir()
        pilot = await perform(tmp_path / name, text.replace("lift.xml", "turn.xml"), 3)
        assert pilot.feedback.warnings == []
        paths.append(pilot.path("r_wrist"))
        assert pilot.feedback.time("b:g:end_of_it") == (2.0 if name == "forward" else 0.0)
    assert paths[0][25] == pytest.approx(paths[1][75], abs=0.01)


async def test_a_capture_in_a_sequence_is_read_in_another_thread(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    reads = []

    def read_bytes(path: Path) -> bytes:
        reads.append(threading.current_thread())
        return path.read_bytes()

    monkeypatch.setattr(capture_words, "read_bytes", read_bytes)
    (tmp_path / "step.bvh").write_text(bvh({}, {"LeftArm": (0.0, 0.0, 60.0)}, step=1.0))
    inner = '<Sequence><Motion type="Keyframe" file="step.bvh" start="0"/></Sequence>'
    (tmp_path / "inner.xml").write_text(inner)
    pilot = await perform(tmp_path, '<Sequence><Motion type="Sequence" file="inner.xml" start="0.5"/></Sequence>', 5)
    assert pilot.feedback.time("b:g:end") - pilot.feedback.time("b:g:start") == pytest.approx(1.5)
    assert [thread is threading.main_thread() for thread in reads] == [False]


async def test_exponentially_nested_files_are_refused(tmp_path: Path) -> None:
    for i in range(12):
        inner = f'type="Sequence" file="s{i + 1}.xml"' if i < 11 else 'type="ProcAnimation" file="lift.xml"'
        part = f'<Motion {inner} start="0"/>'
        (tmp_path / f"s{i}.xml").write_text(f"<Sequence>{part}{part}</Sequence>")
    outer = '<Sequence><Motion type="Sequence" file="s0.xml" start="0"/></Sequence>'
    pilot = await perform(tmp_path, outer, 0.2)
    assert "a sequence, with nested ones, has more than 100 parts" in str(pilot.feedback.of("warningFeedback")[0].text)
