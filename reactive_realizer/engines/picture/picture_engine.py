"""The engine of characters that are shown by pictures (thesis 10.1.3.1, fig. 10.4)."""

from collections.abc import Collection, Iterable, Iterator
from math import inf

from reactive_realizer.binding.spec_reader import read_unit_specs
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.clock.ticker import Tick
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.picture import Picture
from reactive_realizer.engine.context import EngineContext
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.lexicon import LexiconEntry
from reactive_realizer.engines.picture.picture_library import PictureLibrary, Shown
from reactive_realizer.engines.picture.picture_unit import BackgroundUnit, PictureUnit
from reactive_realizer.pegboard.peg_key import BlockKey
from reactive_realizer.planunit.plan_unit import PlanUnit


class PictureEngine(DefaultEngine):
    """Shows pictures for the behaviors that its binding has entries for, and moves the mouth while words sound."""

    def __init__(self, context: EngineContext) -> None:
        super().__init__(f"{context.character}/picture")
        binding = read_unit_specs("picturebinding", "PictureUnit", *context.bindings["picture"])
        self._library = PictureLibrary(binding, context.asset, context.folder)
        self.behaviors = self._library.behaviors()
        self._lip_sync = context.lip_sync
        self._mouth, self._at_rest = self._library.mouth(), self._library.at_rest()
        self._opened: GlobalTime | None = None
        self._background: tuple[Picture, ...] = ()

    def lexicon(self) -> Iterator[LexiconEntry]:
        """The lexemes that have pictures."""
        return self._library.lexicon()

    def supports(self, behavior: Behavior) -> bool:
        """Whether the binding has an entry for the element of a behavior."""
        return self._library.binds(behavior)

    def check(self, behavior: Behavior) -> Collection[str]:
        """The sync points of the pictures.

        Raises:
            RealizerError: the binding has no pictures for it that can be shown.
        """
        return tuple(self._library.pictures(behavior).animation.points)

    def plan(self, block: BlockKey, behavior: Behavior, prepared: object) -> PlanUnit:
        """A unit with the pictures of the behavior.

        Raises:
            RealizerError: the binding has no pictures for it that can be shown.
        """
        animation, layer, stays = self._library.pictures(behavior)
        if stays:
            return BackgroundUnit(block, behavior, animation.files[0], self._set_background)
        return PictureUnit(block, behavior, animation, layer)

    def reset(self, time: GlobalTime) -> None:
        """Remove the background."""
        self._background = ()

    def pictures(self, tick: Tick) -> tuple[Picture, ...]:
        """The pictures of this tick."""
        playing = self.player.show(PictureUnit, lambda unit: unit.shown(tick.time), tick.time)
        return (*self._background, *_repeated(self._at_rest, tick.time), *playing, *self._speaking(tick.time))

    def _set_background(self, file: str) -> None:
        self._background = (Picture(-inf, file),)

    def _speaking(self, now: GlobalTime) -> list[Picture]:
        """The pictures of the mouth, which begin with each stretch of words."""
        if self._lip_sync is None or not self._lip_sync.mouth(now):
            self._opened = None
            return []
        if self._opened is None:
            self._opened = now
        return _repeated(self._mouth, now - self._opened)


def _repeated(pictures: Iterable[Shown], time: float) -> list[Picture]:
    """The pictures of sequences that are repeated, at a time from their start, s."""
    return [
        Picture(layer, animation.file(time % animation.duration / animation.duration))
        for animation, layer, _ in pictures
    ]
