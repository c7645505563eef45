"""Parameters by name."""

import pytest

from reactive_realizer.planunit.parameter import spelled


@pytest.mark.parametrize("said", ["HEAD", "Head", " head ", "head"])
def test_a_parameter_name_may_have_any_case(said: str) -> None:
    assert spelled(said, ("neck", "head")) == "head"


@pytest.mark.parametrize("said", ["right-hand", "RIGHT_HAND", "Right_Hand"])
def test_a_dash_means_an_underscore(said: str) -> None:
    assert spelled(said, {"LEFT_HAND": 1, "RIGHT_HAND": 2}) == "RIGHT_HAND"


def test_names_that_differ_only_in_case_stay_distinct() -> None:
    assert [spelled(name, ("a", "A")) for name in "aA"] == ["a", "A"]


def test_an_unknown_name_is_returned_as_it_is() -> None:
    assert spelled("Shoulder", ("neck", "head")) == "Shoulder"
