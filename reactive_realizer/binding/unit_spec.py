"""An entry of a gesture binding: the behaviors that it matches, and the unit that plays them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from types import MappingProxyType

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior, ForeignBehavior
from reactive_realizer.bml.behaviors import Posture

_NONE: Mapping[str, str] = MappingProxyType({})

_LONGEST_KEPT = 100
"""Characters of the longest values that are remembered; a client may send longer ones."""


@dataclass(frozen=True, slots=True, eq=False)
class UnitSpec:
    """Which behaviors an entry applies to, and which unit plays them (thesis 8.7.3, fig. 8.11).

    Attributes:
        behavior: name of the behavior element, such as "gesture".
        namespace: of that element.
        constraints: attribute -> required value; an attribute of another namespace is written `{uri}name`.
        unit: kind of unit: ProcAnimation (plays a file as it is), Gesture (adds preparation and retraction to a file),
            or another kind that the engine knows.
        file: of the unit; None if it needs none, or if the behavior names it.
        parameter_map: attribute of the behavior -> parameter of the unit.
        defaults: parameter of the unit -> value if the behavior does not set it.
        location: file and line of the entry, for messages.
        normalized_constraints: the constraints, `normalized`.
    """

    behavior: str
    namespace: str
    constraints: Mapping[str, str]
    unit: str
    file: str | None
    parameter_map: Mapping[str, str]
    defaults: Mapping[str, str]
    location: str
    normalized_constraints: Mapping[str, str] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "normalized_constraints", normalized(self.constraints))

    def fits(self, attributes: Mapping[str, str], ignoring: str | None = None) -> bool:
        """Return whether a behavior meets every constraint.

        Args:
            attributes: `normalized` attributes of the behavior.
            ignoring: an attribute whose constraint is ignored.
        """
        required = {name: value for name, value in self.normalized_constraints.items() if name != ignoring}
        return required.items() <= attributes.items()

    def parameters(self, attributes: Mapping[str, str], own: Mapping[str, str] = _NONE) -> dict[str, str]:
        """Return the parameters of the unit for a behavior; the defaults apply where the behavior sets none.

        Args:
            attributes: of the behavior (`behavior_attributes`).
            own: parameters that the behavior sets by the names of the unit.
        """
        mapped = {to: attributes[name] for name, to in self.parameter_map.items() if name in attributes}
        return {**self.defaults, **own, **mapped}


def normalized(attributes: Mapping[str, str]) -> dict[str, str]:
    """Return attributes with values in a form that compares equal across case, and across "_" and "-"."""
    return {
        name: _word(value) if len(value) <= _LONGEST_KEPT else _word.__wrapped__(value)
        for name, value in attributes.items()
    }


@lru_cache
def _word(text: str) -> str:
    return text.strip().casefold().replace("_", "-")


def behavior_attributes(behavior: Behavior) -> dict[str, str]:
    """Return the attributes of a behavior by which bindings match.

    These are the attributes of its element, defaults included, in the spelling of BML 1.0 for every dialect, and for an
    element of another namespace as they are written; attributes of other namespaces as ``{uri}name``; its
    ``bmlt:parameter`` children, which override attributes of the same name; and the stance of a posture.
    """
    values = {each.name: getattr(behavior, each.field) for each in attributes_of(type(behavior))}
    if isinstance(behavior, Posture):
        values["stance"] = behavior.stance
    own = {name: _text(value) for name, value in values.items() if value is not None}
    foreign = {f"{{{namespace}}}{name}": value for (namespace, name), value in behavior.extensions.items()}
    if isinstance(behavior, ForeignBehavior):
        own |= behavior.attributes
    return {**own, **foreign, **behavior.parameters}


def _text(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


_ANIMATION = "asap.animationengine"

CLASS_NAMES: Mapping[str, str] = MappingProxyType(
    {
        f"{_ANIMATION}.gaze.TweedGazeMU": "gaze",
        f"{_ANIMATION}.gaze.DynamicGazeMU": "dynamic-gaze",
        f"{_ANIMATION}.gaze.EyeGazeMU": "eye-gaze",
        f"{_ANIMATION}.gaze.DynamicRestGaze": "rest-gaze",
        f"{_ANIMATION}.gaze.ForwardRestGaze": "rest-gaze",
        f"{_ANIMATION}.pointing.PointingMU": "pointing",
        f"{_ANIMATION}.pointing.DynamicPointingMU": "pointing",
        f"{_ANIMATION}.noise.PerlinNoiseMU": "noise",
        f"{_ANIMATION}.noise.AdditivePerlinNoiseMU": "noise",
        f"{_ANIMATION}.transitions.SlerpTransitionToPoseMU": "transition",
        f"{_ANIMATION}.transitions.TransitionMU": "transition",
        f"{_ANIMATION}.procanimation.ProcAnimationGestureMU": "Gesture",
        f"{_ANIMATION}.procanimation.ProcAnimationMU": "ProcAnimation",
    }
)
"""AsapRealizer class name -> unit id."""

ASKED_OF_BEHAVIOR = frozenset({"target", "influence", "offsetangle", "offsetdirection"})
"""Parameters that published bindings pass to these classes. Units here read them from the behavior instead."""


def unit_id(name: str) -> str:
    """Return the id of the unit that a class name or a unit id refers to."""
    return CLASS_NAMES.get(name, name)
