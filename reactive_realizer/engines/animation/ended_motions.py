"""Shows what is left of ended motions: poses that persist, arms that wait, hands that return, and fading layers."""

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.inertialization import CARRIED
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.fade_out import (
    DURATION,
    FadeOut,
    FadeOuts,
    fade_out_duration,
    moves_lower_body,
    with_reached_root,
)
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.engines.animation.motions.posture import temporary_bodies
from reactive_realizer.engines.animation.persistent_poses import PersistentPoses
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture
from reactive_realizer.engines.animation.returning_hands import ReturningHands
from reactive_realizer.engines.animation.waiting_arms import WaitingArms
from reactive_realizer.planunit.plan_unit import UnitState


class EndedMotions:
    """The motions of a figure that have ended, as long as they show."""

    def __init__(
        self,
        humanoid: Humanoid,
        rest: RestPosture,
        playing: Callable[[], Sequence[AnimationUnit]],
        note_interrupted: Callable[[Iterable[Body]], None],
    ) -> None:
        """Begin with none.

        Args:
            humanoid: the figure.
            rest: its posture.
            playing: returns the units that play, in order of planning.
            note_interrupted: is called with the bodies from which the figure returns unexpectedly.
        """
        self._humanoid = humanoid
        self._rest = rest
        self._playing = playing
        self._note_interrupted = note_interrupted
        self._poses = PersistentPoses()
        self._waiting_arms = WaitingArms(self._release)
        self._returning_hands = ReturningHands(rest)
        self._fade_outs = FadeOuts()

    @property
    def persistent(self) -> tuple[MotionUnit, ...]:
        """The motions that persist; the latest is last and lies above the others."""
        return self._poses.motions

    def hands(self, now: GlobalTime) -> Body | None:
        """Return the figure with its hands where they are at a time; None if it is at rest."""
        return self._returning_hands.body(self._playing(), now)

    def start_frame(self, now: GlobalTime) -> None:
        """Drop what is gone."""
        self._fade_outs.start_frame(now)

    def persisting(self, now: GlobalTime) -> tuple[Layer, ...]:
        """Return the layers of the poses that persist."""
        if not self._poses.motions:
            return ()
        layers = self._poses.layers(now, self._humanoid.body)
        for motion in self._poses.motions:
            if motion.jumped:
                self._humanoid.switch(motion.joints, GlobalTime(now + motion.entrance))
        return layers

    def waiting(self, now: GlobalTime) -> tuple[Layer, ...]:
        """Return the layers of arms that wait for the next gesture."""
        return self._waiting_arms.layers(now)

    def with_playing(self, playing: Iterable[tuple[tuple[float, float], Layer]], now: GlobalTime) -> list[Layer]:
        """Merge what fades out with playing layers, lowest first (`FadeOuts.with_playing`)."""
        return self._fade_outs.with_playing(playing, now)

    def note_relax(self, unit: AnimationUnit, units: Iterable[AnimationUnit], time: GlobalTime) -> None:
        """Let a gesture that relaxes keep up the arms that another gesture of the plan needs soon."""
        self._waiting_arms.note_relax(unit, units, time)

    def end(self, unit: AnimationUnit, time: GlobalTime) -> None:
        """Take over the joints of a unit that has ended. A pose that persists lies below all others from now on."""
        self._returning_hands.note_end(unit, time)
        done = unit.state is UnitState.DONE and not unit.was_cut("end")
        stays = done and unit.motion.persists_as is not None
        if not done:
            self._note_interrupted(temporary_bodies([unit.motion]))
        base, layer = self._rest.layer, with_reached_root(unit.shown, self._humanoid.shown.root)
        duration = fade_out_duration(layer, self._roots())
        if stays and unit.motion.becomes_rest():
            self._fade_outs.hide(layer, unit.height)
            duration = max(duration, fade_out_duration(base, self._roots()))
            self._fade_outs.start(FadeOut(base, time, duration, under=layer.weight))
        elif stays:
            self._release(self._poses.keep(unit.motion), time)
        waiting = self._waiting_arms.note_end(unit, time)
        if moves_lower_body(layer):
            speed = unit.weight_speed(time)
            since = unit.shown_at if speed else time
            self._fade_outs.start(FadeOut(layer, since, duration, unit.height, speed))
            self._humanoid.switch(layer.rotations, GlobalTime(time + CARRIED))
        else:
            self._release(layer.rotations.keys() - waiting, time)

    def reset(self, time: GlobalTime) -> None:
        """Return to the initial posture, without poses that persist."""
        self._release(self._poses.clear(), time)
        base, body = self._rest.layer, self._rest.body
        if self._rest.reset():
            self._note_interrupted([body])
            self._fade_outs.start(FadeOut(base, time, fade_out_duration(base, self._roots())))

    def _release(self, joints: Collection[str], time: GlobalTime) -> None:
        """Let joints go over to what is below the motion that had them."""
        self._humanoid.switch(joints, GlobalTime(time + DURATION))

    def _roots(self) -> Iterator[Vec3]:
        """Yield the displacements of HumanoidRoot at rest and in playing motions."""
        yield self._rest.body.root
        yield from (unit.shown.root for unit in self._playing() if unit.shown.root is not None)
