"""Changes the age, build, skin, hair, eyes and clothes of a character before its avatar is made."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest
from types import MappingProxyType
from typing import Final

from reactive_realizer.bake.characters import Character, HairStyle, Physique
from reactive_realizer.bake.numeric import Color

AGES: Final = (14.0, 90.0)
"""The youngest and the oldest age, years: the clothes do not fit children."""

BUILDS: Final[Mapping[str, tuple[float, float]]] = MappingProxyType(
    {"slim": (0.45, 0.2), "average": (0.5, 0.5), "strong": (0.9, 0.55), "heavy": (0.45, 1.0)}
)
"""Muscle and weight of each build, as in `Physique`."""

SKINS: Final[Mapping[str, Color]] = MappingProxyType(
    {
        "light": (230, 184, 160),
        "fair": (212, 156, 128),
        "olive": (190, 140, 106),
        "tan": (168, 118, 90),
        "brown": (122, 82, 60),
        "dark": (84, 57, 45),
    }
)
"""Tones of skin, sRGB."""

_GRAY: Final[Color] = (176, 172, 168)
_GRAYING: Final = (45.0, 75.0)
"""Ages between which hair turns gray, unless its color is chosen."""


@dataclass(frozen=True, slots=True)
class Appearance:
    """The choices; None is as in the character that they change.

    Attributes:
        age: years, in `AGES`.
        build: a key of `BUILDS`.
        skin: tone; lips and flush follow it.
        hair: style.
        hair_color: brows follow it; by default it turns gray with age.
        eyes: color of the iris.
        clothes: colors of shirt, trousers and shoes, of which the last ones may be left out.
    """

    age: float | None = None
    build: str | None = None
    skin: Color | None = None
    hair: HairStyle | None = None
    hair_color: Color | None = None
    eyes: Color | None = None
    clothes: Sequence[Color] = ()

    def of(self, character: Character) -> Character:
        """A character with this appearance."""
        age = character.physique.age if self.age is None else self.age
        muscle, weight = BUILDS["average" if self.build is None else self.build]
        skin, hair = self.skin or character.skin, self.hair_color or _grayed(character.hair_color, age)
        own = (character.top.color, character.pants.color, character.shoes.upper)
        shirt, trousers, shoes = (chosen or color for chosen, color in zip_longest(self.clothes, own))
        return replace(
            character,
            physique=Physique(age, muscle, weight),
            skin=skin,
            lips=_likewise(character.lips, character.skin, skin),
            flush=_likewise(character.flush, character.skin, skin),
            hair=self.hair or character.hair,
            hair_color=hair,
            brow=_likewise(character.brow, character.hair_color, hair),
            iris=self.eyes or character.iris,
            top=replace(character.top, color=shirt, trim=_likewise(character.top.trim, character.top.color, shirt)),
            pants=replace(character.pants, color=trousers),
            shoes=replace(character.shoes, upper=shoes, lace=_likewise(character.shoes.lace, own[2], shoes)),
        )


def _grayed(color: Color, age: float) -> Color:
    start, end = _GRAYING
    share = min(1.0, max(0.0, (age - start) / (end - start)))
    red, green, blue = (round(own + share * (gray - own)) for own, gray in zip(color, _GRAY, strict=True))
    return red, green, blue


def _likewise(color: Color, before: Color, after: Color) -> Color:
    """A color, changed in proportion as another one was."""
    red, green, blue = (
        min(255, round(own * new / max(1, old))) for own, old, new in zip(color, before, after, strict=True)
    )
    return red, green, blue
