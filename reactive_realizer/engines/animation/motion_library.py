"""From a behavior to a motion: the gesture binding, its files, and the targets of gaze."""

from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from lxml import etree

from reactive_realizer.binding.gesture_binding import GestureBinding, UnitSpec, numbers
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Gaze
from reactive_realizer.bml.names import BMLT
from reactive_realizer.bml.words import Influence
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.vector import ZERO, Vec3
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engines.animation.arms.gesture_motion_unit import GestureMotionUnit
from reactive_realizer.engines.animation.gaze.gaze_motion_unit import GazeMotionUnit
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.engines.animation.posture.rest_pose import REST_POSE
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation
from reactive_realizer.engines.animation.procedural.proc_animation_reader import read_proc_animation
from reactive_realizer.engines.animation.procedural.proc_motion_unit import ProcMotionUnit
from reactive_realizer.errors import error

DYNAMIC = (BMLT, "dynamic")
"""The attribute by which a gaze follows a target that moves."""


class MotionLibrary:
    """Makes motions for one character.

    Attributes:
        extensions: namespaced attributes that it understands.
        rest: the figure at rest. Preferred durations follow from it, whatever is shown: a plan does not depend on who
            is looking.
    """

    extensions = frozenset({DYNAMIC})

    def __init__(self, context: EngineContext) -> None:
        self._context = context
        self._binding = GestureBinding.read(context.asset(context.bindings["gesture"]))
        self.rest = Body(context.humanoid.avatar.skeleton, dict(REST_POSE))
        self._animation: Callable[[str, bool], ProcAnimation] = lru_cache(self._read)
        # Of the time that planning a gesture takes, most is its hands' way to the stroke: found once for all alike.
        self._gesture: Callable[[str, bool, tuple[tuple[str, float], ...]], GestureMotionUnit] = lru_cache(
            lambda file, mirror, parameters: GestureMotionUnit(
                self._animation(file, mirror), dict(parameters), REST_POSE, self.rest
            )
        )

    def motion(self, behavior: Behavior) -> MotionUnit:
        """A motion for a behavior.

        Raises:
            RealizerError: no entry of the binding fits, a file is not usable, a target is not there.
        """
        return self._gaze(behavior) if isinstance(behavior, Gaze) else self._bound(behavior)

    def _bound(self, behavior: Behavior) -> MotionUnit:
        attributes = _attributes(behavior)
        specs = self._binding.match(behavior.name, behavior.namespace, attributes)
        if not specs:
            raise error("no-motion-for", element=behavior.name, lexeme=attributes.get("lexeme", ""))
        return self._make(specs[0], attributes)

    def _make(self, spec: UnitSpec, attributes: dict[str, str]) -> MotionUnit:
        if spec.file is None:
            raise error("no-unit", unit=spec.implementation)
        said = spec.parameters(attributes)
        mirror, parameters = said.get("mirror") == "true", numbers(said)
        if spec.unit == "Gesture":
            return self._gesture(spec.file, mirror, tuple(parameters.items())).another()
        return ProcMotionUnit(self._animation(spec.file, mirror), parameters, spec.parameter_map.get("amount"))

    def _read(self, file: str, mirror: bool) -> ProcAnimation:
        path = self._context.asset(file)
        animation = _animation_in(path, path.stat().st_mtime_ns)
        return animation.mirrored() if mirror else animation

    def _gaze(self, behavior: Gaze) -> GazeMotionUnit:
        if self._context.world.position(behavior.target) is None:
            raise error("no-target", target=behavior.target, known=", ".join(self._context.world.targets))
        return GazeMotionUnit(
            self._target(behavior.target, behavior.extensions.get(DYNAMIC) == "true"),
            behavior.influence or Influence.HEAD,
            REST_POSE,
            behavior.offset_angle,
            behavior.offset_direction.value,
        )

    def _target(self, name: str, dynamic: bool) -> Callable[[], Vec3]:
        """Where to look, in the figure's own frame; a target that is gone stays where it was seen last."""
        world, humanoid = self._context.world, self._context.humanoid
        seen: list[Vec3] = []

        def locate() -> Vec3:
            position = world.position(name) if dynamic or not seen else None
            if position is not None:
                seen[:] = [position]
            return humanoid.to_own_frame(seen[0]) if seen else ZERO

        return locate


@lru_cache
def _animation_in(path: Path, changed: int) -> ProcAnimation:
    """Read once for all characters, unless it has changed: it takes some milliseconds, which a tick hardly has."""
    return read_proc_animation(path)


def _attributes(behavior: Behavior) -> dict[str, str]:
    """As written, attributes of other namespaces as ``{uri}name``, and the core's defaults that bindings map."""
    written = {str(name): str(value) for name, value in etree.fromstring(behavior.source).attrib.items()}
    defaults = {"amount": getattr(behavior, "amount", None), "repetition": getattr(behavior, "repetition", None)}
    return {**{name: str(value) for name, value in defaults.items() if value is not None}, **written}
