"""The classes that published bindings name, and the units here that do their work."""

from collections.abc import Mapping
from types import MappingProxyType

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
"""Name of a class of AsapRealizer -> id of a unit."""

ASKED_OF_BEHAVIOR = frozenset({"target", "influence", "offsetangle", "offsetdirection"})
"""Parameters of these classes that bindings hand on to them; the units here ask the behavior itself."""


def unit_id(name: str) -> str:
    """The unit that a class or an id names; ids stand for themselves."""
    return CLASS_NAMES.get(name, name)
