"""The closed vocabularies of BML 1.0 and of continuous interaction; a word's value is its spelling there."""

from enum import StrEnum


class Composition(StrEnum):
    """How a block joins the earlier ones: at once, after all of them, or in their place."""

    MERGE = "MERGE"
    APPEND = "APPEND"
    REPLACE = "REPLACE"


class Mode(StrEnum):
    """The hands of a gesture."""

    LEFT_HAND = "LEFT_HAND"
    RIGHT_HAND = "RIGHT_HAND"
    BOTH_HANDS = "BOTH_HANDS"


class Influence(StrEnum):
    """How much of the body follows a gaze; each includes the ones before it."""

    EYES = "EYES"
    HEAD = "HEAD"
    SHOULDER = "SHOULDER"
    WAIST = "WAIST"
    WHOLE = "WHOLE"


class OffsetDirection(StrEnum):
    """To which side of its target a gaze is turned, seen by the one who gazes."""

    RIGHT = "RIGHT"
    LEFT = "LEFT"
    UP = "UP"
    DOWN = "DOWN"
    UPRIGHT = "UPRIGHT"
    UPLEFT = "UPLEFT"
    DOWNLEFT = "DOWNLEFT"
    DOWNRIGHT = "DOWNRIGHT"


class InterruptSpeech(StrEnum):
    """Where a speech that is interrupted ends: at once, or before its next word."""

    NOW = "now"
    WORD = "word"


class Side(StrEnum):
    """Which half of the face an action unit moves."""

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
    """The part of the body that a pose is about."""

    ARMS = "ARMS"
    LEFT_ARM = "LEFT_ARM"
    RIGHT_ARM = "RIGHT_ARM"
    LEGS = "LEGS"
    LEFT_LEG = "LEFT_LEG"
    RIGHT_LEG = "RIGHT_LEG"
    HEAD = "HEAD"
    WHOLEBODY = "WHOLEBODY"
