"""Faults of engines and of what they play."""

from reactive_realizer.errors import Fault, PlayingFault, SchedulingFault, WarningType


class EngineFailed(PlayingFault):
    """An engine raised an exception."""

    code = "engine-failed"
    template = "the engine {engine} failed: {reason}"
    engine: str
    reason: str


class UnitFailed(PlayingFault):
    """A behavior raised an exception while it played."""

    code = "unit-failed"
    template = "it failed during playback: {reason}"
    reason: str


class ResourceTaken(SchedulingFault):
    """A behavior lost a joint, morph or replacement group to another one."""

    code = "resource-taken"
    template = "{behavior} is dropped: {resource} is in use by {other}"
    behavior: str
    other: str
    resource: str


class TwoPlugins(Fault):
    """Several plug-ins with the same name in one group."""

    code = "two-plugins"
    template = "'{name}' in the plug-in group {group} is defined more than once: {known}"
    name: str
    group: str
    known: tuple[str, ...]


class UnknownParameter(Fault):
    """Parameters that the player of a behavior does not have."""

    code = "unknown-parameter"
    template = "unknown parameter {names} of <{element}>; it has {known}"
    unknown = "names"
    warning = WarningType.CUSTOM_ATTRIBUTE_NOT_SUPPORTED
    names: tuple[str, ...]
    element: str
    known: tuple[str, ...]
