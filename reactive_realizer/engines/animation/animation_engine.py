"""The engine of body animation (thesis 8.7): gestures, head movements, gaze, posture, and idle life."""

import asyncio
from collections.abc import Awaitable, Callable, Iterator, Mapping, Sequence
from random import Random
from types import MappingProxyType
from typing import TypeVar

from reactive_realizer.binding.gesture_binding import GestureBinding
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Gaze, GazeShift, Gesture, Head, HeadDirectionShift, Pointing
from reactive_realizer.bml.posture import Posture, PostureShift
from reactive_realizer.bml.twente import BEHAVIORS as TWENTE
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import Eyes, Look
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked, over
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import Request, Warn
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.lexicon import Word
from reactive_realizer.engines.animation.actor import Actor
from reactive_realizer.engines.animation.animation_unit import AnimationUnit, Stage
from reactive_realizer.engines.animation.expression.functions import registered
from reactive_realizer.engines.animation.gaze.influence import HEAD_WEIGHTS, WEIGHTS
from reactive_realizer.engines.animation.gaze.lids import with_lids
from reactive_realizer.engines.animation.gaze.looking import Looking
from reactive_realizer.engines.animation.idle.idle import Idle
from reactive_realizer.engines.animation.lasting import Lasting
from reactive_realizer.engines.animation.lexicon import binding_words
from reactive_realizer.engines.animation.motion_library import MotionLibrary
from reactive_realizer.engines.animation.motion_unit import AMOUNT_RANGE, Gazing
from reactive_realizer.engines.animation.net import Net
from reactive_realizer.engines.animation.posture.body_posture import BodyPosture
from reactive_realizer.engines.animation.posture.expectation import bodies_in, posture_after
from reactive_realizer.engines.animation.posture.footing import Footing
from reactive_realizer.engines.animation.posture.posture_library import PostureLibrary
from reactive_realizer.engines.animation.posture.rest import Rest
from reactive_realizer.engines.animation.prediction import AnimationPredictor
from reactive_realizer.engines.animation.release import Release, caught, release_duration, stacked, uncovered
from reactive_realizer.engines.animation.trail import Trail
from reactive_realizer.engines.animation.transition.transition_unit import TransitionUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState

T = TypeVar("T")


class AnimationEngine(DefaultEngine):
    """Turns the joints of one figure."""

    behaviors = TWENTE | {Gesture, Head, HeadDirectionShift, Gaze, GazeShift, Pointing, Posture, PostureShift}
    reads_parameters = True
    parameters = MappingProxyType(
        {
            Gesture: {"amount": AMOUNT_RANGE},
            Head: {"amount": AMOUNT_RANGE},
            **dict.fromkeys((Gaze, GazeShift), WEIGHTS),
            HeadDirectionShift: HEAD_WEIGHTS,
        }
    )

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/animation")
        self._humanoid = context.humanoid
        self._world = context.world
        binding = GestureBinding.read(*context.bindings["gesture"])
        library = PostureLibrary(context.humanoid.avatar.skeleton, context.asset, binding.rest_poses)
        self._rest = Rest(library, self._expected, self._elsewhere)
        self._humanoid.rest(self._rest.body)
        functions = registered(context.functions)
        actor = Actor(context.humanoid, context.world, context.asset, context.seed, self._rest, functions)
        self._library = MotionLibrary(binding, actor)
        self._idle = Idle(Random(context.seed)) if context.idle else None
        self._footing = Footing(context.humanoid.avatar.skeleton)
        self._lasting = Lasting()
        self._looking = Looking(self._idle.blink) if self._idle else Looking()
        self._releases: list[Release] = []
        # In what it was to stay and does not, since something was planned last.
        self._left: list[Body] = []
        # Of the block that is being planned: they are not in the plan yet.
        self._drafts: list[AnimationUnit] = []
        # Of those that have come into the plan, and nobody has been told.
        self._notes: list[Warn] = []
        self._trail = Trail(lambda: self._humanoid.body)
        self._net = Net(self.name)
        self._predictor = AnimationPredictor(
            context.humanoid.avatar.skeleton, self._base, lambda: self.player.units, self._trail
        )
        self._stage = Stage(
            lambda: self._humanoid.body,
            lambda: self._humanoid.shown,
            self._predictor.moved,
            self._hands,
            self._notice,
            self._release,
            context.graph,
        )
        self.extensions = self._library.extensions

    def words(self) -> Iterator[Word]:
        """What its binding says, and the poses of postures."""
        return binding_words(self._library, next(iter(self._world.targets)))

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """Long files are read aside."""
        self._drafts.clear()  # of a block that failed while it was planned
        works = self._library.readings(behavior)
        return asyncio.to_thread(lambda: [work() for work in works]) if works else None

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> AnimationUnit:
        """The motion that the binding has for the behavior.

        Raises:
            RealizerError: it has none, or the target is not there.
        """
        while self._drafts and not _precedes(self._drafts[-1], block, behavior):
            self._drafts.pop()
        if not self._drafts:
            self._library.look_again()
        unit = self._unit(block, behavior)
        self._drafts.append(unit)
        return unit

    def add(self, unit: PlanUnit) -> None:
        """As every engine."""
        self._drafts.clear()
        self._left.clear()
        if isinstance(unit, AnimationUnit):
            self._notes += (Warn(unit, note) for note in unit.notes)
        super().add(unit)

    def _expected(self) -> BodyPosture:
        planned = (unit.motion for unit in (*self.player.units, *self._drafts) if isinstance(unit, AnimationUnit))
        return posture_after(self._rest.posture, planned)

    def _elsewhere(self) -> tuple[Body, ...]:
        planned = (*self.player.playing, *self._drafts)
        return (*bodies_in(unit.motion for unit in planned if isinstance(unit, AnimationUnit)), *self._left)

    def _unit(self, block: BlockKey, behavior: Behavior) -> AnimationUnit:
        choices = self._library.choices(behavior)
        if choices.planned.motion.led:
            return TransitionUnit(block, behavior, choices, self._stage, self._predictor.moving)
        return AnimationUnit(block, behavior, choices, self._stage)

    def reset(self, time: GlobalTime) -> None:
        """The figure stands and looks as at first."""
        for layer in self._lasting.layers(time, self._humanoid.body):
            self._let_go(Release(layer, time))
        self._lasting.clear()
        self._looking.notice(time)
        base, body = self._base(), self._rest.body
        if self._rest.reset():
            self._left.append(body)
            self._let_go(Release(base, time, release_duration(base, self._roots())))

    def layers(self, tick: Tick) -> tuple[Layer, ...]:
        """Rest pose and idle life, what has stayed, what is on its way back, what plays, and where the feet stay."""
        self._trail.frame(tick.time)
        self._releases = [release for release in self._releases if not release.over(tick.time)]
        layers = (
            self._base(),
            *self._breath(tick.time),
            *self._lasting.layers(tick.time, self._humanoid.body),
            *self._stacked(tick.time),
        )
        feet: tuple[Layer, ...] = self._net("where its feet are", lambda: self._footing.layers(layers, tick.time), ())
        return (*layers, *feet)

    def _breath(self, now: GlobalTime) -> tuple[Layer, ...]:
        return self._alive(lambda idle: (checked(idle.layer(now, -self._humanoid.body.root[1])),), ())

    def _alive(self, show: Callable[[Idle], T], instead: T) -> T:
        """Something of its idle life, if it has one."""
        idle = self._idle
        return instead if idle is None else self._net("its idle life", lambda: show(idle), instead)

    def _stacked(self, now: GlobalTime) -> list[Layer]:
        playing = self._playing(now)
        alone = [layer for _, layer in playing]
        return self._net("what is on its way back", lambda: stacked(self._releases, playing, now), alone)

    def _playing(self, now: GlobalTime) -> list[tuple[tuple[float, float], Layer]]:
        layers = self.player.show(AnimationUnit, lambda unit: (unit, unit.layer(now)), now)
        return [(unit.height, layer) for unit, layer in layers]

    def eyes(self, tick: Tick) -> Eyes:
        """What the eyes of all gazes make of it, from the head as it is shown; lids go with them."""
        gazes = list(self._gazes())
        return lambda body: self._look(tick.time, gazes, body)

    def _look(self, now: GlobalTime, gazes: Sequence[Gazing], body: Body) -> Look:
        resting: Mapping[str, Quat] = self._alive(lambda idle: idle.eyes(now), {})
        turns = self._net("its gaze", lambda: self._looking.eyes(now, gazes, body, resting), resting)
        blinks: Mapping[str, float] = self._alive(lambda idle: idle.weights(now), {})
        return Look(turns, with_lids(turns, blinks))

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """What is wrong with a unit that is new, or plays on, is told."""
        notes, self._notes = self._notes, []
        units = [unit for unit in self.player.playing if isinstance(unit, AnimationUnit)]
        return (*notes, *(Warn(unit, fault) for unit in units if (fault := unit.complaint()) is not None))

    def _gazes(self) -> Iterator[Gazing]:
        """What looks now: what has stayed, then what plays, the one that started last at the end."""
        lasting = (motion.gaze(1.0) for motion in self._lasting.motions)
        playing = (unit.motion.gaze(unit.phase) for unit in self.player.stacked(AnimationUnit))
        return (gaze for gaze in (*lasting, *playing) if gaze is not None)

    def _notice(self, unit: AnimationUnit, time: GlobalTime) -> None:
        gaze = unit.motion.gaze(0.0)
        if gaze is not None and gaze.eyes > 0.0:
            self._looking.notice(time)

    def _hands(self, now: GlobalTime) -> Body | None:
        rest = hands = self._rest.body
        for unit in self.player.playing:
            if isinstance(unit, AnimationUnit) and unit.motion.kind is LayerKind.GESTURE and unit.subsiding(now):
                hands = over(hands, unit.way_back(now, rest))
        return None if hands is rest else hands

    def _release(self, unit: AnimationUnit, time: GlobalTime) -> None:
        """Take over the joints of a unit that plays no more; what stays of it lies below all others from now on."""
        self._notice(unit, time)
        done = unit.state is UnitState.DONE and not unit.was_cut("end")
        stays = done and unit.motion.lasts is not None
        if not done:
            self._left += bodies_in([unit.motion])
        base, layer, drift = self._base(), caught(unit.shown, self._humanoid.shown.root), unit.drift(time)
        duration = release_duration(layer, self._roots())
        if stays and unit.motion.becomes_rest():
            self._releases = [uncovered(release, layer, unit.height) for release in self._releases]
            duration = max(duration, release_duration(base, self._roots()))
            self._let_go(Release(base, time, duration, under=layer.weight))
        elif stays:
            self._lasting.keep(unit.motion, time, self._humanoid.body)
            # One that came in time is where it wanted to be.
            drift = None if unit.motion.joined is None else drift
        if layer.rotations or layer.root is not None:
            self._let_go(Release(layer, time, duration, unit.height, drift))

    def _let_go(self, release: Release) -> None:
        # What the figure rested in was below all else.
        lowest = release.layer.kind is LayerKind.BASE
        releases = (release, *self._releases) if lowest else (*self._releases, release)
        self._releases = [other for other in releases if not other.over(release.since)]

    def _roots(self) -> list[Vec3]:
        """Where HumanoidRoot is at rest, and where what plays has it."""
        playing = (unit.shown.root for unit in self.player.playing if isinstance(unit, AnimationUnit))
        return [self._rest.body.root, *(root for root in playing if root is not None)]

    def _base(self) -> Layer:
        return Layer(LayerKind.BASE, self._rest.pose, root=self._rest.body.root)


def _precedes(unit: AnimationUnit, block: BlockKey, behavior: Behavior) -> bool:
    return unit.block == block and unit.behavior.order < behavior.order
