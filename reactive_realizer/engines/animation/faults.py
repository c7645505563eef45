"""Faults of motions: bindings, targets, formulas, captures and poses."""

from reactive_realizer.errors import CreationFault, PlayingFault, TargetFault


class NoMotionFor(CreationFault):
    """A behavior that no entry of the binding matches."""

    code = "no-motion-for"
    template = "no entry of the binding plays <{element}>{condition}"
    unknown = "words"
    element: str
    condition: str
    words: tuple[str, ...] = ()
    known: tuple[str, ...] = ()


class BadMotion(CreationFault):
    """A motion of a plug-in that cannot be played."""

    code = "bad-motion"
    template = "the motion '{kind}' of a plug-in {reason}"
    kind: str
    reason: str


class NoUnit(CreationFault):
    """No kind of motion unit has the name."""

    code = "no-unit"
    template = "there is no motion unit '{unit}'"
    unit: str


class WrongElement(CreationFault):
    """A motion unit bound to an element that it cannot play."""

    code = "wrong-element"
    template = "the motion unit '{unit}' cannot play <{element}>"
    unit: str
    element: str


class NoFile(CreationFault):
    """A behavior without the file that it plays."""

    code = "no-file"
    template = "<{element}> needs a file, or the name of one"
    element: str


class NoPosture(CreationFault):
    """No pose has the lexeme."""

    code = "no-posture"
    template = "there is no {part} pose '{lexeme}' for {stance}; available: {known}"
    unknown = "lexeme"
    part: str
    lexeme: str
    stance: str
    known: tuple[str, ...]


class NoTransition(CreationFault):
    """No transition has the name."""

    code = "no-transition"
    template = "there is no transition '{kind}'; available: {known}"
    unknown = "kind"
    kind: str
    known: tuple[str, ...]


class NoTarget(TargetFault):
    """No target of the world has the name."""

    code = "no-target"
    template = "there is no target '{target}' in the world; available: {known}"
    unknown = "target"
    target: str
    known: tuple[str, ...]


class NoJoints(CreationFault):
    """Joints that a character does not have."""

    code = "no-joints"
    template = "this character lacks {joints}, which <{element}> needs"
    joints: tuple[str, ...]
    element: str


class NoneTurned(CreationFault):
    """An animation that moves none of the joints in use."""

    code = "none-turned"
    template = "{animation} turns none of {joints}; it turns {known}"
    animation: str
    joints: tuple[str, ...]
    known: str


class BadParameter(CreationFault):
    """A value that a parameter of a motion cannot have."""

    code = "bad-parameter"
    template = "the parameter {name} must be a number from {low:g} to {high:g}, not '{value}'"
    name: str
    value: str
    low: float
    high: float


class NoManner(CreationFault):
    """No manner of locomotion has the name."""

    code = "no-manner"
    template = "there is no manner '{manner}' of locomotion; available: {known}"
    unknown = "manner"
    manner: str
    known: tuple[str, ...]


class NotWalkable(TargetFault):
    """A target that a figure cannot walk to."""

    code = "not-walkable"
    template = "nobody can walk to '{target}': {reason}"
    target: str
    reason: str


class NotStanding(CreationFault):
    """A locomotion of a figure that does not stand."""

    code = "not-standing"
    template = "it cannot walk while {stance}; a postureShift to STANDING has to come first"
    stance: str


class PlaceNotReached(PlayingFault):
    """A locomotion that has to end before the figure has arrived; ``way`` in m."""

    code = "place-not-reached"
    template = "it has to end {way:.1f} m before its target, because no figure is as fast as that"
    way: float


class NotPointable(CreationFault):
    """A target that a hand cannot point at."""

    code = "not-pointable"
    template = "the {hand} hand cannot point at '{target}': {reason}"
    hand: str
    target: str
    reason: str


class TargetLost(PlayingFault):
    """A target that a hand can no longer point at."""

    code = "target-lost"
    template = "the {hand} hand can no longer follow '{target}' and stays where it is: {reason}"
    hand: str
    target: str
    reason: str


class NoSuchReach(CreationFault):
    """An unknown word for what a hand does at the target of a pointing."""

    code = "no-such-reach"
    template = "reach='{word}' of <pointing>: not one of {known}"
    unknown = "word"
    word: str
    known: tuple[str, ...]


class NotTouched(PlayingFault):
    """A target that a hand cannot touch, or no longer."""

    code = "not-touched"
    template = "the {hand} hand does not reach '{target}': {reason}"
    hand: str
    target: str
    reason: str


class EndsForBothHands(PlayingFault):
    """A hold of both hands of which one is released."""

    code = "ends-for-both-hands"
    template = (
        "{hold} holds on with both hands, so it ends for both; "
        "to release them one by one, hold on with each in a pointing of its own"
    )
    hold: str


class HandLate(PlayingFault):
    """A hand that is not where its gesture wants it at a sync point; ``distance`` is in cm."""

    code = "hand-late"
    template = (
        "at {point} the {hand} hand is {distance:.0f} cm away from where it should be, "
        "because its motions leave it too little time"
    )
    point: str
    hand: str
    distance: float


class GazeShort(PlayingFault):
    """A target beyond the range of the joints; ``angle`` is how far the gaze falls short, in degrees."""

    code = "gaze-short"
    template = (
        "the gaze stays {angle:.0f} degrees short of its target, which is beyond the reach of the joints that take part"
    )
    angle: float


class GazeNear(PlayingFault):
    """A target too close to the eyes."""

    code = "gaze-near"
    template = "the target is too close to look at, so the eyes look straight ahead"


class JointsLeftOut(PlayingFault):
    """Joints that a motion cannot turn."""

    code = "joints-left-out"
    template = "{joints} stay still: the motion of <{element}> does not turn them, or the character does not have them"
    joints: str
    element: str


class NoIdle(CreationFault):
    """A change of idle animation that a figure does not have."""

    code = "no-idle"
    template = "this character has no idle animation: the human file says so"


class TooMuchOfIdle(CreationFault):
    """A value of a parameter of idle animation that is above its limit."""

    code = "too-much-of-idle"
    template = "{parameter} is at most {most}, not {value}"
    compared = ("value", "most")
    parameter: str
    value: float
    most: float


class WeightOnNoFoot(CreationFault):
    """A shift of the weight of a figure that does not stand."""

    code = "weight-on-no-foot"
    template = "it has no weight on its feet to shift while {stance}; a postureShift to STANDING has to come first"
    stance: str


class NoGroup(CreationFault):
    """No body group has the name."""

    code = "no-group"
    template = "there is no body group '{group}'; available: {known}"
    unknown = "group"
    group: str
    known: tuple[str, ...]


class NoGroupJoints(CreationFault):
    """A goal of joints that a figure does not have."""

    code = "no-group-joints"
    template = "this character has none of the joints of {group}"
    group: str


class GoalOverruled(CreationFault):
    """A goal of a key pose beside others of its kind that count."""

    code = "goal-overruled"
    template = "this {goal} has no effect: {why}"
    goal: str
    why: str


class NotOfGroup(CreationFault):
    """A goal of a key pose that the joints of its group cannot have."""

    code = "not-of-group"
    template = "the joints of {group} have no {goal}; possible are {known}"
    goal: str
    group: str
    known: tuple[str, ...]


class NoDirection(CreationFault):
    """An orientation along a vector without length."""

    code = "no-direction"
    template = "a vector of length 0 has no direction"


class NoGoals(CreationFault):
    """Key poses of which no goal can be met."""

    code = "no-goals"
    template = "none of its goals can be met: {reasons}"
    reasons: tuple[str, ...]


class NotReachable(PlayingFault):
    """A joint that cannot reach a position; ``distance`` in m."""

    code = "not-reachable"
    template = "{joint} cannot reach its goal in {animation} at phase {phase:.2f}: it is {distance:.2f} m too far"
    joint: str
    animation: str
    phase: float
    distance: float


class NotTurned(PlayingFault):
    """A joint that cannot turn to a direction; ``angle`` in degrees."""

    code = "not-turned"
    template = (
        "{joint} cannot turn to its direction in {animation} at phase {phase:.2f}: it is {angle:.0f} degrees short"
    )
    joint: str
    animation: str
    phase: float
    angle: float


class NoMotion(PlayingFault):
    """A formula without a value."""

    code = "no-motion"
    template = "{animation} gives no pose at phase {phase:g}: {reason}"
    animation: str
    phase: float
    reason: str


class BadExpression(CreationFault):
    """A formula that cannot be read; ``at`` is a 1-based character."""

    code = "bad-expression"
    template = "{reason} at character {at} of '{expression}'"
    reason: str
    at: int
    expression: str


class BadCapture(CreationFault):
    """A file of a capture that cannot be used; ``row`` is its line."""

    code = "bad-capture"
    template = "{file}, line {row}: {reason}"
    file: str
    row: int
    reason: str


class BadBinaryMotion(CreationFault):
    """A motion in a binary format that cannot be used."""

    code = "bad-binary-motion"
    template = "{file}: {reason}"
    file: str
    reason: str


class BadKeys(CreationFault):
    """Keyframes that cannot be played."""

    code = "bad-keys"
    template = "{animation}: {reason}"
    animation: str
    reason: str
