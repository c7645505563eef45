"""Procedural animation: motion written as formulas of phase and parameters (thesis 4.2.1 and 10.2.2.2)."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.quaternion import (
    Quat,
    conjugate,
    from_euler,
    multiply,
    normalize,
    power,
    rotate,
    slerp,
    twist,
)
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.embodiment.vector import Vec3, subtract, unit
from reactive_realizer.engines.animation.expression.compiler import Compiled, compile_formulas
from reactive_realizer.engines.animation.expression.nodes import Node
from reactive_realizer.engines.animation.procedural.tracks import EffectorTrack, Keyframe, KeyframeTrack, RotationTrack
from reactive_realizer.errors import error


@dataclass(frozen=True, slots=True)
class Timing:
    """When an animation would like things to happen.

    Attributes:
        duration: preferred, s.
        limits: shortest and longest duration, s; None where the author named no others than the preferred one.
        key_positions: sync id -> phase, 0 to 1, as authored.
    """

    duration: float
    limits: tuple[float, float] | None
    key_positions: Mapping[str, float]


@dataclass(frozen=True, slots=True, eq=False)
class ProcAnimation:
    """What a ProcAnimation file says.

    Attributes:
        name: of the file, for messages.
        parameters: their names and values where nobody says otherwise.
        durations: formulas of the preferred, shortest and longest duration, s.
        key_times: sync id -> formula of its phase.
        rotations: of joints.
        effectors: of wrists.
        keyframes: of joints.
    """

    name: str
    parameters: Mapping[str, float]
    durations: tuple[Node, Node, Node]
    key_times: Mapping[str, Node]
    rotations: tuple[RotationTrack, ...] = ()
    effectors: tuple[EffectorTrack, ...] = ()
    keyframes: tuple[KeyframeTrack, ...] = ()
    joints: frozenset[str] = field(init=False)
    _motion: Compiled = field(init=False, repr=False)
    _times: Compiled = field(init=False, repr=False)

    TIME: ClassVar[str] = "t"
    """The name of the phase in formulas."""

    def __post_init__(self) -> None:
        names = tuple(self.parameters)
        motion = [formula for formulas in self._formulas() for formula in formulas]
        times = [*self.durations, *self.key_times.values()]
        object.__setattr__(self, "_motion", compile_formulas(motion, (self.TIME, *names)))
        object.__setattr__(self, "_times", compile_formulas(times, names))
        object.__setattr__(self, "joints", frozenset(self._turned()))

    def _turned(self) -> Iterator[str]:
        yield from (track.joint for track in self.rotations)
        yield from (track.joint for track in self.keyframes)
        for track in self.effectors:
            yield from (f"{track.side}_shoulder", f"{track.side}_elbow")

    def _formulas(self) -> Iterator[tuple[Node, ...]]:
        """All formulas of motion, in the order in which `sample` takes their values."""
        yield from (track.angles for track in self.rotations)
        yield from (track.path for track in self.effectors)
        yield from (key.rotation for track in self.keyframes for key in track.keyframes)

    def values(self, parameters: Mapping[str, float]) -> dict[str, float]:
        """Values of its parameters: as given, else its own; names that it does not know are of no effect."""
        return {name: parameters.get(name, value) for name, value in self.parameters.items()}

    def timing(self, parameters: Mapping[str, float]) -> Timing:
        """When things happen, for given values of the parameters.

        Raises:
            RealizerError: "no-motion": a duration is not above 0, or a key position is not within 0 and 1.
        """
        preferred, shortest, longest, *phases = self._values(self._times, 0.0, [parameters[n] for n in self.parameters])
        if preferred <= 0.0:
            raise error("no-motion", animation=self.name, phase=0.0, reason=f"it would last {preferred:g} s")
        keys = dict(zip(self.key_times, phases, strict=True))
        wrong = [f"{name} at {phase:g}" for name, phase in keys.items() if not 0.0 <= phase <= 1.0]
        if wrong:
            raise error("no-motion", animation=self.name, phase=0.0, reason=f"not within 0 and 1: {', '.join(wrong)}")
        authored = not shortest == preferred == longest
        return Timing(preferred, (shortest, longest) if authored else None, keys)

    def sample(self, phase: float, parameters: Mapping[str, float], body: Body) -> dict[str, Quat]:
        """The rotations at a phase, 0 to 1, of the joints that this animation turns.

        Args:
            phase: 0 to 1.
            parameters: a value for each of the animation's names.
            body: proportions, and the pose of the joints above those turned.

        Raises:
            RealizerError: "no-motion": a formula has no value there.
        """
        values = iter(self._values(self._motion, phase, [phase, *(parameters[name] for name in self.parameters)]))
        turned = {track.joint: from_euler(next(values), next(values), next(values)) for track in self.rotations}
        for effector in self.effectors:
            goal = (next(values), next(values), next(values))
            turned.update(_arm(effector, goal, next(values), body.posed(turned)))
        for track in self.keyframes:
            keys = [(key, self._quaternion(values, phase)) for key in track.keyframes]
            turned[track.joint] = _between_keys(track.joint, keys, phase, body.posed(turned))
        for effector in self.effectors:
            _share_twist(effector.side, turned, body)
        return turned

    def _values(self, formulas: Compiled, phase: float, arguments: Sequence[float]) -> tuple[float, ...]:
        try:
            values = formulas(*arguments)
        except (ArithmeticError, ValueError) as problem:
            raise error("no-motion", animation=self.name, phase=phase, reason=str(problem)) from problem
        if not all(map(math.isfinite, values)):
            raise error("no-motion", animation=self.name, phase=phase, reason="a formula is infinite or undefined")
        return values

    def _quaternion(self, values: Iterator[float], phase: float) -> Quat:
        try:
            return normalize((next(values), next(values), next(values), next(values)))
        except ZeroDivisionError as problem:
            raise error("no-motion", animation=self.name, phase=phase, reason="a keyframe of length 0") from problem

    def mirrored(self) -> "ProcAnimation":
        """The same motion in a mirror: left is right."""
        return replace(
            self,
            rotations=tuple(track.mirrored() for track in self.rotations),
            effectors=tuple(track.mirrored() for track in self.effectors),
            keyframes=tuple(track.mirrored() for track in self.keyframes),
        )


def _arm(track: EffectorTrack, goal: Vec3, swivel: float, body: Body) -> dict[str, Quat]:
    shoulder, elbow = f"{track.side}_shoulder", f"{track.side}_elbow"
    if not track.local:
        above = body.place(body.skeleton.chain(shoulder)[-2]).rotation
        goal = rotate(conjugate(above), subtract(goal, body.place(shoulder).position))
    upper, lower = Arm.of(body.skeleton, track.side).solve(goal, swivel)
    return {shoulder: upper, elbow: lower}


def _between_keys(joint: str, keys: Sequence[tuple[Keyframe, Quat]], phase: float, body: Body) -> Quat:
    later = next((i for i, (key, _) in enumerate(keys) if key.phase >= phase), len(keys) - 1)
    (before, start), (after, goal) = keys[max(0, later - 1)], keys[later]
    start, goal = _local(joint, before, start, body), _local(joint, after, goal, body)
    length = after.phase - before.phase
    return slerp(start, goal, min(1.0, (phase - before.phase) / length)) if length > 0.0 else goal


def _local(joint: str, key: Keyframe, rotation: Quat, body: Body) -> Quat:
    if key.local or joint not in body.skeleton:
        return rotation
    return multiply(conjugate(body.place(body.skeleton.chain(joint)[-2]).rotation), rotation)


def _share_twist(side: str, turned: dict[str, Quat], body: Body) -> None:
    """Lets the forearm make half of the wrist's twist, as a radius and an ulna do; the hand stays as it is.

    All of it in the wrist would wring the skin there like a towel.
    """
    elbow, wrist = f"{side}_elbow", f"{side}_wrist"
    if wrist not in turned:
        return
    half = power(twist(turned[wrist], unit(body.skeleton.offset(wrist))), 0.5)
    turned[elbow] = multiply(turned[elbow], half)
    turned[wrist] = multiply(conjugate(half), turned[wrist])
