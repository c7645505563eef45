"""Animations by the name of their file."""

from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.procedural.animation_cache import animation_in
from reactive_realizer.engines.animation.procedural.proc_animation import ProcAnimation


def wanted_animation(actor: Actor, wanted: Wanted) -> ProcAnimation:
    """The animation that is wanted, for the actor's figure; a file that was saved anew is read anew.

    Two parameters belong to every animation (thesis C.1.5): `mirror`, true or false, and `joints`, H-Anim names between
    spaces or commas, to which it is confined; mirrored first, then confined.

    Raises:
        RealizerError: there is no such file, or it cannot be read, or turns none of the joints.
    """
    return animation_in(
        actor.file_of(wanted, "xml"),
        actor.humanoid.avatar.skeleton,
        mirror=wanted.mirror,
        joints=wanted.joints,
        functions=actor.functions,
    )
