"""A motion as a function of phase: what the animation engine plays between pegs (thesis 4.2)."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from enum import Enum
from math import inf
from operator import itemgetter
from types import MappingProxyType
from typing import NamedTuple, Protocol, Self

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.joints import LEFT_ARM, LOWER_BODY, RIGHT_ARM
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.moving import Moving
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.parameter import Range

GESTURE_POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
"""Sync points of gesture, head and pointing, in order (BML 1.0)."""

START_TO_END: Mapping[str, float] = MappingProxyType({"start": 0.0, "end": 1.0})
"""Key positions of a motion without other points."""

AMOUNT = "amount"
"""How much of a motion is shown, as BML calls it."""

AMOUNT_RANGE = Range(0.0, 1.0)

ANY_VALUE = Range(-inf, inf)
"""Of parameters whose meaning an animation's author knows."""

FILE, NAME, MIRROR, JOINTS = "file", "name", "mirror", "joints"
"""Parameters of what is made of a file: which file, or one of which name; whether left is to be right; to which joints
it is confined, as they are called in the mirror (thesis C.1.2, C.1.5)."""

OF_FILES = frozenset({FILE, NAME, MIRROR, JOINTS})


class Moment(NamedTuple):
    """When a motion is asked for its pose.

    Attributes:
        phase: how far the motion has come, 0 to 1.
        time: of the frame, s.
        body: as shown last, without additive motion.
        shown: as shown last, with it; None where nothing is shown, but asked what would be.
    """

    phase: float
    time: GlobalTime
    body: Body
    shown: Body | None = None


class Posed(NamedTuple):
    """What a motion asks for.

    Attributes:
        rotations: joint -> rotation local to the parent; of additive motions, the turn to be added.
        weight: how much of it is shown, 0 to 1: motions come and go by it, over whatever lies below them.
        root: how far HumanoidRoot is moved from its place in the default pose, m; None leaves it where it is.
        weights: of joints that come and go for themselves, the share of the weight; HumanoidRoot's is the root's too.
        fault: what it should do and cannot, though this is as near as it comes.
    """

    rotations: Mapping[str, Quat]
    weight: float = 1.0
    root: Vec3 | None = None
    weights: Mapping[str, float] | None = None
    fault: Fault | None = None


class Foreseen(Enum):
    """When it is known what a motion will show, as long as its plan stands."""

    NEVER = "never"
    ONCE_BEGUN = "once begun"
    """It depends on where the body is when it begins."""
    ALWAYS = "always"


class Gazing(Protocol):
    """What leads the eyes."""

    @property
    def eyes(self) -> float:
        """The part that the eyes go of the way to what is looked at, 0 to 1."""
        ...

    def point(self, eyes: Vec3) -> Vec3:
        """Where it looks from between the eyes, both in the figure's frame, m."""
        ...


class MotionUnit(ABC):
    """One motion of one character; a kind of motions is a subclass, and says what it has otherwise than here.

    Which phase it is when is not its business: phases are spread between key positions as their pegs say.

    Attributes:
        kind: where it lies among the layers of a frame.
        joints: the joints that it turns, while it plays.
        lacking: those that it was to turn, too, and cannot, of this figure or at all.
        resources: what of the body it owns while it plays (`Resource`); units that share one exclude each other.
        group: its replacement group, if it has one of its own: see `PlanUnit.group`.
        lasts: the name under which its last pose stays when it has ended, until another of that name has ended or
            everything is replaced; None for what goes when it ends.
        parameters: name -> value; a value may be changed while the motion plays.
        ranges: the parameters that may be changed, with the values that mean something.
        fixed: the names of the parameters that are read when it is made, and stay as they were said.
        key_positions: sync id -> phase, 0 to 1; "start" is 0 and "end" is 1, and later points never lie at earlier
            phases.
        exits: the sync ids of the points where it may well be left, in order.
        preferred_duration: how long it takes where nothing else is asked for, s.
        limits: shortest and longest duration, s, if its author named any; given up before any constraint is.
        foreseen: when it is known what it will show.
        entrance: how long it takes to come in if it joins late, s; None: it is there at once, or sees to that itself.
        joined: when it was started, s, if that was after its time: it is seen from then on; None if it was in time.
        led: whether it goes to where others go on, and is told of them (`lead`).
        fault: what is wrong with it though it plays on, None as long as nothing is.
    """

    kind: LayerKind
    joints: frozenset[str]
    lacking: frozenset[str] = frozenset()
    resources: frozenset[str] = frozenset()
    group: str | None = None
    lasts: str | None = None
    parameters: dict[str, float]
    ranges: Mapping[str, Range] = MappingProxyType({})
    fixed: frozenset[str] = frozenset()
    key_positions: Mapping[str, float] = START_TO_END
    exits: tuple[str, ...] = ()
    preferred_duration: float
    limits: tuple[float, float] | None = None
    foreseen: Foreseen = Foreseen.NEVER
    entrance: float | None = None
    joined: GlobalTime | None = None
    led: bool = False
    fault: Fault | None = None

    @property
    def known(self) -> frozenset[str]:
        """The names of all parameters that mean something to it."""
        return self.fixed.union(self.ranges)

    @abstractmethod
    def start(self, body: Body) -> None:
        """The motion begins from here: the body as shown last, without additive layers."""

    @abstractmethod
    def pose(self, moment: Moment) -> Posed:
        """What it asks for at a moment.

        Raises:
            RealizerError: "no-motion": there is none at this phase; the unit should be stopped.
        """

    def preparation(self, body: Body) -> float | None:
        """How long its first phase would take from where a body is, s; None where that makes no difference."""
        return None

    def another(self) -> Self:
        """The same once more, of one that has not begun: how long it would like to take need not be found out again."""
        motion = object.__new__(type(self))
        motion.__dict__.update(self.__dict__)  # as `copy` does, in a fifth of the time
        motion.parameters = dict(self.parameters)
        return motion

    def lead(self, begin: Moving, goal: Moving, duration: float) -> None:
        """Where to; only motions that are `led` are told.

        Args:
            begin: how the body moves at phase 0.
            goal: how it will move at phase 1.
            duration: s between the two.
        """
        raise NotImplementedError

    def gaze(self, phase: float) -> Gazing | None:
        """What leads the eyes at a phase, if it does."""
        return None

    def becomes_rest(self) -> bool:
        """It has ended, and stays: whether the figure rests so from now on, and nothing is to be shown for it."""
        return False


def layer_of(motion: MotionUnit, moment: Moment, priority: int = 0) -> Layer:
    """What a motion shows at a moment, as a layer of a frame.

    Raises:
        RealizerError: "no-motion", "bad-pose": nothing, or not what can be shown: the unit should be stopped.
    """
    posed = motion.pose(moment)
    return checked(Layer(motion.kind, posed.rotations, posed.weight, priority, posed.root, posed.weights))


class Resource:
    """What of a body has one owner at a time; an additive motion owns nothing."""

    LEFT_ARM = "left arm"
    RIGHT_ARM = "right arm"
    HEAD = "direction of the head"
    STANCE = "stance"


def arms_of(joints: frozenset[str]) -> frozenset[str]:
    """The arms, as resources, that a motion of these joints owns."""
    arms = ((LEFT_ARM, Resource.LEFT_ARM), (RIGHT_ARM, Resource.RIGHT_ARM))
    return frozenset(arm for its_joints, arm in arms if not its_joints.isdisjoint(joints))


def owned(joints: frozenset[str]) -> frozenset[str]:
    """What a motion of these joints owns: the arms, and with a leg or the root the stance."""
    return arms_of(joints) | (frozenset() if LOWER_BODY.isdisjoint(joints) else {Resource.STANCE})


def in_order(key_positions: Mapping[str, float]) -> dict[str, float]:
    """Key positions as authored, from start to end.

    None are added: points that nobody authored would be holds, which take what time there is.
    """
    inner = ((sync, phase) for sync, phase in key_positions.items() if sync not in START_TO_END)
    return {"start": 0.0, **dict(sorted(inner, key=itemgetter(1))), "end": 1.0}


def completed(key_positions: Mapping[str, float]) -> dict[str, float]:
    """Key positions with the seven points of a gesture, in order; those that the author left out coincide with others.

    ready = start, relax = end, strokeStart = ready, strokeEnd = relax, stroke = strokeStart. Other points stay.
    """
    keys = {"start": 0.0, "end": 1.0, **key_positions}
    ready = keys.get("ready", keys["start"])
    relax = keys.get("relax", keys["end"])
    stroke_start = keys.get("strokeStart", ready)
    filled = {
        "ready": ready,
        "strokeStart": stroke_start,
        "stroke": keys.get("stroke", stroke_start),
        "strokeEnd": keys.get("strokeEnd", relax),
        "relax": relax,
    }
    return dict(sorted({**keys, **filled}.items(), key=lambda item: (item[1], _rank(item[0]))))


def _rank(name: str) -> int:
    point = name.partition(":")[0]
    return GESTURE_POINTS.index(point) if point in GESTURE_POINTS else len(GESTURE_POINTS)
