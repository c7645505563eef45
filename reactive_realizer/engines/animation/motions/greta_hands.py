"""What a figure does of a hand in a phase of Greta's gestures: its place, its fingers, its elbow."""

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Final, NamedTuple

from reactive_realizer.binding.asset_file import first_asset
from reactive_realizer.binding.faults import BadAsset, NoAsset
from reactive_realizer.binding.gestuary import read_hand_shapes
from reactive_realizer.binding.gestuary_phases import HandPhase, Wave
from reactive_realizer.bml.vocabulary import BodyGroup
from reactive_realizer.embodiment.joints import SIDES, other_side
from reactive_realizer.embodiment.quaternion import Quat
from reactive_realizer.embodiment.vector import ZERO, Vec3, add, scale, subtract, unit
from reactive_realizer.engines.animation.key_poses.body_groups import group_joints
from reactive_realizer.engines.animation.key_poses.gesture_space import arm_length, arm_place
from reactive_realizer.engines.animation.motion_maker import MakerContext
from reactive_realizer.engines.animation.motions.pose_goals import stored_pose
from reactive_realizer.errors import RealizerError

_SHAPES = "HandShape.xml"
"""The name of the file of shapes in Greta."""

_SWIVEL, _MOST_SWIVEL = math.radians(30.0), math.radians(60.0)
"""Swivel of the elbow at the openness 1, and at most."""

_GROUPS: Final = {"l": BodyGroup.LEFT_HAND, "r": BodyGroup.RIGHT_HAND}

STAND_INS: Final[Mapping[str, str]] = MappingProxyType(
    {
        **dict.fromkeys(("form_fist",), "hands_fist"),
        **dict.fromkeys(("form_point1", "number_two", "form_2apart"), "hands_index"),
        **dict.fromkeys(("number_one_ok",), "hands_thumbUp"),
        **dict.fromkeys(("form_open", "open_thumbin", "thumb_over", "index_straight"), "hands_open-straight"),
        **dict.fromkeys(("form_openapart", "open_thumbout", "thumb_away", "form_3apart"), "hands_open-spread"),
        **dict.fromkeys(("relax", "bend_curved", "reset"), "hands_open-relaxed"),
        **dict.fromkeys(("bend_angled", "middle_angled", "middle_closed", "middle_curved"), "hands_claw"),
        **dict.fromkeys(("closed_inside", "closed_straight", "closed_tight"), "hands_ring"),
        **dict.fromkeys(("index_closed", "index_curved", "symbol_1_open", "symbol_1_closed"), "hands_ring"),
        **dict.fromkeys(("symbol_2_open", "symbol_2_closed", "symbol_3_open", "symbol_3_closed"), "hands_purse"),
    }
)
"""Shape of a hand of Greta -> the stored pose that is most like it, for assets without its file of shapes."""
_NONE: Final = "empty"
"""The shape that leaves the fingers as they are."""

TOUCHED: Final[Mapping[str, tuple[str, Vec3]]] = MappingProxyType(
    {
        "skulltop": ("skullbase", (0.09, 0.30, 0.05)),
        "skullbase": ("skullbase", (0.14, 0.10, 0.05)),
        "nose": ("skullbase", (0.0, 0.10, 0.24)),
        "chin": ("skullbase", (0.0, -0.02, 0.22)),
        "shoulder": ("{side}_shoulder", (0.0, 0.06, 0.10)),
        "chest": ("vt6", (0.0, 0.10, 0.26)),
        "belly": ("vl5", (0.0, 0.05, 0.26)),
        "hip": ("{side}_hip", (0.06, 0.10, 0.18)),
        "hipwide": ("{side}_hip", (0.20, 0.10, 0.05)),
        "thive": ("{side}_hip", (0.08, -0.15, 0.20)),
        "knee": ("{side}_knee", (0.0, 0.02, 0.12)),
    }
)
"""Place that a hand can touch -> the joint that it is near to, and the way from it outward, up and ahead at rest, in
lengths of the arm."""

_SHOULDER: Final = "shoulder"
"""The place that a hand reaches on the other side; others without a side are on its own."""


class HandState(NamedTuple):
    """A hand of the figure in a phase.

    Attributes:
        place: of its point `tip`, from the pelvis, m; None if it stays where it is.
        tip: from the wrist, in the axes of the wrist, m.
        palm: direction of the palm, in the figure's axes, if it touches the body; has no effect beside a turn.
        turn: of the hand (`HandPhase`).
        of_figure: whether the turn is relative to the figure.
        swivel: of the elbow, rad.
        fingers: rotations of their joints.
        waves: of the way to the next phase.
    """

    place: Vec3 | None
    tip: Vec3
    palm: Vec3 | None
    turn: Quat | None
    of_figure: bool
    swivel: float
    fingers: Mapping[str, Quat]
    waves: tuple[Wave, ...]

    @property
    def kind(self) -> tuple[bool, Vec3, Vec3 | None, bool, bool]:
        """What two states have in common if there are states between them."""
        return (self.place is None, self.tip, self.palm, self.turn is None, self.of_figure)

    @property
    def asks(self) -> bool:
        """Whether it asks anything of the figure."""
        return self.place is not None or self.turn is not None or bool(self.fingers)


class GretaFigure:
    """What the figure can do of a gesture.

    Attributes:
        notes: faults of what it cannot do.
    """

    def __init__(self, context: MakerContext, file: str) -> None:
        self.notes: list[BadAsset] = []
        self.skeleton = context.humanoid.avatar.skeleton
        self.arm = arm_length(self.skeleton)
        self._context = context
        self._file = file
        self._rest = context.rest.body
        self._pelvis = self._rest.transform(self.skeleton.joints[0]).position
        self._shapes = _shapes(context.asset)

    def state(self, hand: HandPhase) -> HandState:
        """Return a hand in a phase."""
        place, tip, palm = self._place(hand)
        swivel = min(_MOST_SWIVEL, max(-_MOST_SWIVEL, hand.openness * _SWIVEL))
        return HandState(place, tip, palm, hand.turn, hand.of_figure, swivel, self._fingers(hand), hand.waves)

    def _place(self, hand: HandPhase) -> tuple[Vec3 | None, Vec3, Vec3 | None]:
        """Return the place of a hand, the point of it that is there, and the direction of its palm.

        A hand touches the body with its knuckles, and its palm faces what it touches.
        """
        if hand.touch is None:
            return (None if hand.place is None else arm_place(*hand.place, hand.side, self.skeleton)), ZERO, None
        name, _, side = hand.touch.lower().partition("_")
        if name not in TOUCHED:
            known = ", ".join(TOUCHED)
            self._note(hand, "touchPosition", f"there is no place '{hand.touch}' on the body; known are {known}")
            return None, ZERO, None
        joint, (outward, up, ahead) = TOUCHED[name]
        side = side if side in SIDES else other_side(hand.side) if name == _SHOULDER else hand.side
        start = subtract(self._rest.transform(joint.format(side=side)).position, self._pelvis)
        way = scale((outward if side == "l" else -outward, up, ahead), self.arm)
        knuckles = f"{hand.side}_middle1"
        tip = self.skeleton.offset(knuckles) if knuckles in self.skeleton else ZERO
        return add(start, way), tip, unit(scale(way, -1.0))

    def _fingers(self, hand: HandPhase) -> Mapping[str, Quat]:
        """Return the rotations of the joints of a hand that its shape names."""
        shape = (hand.shape or _NONE).lower()
        if shape in self._shapes:
            return _of_side(self._shapes[shape], hand.side, group_joints(_GROUPS[hand.side], self.skeleton))
        if shape == _NONE:
            return {}
        try:
            return stored_pose(STAND_INS.get(shape, hand.shape or ""), _GROUPS[hand.side], self._context)
        except RealizerError:
            self._note(hand, "handShape", f"there is no shape '{hand.shape}'")
            return {}

    def _note(self, hand: HandPhase, element: str, reason: str) -> None:
        """Note what cannot be done, each reason once."""
        fault = BadAsset(file=self._file, row=hand.row, element=element, reason=reason)
        if all(reason != each.reason for each in self.notes):
            self.notes.append(fault)


def _shapes(asset: Callable[[str], Path]) -> Mapping[str, Mapping[str, Quat]]:
    """Return the shapes of hands in Greta's file of them; none without one."""
    try:
        return read_hand_shapes(first_asset(asset, f"**/{_SHAPES}"))
    except RealizerError as refused:
        if isinstance(refused.fault, NoAsset):
            return {}
        raise


def _of_side(shape: Mapping[str, Quat], side: str, joints: Sequence[str]) -> Mapping[str, Quat]:
    turns = shape
    if side == "l":
        turns = {other_side(joint): (w, x, -y, -z) for joint, (w, x, y, z) in shape.items()}
    return {joint: turns[joint] for joint in joints if joint in turns}
