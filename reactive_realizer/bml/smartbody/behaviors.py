"""Rewrites behaviors with SmartBody's elements and attributes as those of a draft of BML and its extensions.

Names, units and defaults are those of SmartBody's sources (SmartBody-bml, by the University of Southern California).
"""

from collections.abc import Callable, Mapping
from typing import Final

from reactive_realizer.bml.behaviors import MOST_REPETITIONS
from reactive_realizer.bml.block_source import BlockSource
from reactive_realizer.bml.names import BMLA, SBM
from reactive_realizer.bml.smartbody.attributes import (
    WITHOUT_EFFECT,
    drop,
    left_out,
    limit_amount,
    rename,
    set_parameter,
    take,
    take_number,
    tie,
)
from reactive_realizer.bml.smartbody.faces import adapt_face
from reactive_realizer.bml.smartbody.faults import NoOrientation
from reactive_realizer.bml.smartbody.gaze import adapt_gaze
from reactive_realizer.bml.smartbody.gestures import adapt_clip, adapt_gesture
from reactive_realizer.bml.smartbody.noise import adapt_noise
from reactive_realizer.bml.smartbody.reaching import (
    adapt_constraint,
    adapt_grab,
    adapt_reach,
    is_of_hand,
    left_to_plugins,
)
from reactive_realizer.bml.smartbody.saccades import adapt_saccade
from reactive_realizer.bml.trees import Tree, name_of, namespace_of
from reactive_realizer.errors import Fault, RealizerError

_ORIENT: Final = "ORIENT"
"""The type of a movement of the head that turns it to a target."""
_LONGEST: Final = 60.0
_MOST_VELOCITY: Final = 20.0
_STROKES: Final = {"SHAKE": (0.2, 0.5), "TOSS": (0.1, 0.6)}
_NOD: Final = (0.3, 0.4)
"""Duration of a nod at the velocity 1, s: a constant part, and that of each stroke; above, those of other movements."""
_OPPOSITES: Final = {"NOD": "UP", "TOSS": "DOWN"}
"""Movements of the head with an amount below 0; those to both sides only begin to the other side."""
_WAVES: Final = 3
"""Waves of a wiggle or waggle."""
_USUAL_PERIOD: Final = 0.5
_WIGGLE: Final = {"warp": (0.1, 4.0), "accel": (0.5, 3.0)}
_WAVE_FORMS: Final = {"WIGGLE": _WIGGLE, "WAGGLE": {**_WIGGLE, "pitch": (-1.0, 1.0), "decay": (0.1, 3.0)}}
"""Parameters of wiggles and waggles that shape their waves, and their ranges."""
_OF_WALKERS: Final = {"speed": "speed", "facing": "facing", "proximity": "distance"}
"""Attributes of a locomotion, and the parameters that they are here."""
_MANNERS: Final = {"JOG": "RUN", "SBM:STEP": "STRAFE", "SIDESTEP": "STRAFE"}
_CONSTRAINT: Final = "constraint"


def is_of_smartbody(tree: Tree) -> bool:
    """Return whether the element of a behavior is in the namespace of SmartBody, or in none."""
    return namespace_of(tree) in {"", SBM}


def adapt(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a behavior in place, and returns the faults of what is left out.

    Args:
        tree: the behavior, which has an id.
        source: its block.

    Raises:
        RealizerError: ``bad-attribute``, ``no-orientation``.
    """
    rewrite = _REWRITES.get(name_of(tree))
    other = rewrite is None or (name_of(tree) == _CONSTRAINT and not is_of_hand(tree))
    if other and namespace_of(tree) == SBM:
        return [] if rewrite is None else left_to_plugins(tree, source)
    if namespace_of(tree) == SBM:
        tree.tag = name_of(tree)
    drop(tree, *WITHOUT_EFFECT)
    faults = rewrite(tree, source) if rewrite is not None else []
    return [*faults, *left_out(tree, source)]


def _interrupt(tree: Tree, source: BlockSource) -> list[Fault]:
    rename(tree, "act", "target")
    tree.tag = f"{{{BMLA}}}interrupt"
    return []


def _head(tree: Tree, source: BlockSource) -> list[Fault]:
    """Rewrites a movement of the head; its axis and its duration make no difference in SmartBody either.

    Raises:
        RealizerError: ``no-orientation``, ``bad-attribute``.
    """
    if tree.get("type", "").upper() == _ORIENT:
        if "target" not in tree.attrib:
            raise RealizerError(source.located(tree, NoOrientation()))
        tree.tag = "headDirectionShift"
        drop(tree, "type", "amount", "duration", "direction", "angle")
        return left_out(tree, source)
    repeats = take_number(tree, "repeats", source, 0.0, MOST_REPETITIONS)
    velocity = take_number(tree, "velocity", source, 0.01, _MOST_VELOCITY)
    period = take_number(tree, "period", source, 0.01, _LONGEST)
    strokes = max(1, round(repeats or 1.0))
    if repeats is not None and "repetition" not in tree.attrib:
        tree.set("repetition", str(strokes))
    if velocity is not None and velocity != 1.0:
        fixed, each = _STROKES.get(tree.get("type", "").upper(), _NOD)
        tie(tree, "end", "start", (fixed + each * strokes) / velocity)
    if _shape_wave(tree, source) or period is not None:
        tie(tree, "end", "start", _WAVES * (_USUAL_PERIOD if period is None else period) * strokes)
    amount = limit_amount(tree)
    if amount < 0.0:
        tree.set("amount", f"{min(-amount, 1.0):g}")
        kind = tree.get("type", "")
        tree.set("type", _OPPOSITES.get(kind.upper(), kind))
    drop(tree, "axis", "duration", "smooth")
    return left_out(tree, source)


def _shape_wave(tree: Tree, source: BlockSource) -> bool:
    """Gives a wiggle or a waggle the wave that its parameters say; returns whether it has any."""
    ranges = _WAVE_FORMS.get(tree.get("type", "").upper(), {})
    values = {name: take_number(tree, name, source, low, high) for name, (low, high) in ranges.items()}
    given = {name: value for name, value in values.items() if value is not None}
    for name, value in {"wave": 1.0, **given}.items() if given else ():
        set_parameter(tree, name, f"{value:g}", source)
    return bool(given)


def _locomotion(tree: Tree, source: BlockSource) -> list[Fault]:
    for name, parameter in _OF_WALKERS.items():
        if value := take(tree, name):
            set_parameter(tree, parameter, value, source)
    manner = take(tree, "manner")
    if manner:
        tree.set("manner", _MANNERS.get(manner.upper(), manner))
    drop(tree, "type")
    return left_out(tree, source)


def _as_it_is(tree: Tree, source: BlockSource) -> list[Fault]:
    return []


_REWRITES: Final[Mapping[str, Callable[[Tree, BlockSource], list[Fault]]]] = {
    "interrupt": _interrupt,
    "event": _as_it_is,
    "head": _head,
    "face": adapt_face,
    "gaze": adapt_gaze,
    "gesture": adapt_gesture,
    "locomotion": _locomotion,
    "reach": adapt_reach,
    "grab": adapt_grab,
    "noise": adapt_noise,
    "saccade": adapt_saccade,
    _CONSTRAINT: adapt_constraint,
    **dict.fromkeys(("animation", "states", "blend"), adapt_clip),
    "speech": _as_it_is,
}
