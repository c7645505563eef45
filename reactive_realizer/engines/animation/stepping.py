"""Moves the feet of a figure, which stands, walks to the goals of locomotion, and turns by steps for other motions."""

from collections.abc import Iterator, Sequence

from reactive_realizer.bml.vocabulary import StanceType
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.humanoid import Humanoid
from reactive_realizer.embodiment.pose import Layer
from reactive_realizer.engine.effects import MovePoints
from reactive_realizer.engine.player import Player
from reactive_realizer.engines.animation.animation_unit import AnimationUnit
from reactive_realizer.engines.animation.idle_movements import standing_degree
from reactive_realizer.engines.animation.motion_unit import Resource
from reactive_realizer.engines.animation.motions.locomotion import LocomotionUnit
from reactive_realizer.engines.animation.posture.foot_planting import FootPlanting
from reactive_realizer.engines.animation.posture.rest_posture import RestPosture
from reactive_realizer.engines.animation.walk import Walk
from reactive_realizer.engines.animation.walking.progression import Goal
from reactive_realizer.engines.animation.walking.step_turn import StepTurns


class Stepping:
    """Moves the feet of a figure, and what goes with them."""

    def __init__(self, humanoid: Humanoid, rest: RestPosture, player: Player) -> None:
        """Let a figure stand.

        Args:
            humanoid: the figure.
            rest: its posture.
            player: of its units.
        """
        self._humanoid = humanoid
        self._rest = rest
        self._player = player
        self._walk = Walk(humanoid)
        self._turns = StepTurns()
        self._planting = FootPlanting(humanoid.avatar.skeleton)
        self._standing = 1.0

    @property
    def active(self) -> bool:
        """Return whether the figure walks, or its feet are not at rest yet."""
        return self._walk.active

    @property
    def walks(self) -> list[LocomotionUnit]:
        """The locomotion that plays."""
        return [unit for unit in self._player.playing if isinstance(unit, LocomotionUnit)]

    def arrivals(self, now: GlobalTime) -> Iterator[MovePoints]:
        """Yield the moves of the ends of locomotion that arrives at another time."""
        return (move for unit in self.walks for move in self._walk.moves(unit, now))

    def walk(self, now: GlobalTime, playing: Sequence[AnimationUnit], *, balances: bool) -> tuple[Layer, ...]:
        """Move the figure to where it is at a time, and return the layers of its walking.

        Args:
            now: of the frame, s.
            playing: the units that play, in order of planning.
            balances: whether a controller moves the root.
        """
        return self._walk.layers(now, self._destination(now, playing, balances=balances), self._rest.body)

    def standing(self, *, balances: bool) -> float:
        """Return how far the figure stands upright and shifts its weight, 0 to 1.

        While a controller moves the root, and forces sway the pelvis, that stays as it was.
        """
        if not balances:
            self._standing = standing_degree(self._walk.stiffness - self._humanoid.body.root[1])
        return self._standing

    def plant(self, posed: Sequence[Layer], now: GlobalTime) -> tuple[Layer, ...]:
        """Return the layers that put the feet where the other layers of a frame have them."""
        return self._planting.layers(posed, now, self._walk.feet)

    def _destination(self, now: GlobalTime, playing: Sequence[AnimationUnit], *, balances: bool) -> Goal | None:
        """Return where the figure goes or turns now: locomotion comes before turns of the feet for other motions."""
        walks = (unit for unit in playing if isinstance(unit, LocomotionUnit))
        goals = [goal for unit in walks if (goal := unit.goal()) is not None]
        stands = self._rest.posture.stance is StanceType.STANDING and not balances
        if goals or not stands or any(Resource.STANCE in unit.resources for unit in playing):
            self._turns.forget()
            return goals[-1] if goals else None
        return self._turns.goal(now, self._humanoid.place, lambda: self._player.stacked(AnimationUnit))
