"""Checks of what engines return: plug-ins can return anything, and a type checker may not have seen them."""

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Final, TypeVar, cast, get_args

from reactive_realizer.embodiment.audio import AudioChange
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.humanoid import EyePose
from reactive_realizer.embodiment.picture import Picture
from reactive_realizer.embodiment.pose import Layer, LayerKind, check_rotations, checked
from reactive_realizer.engine.effects import (
    NO_EFFECTS,
    ActivateBlock,
    Dropped,
    EndUnit,
    InterruptBlock,
    MovePoints,
    Play,
    Reached,
    ReportFall,
    Request,
)
from reactive_realizer.engine.hearing import Drift
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.plan_unit import PlanUnit
from reactive_realizer.planunit.sync_point import SyncPoint

T = TypeVar("T")

_AUDIO: Final = get_args(AudioChange)
_REQUESTS: Final = get_args(Request)


def expected(kind: type[T] | tuple[type, ...], value: object) -> T:
    """A value, if it is of a kind.

    Raises:
        TypeError: it is not, or it is a text instead of a collection of texts.
    """
    if not isinstance(value, kind) or (isinstance(value, str) and kind is not str):
        raise TypeError(f"it returned {value!r}")
    return cast("T", value)


def number(value: object) -> float:
    """A finite number.

    Raises:
        TypeError: it is something else.
    """
    if not (isinstance(value, (float, int)) and isfinite(value)):
        raise TypeError(f"it returned {value!r} for a time")
    return value


def check_play(play: Play) -> Play:
    """Effects that can be applied.

    Raises:
        TypeError: they cannot.
    """
    if play is NO_EFFECTS:
        return play
    expected(Play, play)
    for effects in (play.reached, play.dropped, play.audio, play.requests):
        if type(effects) is not tuple:  # which nearly all are
            expected((tuple, list), effects)
    for reached in play.reached:
        if type(reached) is Reached and type(reached.point) is SyncPoint and _plays(reached.unit, reached.time):
            continue  # as nearly all are
        expected(SyncPoint, expected(Reached, reached).point)
        expected(PlanUnit, reached.unit)
        number(reached.time)
    for dropped in play.dropped:
        expected(PlanUnit, expected(Dropped, dropped).unit)
        expected(Fault, dropped.fault)
    for change in play.audio:
        expected(_AUDIO, change)
    for request in play.requests:
        expected(_REQUESTS, request)
        expected(PlanUnit, request.unit)
        if isinstance(request, ActivateBlock | InterruptBlock | EndUnit | MovePoints | ReportFall):
            number(request.time)
    return play


def _plays(unit: object, time: object) -> bool:
    return isinstance(unit, PlanUnit) and type(time) is float and isfinite(time)


def check_weights(weights: Mapping[str, float]) -> None:
    """Check the weights of morphs.

    Raises:
        TypeError, ValueError: they are not finite numbers by name.
    """
    if type(weights) is not dict:  # which nearly all are
        expected(Mapping, weights)
    if not isfinite(sum(weights.values())):
        raise ValueError("a weight of its face is not a finite number")


def check_pictures(pictures: Sequence[Picture]) -> None:
    """Check pictures.

    Raises:
        TypeError: they are not names of files on layers.
    """
    if type(pictures) is not tuple:  # which nearly all are
        expected((tuple, list), pictures)
    for picture in pictures:
        layer, file = expected(Picture, picture)
        expected((float, int), layer)
        expected(str, file)


def check_eyes(pose: EyePose) -> EyePose:
    """A pose of the eyes that can be shown.

    Raises:
        RealizerError, TypeError, ValueError: it cannot.
    """
    check_rotations(expected(EyePose, pose).turns)
    check_weights(pose.lids)
    check_weights(pose.blink)
    return pose


def check_body(body: Body, before: Body) -> Body:
    """A body that can be shown.

    Args:
        body: made from another one.
        before: this other one, which can be shown: only what differs is checked.

    Raises:
        RealizerError, TypeError, ValueError: it cannot.
    """
    turned = {joint: turn for joint, turn in expected(Body, body).pose.items() if before.pose.get(joint) is not turn}
    checked(Layer(LayerKind.BASE, turned, root=body.root))
    return body


def check_drift(drift: Drift | None) -> Drift | None:
    """A drift that can be made up for, or None.

    Raises:
        TypeError: it is something else.
    """
    if drift is not None:
        number(expected(Drift, drift).seconds)
    return drift
