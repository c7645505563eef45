"""The engine of the face (thesis 8.8): expressions and the mouth of speech, as weights of morph targets."""

import asyncio
from collections.abc import Awaitable, Collection, Iterator, Mapping
from dataclasses import replace
from functools import partial
from random import Random
from types import MappingProxyType
from typing import Any

from reactive_realizer.binding.spec_reader import read_unit_specs
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.behaviors import Face, FaceFacs, FaceLexeme, FaceShift
from reactive_realizer.bml.extensions import FACES, FaceKeyframe, FaceMorph, FacePlutchik
from reactive_realizer.bml.murml.behaviors import MurmlFace
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import Warn
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.lexicon import LexiconEntry
from reactive_realizer.engines.face.face_animation import FaceAnimation, animation_path, read_face_animation
from reactive_realizer.engines.face.face_library import FaceLibrary
from reactive_realizer.engines.face.face_mixing import Fades, MouthShares, between, greatest, resting_face_under
from reactive_realizer.engines.face.face_shapes import FaceShapes
from reactive_realizer.engines.face.face_timing import SHIFT_TIMING, FaceShape
from reactive_realizer.engines.face.face_unit import (
    ExpressionUnit,
    FaceAnimationUnit,
    FaceShiftUnit,
    FaceUnit,
)
from reactive_realizer.engines.face.living_face import LivingFace
from reactive_realizer.engines.face.murml_face import murml_face
from reactive_realizer.engines.face.weights import Weights, added, limited, scaled
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.planunit.plan_unit import PlanUnit

_MODERATE = 0.5
"""The amount of a compound face that leaves those of its parts as they are, which is its default."""

_STRENGTH = Range(0.0, 1.0)

_FADE = 0.25
"""Duration of the fade of an interrupted expression, s."""
_MOUTH_FADE = 0.12
"""Duration of the fade of the mouth when a word is cut off, s."""


_SHORT = 10_000
"""Size of the keys inside of an animation up to which they are read at once: that takes some milliseconds."""


class FaceEngine(DefaultEngine):
    """Plays expressions and mixes them with the resting face and the lip sync of the character's speech."""

    behaviors = FACES | {FaceLexeme, FaceFacs, Face, FaceShift, MurmlFace}
    parameters: Mapping[type[Behavior], Mapping[str, Range]] = MappingProxyType(
        {
            **{kind: MappingProxyType({"amount": _STRENGTH}) for kind in (FaceLexeme, FaceFacs, Face)},
            **{kind: MappingProxyType({"intensity": _STRENGTH}) for kind in (FaceMorph, FacePlutchik)},
        }
    )

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/face")
        binding = read_unit_specs("facebinding", "FaceUnit", *context.bindings["face"])
        self._library = FaceLibrary(binding, FaceShapes.of(context))
        self._asset = context.asset
        self._graph = context.graph
        self._lip_sync = context.lip_sync
        self._shares = MouthShares()
        self._resting: Weights = {}
        self._living = LivingFace(Random(context.seed), context.idle) if context.idle else None
        self._fading_faces = Fades(_FADE)
        self._fading_mouths = Fades(_MOUTH_FADE)
        self._mouth: Mapping[str, float] = {}
        # Notes of new units, not reported yet.
        self._notes: list[Warn] = []

    def lexicon(self) -> Iterator[LexiconEntry]:
        """The face lexemes."""
        return self._library.lexicon()

    def supports(self, behavior: Behavior) -> bool:
        """Whether a behavior is of one of its kinds, or of another namespace and has an entry in the binding."""
        bound = isinstance(behavior, ForeignBehavior) and self._library.binding.binds(behavior)
        return bound or super().supports(behavior)

    def check(self, behavior: Behavior) -> Collection[str] | None:
        """The points of a face; None for an animation that is yet to be read.

        Raises:
            RealizerError: the binding has no face for it that can be made.
        """
        if isinstance(behavior, FaceKeyframe):
            path = animation_path(behavior, self._asset)
            return tuple(self._animation(behavior).points) if path is None and not _is_long(behavior) else None
        if isinstance(behavior, MurmlFace):
            return tuple(murml_face(behavior.keyframing, self._library.shapes).points)
        timing = self._shape(behavior).timing
        return SHIFT_TIMING.points if isinstance(behavior, FaceShift) else timing.points

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """Read an animation in another thread if it is in a file, or long.

        Raises:
            RealizerError: "no-asset" or "no-face-animation"; the awaitable raises "bad-asset".
        """
        if not isinstance(behavior, FaceKeyframe) or (behavior.interpolator is not None and not _is_long(behavior)):
            return None
        path = animation_path(behavior, self._asset)
        return asyncio.to_thread(read_face_animation, behavior, path, self._library.shapes)

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit with the weights of the behavior.

        Raises:
            RealizerError: the binding has no face for it that can be made.
        """
        if isinstance(behavior, FaceKeyframe):
            animation = prepared if isinstance(prepared, FaceAnimation) else self._animation(behavior)
            return FaceAnimationUnit(block, behavior, animation, self._release)
        if isinstance(behavior, MurmlFace):
            animation = murml_face(behavior.keyframing, self._library.shapes)
            return FaceAnimationUnit(block, behavior, animation, self._release)
        shape = self._shape(behavior)
        if isinstance(behavior, FaceShift):
            return FaceShiftUnit(block, behavior, shape.weights, self._rest)
        overshoot = behavior.overshoot if isinstance(behavior, FaceLexeme | Face) else 0.0
        unit = ExpressionUnit(block, behavior, shape, overshoot, self._release)
        for name, values in self.parameters.get(type(behavior), {}).items():
            parameter = Parameter(self._graph, str(unit.key(name)), getattr(behavior, name), values)
            unit.vary(name, parameter, partial(self._weights_at, behavior, name))
        return unit

    def add(self, unit: PlanUnit) -> None:
        """Add a planned unit."""
        if isinstance(unit, FaceAnimationUnit):
            self._notes += [Warn(unit, note) for note in unit.notes]
        super().add(unit)

    def warnings(self) -> tuple[Warn, ...]:
        """The warnings about new units."""
        notes, self._notes = self._notes, []
        return tuple(notes)

    def reset(self, time: GlobalTime) -> None:
        """Return to the neutral resting face."""
        self._fading_faces.add(self._resting, time)
        self._resting = {}

    def face(self, tick: Tick) -> Mapping[str, float]:
        """Weights of morph targets now."""
        now = tick.time
        mouth = self._lip_sync.mouth(now) if self._lip_sync else None
        self._shares.take(now, speaking=mouth is not None)
        playing = self.player.show(FaceUnit, lambda unit: unit.shown(now), now)
        resting = self._resting
        for shift in self.player.show(FaceShiftUnit, lambda unit: unit.shown(now), now):
            resting = between(resting, shift.weights, shift.share)
        resting = resting_face_under(resting, [(unit.weights, unit.level) for unit in playing])
        faces = [{m: w * unit.level for m, w in unit.weights.items()} for unit in playing]
        shown = [resting, *faces, *self._fading_faces.at(now)]
        if self._living is not None:
            shown.append(self._living.at(now, shown))
        face = self._shares.of(added(shown))
        return greatest(face, self._spoken(mouth or {}, now))

    def _animation(self, behavior: FaceKeyframe) -> FaceAnimation:
        """That inside of a behavior."""
        return read_face_animation(behavior, None, self._library.shapes)

    def _weights_at(self, behavior: Behavior, name: str, value: float) -> Weights:
        """Those of an expression with another value of an attribute."""
        changed: dict[str, Any] = {name: value}
        return self._shape(replace(behavior, **changed)).weights

    def _shape(self, behavior: Behavior) -> FaceShape:
        """The expression of a behavior at its amount."""
        if not isinstance(behavior, Face):
            return self._library.face(behavior)
        parts = [self._library.face(part).weights for part in behavior.parts]
        return FaceShape(limited(scaled(limited(added(parts)), behavior.amount / _MODERATE)))

    def _spoken(self, mouth: Mapping[str, float], now: GlobalTime) -> dict[str, float]:
        """The mouth of the speech; if a word is cut off, the mouth fades."""
        if self._mouth and not mouth:
            self._fading_mouths.add(self._mouth, now)
        self._mouth = mouth
        return added([mouth, *self._fading_mouths.at(now)])

    def _release(self, unit: FaceUnit, time: GlobalTime) -> None:
        if unit.level > 0.0:
            self._fading_faces.add(scaled(unit.weights, unit.level), time)

    def _rest(self, shift: FaceShiftUnit) -> None:
        self._resting = between(self._resting, shift.weights, shift.share)


def _is_long(behavior: FaceKeyframe) -> bool:
    """Whether the keys inside of an animation take long to read."""
    return len(behavior.interpolator or "") > _SHORT
