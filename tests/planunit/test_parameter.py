"""Parameters by name."""

import pytest

from reactive_realizer.planunit.parameter import spelled


@pytest.mark.parametrize("said", ["HEAD", "Head", " head ", "head"])
def test_a_word_may_be_said_in_any_case(said):
    assert spelled(said, ("neck", "head")) == "head"


@pytest.mark.parametrize("said", ["right-hand", "RIGHT_HAND", "Right_Hand"])
def test_a_dash_is_an_underscore(said):
    assert spelled(said, {"LEFT_HAND": 1, "RIGHT_HAND": 2}) == "RIGHT_HAND"


def test_of_names_that_differ_in_case_alone_each_keeps_its_own():
    assert [spelled(name, ("a", "A")) for name in "aA"] == ["a", "A"]


def test_what_nobody_knows_stays_as_it_is_said():
    assert spelled("Shoulder", ("neck", "head")) == "Shoulder"
