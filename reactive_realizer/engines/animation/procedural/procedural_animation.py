"""Procedural animations: motion as formulas of phase and parameters (thesis 4.2.1 and 10.2.2.2)."""

import logging
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, pairwise
from typing import ClassVar

from reactive_realizer.binding.asset_file import is_placed
from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import ROOT
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.two_bone_ik import Arm
from reactive_realizer.engines.animation.expression.compiler import Compiled, compile_formulas
from reactive_realizer.engines.animation.expression.syntax import Constant, Formula
from reactive_realizer.engines.animation.faults import BadKeys, NoMotion, NoneTurned, NotReachable
from reactive_realizer.engines.animation.motion_unit import MotionPose
from reactive_realizer.engines.animation.procedural.effector_track import (
    EffectorTrack,
    carried_as_shown,
    girdle_of,
    natural_arm,
)
from reactive_realizer.engines.animation.procedural.tracks import Formulas, RootTrack, RotationTrack, Track, fold_spine
from reactive_realizer.errors import Fault, RealizerError

_log = logging.getLogger(__name__)


_STILL = (Constant(0.0), Constant(0.0), Constant(0.0))


@dataclass(frozen=True, slots=True)
class AuthoredTiming:
    """Timing of an animation, as authored.

    Attributes:
        duration: preferred, s.
        limits: shortest and longest duration, s; None if the author set only the preferred one.
        key_positions: sync id -> phase, 0 to 1.
    """

    duration: float
    limits: tuple[float, float] | None
    key_positions: Mapping[str, float]

    @property
    def stretch(self) -> tuple[float, float] | None:
        """The limits relative to the preferred duration."""
        return None if self.limits is None else (self.limits[0] / self.duration, self.limits[1] / self.duration)


@dataclass(frozen=True, eq=False)
class ProceduralAnimation:
    """The content of a ProcAnimation file.

    Attributes:
        name: of the file, for messages.
        parameters: name -> default value.
        durations: formulas of the preferred, shortest and longest duration, s.
        key_times: sync id -> formula of its phase.
        root: track of HumanoidRoot, None if the animation does not move it.
        tracks: of joints; later tracks depend on earlier ones.
        lacking: joints that it does not turn because its figure cannot.
    """

    name: str
    parameters: Mapping[str, float]
    durations: tuple[Formula, Formula, Formula]
    key_times: Mapping[str, Formula]
    root: RootTrack | None = None
    tracks: tuple[Track, ...] = ()
    lacking: frozenset[str] = frozenset()

    TIME: ClassVar[str] = "t"
    """Name of the phase in formulas."""

    @cached_property
    def joints(self) -> frozenset[str]:
        """The joints that it turns."""
        return frozenset().union(*(track.joints for track in self.tracks))

    @cached_property
    def independent(self) -> bool:
        """Whether its poses do not depend on the rest of the body."""
        return all(track.independent for track in self.tracks)

    @cached_property
    def reaches(self) -> bool:
        """Return whether it brings hands to goals that do not move with the trunk."""
        return any(isinstance(track, EffectorTrack) and track.reaches for track in self.tracks)

    @cached_property
    def _times(self) -> Compiled:
        return compile_formulas([*self.durations, *self.key_times.values()], tuple(self.parameters))

    @cached_property
    def _motion(self) -> Compiled:
        motion = [node for formulas in self._formulas for node in formulas]
        return compile_formulas(motion, (self.TIME, *self.parameters))

    @cached_property
    def _parts(self) -> Sequence[tuple[Track, slice]]:
        """The moving tracks, each with the slice of its values."""
        ends = accumulate(map(len, self._formulas), initial=0)
        _, *slices = (slice(*both) for both in pairwise(ends))
        return tuple(zip(self._moving, slices, strict=True))

    @cached_property
    def _constants(self) -> Mapping[str, Quat]:
        """Constant rotations, mostly of fingers, which are computed once."""
        tracks = Counter(joint for track in self.tracks for joint in track.joints)
        alone = (track for track in self.tracks if isinstance(track, RotationTrack) and tracks[track.joint] == 1)
        return {track.joint: constant for track in alone if (constant := track.constant) is not None}

    @cached_property
    def _moving(self) -> Sequence[Track]:
        return [track for track in self.tracks if not track.joints <= self._constants.keys()]

    @property
    def _formulas(self) -> Sequence[Formulas]:
        """The formulas of the root and of each moving track."""
        return [() if self.root is None else self.root.formulas, *(track.formulas for track in self._moving)]

    @cached_property
    def _twisted_sides(self) -> Sequence[str]:
        """The sides whose wrists are placed by inverse kinematics."""
        arms = (track for track in self.tracks if isinstance(track, EffectorTrack) and track.limb is Arm)
        return tuple(track.side for track in arms)

    def values(self, parameters: Mapping[str, float]) -> dict[str, float]:
        """Return values of its parameters, as given or by default; unknown names have no effect."""
        return {name: parameters.get(name, value) for name, value in self.parameters.items()}

    def timing(self, parameters: Mapping[str, float]) -> AuthoredTiming:
        """Return the timing for given parameters.

        Raises:
            RealizerError: "no-motion": the duration is not positive; "bad-keys": a key position or the duration limits
                are invalid.
        """
        preferred, shortest, longest, *phases = self._values(self._times, 0.0, [parameters[n] for n in self.parameters])
        if preferred <= 0.0:
            raise RealizerError(NoMotion(animation=self.name, phase=0.0, reason=f"it would last {preferred:g} s"))
        if shortest > longest:
            reason = f"it lasts at least {shortest:g} s and at most {longest:g} s"
            raise RealizerError(BadKeys(animation=self.name, reason=reason))
        keys = dict(zip(self.key_times, phases, strict=True))
        wrong = [f"{name} at {phase:g}" for name, phase in keys.items() if not is_placed(name, phase)]
        if wrong:
            reason = f"key positions lie from 0 to 1, start at 0 and end at 1, but not {', '.join(wrong)}"
            raise RealizerError(BadKeys(animation=self.name, reason=reason))
        authored = not shortest == preferred == longest
        return AuthoredTiming(preferred, (shortest, longest) if authored else None, keys)

    def sample(
        self, phase: float, parameters: Mapping[str, float], body: Body, shown: Body | None = None
    ) -> MotionPose:
        """Return the pose at a phase, of the joints that it turns and of the root if it moves that.

        Args:
            phase: 0 to 1.
            parameters: a value for each of its names.
            body: of the figure that it is fitted to; the pose of joints above those turned matters.
            shown: the same with additive motion, which hands compensate; None if there is none.

        Raises:
            RealizerError: "no-motion": a formula has no value there, or gives no rotation.
        """
        values = self._values(self._motion, phase, [phase, *(parameters[name] for name in self.parameters)])
        root = None if self.root is None else self.root.moved(values[:3], body.skeleton)
        turned = dict(self._constants)
        fault: Fault | None = None

        def so_far() -> Body:
            return body.posed(turned, root)

        def carried() -> Body:
            return so_far() if shown is None else carried_as_shown(so_far(), body, shown)

        for track, its in self._parts:
            reaches = isinstance(track, EffectorTrack) and track.reaches
            try:
                rotations, missed = track.evaluate(values[its], phase, carried if reaches else so_far)
            except ArithmeticError as problem:
                what = f"the rotation of {', '.join(sorted(track.joints))} is undefined"
                raise RealizerError(NoMotion(animation=self.name, phase=phase, reason=what)) from problem
            turned |= rotations
            if missed is not None:
                fault = self._missed(phase, *missed)
        for side in self._twisted_sides:
            turned |= natural_arm(side, turned, body.skeleton)
        return MotionPose(turned, root=root, fault=fault)

    def _missed(self, phase: float, joint: str, distance: float) -> Fault:
        return NotReachable(joint=joint, animation=self.name, phase=phase, distance=distance)

    def _values(self, formulas: Compiled, phase: float, arguments: Sequence[float]) -> tuple[float, ...]:
        try:
            values = formulas(*arguments)
        except (ArithmeticError, ValueError) as problem:
            raise RealizerError(NoMotion(animation=self.name, phase=phase, reason=str(problem))) from problem
        if not all(map(math.isfinite, values)):
            raise RealizerError(NoMotion(animation=self.name, phase=phase, reason="a formula is infinite or undefined"))
        return values

    def mirrored(self) -> "ProceduralAnimation":
        """Return the animation with left and right exchanged."""
        root = None if self.root is None else self.root.mirrored()
        return replace(self, root=root, tracks=tuple(track.mirrored() for track in self.tracks))

    def restricted_to(self, joints: frozenset[str]) -> "ProceduralAnimation":
        """Return the part of the animation for these joints.

        Raises:
            RealizerError: "none-turned": there is none.
        """
        root = self.root if ROOT in joints else None
        tracks = tuple(part for track in self.tracks if (part := track.restricted_to(joints)) is not None)
        if root is None and not tracks:
            known = ", ".join(sorted(self.joints)) or "none"
            raise RealizerError(NoneTurned(joints=tuple(sorted(joints)), animation=self.name, known=known))
        return replace(self, root=root, tracks=tracks)

    def with_girdles(self) -> "ProceduralAnimation":
        """Return the animation with the shoulder girdles of the hands that it places, unless it turns them itself."""
        hands = (track for track in self.tracks if isinstance(track, EffectorTrack) and track.limb is Arm)
        girdles = {girdle_of(each.side) for each in hands if each.local and f"{each.side}_wrist" in self.joints}
        added = (RotationTrack(girdle, True, _STILL) for girdle in sorted(girdles - self.joints))
        return replace(self, tracks=(*self.tracks, *added))

    def fitted_to(self, skeleton: Skeleton) -> "ProceduralAnimation":
        """Return the part of the animation that a figure can perform, from its root outward.

        An arm turns before its hand. Vertebrae turn for those that the figure lacks. Other joints that it lacks and
        limbs with a bone without a length are left out and logged.
        """
        folded = fold_spine(self.tracks, skeleton)
        tracks = [part for track in folded if (part := track.fitted_to(skeleton)) is not None]
        missing = frozenset[str]().union(*(track.joints for track in folded)).difference(*(t.joints for t in tracks))
        if missing:
            _log.warning("%s: this figure cannot turn %s; left out", self.name, ", ".join(sorted(missing)))
        depth = {joint: len(skeleton.links(joint)) for track in tracks for joint in track.joints}
        tracks.sort(key=lambda track: min(depth[joint] for joint in track.joints))
        root = self.root if ROOT in skeleton else None
        return replace(self, root=root, tracks=tuple(tracks), lacking=missing)
