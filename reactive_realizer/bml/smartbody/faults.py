"""Faults of what SmartBody writes, and cannot be played as it says."""

from reactive_realizer.errors import Fault, ParsingFault, WarningType


class NoCounterpart(Fault):
    """Attributes of SmartBody that nothing here corresponds to."""

    code = "no-counterpart"
    template = "{attributes} of SmartBody has no effect on <{element}> here"
    warning = WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED
    element: str
    attributes: tuple[str, ...]


class FadeTooLong(Fault):
    """A time of SmartBody in which a behavior fades out, in s, that is longer than the behavior."""

    code = "fade-too-long"
    template = "sbm:{attribute}='{fade:g}' has no effect: this <{element}> would fade out before it starts"
    warning = WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED
    element: str
    attribute: str
    fade: float


class PlaysOver(Fault):
    """A blend of SmartBody that changes the mixture of the one that plays."""

    code = "plays-over"
    template = (
        "mode='update' names no behavior that it changes, so this blend plays over the one that plays; "
        "a parametervaluechange changes that one"
    )
    warning = WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED


class NoOrientation(ParsingFault):
    """A movement of the head of SmartBody that is to turn it to a target, and has none."""

    code = "no-orientation"
    template = "<head type='ORIENT'> requires a target to which the head turns; SmartBody leaves it out too"


class LeftToPlugins(Fault):
    """A constraint of SmartBody that only an engine of a plug-in could play."""

    code = "left-to-plugins"
    template = (
        "a constraint of the {quantity} of {effector} is left to plug-ins: "
        "here, constraints are of the place of a wrist, hand or finger, such as r_wrist"
    )
    warning = WarningType.CUSTOM_BEHAVIOUR_NOT_SUPPORTED
    quantity: str
    effector: str
