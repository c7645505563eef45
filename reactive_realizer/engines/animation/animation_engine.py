"""The engine of body animation (thesis 8.7): gestures, head movements, gaze, posture, and idle animation."""

from collections.abc import Awaitable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial
from random import Random
from types import MappingProxyType

from reactive_realizer.binding.gesture_binding import GestureBinding
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.behaviors import (
    Gaze,
    GazeShift,
    Gesture,
    Head,
    HeadDirectionShift,
    Locomotion,
    Pointing,
    Posture,
    PostureShift,
)
from reactive_realizer.bml.extensions import MOTIONS
from reactive_realizer.bml.glance import Glance
from reactive_realizer.bml.idle_change import IdleChange
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.murml.behaviors import MurmlGesture
from reactive_realizer.bml.release import Release
from reactive_realizer.bml.weight_shift import WeightShift
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.embodiment.humanoid import Dynamics, Eyes
from reactive_realizer.embodiment.joints import HEAD, ROOT, SIDES
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked, compose
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import EndUnit, ReportFall, Request, Warn
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.lexicon import LexiconEntry
from reactive_realizer.engine.player import height
from reactive_realizer.engines.animation.animation_predictor import AnimationPredictor
from reactive_realizer.engines.animation.animation_unit import AnimationUnit, MotionContext
from reactive_realizer.engines.animation.blinks import USUAL_RATE
from reactive_realizer.engines.animation.ended_motions import EndedMotions
from reactive_realizer.engines.animation.expression.functions import plugin_functions
from reactive_realizer.engines.animation.failure_isolation import FailureIsolation
from reactive_realizer.engines.animation.faults import EndsForBothHands
from reactive_realizer.engines.animation.gaze.eye_poser import EyePoser
from reactive_realizer.engines.animation.gaze.head_turn import GAZE_WEIGHTS, HEAD_WEIGHTS
from reactive_realizer.engines.animation.idle import Idle
from reactive_realizer.engines.animation.idle_course import IdleChangeUnit
from reactive_realizer.engines.animation.kinematics import MotionHistory
from reactive_realizer.engines.animation.late_hands import LateHands
from reactive_realizer.engines.animation.leaning import Leaning
from reactive_realizer.engines.animation.lexicon import binding_lexicon
from reactive_realizer.engines.animation.motion_library import MotionLibrary
from reactive_realizer.engines.animation.motion_maker import MakerContext
from reactive_realizer.engines.animation.motion_planner import MotionDrafts, MotionPlanner
from reactive_realizer.engines.animation.motion_unit import (
    AMOUNT_RANGE,
    EXPRESSIVITY_RANGES,
    MotionUnit,
)
from reactive_realizer.engines.animation.motions.controller import ControllerMotionUnit
from reactive_realizer.engines.animation.motions.locomotion import SPEED, SPEEDS, LocomotionUnit
from reactive_realizer.engines.animation.motions.release import ReleaseMotionUnit
from reactive_realizer.engines.animation.physical_figure import PhysicalFigure
from reactive_realizer.engines.animation.posture.posture_library import PostureLibrary
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture
from reactive_realizer.engines.animation.stepping import Stepping
from reactive_realizer.engines.animation.trunk_following import TrunkFollowing
from reactive_realizer.engines.animation.weight_shifts import WeightShiftUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.physics.controllers.controller import PhysicalController
from reactive_realizer.planunit.parameter import Range
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.reactive.graph import Graph

_HEAD = frozenset(HEAD)

_CLAIMING = (LayerKind.FULL_BODY, LayerKind.GAZE, LayerKind.GESTURE)
"""The kinds of motions whose joints no controller moves."""


class AnimationEngine(DefaultEngine):
    """Moves the joints of one figure."""

    behaviors = MOTIONS | {
        KeyPoses,
        MurmlGesture,
        IdleChange,
        WeightShift,
        Glance,
        Release,
        Gesture,
        Head,
        HeadDirectionShift,
        Gaze,
        GazeShift,
        Locomotion,
        Pointing,
        Posture,
        PostureShift,
    }
    reads_parameters = True
    parameters: Mapping[type[Behavior], Mapping[str, Range]] = MappingProxyType(
        {
            Gesture: {"amount": AMOUNT_RANGE, **EXPRESSIVITY_RANGES},
            Head: {"amount": AMOUNT_RANGE},
            **dict.fromkeys((Gaze, GazeShift), GAZE_WEIGHTS),
            HeadDirectionShift: HEAD_WEIGHTS,
            Locomotion: {SPEED: SPEEDS},
        }
    )

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/animation")
        self._humanoid = context.humanoid
        self._world = context.world
        binding = GestureBinding.read(*context.bindings["gesture"])
        library = PostureLibrary(context.humanoid.avatar.skeleton, context.asset, binding.rest_poses)
        self._drafts = MotionDrafts(lambda: self.player.units, lambda: self.player.playing)
        self._rest = RestPosture(
            library,
            lambda: self._drafts.posture_after(self._rest.posture),
            self._drafts.possible_bodies,
            context.humanoid.clearance,
        )
        self._humanoid.rest(self._rest.body)
        functions = plugin_functions(context.functions)
        maker_context = MakerContext(
            context.humanoid,
            context.world,
            context.asset,
            context.seed,
            self._rest,
            functions,
            context.character,
            lambda: self._drafts.place_after(self._humanoid.place),
            context.expressivity,
        )
        self._library = MotionLibrary(binding, maker_context, context.motions)
        rate = USUAL_RATE if context.blink_rate is None else context.blink_rate
        self._idle = Idle(Random(context.seed), rate, context.idle) if context.idle else None
        self._late_hands = LateHands(context.humanoid)
        self._physical_figure = PhysicalFigure(context.humanoid)
        self._stepping = Stepping(context.humanoid, self._rest, self.player)
        self._ended = EndedMotions(context.humanoid, self._rest, self._playing, self._drafts.note_interrupted)
        self._trunk_following = TrunkFollowing(context.humanoid.avatar.skeleton)
        self._leaning = Leaning(context.humanoid.avatar.skeleton, self._humanoid.switch)
        # The controllers that act in the present frame.
        self._acting: dict[AnimationUnit, PhysicalController] = {}
        self._isolated = FailureIsolation(self.name)
        self._eye_poser = EyePoser(
            context.humanoid, context.world, self._idle, lambda: self._ended.persistent, self._isolated
        )
        # Notes of new units, not reported yet.
        self._notes: list[Warn] = []
        self._history = MotionHistory(lambda: self._humanoid.body)
        # Ends of holds, because a behavior releases their hands.
        self._released: list[EndUnit] = []
        predictor = AnimationPredictor(
            context.humanoid.avatar.skeleton, lambda: self._rest.layer, lambda: self.player.units, self._history
        )
        motion_context = self._new_motion_context(predictor, context.graph)
        self._planner = MotionPlanner(self._library, self._idle, self._rest, self._drafts, predictor, motion_context)
        self.extensions = self._library.extensions

    def _new_motion_context(self, predictor: AnimationPredictor, graph: Graph) -> MotionContext:
        return MotionContext(
            lambda: self._humanoid.body,
            lambda: self._humanoid.shown,
            lambda: self._rest.body,
            predictor.state_before,
            self._ended.hands,
            self._note_passed,
            self._note_end,
            self._claimed,
            self._humanoid.switch,
            graph,
        )

    def lexicon(self) -> Iterator[LexiconEntry]:
        """Yield the entries of the binding, and the poses of postures."""
        return binding_lexicon(self._library, next(iter(self._world.targets)))

    def supports(self, behavior: Behavior) -> bool:
        """Whether a behavior is of one of its kinds, or of another namespace and has an entry in the binding."""
        bound = isinstance(behavior, ForeignBehavior) and self._library.binding.binds(behavior)
        return bound or super().supports(behavior)

    def check(self, behavior: Behavior) -> Collection[str] | None:
        """Return the points of the motion that the binding has for a behavior; None if its file is yet to be read.

        Raises:
            RealizerError: there is no motion for it, or no such target.
        """
        return self._planner.check(behavior)

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """Read long files in another thread."""
        return self._planner.prepare(behavior)

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """Plan the motion that the binding has for the behavior.

        Raises:
            RealizerError: there is no motion for it, or no such target.
        """
        return self._planner.plan(block, behavior)

    def add(self, unit: PlanUnit) -> None:
        """Add a planned unit, and forget the drafts."""
        self._drafts.enter_plan()
        if isinstance(unit, AnimationUnit):
            self._notes += [Warn(unit, note) for note in unit.notes]
        super().add(unit)

    def reset(self, time: GlobalTime) -> None:
        """Return to the initial posture and gaze, and to usual idle animation."""
        if self._idle is not None:
            self._idle.reset(time)
        self._eye_poser.note_change(time)
        self._ended.reset(time)

    def layers(self, tick: Tick) -> tuple[Layer, ...]:
        """Return all layers: rest posture, idle animation, persistent poses, fading and playing motions, feet."""
        self._history.start_frame(tick.time)
        self._ended.start_frame(tick.time)
        playing = self._playing()
        self._acting = self._controlling(playing)
        self._humanoid.aim(_pointing_arms(playing))
        balances = self._balances()
        walking: tuple[Layer, ...] = self._isolated(
            "walking", lambda: self._stepping.walk(tick.time, playing, balances=balances), ()
        )
        standing = self._stepping.standing(balances=balances)
        layers = (
            self._rest.layer,
            *walking,
            *self._breath(tick.time, standing, playing),
            *self._ended.persisting(tick.time),
            *self._ended.waiting(tick.time),
            *self._stacked(tick.time),
        )
        follow: tuple[Layer, ...] = self._isolated(
            "trunk following", lambda: self._followed(tick.time, playing, layers, standing), ()
        )
        lean: tuple[Layer, ...] = self._isolated(
            "leaning", lambda: self._leant(tick.time, playing, (*layers, *follow)), ()
        )
        posed = (*layers, *follow, *lean)
        feet: tuple[Layer, ...] = self._isolated("foot planting", lambda: self._stepping.plant(posed, tick.time), ())
        return (*posed, *feet)

    def _followed(
        self, now: GlobalTime, playing: Sequence[AnimationUnit], layers: Iterable[Layer], standing: float
    ) -> tuple[Layer, ...]:
        """Return the layer in which trunk and pelvis follow gesturing and pointing arms."""
        arms = [
            unit.shown for unit in playing if isinstance(unit.behavior, (Gesture, MurmlGesture, Pointing)) and unit.live
        ]
        if not arms and self._trunk_following.rests:
            return ()
        directed = any(layer.kind is LayerKind.GAZE and not _HEAD.isdisjoint(layer.rotations) for layer in layers)
        steps = 0.0 if self._balances() else standing
        return self._trunk_following.layers(now, arms, self._humanoid.body, directed=directed, standing=steps)

    def _leant(self, now: GlobalTime, playing: Sequence[AnimationUnit], layers: Sequence[Layer]) -> tuple[Layer, ...]:
        """Return the layer in which the trunk leans for hands whose arms do not reach their goals."""
        if self._leaning.rests and not any(unit.motion.hands for unit in playing):
            return ()
        uppermost = {
            side: unit
            for unit in self.player.stacked(AnimationUnit)
            for side in SIDES
            if unit.live and unit.motion.kind in _CLAIMING and f"{side}_shoulder" in unit.motion.joints
        }
        goals = [hand for side, unit in uppermost.items() for hand in unit.motion.hands if hand.side == side]
        if not goals and self._leaning.rests:
            return ()
        return self._leaning.layers(now, goals, compose(self._humanoid.avatar.skeleton, layers).shown)

    def _breath(self, now: GlobalTime, standing: float, playing: Iterable[AnimationUnit]) -> tuple[Layer, ...]:
        for unit in self.player.playing:
            if isinstance(unit, IdleChangeUnit | WeightShiftUnit):
                unit.follow(now)
        idle = self._idle
        if idle is None:
            return ()
        busy = _moved_arms((*(unit.motion for unit in playing), *self._ended.persistent))
        return self._isolated("idle animation", lambda: (checked(idle.layer(now, standing, busy)),), ())

    def _stacked(self, now: GlobalTime) -> list[Layer]:
        shown = self.player.show(AnimationUnit, lambda unit: (unit, unit.layer(now)), now)
        playing = [(unit.height, layer) for unit, layer in shown]
        alone = [layer for _, layer in shown]
        return self._isolated("fading motion", lambda: self._ended.with_playing(playing, now), alone)

    def _playing(self) -> list[AnimationUnit]:
        """Return the units that play, in order of planning."""
        return [unit for unit in self.player.playing if isinstance(unit, AnimationUnit)]

    def push(self, joint: str, force: Vec3, duration: float) -> None:
        """Push the figure; it gives way where controllers move it."""
        self._physical_figure.push(joint, force, duration)

    @property
    def needs_frames(self) -> bool:
        """Whether the figure is simulated, or walks: what happens then depends on what happened before."""
        if self._physical_figure.active or self._stepping.active:
            return True
        playing = self._playing()
        steps = any(unit.motion.steps or isinstance(unit, LocomotionUnit) for unit in playing)
        return steps or bool(self._controlling(playing))

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """Return the moves of points: locomotion arrives at another time, or a temporal extent has changed.

        Hands that are released no longer hold on to a target.
        """
        slowed = (move for unit in self._playing() for move in unit.moves(tick.time, partial(self._awaited_from, unit)))
        released, self._released = tuple(self._released), []
        return (*self._stepping.arrivals(tick.time), *slowed, *released)

    def _awaited_from(self, unit: AnimationUnit) -> Time:
        """Return the first start of a behavior that needs the limbs of a unit after its relax; None if none does."""
        relax = unit.time("relax") if "relax" in unit.timing.points else None
        waiting = (other for other in self.player.units if not other.begun and not other.spares(unit.resources))
        starts = (start for other in waiting if (start := other.start_and_end[0]) is not None)
        return min((start for start in starts if relax is not None and start > relax - RESOLUTION), default=None)

    def _balances(self) -> bool:
        """Return whether a controller moves the root in this frame."""
        return any(ROOT in controller.joints for controller in self._acting.values())

    def dynamics(self, tick: Tick) -> Dynamics | None:
        """Return the movement of the joints that controllers move and no motion turns (thesis 8.7.5)."""
        claimed: frozenset[str] = frozenset()
        controllers = [controller for unit, controller in self._acting.items() if unit.live]
        if controllers or self._physical_figure.active:
            claimed = claimed.union(*(u.shown.rotations for u in self._playing() if u.motion.kind in _CLAIMING))
        return self._physical_figure.dynamics(controllers, claimed)

    @staticmethod
    def _controlling(playing: Sequence[AnimationUnit]) -> dict[AnimationUnit, PhysicalController]:
        """Return the controllers that act, the latest last: in each replacement group, only the uppermost unit does."""
        if not any(isinstance(unit.motion, ControllerMotionUnit) for unit in playing):
            return {}
        units = {unit.group or unit: unit for unit in sorted(playing, key=height)}
        motions = ((unit, unit.motion) for unit in units.values())
        return {unit: motion.controller for unit, motion in motions if isinstance(motion, ControllerMotionUnit)}

    def eyes(self, tick: Tick) -> Eyes:
        """Pose the eyes for all gazes, from the head as shown; the lids follow."""
        return self._eye_poser.eyes(tick.time, self._playing())

    def warnings(self) -> tuple[Warn | ReportFall, ...]:
        """Return warnings about new units, and about playing units; and a fall."""
        notes, self._notes = self._notes, []
        faults = (Warn(unit, fault) for unit in self._playing() if (fault := unit.new_fault()) is not None)
        return (*notes, *faults, *self._falls(), *self._late_hands.warnings())

    def _falls(self) -> Iterator[ReportFall]:
        """Yield the fall of the figure in the frame shown last, if it has, with the last unit that moves its root.

        A figure that lies because its posture says so has not fallen.
        """
        if self._physical_figure.take_fall():
            controlling = self._controlling(self._playing())
            units = [unit for unit, controller in controlling.items() if ROOT in controller.joints]
            yield from (ReportFall(unit, self._humanoid.time) for unit in units[-1:])

    def _note_passed(self, unit: AnimationUnit, sync: str, time: GlobalTime) -> None:
        if isinstance(unit.motion, ReleaseMotionUnit) and sync == "start":
            self._end_holds(unit, unit.motion.released, time)
        self._eye_poser.note_change_by(unit, time)
        self._late_hands.note(unit, sync, time)
        if sync == "relax" and unit.motion.kind is LayerKind.GESTURE:
            others = (other for other in self.player.units if isinstance(other, AnimationUnit))
            self._ended.note_relax(unit, others, time)

    def _end_holds(self, unit: AnimationUnit, released: frozenset[str], time: GlobalTime) -> None:
        """End the units that hold on to a target with an arm that is released; each ends as a whole."""
        for hold in (other for other in self._playing() if other.holds_on and other.resources & released):
            self._released.append(EndUnit(hold, time))
            if not hold.resources <= released:
                name = f"{hold.block.block}:{hold.behavior.id}"
                self._notes.append(Warn(unit, EndsForBothHands(hold=name)))

    def _claimed(self, unit: AnimationUnit) -> frozenset[str]:
        """Return the resources that are better left to others.

        Later behaviors of the same block name them, and need them before a unit only retracts; or hands hold a target.
        """
        until = unit.time("relax" if "relax" in unit.timing.points else "end")
        waiting = (other for other in self.player.units if other.block == unit.block and not other.begun)
        naming = (other for other in waiting if other is not unit and getattr(other.behavior, "mode", None) is not None)
        starts = ((other, other.start_and_end[0]) for other in naming)
        claims = (other.resources for other, start in starts if start is not None and (until is None or start < until))
        holds = (other.resources for other in self._playing() if other.holds_on and other is not unit)
        return frozenset[str]().union(*claims, *holds)

    def _note_end(self, unit: AnimationUnit, time: GlobalTime) -> None:
        self._eye_poser.note_change_by(unit, time)
        self._ended.end(unit, time)


def _pointing_arms(playing: Iterable[AnimationUnit]) -> frozenset[str]:
    """Return the sides of the arms that point, or are about to."""
    pointing = [unit for unit in playing if isinstance(unit.behavior, Pointing) and unit.phase < unit.keys["relax"]]
    return frozenset(side for unit in pointing for side in SIDES if f"{side}_shoulder" in unit.motion.joints)


def _moved_arms(motions: Iterable[MotionUnit]) -> frozenset[str]:
    """Return the sides of the arms that motions above postures move."""
    moving = [motion for motion in motions if motion.kind in _CLAIMING]
    return frozenset(side for motion in moving for side in SIDES if f"{side}_elbow" in motion.joints)
