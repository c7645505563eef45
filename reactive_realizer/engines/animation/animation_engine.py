"""The engine of body animation (thesis 8.7): gestures, head movements, gaze, posture, and idle animation."""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial, reduce
from operator import itemgetter
from random import Random
from types import MappingProxyType
from typing import TypeVar

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
from reactive_realizer.bml.idle_change import MOSTS, IdleChange
from reactive_realizer.bml.key_poses import KeyPoses
from reactive_realizer.bml.murml.behaviors import MurmlGesture
from reactive_realizer.bml.release import Release
from reactive_realizer.bml.vocabulary import StanceType
from reactive_realizer.bml.weight_shift import WeightShift
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import RESOLUTION, GlobalTime, Time
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import Dynamics, EyePose, Eyes
from reactive_realizer.embodiment.inertialization import CARRIED
from reactive_realizer.embodiment.joints import EYES, HEAD, ROOT, SIDES
from reactive_realizer.embodiment.place import Place
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked, compose, over
from reactive_realizer.embodiment.quaternion import IDENTITY, Quat, multiply
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.effects import EndUnit, ReportFall, Request, Warn
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.lexicon import LexiconEntry
from reactive_realizer.engine.player import height
from reactive_realizer.engines.animation.animation_predictor import AnimationPredictor
from reactive_realizer.engines.animation.animation_unit import AnimationUnit, MotionContext, keys_of
from reactive_realizer.engines.animation.blinks import USUAL_RATE
from reactive_realizer.engines.animation.expression.functions import plugin_functions
from reactive_realizer.engines.animation.fade_out import DURATION as FADE_OUT
from reactive_realizer.engines.animation.fade_out import (
    FadeOut,
    fade_out_duration,
    in_stacking_order,
    moves_lower_body,
    visible_part,
    with_reached_root,
)
from reactive_realizer.engines.animation.faults import NoIdle, TooMuchOfIdle, WeightOnNoFoot
from reactive_realizer.engines.animation.gaze.eye_controller import EyeController
from reactive_realizer.engines.animation.gaze.eyes import lid_weights
from reactive_realizer.engines.animation.gaze.head_turn import GAZE_WEIGHTS, HEAD_WEIGHTS
from reactive_realizer.engines.animation.gaze.viewer import VIEWER
from reactive_realizer.engines.animation.idle import Idle
from reactive_realizer.engines.animation.idle_course import IdleChangeUnit
from reactive_realizer.engines.animation.idle_movements import standing_degree
from reactive_realizer.engines.animation.kinematics import MotionHistory
from reactive_realizer.engines.animation.late_hands import LateHands
from reactive_realizer.engines.animation.leaning import Leaning
from reactive_realizer.engines.animation.lexicon import binding_lexicon
from reactive_realizer.engines.animation.motion_library import MotionLibrary
from reactive_realizer.engines.animation.motion_maker import MakerContext
from reactive_realizer.engines.animation.motion_unit import (
    AMOUNT_RANGE,
    EXPRESSIVITY_RANGES,
    GazeGoal,
    MotionUnit,
    Resource,
)
from reactive_realizer.engines.animation.motions.controller import ControllerMotionUnit
from reactive_realizer.engines.animation.motions.locomotion import SPEED, SPEEDS, LocomotionMotionUnit, LocomotionUnit
from reactive_realizer.engines.animation.motions.posture import posture_after, temporary_bodies
from reactive_realizer.engines.animation.motions.release import ReleaseMotionUnit
from reactive_realizer.engines.animation.motions.transition import TransitionMotionUnit, TransitionUnit
from reactive_realizer.engines.animation.persistent_poses import PersistentPoses
from reactive_realizer.engines.animation.physical_figure import PhysicalFigure
from reactive_realizer.engines.animation.posture.foot_planting import FootPlanting
from reactive_realizer.engines.animation.posture.posture_library import BodyPosture, PostureLibrary
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture
from reactive_realizer.engines.animation.trunk_following import TrunkFollowing
from reactive_realizer.engines.animation.waiting_arms import WaitingArms
from reactive_realizer.engines.animation.walk import Walk
from reactive_realizer.engines.animation.walking.progression import Goal
from reactive_realizer.engines.animation.walking.step_turn import StepTurns
from reactive_realizer.engines.animation.weight_shifts import WeightShiftUnit
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.physics.controllers.controller import PhysicalController
from reactive_realizer.planunit.parameter import Range
from reactive_realizer.planunit.plan_unit import PlanUnit, UnitState
from reactive_realizer.reactive.graph import Graph

T = TypeVar("T")

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
        self._rest = RestPosture(library, self._expected, self._possible_bodies, context.humanoid.clearance)
        self._base_layer: Layer | None = None
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
            self._expected_place,
            context.expressivity,
        )
        self._library = MotionLibrary(binding, maker_context, context.motions)
        rate = USUAL_RATE if context.blink_rate is None else context.blink_rate
        self._idle = Idle(Random(context.seed), rate, context.idle) if context.idle else None
        self._late_hands = LateHands(context.humanoid)
        self._physical_figure = PhysicalFigure(context.humanoid)
        self._foot_planting = FootPlanting(context.humanoid.avatar.skeleton)
        self._standing = 1.0
        self._walk = Walk(context.humanoid)
        self._waiting_arms = WaitingArms(self._release)
        self._trunk_following = TrunkFollowing(context.humanoid.avatar.skeleton)
        self._leaning = Leaning(context.humanoid.avatar.skeleton, self._humanoid.switch)
        # The controllers that act in the present frame.
        self._acting: dict[AnimationUnit, PhysicalController] = {}
        self._step_turns = StepTurns()
        self._persistent = PersistentPoses()
        self._eye_controller = EyeController(self._idle.blink) if self._idle else EyeController()
        self._fade_outs: list[FadeOut] = []
        # Layers of ended gestures, as the times of their points imply, whether frames are made or not.
        self._left_hands: list[FadeOut] = []
        # Bodies in postures that were cut since the last plan; the figure may still be there.
        self._interrupted_bodies: list[Body] = []
        # Units of the block that is being planned, by behavior; they are not in the plan yet.
        self._drafts: dict[str, AnimationUnit] = {}
        # Notes of new units, not reported yet.
        self._notes: list[Warn] = []
        self._history = MotionHistory(lambda: self._humanoid.body)
        self._isolated = FailureIsolation(self.name)
        self._predictor = AnimationPredictor(
            context.humanoid.avatar.skeleton, self._base, lambda: self.player.units, self._history
        )
        # Ends of holds, because a behavior releases their hands.
        self._released: list[EndUnit] = []
        self._motion_context = self._new_motion_context(context.graph)
        self.extensions = self._library.extensions

    def _new_motion_context(self, graph: Graph) -> MotionContext:
        return MotionContext(
            lambda: self._humanoid.body,
            lambda: self._humanoid.shown,
            lambda: self._rest.body,
            self._predictor.state_before,
            self._hands,
            self._note_passed,
            self._fade_out,
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
        if isinstance(behavior, IdleChange | WeightShift):
            return self._idle_unit(BlockKey("", ""), behavior).timing.points
        self._library.refresh()
        if self._library.preloads(behavior):
            return None
        return tuple(keys_of(behavior, self._library.candidates(behavior).planned.motion))

    def prepare(self, behavior: Behavior) -> Awaitable[object] | None:
        """Read long files in another thread."""
        self._drafts.clear()  # they may be left from a block that failed while it was planned
        works = self._library.preloads(behavior)
        return asyncio.to_thread(lambda: [work() for work in works]) if works else None

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """Plan the motion that the binding has for the behavior.

        Raises:
            RealizerError: there is no motion for it, or no such target.
        """
        if isinstance(behavior, IdleChange | WeightShift):
            return self._idle_unit(block, behavior)
        while self._drafts and not _precedes(next(reversed(self._drafts.values())), block, behavior):
            self._drafts.popitem()
        if not self._drafts:
            self._library.refresh()
        unit = self._drafts[behavior.id] = self._unit(block, behavior)
        return unit

    def add(self, unit: PlanUnit) -> None:
        """Add a planned unit, and forget the drafts."""
        self._drafts.clear()
        self._interrupted_bodies.clear()
        if isinstance(unit, AnimationUnit):
            self._notes += [Warn(unit, note) for note in unit.notes]
        super().add(unit)

    def _expected(self) -> BodyPosture:
        planned = (
            unit.motion for unit in (*self.player.units, *self._drafts.values()) if isinstance(unit, AnimationUnit)
        )
        return posture_after(self._rest.posture, planned)

    def _expected_place(self) -> Place:
        planned = (
            unit.motion for unit in (*self.player.units, *self._drafts.values()) if isinstance(unit, AnimationUnit)
        )
        places = [motion.place for motion in planned if isinstance(motion, LocomotionMotionUnit)]
        return places[-1] if places else self._humanoid.place

    def _possible_bodies(self) -> tuple[Body, ...]:
        planned = (*self.player.playing, *self._drafts.values())
        bodies = temporary_bodies(unit.motion for unit in planned if isinstance(unit, AnimationUnit))
        return tuple(dict.fromkeys((*bodies, *self._interrupted_bodies)))

    def _idle_unit(self, block: BlockKey, behavior: IdleChange | WeightShift) -> IdleChangeUnit | WeightShiftUnit:
        """Plan a change of idle animation, or a movement of it.

        Raises:
            RealizerError: "no-idle": the figure has none; "too-much-of-idle": the value is above its limit;
                "weight-on-no-foot": the figure does not stand.
        """
        if self._idle is None:
            raise RealizerError(NoIdle())
        if isinstance(behavior, WeightShift):
            stance = self._expected().stance
            if stance is not StanceType.STANDING:
                raise RealizerError(WeightOnNoFoot(stance=stance))
            return WeightShiftUnit(block, behavior, self._idle.shifts)
        most = MOSTS[behavior.parameter]
        if behavior.value > most:
            raise RealizerError(TooMuchOfIdle(parameter=behavior.parameter, value=behavior.value, most=most))
        goal = self._idle.relative(behavior.parameter, behavior.value)
        return IdleChangeUnit(block, behavior, self._idle.courses[behavior.parameter], goal)

    def _unit(self, block: BlockKey, behavior: Behavior) -> AnimationUnit:
        candidates = self._library.candidates(behavior)
        if isinstance(candidates.planned.motion, TransitionMotionUnit):
            return TransitionUnit(block, behavior, candidates, self._motion_context, self._predictor.state_after)
        if isinstance(candidates.planned.motion, LocomotionMotionUnit):
            return LocomotionUnit(block, behavior, candidates, self._motion_context)
        unit = AnimationUnit(block, behavior, candidates, self._motion_context)
        previous = self._continued(unit)
        if previous is not None:
            unit.continue_from(previous.relaxed_body(GlobalTime(0.0), self._rest.body))
        return unit

    def _continued(self, unit: AnimationUnit) -> AnimationUnit | None:
        """Return the gesture of the same block that a new unit follows at once with the same hand, if there is one."""
        start = unit.behavior.syncs.get("start")
        if start is None or start.block not in (None, unit.block.block) or start.sync not in ("relax", "end"):
            return None
        draft = self._drafts.get(start.behavior or "")
        follows = draft is not None and start.offset < FADE_OUT and draft.resources & unit.resources
        return draft if follows else None

    def reset(self, time: GlobalTime) -> None:
        """Return to the initial posture and gaze, and to usual idle animation."""
        if self._idle is not None:
            self._idle.reset(time)
        self._release(self._persistent.clear(), time)
        self._eye_controller.note_change(time)
        base, body = self._base(), self._rest.body
        if self._rest.reset():
            self._interrupted_bodies.append(body)
            self._start_fade_out(FadeOut(base, time, fade_out_duration(base, self._roots())))

    def layers(self, tick: Tick) -> tuple[Layer, ...]:
        """Return all layers: rest posture, idle animation, persistent poses, fading and playing motions, feet."""
        self._history.start_frame(tick.time)
        self._fade_outs = [fade_out for fade_out in self._fade_outs if not fade_out.finished(tick.time)]
        playing = self._playing()
        self._acting = self._controlling(playing)
        self._humanoid.aim(_pointing_arms(playing))
        walking: tuple[Layer, ...] = self._isolated(
            "walking", lambda: self._walk.layers(tick.time, self._destination(tick.time, playing), self._rest.body), ()
        )
        if not self._balances():  # forces sway the pelvis: its animation stays as it was
            self._standing = standing_degree(self._walk.stiffness - self._humanoid.body.root[1])
        standing = self._standing
        layers = (
            self._base(),
            *walking,
            *self._breath(tick.time, standing, playing),
            *self._persisting(tick.time),
            *self._waiting_arms.layers(tick.time),
            *self._stacked(tick.time),
        )
        follow: tuple[Layer, ...] = self._isolated(
            "trunk following", lambda: self._followed(tick.time, playing, layers, standing), ()
        )
        lean: tuple[Layer, ...] = self._isolated(
            "leaning", lambda: self._leant(tick.time, playing, (*layers, *follow)), ()
        )
        posed = (*layers, *follow, *lean)
        feet: tuple[Layer, ...] = self._isolated(
            "foot planting", lambda: self._foot_planting.layers(posed, tick.time, self._walk.feet), ()
        )
        return (*posed, *feet)

    def _persisting(self, now: GlobalTime) -> tuple[Layer, ...]:
        layers = self._persistent.layers(now, self._humanoid.body)
        for motion in self._persistent.motions:
            if motion.jumped:
                self._humanoid.switch(motion.joints, GlobalTime(now + motion.entrance))
        return layers

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
        busy = _moved_arms((*(unit.motion for unit in playing), *self._persistent.motions))
        return self._idle_part(lambda idle: (checked(idle.layer(now, standing, busy)),), ())

    def _idle_part(self, show: Callable[[Idle], T], fallback: T) -> T:
        """Return a part of idle animation, or a fallback if the figure has none."""
        idle = self._idle
        return fallback if idle is None else self._isolated("idle animation", lambda: show(idle), fallback)

    def _stacked(self, now: GlobalTime) -> list[Layer]:
        shown = self.player.show(AnimationUnit, lambda unit: (unit, unit.layer(now)), now)
        alone = [layer for _, layer in shown]
        if not self._fade_outs:
            return alone
        playing = [(unit.height, layer) for unit, layer in shown]
        return self._isolated("fading motion", lambda: in_stacking_order(self._fade_outs, playing, now), alone)

    def _playing(self) -> list[AnimationUnit]:
        """Return the units that play, in order of planning."""
        return [unit for unit in self.player.playing if isinstance(unit, AnimationUnit)]

    def push(self, joint: str, force: Vec3, duration: float) -> None:
        """Push the figure; it gives way where controllers move it."""
        self._physical_figure.push(joint, force, duration)

    @property
    def needs_frames(self) -> bool:
        """Whether the figure is simulated, or walks: what happens then depends on what happened before."""
        if self._physical_figure.active or self._walk.active:
            return True
        playing = self._playing()
        return bool(self._controlling(playing) or self._walks()) or any(unit.motion.steps for unit in playing)

    def requests(self, tick: Tick) -> tuple[Request, ...]:
        """Return the moves of points: locomotion arrives at another time, or a temporal extent has changed.

        Hands that are released no longer hold on to a target.
        """
        arrivals = (move for unit in self._walks() for move in self._walk.moves(unit, tick.time))
        slowed = (move for unit in self._playing() for move in unit.moves(tick.time, partial(self._awaited_from, unit)))
        released, self._released = tuple(self._released), []
        return (*arrivals, *slowed, *released)

    def _awaited_from(self, unit: AnimationUnit) -> Time:
        """Return the first start of a behavior that needs the limbs of a unit after its relax; None if none does."""
        relax = unit.time("relax") if "relax" in unit.timing.points else None
        waiting = (other for other in self.player.units if not other.begun and not other.spares(unit.resources))
        starts = (start for other in waiting if (start := other.start_and_end[0]) is not None)
        return min((start for start in starts if relax is not None and start > relax - RESOLUTION), default=None)

    def _destination(self, now: GlobalTime, playing: Sequence[AnimationUnit]) -> Goal | None:
        """Return where the figure goes or turns now: locomotion comes before turns of the feet for other motions."""
        walks = (unit for unit in playing if isinstance(unit, LocomotionUnit))
        goals = [goal for unit in walks if (goal := unit.goal()) is not None]
        stands = self._rest.posture.stance is StanceType.STANDING and not self._balances()
        if goals or not stands or any(Resource.STANCE in unit.resources for unit in playing):
            self._step_turns.forget()
            return goals[-1] if goals else None
        return self._step_turns.goal(now, self._humanoid.place, lambda: self.player.stacked(AnimationUnit))

    def _balances(self) -> bool:
        """Return whether a controller moves the root in this frame."""
        return any(ROOT in controller.joints for controller in self._acting.values())

    def _walks(self) -> list[LocomotionUnit]:
        """Return the locomotion that plays."""
        return [unit for unit in self.player.playing if isinstance(unit, LocomotionUnit)]

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
        playing = self._playing()
        gazes, aside = list(self._gazes(playing)), _aside(playing)
        return lambda body: self._look(tick.time, gazes, aside, body)

    def _look(self, now: GlobalTime, gazes: Sequence[GazeGoal], aside: Quat, body: Body) -> EyePose:
        directed = any(gaze.eyes >= 1.0 and all(eye in gaze.directed for eye in EYES) for gaze in gazes)
        resting: Mapping[str, Quat] = {} if directed else self._idle_part(lambda idle: idle.eyes(now), {})
        camera = None if directed or self._idle is None else self._world.position(VIEWER)
        viewer = None if camera is None else self._humanoid.to_own_frame(camera)
        turns = self._isolated(
            "gaze", lambda: self._eye_controller.eyes(now, gazes, body, resting, viewer, aside), resting
        )
        blinks: Mapping[str, float] = self._idle_part(lambda idle: idle.blinks(now), {})
        return EyePose(turns, lid_weights(turns), blinks)

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

    def _gazes(self, playing: Iterable[AnimationUnit]) -> Iterator[GazeGoal]:
        """Yield the active gaze goals: persistent ones, then playing ones, the latest last."""
        lasting = (motion.gaze(1.0) for motion in self._persistent.motions)
        gazing = [(height(unit), gaze) for unit in playing if (gaze := unit.motion.gaze(unit.phase)) is not None]
        yield from (gaze for gaze in lasting if gaze is not None)
        yield from (gaze for _, gaze in sorted(gazing, key=itemgetter(0)))

    def _note_passed(self, unit: AnimationUnit, sync: str, time: GlobalTime) -> None:
        if isinstance(unit.motion, ReleaseMotionUnit) and sync == "start":
            holding = (other for other in self._playing() if other.holds_on and other.resources & unit.motion.released)
            self._released += [EndUnit(other, time) for other in holding]
        self._note_gaze_change(unit, time)
        self._late_hands.note(unit, sync, time)
        if sync == "relax" and unit.motion.kind is LayerKind.GESTURE:
            others = (other for other in self.player.units if isinstance(other, AnimationUnit))
            self._waiting_arms.note_relax(unit, others, time)

    def _note_gaze_change(self, unit: AnimationUnit, time: GlobalTime) -> None:
        gaze = unit.motion.gaze(0.0)
        if (gaze is not None and gaze.eyes > 0.0) or unit.motion.glance(0.0) is not None:
            self._eye_controller.note_change(time)

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

    def _hands(self, now: GlobalTime) -> Body | None:
        rest = hands = self._rest.body
        self._left_hands = [left for left in self._left_hands if not left.finished(now)]
        playing = self._playing()
        for unit in playing:
            if unit.motion.kind is LayerKind.POSTURE:
                hands = over(hands, unit.timed_layer(now, rest))
        for left in self._left_hands:
            hands = over(hands, left.at(now))
        for unit in playing:
            if unit.motion.kind is LayerKind.GESTURE and unit.subsiding(now) and not unit.accompanies:
                hands = over(hands, unit.retraction_layer(now, rest))
        return None if hands is rest else hands

    def _note_hands(self, unit: AnimationUnit, time: GlobalTime) -> None:
        """Note where a gesture leaves the hands; one that accompanies others must not change the times of the next."""
        if unit.motion.kind is LayerKind.GESTURE and unit.shortest[0] > 0.0 and not unit.accompanies:
            left = FadeOut(unit.final_layer(time, self._rest.body), time)
            self._left_hands = [each for each in (*self._left_hands, left) if not each.finished(time)]

    def _fade_out(self, unit: AnimationUnit, time: GlobalTime) -> None:
        """Take over the joints of a unit that has ended. A pose that persists lies below all others from now on."""
        self._note_gaze_change(unit, time)
        self._note_hands(unit, time)
        done = unit.state is UnitState.DONE and not unit.was_cut("end")
        stays = done and unit.motion.persists_as is not None
        if not done:
            self._interrupted_bodies += temporary_bodies([unit.motion])
        base, layer = self._base(), with_reached_root(unit.shown, self._humanoid.shown.root)
        duration = fade_out_duration(layer, self._roots())
        if stays and unit.motion.becomes_rest():
            self._fade_outs = [visible_part(fade_out, layer, unit.height) for fade_out in self._fade_outs]
            duration = max(duration, fade_out_duration(base, self._roots()))
            self._start_fade_out(FadeOut(base, time, duration, under=layer.weight))
        elif stays:
            self._release(self._persistent.keep(unit.motion), time)
        waiting = self._waiting_arms.note_end(unit, time)
        if moves_lower_body(layer):
            speed = unit.weight_speed(time)
            since = unit.shown_at if speed else time
            self._start_fade_out(FadeOut(layer, since, duration, unit.height, speed))
            self._humanoid.switch(layer.rotations, GlobalTime(time + CARRIED))
        else:
            self._release(layer.rotations.keys() - waiting, time)

    def _release(self, joints: Collection[str], time: GlobalTime) -> None:
        """Let joints go over to what is below the motion that had them."""
        self._humanoid.switch(joints, GlobalTime(time + FADE_OUT))

    def _start_fade_out(self, fade_out: FadeOut) -> None:
        # A former rest posture is below everything else.
        lowest = fade_out.layer.kind is LayerKind.BASE
        fade_outs = (fade_out, *self._fade_outs) if lowest else (*self._fade_outs, fade_out)
        self._fade_outs = [other for other in fade_outs if not other.finished(fade_out.since)]

    def _roots(self) -> Iterator[Vec3]:
        """Yield the displacements of HumanoidRoot at rest and in playing motions."""
        yield self._rest.body.root
        yield from (unit.shown.root for unit in self._playing() if unit.shown.root is not None)

    def _base(self) -> Layer:
        if self._base_layer is None or self._base_layer.rotations is not self._rest.pose:
            self._base_layer = Layer(LayerKind.BASE, self._rest.pose, root=self._rest.body.root)
        return self._base_layer


def _aside(playing: Iterable[AnimationUnit]) -> Quat:
    """Return the turn of the eyes from where they look, in the axes of the head: that of all glances."""
    glances = (unit.motion.glance(unit.phase) for unit in playing)
    return reduce(multiply, (glance for glance in glances if glance is not None), IDENTITY)


def _pointing_arms(playing: Iterable[AnimationUnit]) -> frozenset[str]:
    """Return the sides of the arms that point, or are about to."""
    pointing = [unit for unit in playing if isinstance(unit.behavior, Pointing) and unit.phase < unit.keys["relax"]]
    return frozenset(side for unit in pointing for side in SIDES if f"{side}_shoulder" in unit.motion.joints)


def _moved_arms(motions: Iterable[MotionUnit]) -> frozenset[str]:
    """Return the sides of the arms that motions above postures move."""
    moving = [motion for motion in motions if motion.kind in _CLAIMING]
    return frozenset(side for motion in moving for side in SIDES if f"{side}_elbow" in motion.joints)


def _precedes(unit: AnimationUnit, block: BlockKey, behavior: Behavior) -> bool:
    return unit.block == block and unit.behavior.order < behavior.order


_log = logging.getLogger(__name__)


class FailureIsolation:
    """Isolates failures outside of units, such as in idle animation: the other parts continue to move."""

    def __init__(self, figure: str) -> None:
        """Isolate the failures of a figure, given by name for messages."""
        self._figure = figure
        self._logged: set[str] = set()

    def __call__(self, part: str, show: Callable[[], T], fallback: T) -> T:
        """Return a part of the figure's motion, or a fallback in frames in which it fails. The first failure is logged.

        Args:
            part: its name, for the log.
            show: returns the part.
            fallback: returned if that fails.
        """
        try:
            return show()
        except Exception:
            if part not in self._logged:
                self._logged.add(part)
                _log.exception("%s: %s failed and is left out", self._figure, part)
            return fallback
