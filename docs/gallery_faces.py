"""The entries of the gallery that show faces: action units, parameters of MPEG-4, emotions and visemes."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from math import ceil

from gallery_entry import Entry

from reactive_realizer.assembly.assets import PACKAGE_ASSETS, Assets
from reactive_realizer.binding.mouth_shapes import SILENCE, VISEMES
from reactive_realizer.binding.viseme_binding import VisemeBinding
from reactive_realizer.bml.names import BML_EXT
from reactive_realizer.embodiment.avatar import Avatar
from reactive_realizer.embodiment.face_map import STAND_INS, FaceMap, StandIns
from reactive_realizer.embodiment.turn_weights import turned_joint
from reactive_realizer.engines.face.expressions import Expressions
from reactive_realizer.engines.face.faps import FapTable

_SHOWN_PARAMETERS = (
    ("lips", range(3, 19), "mouth", "female"),
    ("eyes", range(19, 39), "eyes", "female"),
    ("cheeks", range(39, 43), "", "male"),
    ("tongue", range(43, 48), "mouth", "female"),
    ("head", range(48, 51), "", "female"),
    ("nose", range(61, 65), "nose", "male"),
    ("ears", range(65, 69), "", "male"),
)
"""For some of MPEG-4's parameters, how they are shown. The outer lips (51 to 60) move like the inner ones."""

_WIDEST = 7
"""The most pictures in a strip."""


def face_strips() -> list[Entry]:
    """All of them, in order."""
    return [*_action_units(), *_FACES, *_parameters(), *_visemes()]


def _action_units() -> Iterator[Entry]:
    face = PACKAGE_ASSETS / "face"
    for number, unit in Expressions.read(face / "lexemes.json", face / "action_units.json").units.items():
        behavior = f'<faceFacs xmlns="{BML_EXT}" id="f" au="{number}" amount="1"/>'
        yield Entry(f"facefacs-{number:02}", behavior, face=True, caption=unit.name)


def _parameters() -> Iterator[Entry]:
    """MPEG-4's parameters, one in each picture: positive values at most of their range, then negative ones."""
    assets = Assets()
    stand_ins = StandIns.read(assets(STAND_INS))
    for part, numbers, closeup, figure in _SHOWN_PARAMETERS:
        avatar = Avatar.read(assets(f"avatars/{figure}.glb"))
        faps = FapTable(assets("face/faps.json"), avatar, FaceMap(avatar, stand_ins))
        pairs = [(number, sign) for sign in (1.0, -1.0) for number in numbers if faps.missing(number, sign) is None]
        shown = [(number, _most(faps, number, sign)) for number, sign in pairs]
        jaw = {"3": 900.0} if part == "tongue" else {}
        strips = ceil(len(shown) / _WIDEST)
        size = ceil(len(shown) / strips)
        for index in range(strips):
            strip = shown[index * size : (index + 1) * size]
            frames = _all_held([{str(number): value, **jaw} for number, value in strip])
            yield Entry(
                f"faps-{part}-{index + 1}",
                f'<bmlt:facekeyframe id="k" type="FAPS">{frames}</bmlt:facekeyframe>',
                face=not closeup,
                closeup=closeup,
                held=len(strip),
                avatar=figure,
                caption=", ".join(f"{faps.name(number)} {value:g}" for number, value in strip),
            )


def _most(faps: FapTable, number: int, sign: float) -> float:
    """A value in most of the range of a parameter; eyes and head turn less."""
    weights = faps.weights({number: sign})
    share = 0.25 if any(map(turned_joint, weights)) else 0.9
    return sign * round(share / max(weights.values()))


def _visemes() -> Iterator[Entry]:
    """Seven visemes in each strip, one in each of its pictures."""
    names = [viseme for viseme in VISEMES if viseme != SILENCE]
    for avatar, first in product(("female", "male"), (0, 7)):
        shown = names[first : first + 7]
        behavior = f'<bmlt:facekeyframe id="k">{_held(avatar, shown)}</bmlt:facekeyframe>'
        name = f"visemes-{avatar}-{'-'.join(shown[:: len(shown) - 1])}".lower()
        caption = f"the visemes {', '.join(shown)}"
        yield Entry(name, behavior, closeup="mouth", held=len(shown), avatar=avatar, caption=caption)


def _held(avatar: str, visemes: Sequence[str]) -> str:
    """Keyframes in which each viseme is held in its second."""
    assets = Assets()
    binding = VisemeBinding.read((), Avatar.read(assets(f"avatars/{avatar}.glb")).morphs, assets)
    return _all_held([binding.shapes[viseme].morphs for viseme in visemes])


def _all_held(faces: Sequence[Mapping[str, float]]) -> str:
    """Keyframes in which each face is held in its second; a face is the value of each part that moves."""
    parts = sorted({part for face in faces for part in face})
    rows = [
        " ".join(f"{value:g}" for value in (time, *(face.get(part, 0) for part in parts)))
        for second, face in enumerate(faces)
        for time in (second + 0.2, second + 0.8)
    ]
    zeros = " 0" * len(parts)
    content = "\n".join([f"0{zeros}", *rows, f"{len(faces)}{zeros}"])
    return f'<FaceInterpolator xmlns="" parts="{" ".join(parts)}">\n{content}\n</FaceInterpolator>'


_SIGH = """
<FaceInterpolator xmlns="" parts="1 26 43">
  0    0    0    0
  0.8  0.6  0.7  0.3
  1.4  0.8  0.2  0.9
  2.2  0    0    0
</FaceInterpolator>
""".strip()

_FACES = (
    Entry("facekeyframe", f'<bmlt:facekeyframe id="k" type="FACS">{_SIGH}</bmlt:facekeyframe>', face=True),
    Entry("facefap-jaw", '<bmlt:facefap id="f" fap="open_jaw" value="900"/>', face=True),
    Entry("facefap-corners", '<bmlt:facefap id="f" fap="raise_l_cornerlip raise_r_cornerlip" value="450"/>', face=True),
    Entry("facefap-brow", '<bmlt:facefap id="f" fap="raise_l_m_eyebrow raise_l_o_eyebrow" value="130"/>', face=True),
    Entry("facefap-eyes", '<bmlt:facefap id="f" fap="yaw_l_eyeball yaw_r_eyeball" value="25000"/>', face=True),
    Entry("facefap-head", '<bmlt:facefap id="f" fap="head_yaw head_roll" value="20000"/>', face=True),
    *(
        Entry(
            f"faceplutchik-{name}",
            f'<bmlt:faceplutchik id="f" angle="{angle}" activation="{activation}"/>',
            face=True,
        )
        for name, angle, activation in (
            ("serenity", 315, 3.0),
            ("ecstasy", 315, 7.0),
            ("love", 337.5, 5.0),
            ("awe", 67.5, 6.0),
            ("remorse", 157.5, 5.0),
            ("contempt", 202.5, 5.0),
        )
    ),
)
