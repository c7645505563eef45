"""The closed vocabularies of BML 1.0 and of continuous interaction; a value is the spelling of its word in BML."""

from enum import StrEnum


class Composition(StrEnum):
    """The relation of a block to earlier ones: it starts at once, after all of them, or in their place."""

    MERGE = "MERGE"
    APPEND = "APPEND"
    REPLACE = "REPLACE"


class Mode(StrEnum):
    """The hands of a gesture."""

    LEFT_HAND = "LEFT_HAND"
    RIGHT_HAND = "RIGHT_HAND"
    BOTH_HANDS = "BOTH_HANDS"


class Reach(StrEnum):
    """What a hand does that goes to the target of a pointing."""

    TOUCH = "TOUCH"
    """Its fingertips stay at the target."""
    TAKE = "TAKE"
    """The target follows the hand from ready on."""
    PUT = "PUT"
    """What follows the hand stays at the target, which is a place, from ready on."""
    HOLD = "HOLD"
    """As TOUCH, and without a tied end, until the hand is released or used by another behavior."""


class Influence(StrEnum):
    """The part of the body that follows a gaze; each includes the ones before it."""

    EYES = "EYES"
    HEAD = "HEAD"
    SHOULDER = "SHOULDER"
    WAIST = "WAIST"
    WHOLE = "WHOLE"


class OffsetDirection(StrEnum):
    """The side of its target to which a gaze is offset, as seen by the character."""

    RIGHT = "RIGHT"
    LEFT = "LEFT"
    UP = "UP"
    DOWN = "DOWN"
    UPRIGHT = "UPRIGHT"
    UPLEFT = "UPLEFT"
    DOWNLEFT = "DOWNLEFT"
    DOWNRIGHT = "DOWNRIGHT"


class InterruptSpeech(StrEnum):
    """The point at which an interrupted speech ends: immediately, or before its next word or clause."""

    NOW = "now"
    WORD = "word"
    CLAUSE = "clause"


class Side(StrEnum):
    """The half of the face that an action unit moves."""

    LEFT = "LEFT"
    RIGHT = "RIGHT"
    BOTH = "BOTH"


class StanceType(StrEnum):
    """The global body position."""

    SITTING = "SITTING"
    CROUCHING = "CROUCHING"
    STANDING = "STANDING"
    LYING = "LYING"


class PosePart(StrEnum):
    """The part of the body of a pose."""

    ARMS = "ARMS"
    LEFT_ARM = "LEFT_ARM"
    RIGHT_ARM = "RIGHT_ARM"
    LEGS = "LEGS"
    LEFT_LEG = "LEFT_LEG"
    RIGHT_LEG = "RIGHT_LEG"
    HEAD = "HEAD"
    WHOLEBODY = "WHOLEBODY"


class BodyGroup(StrEnum):
    """The part of the body that a sequence of key poses moves. HEAD_NECK and HEAD_... include the ones before them."""

    LEFT_ARM = "LEFT_ARM"
    RIGHT_ARM = "RIGHT_ARM"
    LEFT_HAND = "LEFT_HAND"
    RIGHT_HAND = "RIGHT_HAND"
    HEAD = "HEAD"
    HEAD_NECK = "HEAD_NECK"
    HEAD_CHEST = "HEAD_CHEST"
    HEAD_BACK = "HEAD_BACK"
    TRUNK = "TRUNK"
    SHOULDERS = "SHOULDERS"
    EYES = "EYES"
    LEFT_EYE = "LEFT_EYE"
    RIGHT_EYE = "RIGHT_EYE"
    WHOLEBODY = "WHOLEBODY"


class BodyAxis(StrEnum):
    """An axis of a part of the body, for its orientation."""

    PALM = "PALM"
    """Out of the palm."""
    FINGERS = "FINGERS"
    """From the wrist along the hand."""
    THUMB = "THUMB"
    """To the side of the thumb."""
    FACE = "FACE"
    """Out of the face."""
    CROWN = "CROWN"
    """Out of the top of the head."""
    LEFT_EAR = "LEFT_EAR"
    """Out of the left ear."""
    SIGHT = "SIGHT"
    """Out of the eyes, where they look."""
    CHEST = "CHEST"
    """Out of the chest."""
    SPINE = "SPINE"
    """Up along the spine."""
    LEFT_SIDE = "LEFT_SIDE"
    """Out of the left side of the trunk."""
    SHOULDER = "SHOULDER"
    """From the breastbone along the collarbone to the shoulder."""


class WarpKind(StrEnum):
    """A family of time warps."""

    TAN = "TAN"
    EXP = "EXP"


class FacePart(StrEnum):
    """What a keyframe animation of the face moves: morph targets, action units, or facial animation parameters."""

    MORPH = "MORPH"
    FACS = "FACS"
    FAPS = "FAPS"
