"""Reads a sequence of key poses: a behavior for each body group, each morph target and shader, and each clip."""

from collections.abc import Iterator, Mapping
from itertools import pairwise
from types import MappingProxyType
from typing import Any, Final, NamedTuple

from lxml import etree

from reactive_realizer.bml.attribute_types import Id
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.embr.autonomous import Autonomous, read_autonomous
from reactive_realizer.bml.embr.faults import BadValue, Limited, UnknownName
from reactive_realizer.bml.embr.goals import GOALS, read_goal
from reactive_realizer.bml.embr.nucleus import Nuclei
from reactive_realizer.bml.embr.syntax import AUTONOMOUS, CLIP, MORPH, POSE, Node
from reactive_realizer.bml.embr.timeline import Timed, sequence_start, timed
from reactive_realizer.bml.embr.values import Notes
from reactive_realizer.bml.embr.words import MORPHS, SHADERS, Expression
from reactive_realizer.bml.extensions import FaceKeyframe, Keyframe
from reactive_realizer.bml.key_poses import KeyPose, KeyPoseGoal, KeyPoses
from reactive_realizer.bml.motion_faults import BeyondLimit
from reactive_realizer.bml.names import BMLT, OWN, Location, is_sync_id
from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.bml.time_warps import warped
from reactive_realizer.bml.vocabulary import BodyGroup, FacePart, WarpKind
from reactive_realizer.errors import RealizerError, quoted
from reactive_realizer.limits import Limits

_SAMPLES = 10
"""Number of parts of a warped way of a weight, each of which is even."""

_FINGERS: Final = (BodyGroup.LEFT_HAND, BodyGroup.RIGHT_HAND)

Warped = tuple[WarpKind | None, float]
"""A time warp and its steepness."""


class _Step(NamedTuple):
    """The part of a key pose that concerns one body group or one weight.

    Attributes:
        at: its times.
        value: of a weight.
        goals: of joints.
        id: of its sync point.
        warp: of the way to it.
        place: of its first constraint.
    """

    at: Timed
    value: float
    goals: tuple[KeyPoseGoal, ...]
    id: str | None
    warp: Warped
    place: Location


class SequenceReader:
    """Reads one sequence.

    Attributes:
        behaviors: that it means, each with its id and start; their order counts from 0.
    """

    def __init__(self, node: Node, name: str, nuclei: Nuclei, notes: Notes) -> None:
        """Read a sequence.

        Args:
            node: its element.
            name: of the sequence; ids of its behaviors begin with it.
            nuclei: of the script.
            notes: receives the faults of what is left out.
        """
        self._node, self._name, self._notes = node, name, notes
        self._start = sequence_start(node, notes)
        self._fades = self._fade("FADE_IN"), self._fade("FADE_OUT")
        self._warp = self._warp_of(node)
        self._groups: dict[BodyGroup, list[_Step]] = {}
        self._weights: dict[tuple[str, str], list[_Step]] = {}
        self._autonomous: list[Autonomous] = []
        self._clips: list[Timed] = []
        self._goals: dict[object, int] = {}
        for each in nuclei.expressed(timed(node, self._start, notes)):
            if each.node.name == CLIP:
                self._clips.append(each)
            else:
                self._take(each)

    def behaviors(self) -> Iterator[Behavior]:
        """The behaviors of the sequence."""
        for group, steps in self._groups.items():
            yield self._key_poses(group, steps)
        for (kind, key), steps in self._weights.items():
            yield self._face(kind, key, steps)
        for number, each in enumerate(self._autonomous, 1):
            part, place = f"{_id_of(each.key)}{number}", each.node.location
            points = {sync: self._start + time for sync, time in each.points.items()}
            yield each.kind(
                **self._common(part, each.element, each.kind.NAMESPACE, place), syncs=_syncs(points), **each.values
            )
        for number, clip in enumerate(self._clips, 1):
            try:
                yield self._clip(clip, number)
            except RealizerError as refused:
                self._notes.faults.append(refused.fault)

    def _fade(self, name: str) -> float:
        try:
            return self._notes.seconds(self._node, name, 0.0)
        except RealizerError as refused:
            self._notes.faults.append(refused.fault)
            return 0.0

    def _warp_of(self, *nodes: Node) -> Warped:
        """The time warp of the first of some elements that has one."""
        for node in nodes:
            if "TIME_WARP" in node.values:
                try:
                    return self._notes.warp(node)
                except RealizerError as refused:
                    self._notes.faults.append(refused.fault)
        return None, 1.0

    # --- key poses

    def _take(self, at: Timed) -> None:
        groups: dict[BodyGroup, list[tuple[Node, KeyPoseGoal]]] = {}
        for constraint in at.node.children:
            try:
                if constraint.name in GOALS:
                    group, goal = self._notes.body_group(constraint), read_goal(constraint, self._notes)
                    groups.setdefault(group, []).append((constraint, goal))
                elif constraint.name == AUTONOMOUS:
                    if (found := read_autonomous(at, constraint, self._notes)) is not None:
                        self._autonomous.append(found)
                else:
                    self._take_weight(at, constraint)
            except RealizerError as refused:
                self._notes.faults.append(refused.fault)
        for group, read in groups.items():
            if self._is_beyond(group, len(read), at.node.location):
                continue
            nodes = [node for node, _ in read]
            steps = self._groups.setdefault(group, [])
            goals = tuple(goal for _, goal in read)
            warp = self._warp_of(*nodes, at.node)
            steps.append(_Step(at, 0.0, goals, self._feedback(nodes, steps), warp, nodes[0].location))

    def _take_weight(self, at: Timed, node: Node) -> None:
        kind = "MORPH" if node.name == MORPH else "SHADER"
        key = self._notes.text(node, f"{kind}_KEY")
        value = self._weight(node, f"{kind}_VALUE")
        if kind == "SHADER" and key not in SHADERS:
            place = node.values["SHADER_KEY"].location
            fault = UnknownName(kind="SHADER_KEY", name=quoted(key), known=tuple(SHADERS))
            raise RealizerError(fault.located(place.line, place.column))
        if self._is_beyond((kind, key), 1, at.node.location):
            return
        steps = self._weights.setdefault((kind, key), [])
        warp = self._warp_of(node, at.node)
        steps.append(_Step(at, value, (), self._feedback([node], steps), warp, node.location))

    def _weight(self, node: Node, name: str) -> float:
        """The weight of a morph target or shader, 0 to 1; one beyond is named, and becomes the limit."""
        value = self._notes.number(node, name)
        limited = min(max(value, 0.0), 1.0)
        if value != limited:
            bound = f"{'at most' if limited else 'at least'} {limited:g}"
            self._notes.add(Limited(key=name, value=value, bound=bound), node.values[name].location)
        return limited

    def _is_beyond(self, part: object, goals: int, place: Location) -> bool:
        """Count the goals of a pose, and return whether they exceed the limit; the first pose that exceeds it is named.

        Args:
            part: the body group or the weight that has the goals.
            goals: their number.
            place: of the pose.
        """
        before, most = self._goals.get(part, 0), self._notes.most_goals
        self._goals[part] = before + goals
        if before <= most < self._goals[part]:
            self._notes.add(BeyondLimit(element=POSE, limit=most, things="goals", key="goals_per_behavior"), place)
        return self._goals[part] > most

    def _feedback(self, nodes: list[Node], steps: list[_Step]) -> str | None:
        """The id of the sync point of some constraints on the same joints at the same time."""
        given = [node.values["FEEDBACK_ID"] for node in nodes if "FEEDBACK_ID" in node.values]
        if not given:
            return None
        text = given[0].text
        taken = {*KeyPoses.SYNC_POINTS, *(step.id for step in steps)}
        try:
            if text in taken or not is_sync_id(Id().read(text, Limits())):
                raise RealizerError(BadValue(parameter="FEEDBACK_ID", value=quoted(text), reason=""))
        except RealizerError:
            reason = "it has to be a name that no other pose of this group has"
            self._notes.add(BadValue(parameter="FEEDBACK_ID", value=quoted(text), reason=reason), given[0].location)
            return None
        return text

    def _key_poses(self, group: BodyGroup, steps: list[_Step]) -> Behavior:
        ends = [*(step.at.begins for step in steps[1:]), steps[-1].at.left]
        curves = self._curves(group, steps)
        poses = tuple(
            KeyPose(
                time=step.at.reached,
                hold=round(end - step.at.reached, 6),
                id=step.id,
                warp=step.warp[0],
                steepness=step.warp[1],
                power=step.at.power,
                **curve,
                goals=step.goals,
                location=step.place,
            )
            for step, end, curve in zip(steps, ends, curves, strict=True)
        )
        kind, steepness = self._warp
        return KeyPoses(
            **self._common(group.value.lower(), "keyPoses", OWN, steps[0].place),
            syncs=_syncs({"start": self._start}),
            group=group,
            fade_in=self._fades[0],
            fade_out=self._fades[1],
            warp=kind,
            steepness=steepness,
            poses=poses,
        )

    def _curves(self, group: BodyGroup, steps: list[_Step]) -> list[dict[str, float]]:
        """The parameters of the curve at each pose that the motion passes; none where it stops.

        It stops for a hold, which may be written as the same pose again, and where a time warp says how it begins and
        ends. Fingers stop at each of their poses: beyond it, they would go through the palm.
        """
        if group in _FINGERS:
            return [{} for _ in steps]
        stops = {len(steps)}
        for number, (here, after) in enumerate(pairwise(steps), 1):
            warped = (here.warp[0] or after.warp[0] or self._warp[0]) is not None
            if warped or after.at.begins > here.at.reached or here.goals == after.goals:
                stops |= {number}
            if here.goals == after.goals:
                stops |= {number + 1}
        return [{} if number in stops else _curve(step.at.power) for number, step in enumerate(steps, 1)]

    # --- face

    def _face(self, kind: str, key: str, steps: list[_Step]) -> Behavior:
        if kind == "SHADER":
            expression = Expression(FacePart.MORPH, {SHADERS[key]: 1.0})
        else:
            expression = MORPHS.get(key, Expression(FacePart.MORPH, {key: 1.0}))
        return FaceKeyframe(
            **self._common(_id_of(key), "facekeyframe", BMLT, steps[0].place),
            syncs=_syncs({"start": self._start}),
            type=expression.type,
            interpolator=self._interpolator(expression, steps),
        )

    def _interpolator(self, expression: Expression, steps: list[_Step]) -> str:
        rows = {0.0: 0.0}
        last = 0.0
        for step in steps:
            rows[step.at.begins] = last
            rows |= self._way(step, last)
            rows[step.at.left] = last = step.value
        if self._fades[1] > 0.0:
            rows[round(steps[-1].at.left + self._fades[1], 6)] = 0.0
        element = etree.Element("FaceInterpolator", parts=" ".join(expression.parts))
        for step in steps:
            if step.id is not None:
                etree.SubElement(element, "KeyPosition", id=step.id, time=f"{step.at.reached:g}")
        lines = (
            " ".join([f"{time:.6g}", *(f"{share * value:.4g}" for share in expression.parts.values())])
            for time, value in rows.items()
        )
        element.text = "\n" + "\n".join(lines) + "\n"
        return etree.tostring(element, encoding="unicode")

    def _way(self, step: _Step, last: float) -> Mapping[float, float]:
        """The weights on the way to a pose, by time."""
        kind, steepness = step.warp if step.warp[0] is not None else self._warp
        shares = [number / _SAMPLES for number in range(1, _SAMPLES)] if kind is not None else []
        way = {step.at.begins + share * (step.at.reached - step.at.begins): share for share in shares}
        values = {
            round(time, 6): last + warped(share, kind, steepness) * (step.value - last)
            for time, share in way.items()
            if kind is not None
        }
        return {**values, step.at.reached: step.value}

    # --- clips

    def _clip(self, clip: Timed, number: int) -> Behavior:
        name, group = self._notes.text(clip.node, "ANIMATION_CLIP"), self._notes.body_group(clip.node)
        length = clip.reached - clip.begins
        shares = {"fadeIn": self._fades[0] / length, "fadeOut": self._fades[1] / length}
        parameters = {fade: f"{min(1.0, share):.4g}" for fade, share in shares.items() if share > 0.0}
        if group is not BodyGroup.WHOLEBODY:
            parameters["group"] = group.value
        parameters["replacementgroup"] = group.value  # a later clip overrides an earlier one
        return Keyframe(
            **self._common(f"animation{number}", "keyframe", BMLT, clip.node.location),
            syncs=_syncs({"start": self._start + clip.begins, "end": self._start + clip.reached}),
            animation=name,
            parameters=MappingProxyType(parameters),
        )

    # --- what all have

    def _common(self, part: str, element: str, namespace: str, place: Location) -> dict[str, Any]:
        name = f"{self._name}_{part}"
        return {"id": name, "name": element, "namespace": namespace, "location": place, "order": 0}


def _syncs(points: Mapping[str, float]) -> Mapping[str, SyncRef]:
    """References to times, s after the script enters."""
    return MappingProxyType({sync: SyncRef(None, None, None, round(time, 6)) for sync, time in points.items()})


def _curve(power: float) -> dict[str, float]:
    """The parameters of the curve at a pose: power is tension and bias, as in EMBR.

    Its continuity is 0 there unless fluidity is below 0, which has the hand stop at each pose instead.
    """
    return {"tension": power, "bias": power}


def _id_of(key: str) -> str:
    """A name for a sync reference."""
    return "".join(letter if letter.isalnum() or letter in "_-." else "_" for letter in key)[:60]
