"""A motion as a function of phase, which the animation engine plays between pegs (thesis 4.2)."""

from abc import ABC, abstractmethod
from collections.abc import Collection, Hashable, Mapping
from enum import Enum
from math import inf
from operator import itemgetter
from types import MappingProxyType
from typing import NamedTuple, Protocol, Self

from reactive_realizer.bml.expressivity import MOST
from reactive_realizer.bml.expressivity import NAMES as EXPRESSIVITY_NAMES
from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.inertialization import CARRIED
from reactive_realizer.embodiment.joints import LEFT_ARM, LOWER_BODY, RIGHT_ARM
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.spine_ik import HandGoal
from reactive_realizer.errors import Fault
from reactive_realizer.planunit.parameter import Range

GESTURE_POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
"""Sync points of gesture, head and pointing, in order (BML 1.0)."""

START_TO_END: Mapping[str, float] = MappingProxyType({"start": 0.0, "end": 1.0})
"""Key positions of a motion without inner points."""

AMOUNT = "amount"
"""Parameter that scales a motion, as BML calls it."""

AMOUNT_RANGE = Range(0.0, 1.0)

EXPRESSIVITY_RANGES: Mapping[str, Range] = MappingProxyType(dict.fromkeys(EXPRESSIVITY_NAMES, Range(-MOST, MOST)))
"""Valid values of the parameters of expressivity."""

ANY_VALUE = Range(-inf, inf)
"""Range of parameters that an animation's author defines."""

FILE, NAME, MIRROR, JOINTS = "file", "name", "mirror", "joints"
"""Parameters of motions from files: the file or its name; whether left and right are exchanged; the joints to which the
motion is restricted, by their names after mirroring (thesis C.1.2, C.1.5)."""

FILE_PARAMETERS = frozenset({FILE, NAME, MIRROR, JOINTS})


class Moment(NamedTuple):
    """The moment at which a motion is sampled.

    Attributes:
        phase: progress of the motion, 0 to 1.
        time: of the frame, s.
        body: as shown last, without additive motion.
        shown: as shown last, with additive motion; None if the motion is sampled for a prediction and not shown.
    """

    phase: float
    time: GlobalTime
    body: Body
    shown: Body | None = None


class PhaseDuration(NamedTuple):
    """The duration of a phase of a motion, s.

    Attributes:
        preferred: not less than the shortest.
        shortest: that the limits of the body allow.
    """

    preferred: float
    shortest: float = 0.0


class MotionPose(NamedTuple):
    """The pose that a motion requests.

    Attributes:
        rotations: joint -> rotation local to the parent; for additive motions, the turn to be added.
        weight: 0 to 1; motions come and go over the layers below by their weight.
        root: displacement of HumanoidRoot from its position in the default pose, m; None leaves it.
        weights: joint -> factor of the weight, for joints that come and go separately; HumanoidRoot's also applies to
            `root`.
        fault: a goal that the motion misses, though this pose is as near as possible.
    """

    rotations: Mapping[str, Quat]
    weight: float = 1.0
    root: Vec3 | None = None
    weights: Mapping[str, float] | None = None
    fault: Fault | None = None


class Predictability(Enum):
    """Whether and when the poses of a motion can be predicted, as long as its plan does not change."""

    NEVER = "never"
    ONCE_STARTED = "once begun"
    """They depend on the body at the start."""
    ALWAYS = "always"


class GazeGoal(Protocol):
    """Directs the eyes."""

    @property
    def eyes(self) -> float:
        """Share by which the eyes turn to the target, 0 to 1."""
        ...

    @property
    def directed(self) -> Collection[str]:
        """Joints of the eyes that it directs."""
        ...

    def point(self, eyes: Vec3) -> Vec3:
        """Return the point to look at from the midpoint between the eyes, both in the figure's frame, m."""
        ...


class MotionUnit(ABC):
    """One motion of one character. Each kind of motion is a subclass, which overrides what differs from the defaults.

    A motion does not know when it has which phase: pegs distribute the phases between its key positions.

    Attributes:
        kind: of its layer.
        joints: that it turns.
        lacking: joints that it should turn, but cannot, of this figure or at all.
        resources: parts of the body that it owns while it plays (`Resource`); units that share one exclude each other.
        group: its own replacement group, if any (`PlanUnit.group`).
        persists_as: name under which its last pose stays after its end, until another motion with that name has ended
            or everything is replaced; None for a motion that goes at its end.
        parameters: name -> value; may change while the motion plays.
        ranges: parameter that may change -> valid values.
        fixed: names of parameters that are read only when the motion is made.
        key_positions: sync id -> phase, 0 to 1; "start" is 0 and "end" is 1, and phases never decrease.
        exits: sync ids of points at which it may be left gracefully, in order.
        preferred_duration: s.
        shortest: sync id -> shortest duration of the phase that ends there, s, where the limits of the body matter.
        retraction: shortest duration of the way back from relax to end, s; it may be cut short.
        stretch: the least and the greatest stretch of each phase that its author allows, if there are such limits; they
            are relaxed before any constraint.
        authored: the points between which they apply.
        predictability: when its poses can be predicted.
        entrance: time in which the joints go over to it at its start, s.
        fade_in: duration of its fade-in if it joins late, s; None if it appears at once.
        joined: time at which it joined late, s; None if it started in time.
        hands: where it brings wrists, as last shown; the trunk leans where their arms do not reach.
        jumped: whether its goal jumped in the last pose, for a reason of its own.
        steps: whether the feet may turn the figure for it (`step_turn`).
        fault: that occurred while playing; None if there is none.
        notes: faults of parts that are left out.
        planning_work: what it takes to make it (`PlanUnit.planning_work`).
        origin: what takes further work only the first time that something is planned from it; None if nothing does.
        first_work: this further work.
    """

    kind: LayerKind
    joints: frozenset[str]
    lacking: frozenset[str] = frozenset()
    resources: frozenset[str] = frozenset()
    group: str | None = None
    persists_as: str | None = None
    parameters: Mapping[str, float]
    ranges: Mapping[str, Range] = MappingProxyType({})
    fixed: frozenset[str] = frozenset()
    key_positions: Mapping[str, float] = START_TO_END
    exits: tuple[str, ...] = ()
    preferred_duration: float
    shortest: Mapping[str, float] = MappingProxyType({})
    retraction: float = 0.0
    stretch: tuple[float, float] | None = None
    authored: tuple[str, str] = ("start", "end")
    predictability: Predictability = Predictability.NEVER
    entrance: float = CARRIED
    fade_in: float | None = None
    hands: tuple[HandGoal, ...] = ()
    jumped: bool = False
    steps: bool = False
    joined: GlobalTime | None = None
    fault: Fault | None = None
    notes: tuple[Fault, ...] = ()
    planning_work: int = 16
    origin: Hashable = None
    first_work: int = 0

    @property
    def parameter_names(self) -> frozenset[str]:
        """Names of all parameters that have an effect."""
        return self.fixed.union(self.ranges)

    @abstractmethod
    def start(self, body: Body) -> None:
        """Start from a body: the one shown last, without additive layers."""

    @abstractmethod
    def pose(self, moment: Moment) -> MotionPose:
        """Return the pose at a moment.

        Raises:
            RealizerError: "no-motion": there is no pose at this phase; the unit should be stopped.
        """

    def preparation(self, body: Body) -> PhaseDuration | None:
        """Return the duration of the first phase from a body; None if it does not depend on the body."""
        return None

    def slowed(self, before: float, after: float) -> Mapping[str, float]:
        """Return by how much phases are longer with another temporal extent, by the point at which each ends.

        Args:
            before: temporal extent, -1 to 1 (`Expressivity`).
            after: another one.

        Returns:
            Factors; phases without one stay as they are.
        """
        return {}

    def copy(self) -> Self:
        """Return a copy of a motion that has not started. This avoids computing its durations again."""
        motion = object.__new__(type(self))
        motion.__dict__.update(self.__dict__)  # five times as fast as copy.copy
        motion.parameters = dict(self.parameters)
        return motion

    def gaze(self, phase: float) -> GazeGoal | None:
        """Return what directs the eyes at a phase; None if the motion does not."""
        return None

    def glance(self, phase: float) -> Quat | None:
        """Return by how much it turns the eyes from where they look, in the axes of the head; None if it does not."""
        return None

    def step_turn(self, phase: float) -> float | None:
        """Return how far the feet are to turn the figure now, so that the joints reach a target, rad to the left.

        Returns:
            0 where the joints reach it; None without such a target at this phase.
        """
        return None

    def becomes_rest(self) -> bool:
        """Return whether a motion that has ended becomes the rest posture, so that nothing persists as a layer."""
        return False


def layer_of(motion: MotionUnit, moment: Moment, priority: int = 0) -> Layer:
    """Return the layer of a motion at a moment.

    Raises:
        RealizerError: "no-motion", "bad-pose": there is no layer, or an invalid one; the unit should be stopped.
    """
    posed = motion.pose(moment)
    return checked(Layer(motion.kind, posed.rotations, posed.weight, priority, posed.root, posed.weights))


class Resource:
    """Parts of a body with one owner at a time; additive motions own nothing."""

    LEFT_ARM = "left arm"
    RIGHT_ARM = "right arm"
    HEAD = "direction of the head"
    STANCE = "stance"


def arms_used(joints: frozenset[str]) -> frozenset[str]:
    """Return the arms, as resources, that a motion of these joints owns."""
    arms = ((LEFT_ARM, Resource.LEFT_ARM), (RIGHT_ARM, Resource.RIGHT_ARM))
    return frozenset(arm for its_joints, arm in arms if not its_joints.isdisjoint(joints))


def resources_used(joints: frozenset[str]) -> frozenset[str]:
    """Return the resources that a motion of these joints owns: the arms, and the stance for legs and root."""
    return arms_used(joints) | (frozenset() if LOWER_BODY.isdisjoint(joints) else {Resource.STANCE})


def ordered(key_positions: Mapping[str, float]) -> dict[str, float]:
    """Return authored key positions in order, with start and end.

    No points are added: points that were not authored would become holds, which absorb time.
    """
    inner = ((sync, phase) for sync, phase in key_positions.items() if sync not in START_TO_END)
    return {"start": 0.0, **dict(sorted(inner, key=itemgetter(1))), "end": 1.0}


def with_gesture_points(key_positions: Mapping[str, float]) -> dict[str, float]:
    """Return key positions with the seven points of a gesture, in order. Missing points coincide with others.

    ready = start, relax = end, strokeStart = ready, strokeEnd = relax, stroke = strokeStart. Other points are kept.
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
