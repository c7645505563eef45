"""How one figure holds itself when it does nothing."""

from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.skeleton import Pose
from reactive_realizer.engines.animation.posture.body_posture import BodyPosture
from reactive_realizer.engines.animation.posture.posture_library import PostureLibrary


class Rest:
    """The figure at rest: where gestures come from and return to, if nothing else is known.

    Attributes:
        posture: as words.
        expected: the posture after all shifts that are planned; how long later ones take follows from it.
        body: in the posture. Preferred durations follow from it, whatever is shown: a plan does not depend on who is
            looking.
    """

    def __init__(self, library: PostureLibrary) -> None:
        self._library = library
        self.posture = self.expected = BodyPosture()
        self.body = library.body(self.posture)

    @property
    def pose(self) -> Pose:
        """Of its joints; those left out are in the default pose."""
        return self.body.pose

    def take(self, posture: BodyPosture, body: Body) -> None:
        """From now on the figure rests in a posture.

        Args:
            posture: as words.
            body: in that posture.
        """
        self.posture, self.body = posture, body

    def reset(self) -> bool:
        """It stands as at first; whether it did not before."""
        self.expected = BodyPosture()
        if self.posture == self.expected:
            return False
        self.take(self.expected, self._library.body(self.expected))
        return True

    def in_posture(self, posture: BodyPosture) -> Body:
        """The body in a posture.

        Raises:
            RealizerError: there is no such posture.
        """
        return self.body if posture == self.posture else self._library.body(posture)
