"""Animations by the name of their file."""

from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.motion_unit import JOINTS, MIRROR, NAME
from reactive_realizer.engines.animation.procedural.animation_cache import animation_in
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation

_SAID = (NAME, MIRROR, JOINTS)
"""The parameters that, with a file, say which animation it is."""


class AnimationFiles:
    """The animations of files, for an actor's figure; a file that was saved anew is read anew.

    What was found stays until somebody says to look again: to look takes as long as to plan what was found.
    """

    def __init__(self, actor: Actor) -> None:
        self._actor = actor
        self._found: dict[tuple[str | None, ...], ProcAnimation] = {}

    def look_again(self) -> None:
        """Files may have been saved since."""
        self._found.clear()

    def __call__(self, wanted: Wanted) -> ProcAnimation:
        """The animation that is wanted.

        Two parameters belong to every animation (thesis C.1.5): `mirror`, true or false, and `joints`, H-Anim names
        between spaces or commas, to which it is confined; mirrored first, then confined.

        Raises:
            RealizerError: there is no such file, or it cannot be read, or turns none of the joints.
        """
        key = (wanted.file, *map(wanted.parameters.get, _SAID))
        if key not in self._found:
            self._found[key] = self._read(wanted)
        return self._found[key]

    def _read(self, wanted: Wanted) -> ProcAnimation:
        return animation_in(
            self._actor.file_of(wanted, "xml"),
            self._actor.humanoid.avatar.skeleton,
            mirror=wanted.mirror,
            joints=wanted.joints,
            functions=self._actor.functions,
        )
