"""Reads autonomous behaviors: changes of idle animation, and movements that a key pose triggers."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, Final, NamedTuple

from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import FaceLexeme, Gesture
from reactive_realizer.bml.embr.faults import Limited
from reactive_realizer.bml.embr.syntax import Node
from reactive_realizer.bml.embr.timeline import Timed
from reactive_realizer.bml.embr.values import Notes
from reactive_realizer.bml.idle_change import MOSTS, IdleChange, IdleParameter
from reactive_realizer.bml.weight_shift import WeightShift
from reactive_realizer.errors import quoted

_MS_PER_MINUTE: Final = 60_000.0


class Autonomous(NamedTuple):
    """An autonomous behavior of a key pose.

    Attributes:
        key: as written.
        node: its element.
        kind: of the behavior that it is read as.
        element: name of that.
        points: sync id -> time, s after the start of the sequence.
        values: attributes.
    """

    key: str
    node: Node
    kind: type[Behavior]
    element: str
    points: Mapping[str, float]
    values: Mapping[str, Any]


class _Parameter(NamedTuple):
    """A parameter of autonomous behavior.

    Attributes:
        parameter: of idle animation.
        factor: from its value in a script to that of the parameter.
    """

    parameter: IdleParameter
    factor: float

    @property
    def most(self) -> float:
        """Its largest value in a script."""
        return MOSTS[self.parameter] / self.factor


_PARAMETERS: Final[Mapping[str, _Parameter]] = MappingProxyType(
    {
        "breathingFrequency": _Parameter(IdleParameter.BREATHING_RATE, 60.0),
        "breathingAmplitude": _Parameter(IdleParameter.BREATHING_DEPTH, 10.0),
        "blinkIntensity": _Parameter(IdleParameter.BLINK_DEPTH, 1.0),
        "weightShiftFrequency": _Parameter(IdleParameter.WEIGHT_SHIFT_RATE, 60.0),
        "weightShiftAmplitude": _Parameter(IdleParameter.WEIGHT_SHIFT_DEPTH, 1.0),
    }
)
"""Breaths and weight shifts per second; depths, 0.1 at rest of breaths as in EMBR, and 1 of blinks and shifts."""

_BLINKS: Final = "blinkProbability"
"""Not a probability in EMBR, but the time between blinks, ms."""


class _Trigger(NamedTuple):
    """A movement that a key pose triggers.

    Attributes:
        kind: of its behavior.
        element: name of that.
        point: sync point that is at the pose; None if the way to the pose is the whole behavior.
        least: smallest value; the largest is 1.
        values: returns the attributes for a value.
    """

    kind: type[Behavior]
    element: str
    point: str | None
    least: float
    values: Callable[[float], dict[str, Any]]


def _deep(value: float) -> dict[str, Any]:
    return {"lexeme": "BREATHE", "parameters": MappingProxyType({"amount": f"{value:g}"})}


_TRIGGERS: Final[Mapping[str, _Trigger]] = MappingProxyType(
    {
        "blinking": _Trigger(
            FaceLexeme, "faceLexeme", "start", 0.0, lambda value: {"lexeme": "BLINK", "amount": value}
        ),
        "breathing": _Trigger(Gesture, "gesture", "stroke", 0.0, _deep),
        "weightShift": _Trigger(WeightShift, "weightShift", None, -1.0, lambda value: {"side": value}),
    }
)

PARAMETER_KEYS: Final = (*_PARAMETERS, _BLINKS)
"""The keys that change parameters."""
TRIGGER_KEYS: Final = tuple(_TRIGGERS)
"""The keys that trigger a movement."""

_WITHOUT_EFFECT: Final[Mapping[str, str]] = MappingProxyType(
    {
        "FEEDBACK_ID": "the start and the end of its behavior are reported",
        "TIME_WARP": "its value changes evenly",
    }
)


def read_autonomous(at: Timed, node: Node, notes: Notes) -> Autonomous | None:
    """The behavior of an element; None if its key is not known, which is noted.

    Raises:
        RealizerError: a parameter is missing or bad.
    """
    key = notes.text(node, "BEHAVIOR_KEY")
    trigger = _TRIGGERS.get(key)
    if trigger is not None:
        value = notes.number(node, "BEHAVIOR_VALUE", low=trigger.least, high=1.0)
        points = _way(at) if trigger.point is None else {trigger.point: at.reached}
        found = Autonomous(key, node, trigger.kind, trigger.element, points, trigger.values(value))
    elif key in PARAMETER_KEYS:
        parameter, amount = _change(key, notes.number(node, "BEHAVIOR_VALUE", low=0.0), node, notes)
        values = {"parameter": parameter, "value": round(amount, 4)}
        found = Autonomous(key, node, IdleChange, "idleChange", _way(at), values)
    else:
        reason = f"known are {', '.join((*PARAMETER_KEYS, *_TRIGGERS))}"
        notes.left_out(f"AUTONOMOUS_BEHAVIOR {quoted(key)}", reason, node.location)
        return None
    for name, reason in _WITHOUT_EFFECT.items():
        if name in node.values:
            notes.left_out(f"{name} of AUTONOMOUS_BEHAVIOR", reason, node.values[name].location)
    return found


def _way(at: Timed) -> dict[str, float]:
    return {"start": at.begins, "end": at.reached}


def _change(key: str, value: float, node: Node, notes: Notes) -> tuple[IdleParameter, float]:
    """The parameter of a key, and its value; one beyond the limit has a fault, and becomes the limit."""
    place = node.values["BEHAVIOR_VALUE"].location
    if key == _BLINKS:
        parameter = IdleParameter.BLINK_RATE
        least = _MS_PER_MINUTE / MOSTS[parameter]
        if 0.0 < value < least:
            notes.add(Limited(key=key, value=value, bound=f"at least {least:g}"), place)
        return parameter, _MS_PER_MINUTE / max(value, least) if value > 0.0 else 0.0
    (parameter, factor), most = _PARAMETERS[key], _PARAMETERS[key].most
    if value > most:
        notes.add(Limited(key=key, value=value, bound=f"at most {most:g}"), place)
    return parameter, factor * min(value, most)
