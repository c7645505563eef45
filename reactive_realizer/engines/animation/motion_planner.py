"""Plans motions: the units of behaviors, and the posture and the place in which they leave the figure."""

import asyncio
from collections.abc import Awaitable, Callable, Collection, Hashable, Iterable, Iterator
from itertools import chain

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.idle_change import MOSTS, IdleChange
from reactive_realizer.bml.vocabulary import StanceType
from reactive_realizer.bml.weight_shift import WeightShift
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.place import Place
from reactive_realizer.engines.animation.animation_predictor import AnimationPredictor
from reactive_realizer.engines.animation.animation_unit import AnimationUnit, MotionContext
from reactive_realizer.engines.animation.fade_out import DURATION as FADE_OUT
from reactive_realizer.engines.animation.faults import NoIdle, TooMuchOfIdle, WeightOnNoFoot
from reactive_realizer.engines.animation.idle import Idle
from reactive_realizer.engines.animation.idle_course import IdleChangeUnit
from reactive_realizer.engines.animation.motion_library import MotionLibrary
from reactive_realizer.engines.animation.motion_timing import keys_of
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.engines.animation.motions.locomotion import LocomotionMotionUnit, LocomotionUnit
from reactive_realizer.engines.animation.motions.posture import (
    PostureMotionUnit,
    PostureUnit,
    posture_after,
    temporary_bodies,
)
from reactive_realizer.engines.animation.motions.transition import TransitionMotionUnit, TransitionUnit
from reactive_realizer.engines.animation.posture.posture_library import BodyPosture
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture
from reactive_realizer.engines.animation.weight_shifts import WeightShiftUnit
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit

_MOST_ORIGINS = 64
"""Origins of motions that are remembered; makers of motions remember what they made for as many at least."""


class MotionDrafts:
    """The units of the block that is being planned, by the ids of their behaviors; they are not in the plan yet.

    Args:
        units: returns those of the plan, in order.
        playing: returns those of them that play.
    """

    def __init__(self, units: Callable[[], Iterable[PlanUnit]], playing: Callable[[], Iterable[PlanUnit]]) -> None:
        self._units, self._playing = units, playing
        self._drafts: dict[str, AnimationUnit] = {}
        # Bodies in postures that were cut since the last plan; the figure may still be there.
        self._interrupted: list[Body] = []

    def keep_before(self, block: BlockKey, behavior: Behavior) -> bool:
        """Forget the drafts of what does not precede a behavior in its block; whether any are left."""
        while self._drafts and not _precedes(next(reversed(self._drafts.values())), block, behavior):
            self._drafts.popitem()
        return bool(self._drafts)

    def add(self, unit: AnimationUnit) -> None:
        """Add the unit of a behavior."""
        self._drafts[unit.behavior.id] = unit

    def get(self, behavior: str) -> AnimationUnit | None:
        """Return the unit of a behavior of the block that is being planned."""
        return self._drafts.get(behavior)

    def note_interrupted(self, bodies: Iterable[Body]) -> None:
        """Note bodies in postures that were cut."""
        self._interrupted += bodies

    def clear(self) -> None:
        """Forget the drafts."""
        self._drafts.clear()

    def enter_plan(self) -> None:
        """Forget the drafts, because they are in the plan, and with them the interrupted postures."""
        self.clear()
        self._interrupted.clear()

    def posture_after(self, posture: BodyPosture) -> BodyPosture:
        """Return the posture in which the figure will be, after everything that is planned, if it is in one now."""
        return posture_after(posture, self._motions(self._units()))

    def place_after(self, place: Place) -> Place:
        """Return the place at which it will be, if it is at one now."""
        places = [motion.place for motion in self._motions(self._units()) if isinstance(motion, LocomotionMotionUnit)]
        return places[-1] if places else place

    def possible_bodies(self) -> tuple[Body, ...]:
        """Return bodies in other postures in which the next behavior may find the figure."""
        return tuple(dict.fromkeys((*temporary_bodies(self._motions(self._playing())), *self._interrupted)))

    def _motions(self, units: Iterable[PlanUnit]) -> Iterator[MotionUnit]:
        return (unit.motion for unit in chain(units, self._drafts.values()) if isinstance(unit, AnimationUnit))


class MotionPlanner:
    """Plans units for behaviors of the body.

    Args:
        library: of motions.
        idle: the idle animation; None if the figure has none.
        rest: the figure at rest.
        drafts: the units of the block that is being planned.
        predictor: of the body.
        context: of the units.
    """

    def __init__(
        self,
        library: MotionLibrary,
        idle: Idle | None,
        rest: RestPosture,
        drafts: MotionDrafts,
        predictor: AnimationPredictor,
        context: MotionContext,
    ) -> None:
        self._library = library
        self._idle = idle
        self._rest = rest
        self._drafts = drafts
        self._predictor = predictor
        self._context = context
        self._origins: dict[Hashable, None] = {}

    def check(self, behavior: Behavior) -> Collection[str] | None:
        """See `DefaultEngine`."""
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

    def plan(self, block: BlockKey, behavior: Behavior) -> PlanUnit:
        """Plan the motion that the binding has for a behavior.

        Raises:
            RealizerError: there is no motion for it, or no such target.
        """
        if isinstance(behavior, IdleChange | WeightShift):
            return self._idle_unit(block, behavior)
        if not self._drafts.keep_before(block, behavior):
            self._library.refresh()
        unit = self._unit(block, behavior)
        unit.planning_work += self._first_work(unit.motion)
        self._drafts.add(unit)
        return unit

    def _first_work(self, motion: MotionUnit) -> int:
        """Return the further work of a motion, if none was planned from its origin before.

        What other sessions of the process have planned does not count, so that a replay takes the same ticks.
        """
        if motion.origin is None or motion.origin in self._origins:
            return 0
        if len(self._origins) == _MOST_ORIGINS:
            del self._origins[next(iter(self._origins))]
        self._origins[motion.origin] = None
        return motion.first_work

    def _idle_unit(self, block: BlockKey, behavior: IdleChange | WeightShift) -> IdleChangeUnit | WeightShiftUnit:
        """Plan a change of idle animation, or a movement of it.

        Raises:
            RealizerError: "no-idle": the figure has none; "too-much-of-idle": the value is above its limit;
                "weight-on-no-foot": the figure does not stand.
        """
        if self._idle is None:
            raise RealizerError(NoIdle())
        if isinstance(behavior, WeightShift):
            stance = self._rest.expected.stance
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
            return TransitionUnit(block, behavior, candidates, self._context, self._predictor.state_after)
        if isinstance(candidates.planned.motion, LocomotionMotionUnit):
            return LocomotionUnit(block, behavior, candidates, self._context)
        if isinstance(candidates.planned.motion, PostureMotionUnit):
            return PostureUnit(block, behavior, candidates, self._context)
        unit = AnimationUnit(block, behavior, candidates, self._context)
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


def _precedes(unit: AnimationUnit, block: BlockKey, behavior: Behavior) -> bool:
    return unit.block == block and unit.behavior.order < behavior.order
