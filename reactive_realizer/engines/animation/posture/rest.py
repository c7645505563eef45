"""How one figure holds itself when it does nothing."""

from collections.abc import Callable, Iterable

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.skeleton import Pose
from reactive_realizer.engines.animation.posture.body_posture import BodyPosture
from reactive_realizer.engines.animation.posture.posture_library import PostureLibrary


class Rest:
    """The figure at rest: where gestures come from and return to, if nothing else is known.

    Attributes:
        posture: as words.
        body: in the posture. Preferred durations follow from it, whatever is shown: a plan does not depend on who is
            looking.
    """

    def __init__(
        self,
        library: PostureLibrary,
        expected: Callable[[], BodyPosture] = BodyPosture,
        elsewhere: Callable[[], Iterable[Body]] = tuple,
    ) -> None:
        """Standing, as at first.

        Args:
            library: of postures.
            expected: the posture after all shifts that come before what is being planned.
            elsewhere: in which other postures the figure may be when what is being planned begins.
        """
        self._library = library
        self._expected = expected
        self._elsewhere = elsewhere
        self.posture = BodyPosture()
        self.body = library.body(self.posture)

    @property
    def pose(self) -> Pose:
        """Of its joints; those left out are in the default pose."""
        return self.body.pose

    @property
    def expected(self) -> BodyPosture:
        """The posture in which what is being planned will begin: how long a shift takes follows from it."""
        return self._expected()

    @property
    def elsewhere(self) -> Iterable[Body]:
        """The figure in other postures, in which what is being planned may find it: from there it takes longer."""
        return self._elsewhere()

    def take(self, posture: BodyPosture, body: Body) -> None:
        """From now on the figure rests in a posture.

        Args:
            posture: as words.
            body: in that posture.
        """
        self.posture, self.body = posture, body

    def reset(self) -> bool:
        """It stands as at first; whether it did not before."""
        first = BodyPosture()
        if self.posture == first:
            return False
        self.take(first, self._library.body(first))
        return True

    def check(self, posture: BodyPosture) -> None:
        """Whether there is such a posture.

        Raises:
            RealizerError: there is not.
        """
        self._library.check(posture)

    def in_posture(self, posture: BodyPosture) -> Body:
        """The body in a posture, without the poses that are not there in its stance: who crouches crosses no legs.

        Raises:
            RealizerError: a file is not usable.
        """
        return self.body if posture == self.posture else self._library.body(self._library.possible(posture))
