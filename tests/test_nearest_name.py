"""The known name that is nearest to an unknown one."""

import pytest

from reactive_realizer.errors import TargetFault
from reactive_realizer.nearest_name import nearest_name

LEXEMES = ("BEAT", "OFFER", "ARMS_CROSSED", "NOD")


@pytest.mark.parametrize(
    ("name", "nearest"),
    [
        ("BAET", "BEAT"),
        ("bea", "BEAT"),
        ("Arms-Crosed", "ARMS_CROSSED"),
        ("OFER", "OFFER"),
        ("DANCE", None),
        ("nobody", None),
        ("", None),
        ("BEAT", None),
        ("BEAT" * 100_000, None),
    ],
)
def test_a_name_that_is_nearly_known_is_found(name: str, nearest: str | None) -> None:
    assert nearest_name(name, LEXEMES) == nearest


def test_no_name_is_near_without_known_ones() -> None:
    assert nearest_name("BEAT", ()) is None


def test_only_some_of_very_many_names_are_compared() -> None:
    known = [f"target{number}" for number in range(100_000)]
    assert nearest_name("targt7", known) == "target7"
    assert nearest_name("tar-get", ["z" * 1_000_000]) is None


class _NoSeats(TargetFault):
    code = "test-no-seats"
    template = "there are no seats {seats}; available: {known}"
    unknown = "seats"
    seats: tuple[str, ...]
    known: tuple[str, ...]


def test_a_sentence_suggests_a_name_for_each_unknown_one_that_has_a_near_one() -> None:
    known = ("window", "aisle")
    fault = _NoSeats(seats=("windwo", "roof", "ailse"), known=known)
    assert fault.sentence == (
        "there are no seats windwo, roof, ailse; available: window, aisle; did you mean 'window' and 'aisle'?"
    )
    assert _NoSeats(seats=("windwo",) * 1000, known=known).sentence.endswith("did you mean 'window'?")
    assert _NoSeats(seats=("roof",), known=known).sentence.endswith("available: window, aisle")


def test_a_fault_that_suggests_names_declares_the_known_ones() -> None:
    with pytest.raises(TypeError, match="known"):

        class _Wrong(TargetFault):
            code = "test-wrong-seat"
            template = "there is no seat {seat}"
            unknown = "seat"
            seat: str


def test_long_lists_of_known_names_are_truncated() -> None:
    known = tuple(f"seat {number} of the hall" for number in range(1000))
    assert len(_NoSeats(seats=("roof" * 1000,), known=known).sentence) < 1200
