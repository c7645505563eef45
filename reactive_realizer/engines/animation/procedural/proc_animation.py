"""Procedural animation: motion written as formulas of phase and parameters (thesis 4.2.1 and 10.2.2.2)."""

import logging
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, pairwise
from typing import ClassVar

from reactive_realizer.binding.sync_id import is_placed
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.skeleton import Skeleton
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.engines.animation.expression.compiler import Compiled, compile_formulas
from reactive_realizer.engines.animation.expression.nodes import Node
from reactive_realizer.engines.animation.motion_unit import Posed
from reactive_realizer.engines.animation.procedural.effector_track import EffectorTrack, as_carried, share_twist
from reactive_realizer.engines.animation.procedural.tracks import Formulas, RootTrack, RotationTrack, Track
from reactive_realizer.errors import Fault, error

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class AuthoredTiming:
    """When an animation would like things to happen.

    Attributes:
        duration: preferred, s.
        limits: shortest and longest duration, s; None where the author named no others than the preferred one.
        key_positions: sync id -> phase, 0 to 1, as authored.
    """

    duration: float
    limits: tuple[float, float] | None
    key_positions: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class ProcAnimation:
    """What a ProcAnimation file says.

    Attributes:
        name: of the file, for messages.
        parameters: their names and values where nobody says otherwise.
        durations: formulas of the preferred, shortest and longest duration, s.
        key_times: sync id -> formula of its phase.
        root: where HumanoidRoot is, None for an animation that leaves it alone.
        tracks: what turns joints; later ones stand on what earlier ones do.
        lacking: the joints that it does not turn because its figure cannot.
    """

    name: str
    parameters: Mapping[str, float]
    durations: tuple[Node, Node, Node]
    key_times: Mapping[str, Node]
    root: RootTrack | None = None
    tracks: tuple[Track, ...] = ()
    lacking: frozenset[str] = frozenset()

    TIME: ClassVar[str] = "t"
    """The name of the phase in formulas."""

    @cached_property
    def joints(self) -> frozenset[str]:
        """The joints that it turns."""
        return frozenset().union(*(track.joints for track in self.tracks))

    @cached_property
    def alone(self) -> bool:
        """Whether its poses are the same whatever the rest of the body does."""
        return all(track.alone for track in self.tracks)

    @cached_property
    def _times(self) -> Compiled:
        return compile_formulas([*self.durations, *self.key_times.values()], tuple(self.parameters))

    @cached_property
    def _motion(self) -> Compiled:
        motion = [node for formulas in self._formulas for node in formulas]
        return compile_formulas(motion, (self.TIME, *self.parameters))

    @cached_property
    def _parts(self) -> Sequence[tuple[Track, slice]]:
        """The tracks that move, each with the place of its values among those of all."""
        ends = accumulate(map(len, self._formulas), initial=0)
        _, *slices = (slice(*both) for both in pairwise(ends))
        return tuple(zip(self._moving, slices, strict=True))

    @cached_property
    def _held(self) -> Mapping[str, Quat]:
        """What never changes, mostly fingers: found once, for a hand has many."""
        tracks = Counter(joint for track in self.tracks for joint in track.joints)
        alone = (track for track in self.tracks if isinstance(track, RotationTrack) and tracks[track.joint] == 1)
        return {track.joint: held for track in alone if (held := track.held) is not None}

    @cached_property
    def _moving(self) -> Sequence[Track]:
        return [track for track in self.tracks if not track.joints <= self._held.keys()]

    @property
    def _formulas(self) -> Sequence[Formulas]:
        """Of the root and of each track that moves."""
        return [() if self.root is None else self.root.formulas, *(track.formulas for track in self._moving)]

    @cached_property
    def _wrung(self) -> Sequence[str]:
        """The sides of the wrists that are led."""
        arms = (track for track in self.tracks if isinstance(track, EffectorTrack) and track.limb is Arm)
        return tuple(track.side for track in arms)

    def values(self, parameters: Mapping[str, float]) -> dict[str, float]:
        """Values of its parameters: as given, else its own; names that it does not know are of no effect."""
        return {name: parameters.get(name, value) for name, value in self.parameters.items()}

    def timing(self, parameters: Mapping[str, float]) -> AuthoredTiming:
        """When things happen, for given values of the parameters.

        Raises:
            RealizerError: "no-motion": it would last no time; "bad-keys": a key position is where it cannot be, or what
                is shortest is longer than what is longest.
        """
        preferred, shortest, longest, *phases = self._values(self._times, 0.0, [parameters[n] for n in self.parameters])
        if preferred <= 0.0:
            raise error("no-motion", animation=self.name, phase=0.0, reason=f"it would last {preferred:g} s")
        if shortest > longest:
            reason = f"it lasts at least {shortest:g} s and at most {longest:g} s"
            raise error("bad-keys", animation=self.name, reason=reason)
        keys = dict(zip(self.key_times, phases, strict=True))
        wrong = [f"{name} at {phase:g}" for name, phase in keys.items() if not is_placed(name, phase)]
        if wrong:
            reason = f"key positions lie from 0 to 1, start at 0 and end at 1, but not {', '.join(wrong)}"
            raise error("bad-keys", animation=self.name, reason=reason)
        authored = not shortest == preferred == longest
        return AuthoredTiming(preferred, (shortest, longest) if authored else None, keys)

    def sample(self, phase: float, parameters: Mapping[str, float], body: Body, shown: Body | None = None) -> Posed:
        """The pose at a phase: of the joints that this animation turns, and of the root if it moves that.

        Args:
            phase: 0 to 1.
            parameters: a value for each of the animation's names.
            body: of a figure that it has been made for (`on`); the pose of the joints above those turned counts.
            shown: the same with what is added to its motion; None if nothing is. Hands reach their places through it.

        Raises:
            RealizerError: "no-motion": a formula has no value there, or names no rotation.
        """
        values = self._values(self._motion, phase, [phase, *(parameters[name] for name in self.parameters)])
        root = None if self.root is None else self.root.moved(values[:3], body.skeleton)
        turned = dict(self._held)
        fault: Fault | None = None

        def so_far() -> Body:
            return body.posed(turned, root)

        def carried() -> Body:
            return so_far() if shown is None else as_carried(so_far(), body, shown)

        for track, its in self._parts:
            reaches = isinstance(track, EffectorTrack) and track.reaches
            try:
                rotations, missed = track.turned(values[its], phase, carried if reaches else so_far)
            except ArithmeticError as problem:
                what = f"what is asked of {', '.join(sorted(track.joints))} is no rotation"
                raise error("no-motion", animation=self.name, phase=phase, reason=what) from problem
            turned |= rotations
            if missed is not None:
                fault = self._missed(phase, *missed)
        for side in self._wrung:
            turned |= share_twist(side, turned, body.skeleton)
        return Posed(turned, root=root, fault=fault)

    def _missed(self, phase: float, joint: str, distance: float) -> Fault:
        return Fault("not-reachable", {"joint": joint, "animation": self.name, "phase": phase, "distance": distance})

    def _values(self, formulas: Compiled, phase: float, arguments: Sequence[float]) -> tuple[float, ...]:
        try:
            values = formulas(*arguments)
        except (ArithmeticError, ValueError) as problem:
            raise error("no-motion", animation=self.name, phase=phase, reason=str(problem)) from problem
        if not all(map(math.isfinite, values)):
            raise error("no-motion", animation=self.name, phase=phase, reason="a formula is infinite or undefined")
        return values

    def mirrored(self) -> "ProcAnimation":
        """The same motion in a mirror: left is right."""
        root = None if self.root is None else self.root.mirrored()
        return replace(self, root=root, tracks=tuple(track.mirrored() for track in self.tracks))

    def of(self, joints: frozenset[str]) -> "ProcAnimation":
        """What of it is about these joints.

        Raises:
            RealizerError: "none-turned": nothing is.
        """
        root = self.root if ROOT in joints else None
        tracks = tuple(part for track in self.tracks if (part := track.of(joints)) is not None)
        if root is None and not tracks:
            known = ", ".join(sorted(self.joints)) or "none"
            raise error("none-turned", joints=", ".join(sorted(joints)), animation=self.name, known=known)
        return replace(self, root=root, tracks=tracks)

    def on(self, skeleton: Skeleton) -> "ProcAnimation":
        """What of it a figure can do, from its root outward, so that a hand is turned after the arm that carries it.

        Joints that the figure lacks are left out, and limbs with a bone of no length; the log says which.
        """
        tracks = [part for track in self.tracks if (part := track.on(skeleton)) is not None]
        missing = self.joints.difference(*(track.joints for track in tracks))
        if missing:
            _log.warning("%s: this figure cannot turn %s; left out", self.name, ", ".join(sorted(missing)))
        depth = {joint: len(skeleton.links(joint)) for track in tracks for joint in track.joints}
        tracks.sort(key=lambda track: min(depth[joint] for joint in track.joints))
        root = self.root if ROOT in skeleton else None
        return replace(self, root=root, tracks=tuple(tracks), lacking=missing)
