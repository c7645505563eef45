"""Faults: what a kind of fault is made of, and what it guarantees."""

import gc

import pytest

from reactive_realizer.errors import FAULTS, RealizerError, SchedulingFault, WarningType


class _NoSeat(SchedulingFault):
    code = "test-no-seat"
    template = "there is no seat {number:02d}; available: {known}"
    number: int
    known: tuple[str, ...] = ()


def test_the_sentence_mentions_the_details() -> None:
    fault = _NoSeat(number=7, known=("1", "2"))
    assert (fault.code, fault.warning) == ("test-no-seat", WarningType.IMPOSSIBLE_TO_SCHEDULE)
    assert str(fault) == "there is no seat 07; available: 1, 2"
    assert fault.details == {"number": 7, "known": ("1", "2")}
    assert str(_NoSeat(number=7)).endswith("available: none")


class _Late(SchedulingFault):
    code = "test-late"
    template = "{late} s late: needs {need} s, has {room} s"
    compared = ("need", "room")
    late: float
    need: float
    room: float


@pytest.mark.parametrize(
    ("late", "need", "room", "said"),
    [
        (0.392817, 0.4, 0.0, "0.39 s late: needs 0.40 s, has 0.00 s"),
        (-2.0, 0.104, 0.0982, "-2.00 s late: needs 0.104 s, has 0.098 s"),
        (0.0004, 0.5, 0.5 + 1e-12, "0.0004 s late: needs 0.50 s, has 0.50 s"),
        (-1e-12, 0.1, 0.1, "0.00 s late: needs 0.10 s, has 0.10 s"),
        (1e300, 0.1, 0.1, "1e+300 s late: needs 0.10 s, has 0.10 s"),
    ],
)
def test_numbers_have_two_digits_or_more_if_these_show_no_difference(
    late: float, need: float, room: float, said: str
) -> None:
    assert str(_Late(late=late, need=need, room=room)) == said


def test_a_fault_keeps_the_first_place_that_it_is_given() -> None:
    fault = _NoSeat(number=7).located(3, 14).located(1, 1)
    assert str(fault).startswith("line 3, column 14: there is no seat")
    assert fault == _NoSeat(number=7, line=3, column=14)


def test_details_are_checked_when_a_fault_is_made() -> None:
    with pytest.raises(TypeError, match="row"):
        _NoSeat(number=7, row=2)  # type: ignore[call-arg]


def test_a_template_mentions_only_fields() -> None:
    with pytest.raises(TypeError, match="row"):

        class _Wrong(SchedulingFault):
            code = "test-wrong"
            template = "no row {row}"


def test_two_kinds_of_fault_do_not_have_one_code() -> None:
    with pytest.raises(TypeError, match="_NoSeat"):

        class _Second(SchedulingFault):
            code = "test-no-seat"
            template = "there is no seat"


def test_every_kind_of_fault_is_registered_by_its_code() -> None:
    assert FAULTS["test-no-seat"] is _NoSeat


def test_a_fault_that_was_raised_keeps_no_traceback() -> None:
    try:
        raise RealizerError(_NoSeat(number=7))
    except RealizerError as refused:
        fault = refused.fault
    assert not any(isinstance(each, BaseException) for each in gc.get_referents(fault, *gc.get_referents(fault)))
