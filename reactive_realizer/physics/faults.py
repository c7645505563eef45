"""Faults of controllers."""

from reactive_realizer.errors import CreationFault, PlayingFault


class UnknownController(CreationFault):
    """No controller has the name."""

    code = "unknown-controller"
    template = "there is no controller '{kind}'; available: {known}"
    unknown = "kind"
    kind: str
    known: tuple[str, ...]


class NoSegment(CreationFault):
    """A joint about which no segment of the physical body of a character turns."""

    code = "no-segment"
    template = "no segment of the physical body turns about {joint}; available: {known}"
    unknown = "joint"
    joint: str
    known: tuple[str, ...]


class MissingJoint(CreationFault):
    """A controller that does not say which joint it moves."""

    code = "missing-joint"
    template = "{kind} needs the parameter 'joint'"
    kind: str


class BadAxis(CreationFault):
    """An axis of a hinge that is none."""

    code = "bad-axis"
    template = "'{axis}' is not an axis: 0, 1 and 2 are x, y and z"
    axis: str


class NoLegs(CreationFault):
    """A figure that cannot balance, because it lacks joints."""

    code = "no-legs"
    template = "this character cannot balance: it lacks {joints}"
    joints: tuple[str, ...]


class SimulationFailed(PlayingFault):
    """A simulation that cannot go on: forces or gains are too great."""

    code = "simulation-failed"
    template = "the simulation of the body cannot go on; the body returns to its animation"
