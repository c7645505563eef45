"""A motion as a function of phase: what the animation engine plays between pegs (thesis 4.2)."""

from collections.abc import Mapping
from math import inf
from typing import NamedTuple, Protocol

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.body import Body
from reactive_realizer.embodiment.pose import Layer, LayerKind, checked
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.planunit.parameter import Range

GESTURE_POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
"""Sync points of gesture, head and pointing, in order (BML 1.0)."""


AMOUNT = "amount"
"""How much of a motion is shown, as BML calls it."""

AMOUNT_RANGE = Range(0.0, 1.0)

ANY_VALUE = Range(-inf, inf)
"""Of parameters whose meaning an animation's author knows."""


class Moment(NamedTuple):
    """When a motion is asked for its pose.

    Attributes:
        phase: how far the motion has come, 0 to 1.
        time: of the frame, s.
        body: as shown last, without additive motion.
    """

    phase: float
    time: GlobalTime
    body: Body


class Posed(NamedTuple):
    """What a motion asks for.

    Attributes:
        rotations: joint -> rotation local to the parent; of additive motions, the turn to be added.
        weight: how much of it is shown, 0 to 1: motions come and go by it, over whatever lies below them.
        root: how far HumanoidRoot is moved from its place in the default pose, m; None leaves it where it is.
        weights: of joints that come and go for themselves, the share of the weight; HumanoidRoot's is the root's too.
    """

    rotations: Mapping[str, Quat]
    weight: float = 1.0
    root: Vec3 | None = None
    weights: Mapping[str, float] | None = None


class MotionUnit(Protocol):
    """One motion of one character.

    Which phase it is when is not its business: phases are spread between key positions as their pegs say.

    Attributes:
        kind: where it lies among the layers of a frame.
        resources: what of the body it owns while it plays (`Resource`); units that share one exclude each other.
        group: its replacement group, if it has one of its own: see `PlanUnit.group`.
        lasts: the name under which its last pose stays when it has ended, until another of that name has ended or
            everything is replaced; None for what goes when it ends.
        parameters: name -> value; a value may be changed while the motion plays.
        ranges: the parameters that may be changed, with the values that mean something.
    """

    kind: LayerKind
    resources: frozenset[str]
    group: str | None
    lasts: str | None
    parameters: dict[str, float]
    ranges: Mapping[str, Range]

    @property
    def joints(self) -> frozenset[str]:
        """The joints that it turns, while it plays."""

    @property
    def key_positions(self) -> Mapping[str, float]:
        """Sync id -> phase, 0 to 1; "start" is 0 and "end" is 1, and later points never lie at earlier phases."""

    @property
    def preferred_duration(self) -> float:
        """How long it takes where nothing else is asked for, s."""

    @property
    def limits(self) -> tuple[float, float] | None:
        """Shortest and longest duration, s, if its author named any; given up before any constraint is."""

    def start(self, body: Body) -> None:
        """The motion begins from here: the body as shown last, without additive layers."""

    def pose(self, moment: Moment) -> Posed:
        """What it asks for at a moment.

        Raises:
            RealizerError: "no-motion": there is none at this phase; the unit should be stopped.
        """


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
    return frozenset(
        arm
        for side, arm in (("l", Resource.LEFT_ARM), ("r", Resource.RIGHT_ARM))
        if any(joint.startswith(f"{side}_") and not joint.startswith(_LEG[side]) for joint in joints)
    )


def owned(joints: frozenset[str]) -> frozenset[str]:
    """What a motion of these joints owns: the arms, and with a leg or the root the stance."""
    return arms_of(joints) | (frozenset() if _STANCE.isdisjoint(joints) else {Resource.STANCE})


_STANCE = frozenset({"HumanoidRoot", *(f"{side}_{joint}" for side in "lr" for joint in ("hip", "knee", "ankle"))})
_LEG = {side: tuple(f"{side}_{joint}" for joint in ("hip", "knee", "ankle", "midtarsal", "eyeball")) for side in "lr"}


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
