"""The engine of body animation (thesis 8.7): gestures, head movements, gaze, posture, and idle life."""

from collections.abc import Mapping
from random import Random
from types import MappingProxyType

from reactive_realizer.binding.gesture_binding import GestureBinding
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Gaze, Gesture, Head
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import Eyes
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, slerp
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engines.animation.actor import Actor
from reactive_realizer.engines.animation.animation_unit import AnimationUnit, Stage
from reactive_realizer.engines.animation.gaze.gaze_motion_unit import GazeMotionUnit
from reactive_realizer.engines.animation.idle.idle import Idle
from reactive_realizer.engines.animation.lasting import Lasting
from reactive_realizer.engines.animation.motion_library import MotionLibrary
from reactive_realizer.engines.animation.motion_unit import AMOUNT_RANGE
from reactive_realizer.engines.animation.posture.rest import Rest
from reactive_realizer.engines.animation.release import Release
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import UnitState


class AnimationEngine(DefaultEngine):
    """Turns the joints of one figure."""

    behaviors = frozenset({Gesture, Head, Gaze})
    parameters = MappingProxyType({Gesture: {"amount": AMOUNT_RANGE}, Head: {"amount": AMOUNT_RANGE}})

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/animation")
        self._humanoid = context.humanoid
        self._rest = Rest(context.humanoid.avatar.skeleton)
        actor = Actor(context.humanoid, context.world, context.asset, context.seed, self._rest)
        self._library = MotionLibrary(GestureBinding.read(context.asset(context.bindings["gesture"])), actor)
        self._idle = Idle(Random(context.seed))
        self._lasting = Lasting()
        self._releases: list[Release] = []
        self._stage = Stage(lambda: self._humanoid.body, self._hands, self._release, context.graph)
        self._now = GlobalTime(0.0)
        self.extensions = self._library.extensions

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> AnimationUnit:
        """The motion that the binding has for the behavior.

        Raises:
            RealizerError: it has none, or the target is not there.
        """
        return AnimationUnit(block, behavior, self._library.choices(behavior), self._stage)

    def play(self, tick: Tick) -> Play:
        """As every engine."""
        self._now = tick.time
        return super().play(tick)

    def reset(self, time: GlobalTime) -> None:
        """The figure stands and looks as at first."""
        for layer in self._lasting.layers(time, self._humanoid.body):
            self._releases.append(Release(layer, time))
        self._lasting.clear()

    def layers(self, tick: Tick) -> tuple[Layer, ...]:
        """Rest pose and idle life, what has stayed, what is on its way back, what plays."""
        self._releases = [release for release in self._releases if not release.over(tick.time)]
        return (
            Layer(LayerKind.BASE, self._rest.pose),
            Layer(LayerKind.ADDITIVE, self._idle.rotations(tick.time)),
            *self._lasting.layers(tick.time, self._humanoid.body),
            *(release.at(tick.time) for release in self._releases),
            *self.player.show(AnimationUnit, lambda unit: unit.layer(tick.time), tick.time),
        )

    def face(self, tick: Tick) -> Mapping[str, float]:
        """Blinks."""
        return self._idle.weights(tick.time)

    def eyes(self, tick: Tick) -> Eyes | None:
        """The eyes of the gaze that plays; straight ahead without one."""
        units = (unit for unit in self.player.playing if isinstance(unit, AnimationUnit))
        gazing = [(unit, unit.motion) for unit in units if isinstance(unit.motion, GazeMotionUnit)]
        return _eyes_of(*gazing[-1]) if gazing else None

    def _hands(self) -> Body | None:
        rest, back = self._rest.body, dict[str, Quat]()
        for unit in self.player.playing:
            if isinstance(unit, AnimationUnit) and unit.motion.kind is LayerKind.GESTURE and unit.subsiding(self._now):
                back |= unit.way_back(self._now, rest)
        return rest.posed(back) if back else None

    def _release(self, unit: AnimationUnit, time: GlobalTime) -> None:
        """Take over the joints of a unit that plays no more."""
        stays = unit.state is UnitState.DONE and unit.motion.lasts is not None and not unit.was_cut("end")
        if stays:
            self._lasting.keep(unit.motion)
        elif unit.shown.rotations:
            self._releases.append(Release(unit.shown, time))


def _eyes_of(unit: AnimationUnit, motion: GazeMotionUnit) -> Eyes:
    def eyes(composed: Body) -> dict[str, Quat]:
        layer = motion.eye_layer(unit.phase, composed)
        return {joint: slerp(IDENTITY, rotation, layer.weight) for joint, rotation in layer.rotations.items()}

    return eyes
