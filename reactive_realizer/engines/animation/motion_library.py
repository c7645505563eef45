"""From a behavior to the motions that could play it: the gesture binding, and who makes what it names."""

from collections.abc import Mapping

from lxml import etree

from reactive_realizer.binding.gesture_binding import GestureBinding, UnitSpec
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.behaviors import Head
from reactive_realizer.engines.animation.actor import Actor, Wanted
from reactive_realizer.engines.animation.choice import Choice
from reactive_realizer.engines.animation.gaze.gaze_maker import DYNAMIC
from reactive_realizer.engines.animation.makers import MAKERS
from reactive_realizer.engines.animation.motion_unit import MotionUnit
from reactive_realizer.errors import error


class MotionLibrary:
    """Makes motions for one character.

    Attributes:
        extensions: namespaced attributes that it understands.
    """

    extensions = frozenset({DYNAMIC})

    def __init__(self, binding: GestureBinding, actor: Actor) -> None:
        self._binding = binding
        self._makers = {unit: maker(actor) for unit, maker in MAKERS.items()}

    def choices(self, behavior: Behavior) -> tuple[Choice, ...]:
        """The motions that could play a behavior, the best first: one or more.

        Raises:
            RealizerError: no entry of the binding fits, a file is not usable, a target is not there.
        """
        attributes = _attributes(behavior)
        specs = self._binding.match(behavior.name, behavior.namespace, attributes)
        if not specs:
            raise error("no-motion-for", element=behavior.name, lexeme=attributes.get("lexeme", ""))
        return (self._choice(specs[0], behavior, attributes),)

    def _choice(self, spec: UnitSpec, behavior: Behavior, attributes: Mapping[str, str]) -> Choice:
        maker = self._makers.get(spec.unit)
        if maker is None:
            raise error("no-unit", unit=spec.unit)
        parameters = spec.parameters(attributes)
        # Nodding adds to whatever the head does.
        motion = maker(Wanted(behavior, parameters, spec.file, added=isinstance(behavior, Head)))
        group = parameters.get("replacementgroup")
        yields = group is not None or getattr(behavior, "persistent", False)
        return Choice(motion, _names(spec, motion), group, yields)


def _names(spec: UnitSpec, motion: MotionUnit) -> Mapping[str, str]:
    """The motion's parameters as BML calls them."""
    mapped = {own: name for name, own in spec.parameter_map.items()}
    return {mapped.get(own, own): own for own in motion.ranges}


def _attributes(behavior: Behavior) -> dict[str, str]:
    """As written, attributes of other namespaces as ``{uri}name``, and the core's defaults that bindings map."""
    written = {str(name): str(value) for name, value in etree.fromstring(behavior.source).attrib.items()}
    defaults = {"amount": getattr(behavior, "amount", None), "repetition": getattr(behavior, "repetition", None)}
    return {**{name: str(value) for name, value in defaults.items() if value is not None}, **written}
