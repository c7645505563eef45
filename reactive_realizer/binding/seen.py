"""What a binding sees of a behavior."""

from reactive_realizer.bml.attributes import attributes_of
from reactive_realizer.bml.behavior import Behavior
from reactive_realizer.bml.posture import Posture


def seen(behavior: Behavior) -> dict[str, str]:
    """Its attributes, as bindings name them.

    These are the attributes of its element, defaults among them, in the spelling of BML 1.0 whatever dialect it was
    written in; attributes of other namespaces as ``{uri}name``; its ``bmlt:parameter`` children; and the stance of a
    posture. A parameter of the name of an attribute stands in its place.
    """
    values = {each.name: getattr(behavior, each.field) for each in attributes_of(type(behavior))}
    if isinstance(behavior, Posture):
        values["stance"] = behavior.stance
    own = {name: _text(value) for name, value in values.items() if value is not None}
    foreign = {f"{{{namespace}}}{name}": value for (namespace, name), value in behavior.extensions.items()}
    return {**own, **foreign, **behavior.parameters}


def _text(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
