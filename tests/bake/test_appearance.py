"""What users choose of an avatar."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.bake.appearance import AGES, BUILDS, SKINS, Appearance
from reactive_realizer.bake.characters import CHARACTERS, FEMALE, HairStyle, Physique


@pytest.mark.parametrize("name", CHARACTERS)
def test_without_choices_a_character_stays_as_it_is(name: str) -> None:
    assert Appearance().of(CHARACTERS[name]) == CHARACTERS[name]


@given(st.floats(*AGES), st.floats(0, 1), st.floats(0, 1))
def test_the_shapes_of_any_physique_add_up_to_one_person(age: float, muscle: float, weight: float) -> None:
    physique = Physique(age, muscle, weight)
    assert sum(physique.ages.values()) == pytest.approx(1.0)
    assert sum(physique.builds.values()) == pytest.approx(1.0)


def test_a_physique_is_mixed_from_the_shapes_around_it() -> None:
    physique = Physique(age=57.5, weight=0.75)
    assert physique.ages == pytest.approx({"young": 0.5, "old": 0.5})
    assert physique.builds == pytest.approx(
        {
            "young-averagemuscle-averageweight": 0.25,
            "young-averagemuscle-maxweight": 0.25,
            "old-averagemuscle-averageweight": 0.25,
            "old-averagemuscle-maxweight": 0.25,
        }
    )


def test_heavier_builds_weigh_more() -> None:
    weights = [Appearance(build=build).of(FEMALE).physique.weight for build in ("slim", "average", "strong", "heavy")]
    assert weights == sorted(weights)
    assert len(set(weights)) == len(BUILDS)


def test_lips_and_flush_follow_the_skin() -> None:
    dark = Appearance(skin=SKINS["dark"]).of(FEMALE)
    assert dark.skin == SKINS["dark"]
    for before, after in ((FEMALE.lips, dark.lips), (FEMALE.flush, dark.flush)):
        assert all(new < old for old, new in zip(before, after, strict=True))


def test_hair_turns_gray_with_age_unless_its_color_is_chosen() -> None:
    def spread(color: tuple[int, int, int]) -> int:
        return max(color) - min(color)

    spreads = [spread(Appearance(age=age).of(FEMALE).hair_color) for age in (30, 55, 80)]
    assert spreads[0] == spread(FEMALE.hair_color)
    assert spreads == sorted(spreads, reverse=True)
    assert Appearance(age=80, hair_color=(90, 20, 10)).of(FEMALE).hair_color == (90, 20, 10)


def test_clothes_are_named_from_the_shirt_to_the_shoes() -> None:
    character = Appearance(hair=HairStyle.CROP, eyes=(1, 2, 3), clothes=((10, 20, 30), (40, 50, 60))).of(FEMALE)
    assert (character.top.color, character.pants.color) == ((10, 20, 30), (40, 50, 60))
    assert character.shoes == FEMALE.shoes
    assert (character.hair, character.iris) == (HairStyle.CROP, (1, 2, 3))
