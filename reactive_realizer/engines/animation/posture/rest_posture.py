"""The rest posture of a figure."""

from collections.abc import Callable, Iterable
from functools import lru_cache
from pathlib import Path

from reactive_realizer.bml.behaviors import Pose
from reactive_realizer.bml.vocabulary import StanceType
from reactive_realizer.embodiment.body import Body, JointRotations
from reactive_realizer.embodiment.clearance import Clear
from reactive_realizer.embodiment.pose import Layer, LayerKind
from reactive_realizer.engines.animation.posture.detour import Detour
from reactive_realizer.engines.animation.posture.posture_library import BodyPosture, PostureLibrary
from reactive_realizer.sized_cache import SizedCache

_REMEMBERED = 64
"""Postures, and ways between them, that are remembered: to find a body or a way takes milliseconds."""


class RestPosture:
    """The figure at rest: gestures start from here and return here, unless another pose is known.

    Attributes:
        posture: by lexemes.
        body: in that posture. Preferred durations follow from it and not from the shown body, so a plan does not depend
            on whether frames are made.
        clear: brings the arms of a body out of its flesh.
        found: how many bodies in postures had to be found so far.
        detours: those that were found between two bodies. Other figures do not share them, so that a replayed session
            plans in the same ticks.
    """

    def __init__(
        self,
        library: PostureLibrary,
        expected: Callable[[], BodyPosture] = BodyPosture,
        possible_bodies: Callable[[], Iterable[Body]] = tuple,
        clear: Clear = lambda body, _: body,
    ) -> None:
        """Start with standing.

        Args:
            library: of postures.
            expected: returns the posture after all shifts that come before the behavior that is being planned.
            possible_bodies: returns bodies in other postures in which that behavior may find the figure.
            clear: brings the arms of a body out of its flesh.
        """
        self._library, self.clear = library, clear
        self._expected = expected
        self._possible_bodies = possible_bodies
        self.posture = BodyPosture()
        self.found = 0
        self.detours = SizedCache[tuple[Body, Body], Detour](_REMEMBERED)
        self._resting = lru_cache(_REMEMBERED)(self._body)
        self.body = self._resting(self.posture)
        self._layer: Layer | None = None

    @property
    def pose(self) -> JointRotations:
        """JointRotations of its joints; joints that are left out are in the default pose."""
        return self.body.pose

    @property
    def expected(self) -> BodyPosture:
        """The posture in which the behavior that is being planned will start; the duration of a shift depends on it."""
        return self._expected()

    @property
    def possible_bodies(self) -> Iterable[Body]:
        """Bodies in other postures in which that behavior may find the figure; from there it takes longer."""
        return self._possible_bodies()

    @property
    def layer(self) -> Layer:
        """The layer of its pose, below all others; the same one until it rests in another posture."""
        if self._layer is None or self._layer.rotations is not self.pose:
            self._layer = Layer(LayerKind.BASE, self.pose, root=self.body.root)
        return self._layer

    def adopt(self, posture: BodyPosture, body: Body) -> None:
        """Rest in another posture from now on.

        Args:
            posture: by lexemes.
            body: in that posture.
        """
        self.posture, self.body = posture, body

    def reset(self) -> bool:
        """Return to standing; return whether that is a change."""
        first = BodyPosture()
        if self.posture == first:
            return False
        self.adopt(first, self._resting(first))
        return True

    def check(self, posture: BodyPosture) -> None:
        """Check that a posture exists.

        Raises:
            RealizerError: it does not.
        """
        self._library.check(posture)

    def captures(self, stance: StanceType | None, poses: Iterable[Pose]) -> list[Path]:
        """Return the files of those poses that are the first frame of a capture.

        Args:
            stance: None for that of the expected posture.
            poses: of parts of the body.
        """
        return self._library.captures(stance or self.expected.stance, poses)

    def in_posture(self, posture: BodyPosture) -> Body:
        """Return the body in a posture.

        Poses that do not exist in its stance are left out: a crouching figure crosses no legs.

        Raises:
            RealizerError: a file cannot be used.
        """
        if posture == self.posture:
            return self.body
        return self._resting(self._library.possible(posture))

    def _body(self, posture: BodyPosture) -> Body:
        self.found += 1
        return self.clear(self._library.body(posture), 0.0)
