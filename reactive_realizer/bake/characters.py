"""The characters to bake, as data: everything in which the avatars differ. Colors are sRGB, lengths in meters."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from itertools import product

import numpy as np

from reactive_realizer.bake.numeric import Color


class Neckline(Enum):
    """Cuts of a shirt at the neck."""

    SCOOP = "scoop"
    CREW = "crew"


class HairStyle(Enum):
    """Hairdos that `hair` makes."""

    BOB = "bob"
    CROP = "crop"


@dataclass(frozen=True, slots=True)
class TopDesign:
    """A shirt.

    Attributes:
        color: of the cloth.
        trim: of collar and cuffs.
        neckline: cut at the neck.
        sleeve_bone: the bone on which the sleeve ends, "Arm" or "ForeArm".
        sleeve_part: where along that bone, 0..1.
        cling: 0 hangs straight from the chest, 1 follows the waist.
        fall: how fast the cloth may narrow below what it hangs from, m per m.
        sleeve_radius: of the sleeve around the arm.
    """

    color: Color
    trim: Color
    neckline: Neckline
    sleeve_bone: str
    sleeve_part: float
    cling: float
    fall: float
    sleeve_radius: float


@dataclass(frozen=True, slots=True)
class PantsDesign:
    """Trousers: color, and radii around the leg."""

    color: Color
    knee: float
    ankle: float


@dataclass(frozen=True, slots=True)
class ShoesDesign:
    """Colors of a shoe's parts."""

    upper: Color
    sole: Color
    lace: Color


@dataclass(frozen=True, slots=True)
class Physique:
    """Age and build, mixed from MakeHuman's macro shapes as its own sliders mix them.

    Attributes:
        age: years.
        muscle: 0 for the least muscle of MakeHuman's shapes, 0.5 for average, 1 for the most.
        weight: likewise.
    """

    age: float = 25.0
    muscle: float = 0.5
    weight: float = 0.5

    @property
    def ages(self) -> Mapping[str, float]:
        """Amounts of the shapes of an age."""
        return _mix(self.age, {"child": 10.0, "young": 25.0, "old": 90.0})

    @property
    def builds(self) -> Mapping[str, float]:
        """Amounts of the shapes of an age, muscle and weight."""
        muscles, weights = _mix(self.muscle, _AMOUNTS), _mix(self.weight, _AMOUNTS)
        return {
            f"{age}-{muscle}muscle-{weight}weight": self.ages[age] * muscles[muscle] * weights[weight]
            for age, muscle, weight in product(self.ages, muscles, weights)
        }


_AMOUNTS = {"min": 0.0, "average": 0.5, "max": 1.0}


def _mix(value: float, places: Mapping[str, float]) -> dict[str, float]:
    """The amounts of the two shapes between whose places a value lies; one of nothing is left out."""
    names = list(places)
    place = float(np.interp(value, list(places.values()), range(len(places))))
    low = min(int(place), len(places) - 2)
    shares = {names[low]: low + 1 - place, names[low + 1]: place - low}
    return {name: share for name, share in shares.items() if share > 0}


@dataclass(frozen=True, slots=True)
class Character:
    """One person.

    Attributes:
        gender: as MakeHuman's targets name it.
        macros: weights of MakeHuman's macro shapes; they sum to 1.
        physique: age and build.
        details: weights of its detail targets; ``{side}`` stands for both sides.
        smile: how much of a smile the mouth has at rest, 0..1.
        skin: tone; lips, flush, brow, iris, hair_color: of these parts.
        lip_amount: how much of the lip color covers the skin, 0..1; likewise flush_amount, stubble, liner (lash line).
        brow_height: half the thickness of the brows.
        brow_lift: how much they lie above the usual place.
        lash_length: relative to MakeHuman's lashes.
        hair: style.
    """

    gender: str
    macros: Mapping[str, float]
    physique: Physique
    details: Mapping[str, float]
    smile: float
    skin: Color
    lips: Color
    lip_amount: float
    flush: Color
    flush_amount: float
    brow: Color
    brow_height: float
    brow_lift: float
    stubble: float
    liner: float
    lash_length: float
    iris: Color
    hair: HairStyle
    hair_color: Color
    top: TopDesign
    pants: PantsDesign
    shoes: ShoesDesign

    def targets(self) -> Iterator[tuple[str, float]]:
        """MakeHuman's shape targets and how much of each."""
        for age, amount in self.physique.ages.items():
            for macro, share in self.macros.items():
                yield f"macrodetails/{macro}-{self.gender}-{age}", share * amount
        for build, amount in self.physique.builds.items():
            yield f"macrodetails/universal-{self.gender}-{build}", amount
            yield f"macrodetails/proportions/{self.gender}-{build}-idealproportions", 0.8 * amount
        for detail, amount in self.details.items():
            for side in "lr" if "{side}" in detail else "-":
                yield detail.format(side=side), amount


FEMALE = Character(
    gender="female",
    macros={"african": 0.15, "asian": 0.35, "caucasian": 0.5},
    physique=Physique(),
    details={
        "head/head-oval": 0.35,
        "nose/nose-scale-horiz-decr": 0.30,
        "nose/nose-volume-decr": 0.25,
        "nose/nose-point-up": 0.15,
        "mouth/mouth-angles-up": 0.30,
        "mouth/mouth-upperlip-volume-incr": 0.25,
        "mouth/mouth-lowerlip-volume-incr": 0.20,
        "chin/chin-triangle": 0.15,
        "cheek/{side}-cheek-bones-incr": 0.30,
        "cheek/{side}-cheek-volume-incr": 0.25,
        "eyes/{side}-eye-scale-incr": 0.30,
        "eyes/{side}-eye-height2-incr": 0.15,
    },
    smile=0.10,
    skin=(212, 156, 128),
    lips=(178, 82, 84),
    lip_amount=0.62,
    flush=(204, 100, 86),
    flush_amount=0.30,
    brow=(70, 45, 33),
    brow_height=0.0042,
    brow_lift=0.0,
    stubble=0.0,
    liner=0.55,
    lash_length=1.0,
    iris=(78, 94, 70),
    hair=HairStyle.BOB,
    hair_color=(104, 62, 38),
    top=TopDesign(
        color=(28, 118, 122),
        trim=(22, 98, 103),
        neckline=Neckline.SCOOP,
        sleeve_bone="ForeArm",
        sleeve_part=0.30,
        cling=0.50,
        fall=0.50,
        sleeve_radius=0.047,
    ),
    pants=PantsDesign(color=(58, 62, 84), knee=0.070, ankle=0.061),
    shoes=ShoesDesign(upper=(233, 229, 222), sole=(250, 249, 246), lace=(205, 200, 192)),
)

MALE = Character(
    gender="male",
    macros={"african": 0.45, "asian": 0.15, "caucasian": 0.40},
    physique=Physique(),
    details={
        "head/head-oval": 0.15,
        "mouth/mouth-angles-up": 0.35,
        "chin/chin-width-incr": 0.15,
        "nose/nose-scale-horiz-decr": 0.25,
        "nose/nose-volume-decr": 0.15,
        "cheek/{side}-cheek-bones-incr": 0.20,
        "eyes/{side}-eye-scale-incr": 0.20,
        "eyes/{side}-eye-height2-incr": 0.35,
    },
    smile=0.12,
    skin=(168, 118, 90),
    lips=(142, 84, 76),
    lip_amount=0.50,
    flush=(158, 84, 64),
    flush_amount=0.16,
    brow=(34, 24, 20),
    brow_height=0.0056,
    brow_lift=-0.001,
    stubble=0.42,
    liner=0.28,
    lash_length=0.7,
    iris=(74, 48, 30),
    hair=HairStyle.CROP,
    hair_color=(50, 37, 31),
    top=TopDesign(
        color=(206, 148, 58),
        trim=(184, 126, 44),
        neckline=Neckline.CREW,
        sleeve_bone="Arm",
        sleeve_part=0.62,
        cling=0.25,
        fall=0.30,
        sleeve_radius=0.066,
    ),
    pants=PantsDesign(color=(52, 66, 92), knee=0.083, ankle=0.073),
    shoes=ShoesDesign(upper=(74, 62, 56), sole=(236, 232, 224), lace=(222, 216, 206)),
)

CHARACTERS: Mapping[str, Character] = {"female": FEMALE, "male": MALE}
