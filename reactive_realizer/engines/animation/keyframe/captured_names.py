"""How capture files call the joints."""

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from reactive_realizer.embodiment.mixamo import JOINTS

_BIOVISION_TRUNK = {"Hips": "HumanoidRoot", "Chest": "vl5", "Chest2": "vt6", "Neck": "vc4", "Head": "skullbase"}
_BIOVISION_SIDE = {
    "Collar": "sternoclavicular",
    "Shoulder": "shoulder",
    "Elbow": "elbow",
    "Wrist": "wrist",
    "Hip": "hip",
    "Knee": "knee",
    "Ankle": "ankle",
    "Toe": "midtarsal",
}
_POSER_TRUNK = {"hip": "HumanoidRoot", "abdomen": "vl5", "chest": "vt6", "neck": "vc4", "head": "skullbase"}
_POSER_SIDE = {
    "Collar": "sternoclavicular",
    "Shldr": "shoulder",
    "ForeArm": "elbow",
    "Hand": "wrist",
    "Thigh": "hip",
    "Shin": "knee",
    "Foot": "ankle",
}

_TABLES: Sequence[dict[str, str]] = (
    # Autodesk's MotionBuilder has the names of Mixamo.
    dict(JOINTS),
    # The captures of Carnegie Mellon University, in the form that B. Hahne gave them: one more joint below the others.
    {**JOINTS, "LowerBack": "vl5", "Spine": "vt10", "Spine1": "vt6"},
    {
        **_BIOVISION_TRUNK,
        **{f"Left{name}": f"l_{joint}" for name, joint in _BIOVISION_SIDE.items()},
        **{f"Right{name}": f"r_{joint}" for name, joint in _BIOVISION_SIDE.items()},
    },
    {
        **_POSER_TRUNK,
        **{f"l{name}": f"l_{joint}" for name, joint in _POSER_SIDE.items()},
        **{f"r{name}": f"r_{joint}" for name, joint in _POSER_SIDE.items()},
    },
)


def joints_of(names: Iterable[str], joints: Iterable[str]) -> Mapping[str, str]:
    """What the joints of a file are in H-Anim: name in the file -> name there.

    Of the conventions known here (H-Anim, Mixamo and MotionBuilder, the captures of CMU, Biovision, Poser) the one that
    explains most names.

    Args:
        names: of the joints in the file; what stands before a colon does not count.
        joints: of the figure, in H-Anim.
    """
    own = dict.fromkeys(joints)
    plain = {name: name.rpartition(":")[2] for name in names}
    tables = ({joint: joint for joint in own}, *_TABLES)
    found = [{name: table[short] for name, short in plain.items() if table.get(short) in own} for table in tables]
    most = max(found, key=len)
    return MappingProxyType(most)
