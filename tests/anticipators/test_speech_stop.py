"""The end of a turn is predicted from voice activity and recognized words."""

from math import exp
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from anticipators.speech_stop import SpeechStop
from anticipators.turn_model import PauseModel, Turn, TurnModel
from reactive_realizer.clock.units import GlobalTime, Time
from reactive_realizer.errors import RealizerError
from reactive_realizer.pegboard.time_peg import OffsetPeg
from reactive_realizer.reactive.graph import Cell
from reactive_realizer.testing.anticipator_harness import AnticipatorHarness

from .conftest import CONTEXT

PLAIN, FINISHED, OPEN = "I live in a house", "I live in a house.", "I live in a house and"


class User:
    """A user with voice activity detection and speech recognition."""

    def __init__(self, stage: AnticipatorHarness, model: TurnModel | None = None) -> None:
        self.stage = stage
        self.stop = stage.make("user", SpeechStop, model=model)

    def voice(self, now: float, value: float) -> float | None:
        self.stage.event(now, self.stop, "voice", value)
        return self.time

    def words(self, now: float, text: str) -> float | None:
        self.stage.event(now, self.stop, "words", text=text)
        return self.time

    def hang(self) -> Cell[Time]:
        """The peg of a behavior that refers to the stop now."""
        return OffsetPeg(self.stage.board.graph, "behavior", self.stage.board.predicted("user", "stop"), 0.0)

    @property
    def time(self) -> float | None:
        return self.stage.time(self.stop, "stop")


@pytest.fixture
def user(stage: AnticipatorHarness) -> User:
    return User(stage)


def known(time: float | None) -> float:
    assert time is not None
    return time


def silence(words: str, certainty: float = 0.9, pause: float = 0.4) -> float:
    return known(PauseModel(certainty, pause).end(Turn(words, False, GlobalTime(0.0))))


def test_the_end_is_unknown_while_the_user_speaks_and_predicted_afterwards(user: User) -> None:
    assert user.time is None
    assert user.voice(1.0, 0.0) is None
    assert user.voice(2.0, 0.9) is None
    assert user.voice(4.0, 0.1) == pytest.approx(4.0 + 0.88, abs=1e-2)


def test_silent_frames_change_nothing(user: User) -> None:
    user.voice(1.0, 1.0)
    said = user.voice(2.0, 0.2)
    assert [user.voice(2.0 + n / 50, n / 100) for n in range(40)] == [said] * 40


def test_a_resumed_turn_withdraws_the_prediction(user: User) -> None:
    user.voice(1.0, 1.0)
    user.voice(2.0, 0.0)
    assert user.voice(2.4, 1.0) is None
    assert user.voice(3.0, 0.0) == pytest.approx(3.0 + silence(""))


def test_a_complete_sentence_ends_earlier_and_an_incomplete_one_later() -> None:
    assert silence(FINISHED) < silence(PLAIN) < silence(OPEN)
    assert silence("") == silence(PLAIN)
    assert silence("Wait, um") == silence("I see,") == silence("to the")


def test_words_recognized_after_the_voice_refine_the_prediction(user: User) -> None:
    user.voice(1.0, 1.0)
    user.words(2.0, OPEN)
    assert user.voice(3.0, 0.0) == pytest.approx(3.0 + silence(OPEN))
    assert user.words(3.05, PLAIN) == pytest.approx(3.0 + silence(PLAIN))
    assert user.words(3.1, FINISHED) == pytest.approx(3.0 + silence(FINISHED))


def test_a_predicted_end_in_the_past_is_set_to_now(user: User) -> None:
    user.voice(1.0, 1.0)
    user.voice(3.0, 0.0)
    stop = user.hang()
    user.words(3.5, FINISHED)
    assert stop.value == 3.5


def test_an_end_predicted_in_the_past_can_be_withdrawn_like_any_other(user: User) -> None:
    user.words(1.0, OPEN)
    user.voice(1.0, 1.0)
    user.voice(3.0, 0.0)
    stop = user.hang()
    user.words(4.5, FINISHED)
    assert stop.value == 4.5
    user.voice(5.4, 0.0)
    assert stop.value == 4.5
    user.voice(5.45, 1.0)
    assert stop.value is None


def test_words_alone_make_a_turn_and_each_new_word_delays_its_end(user: User) -> None:
    assert user.words(1.0, "I live") == pytest.approx(1.0 + silence(PLAIN))
    assert user.words(1.4, "I live in a") == pytest.approx(1.4 + silence(OPEN))
    assert user.words(1.9, FINISHED) == pytest.approx(1.9 + silence(FINISHED))
    assert user.words(2.0, f"{FINISHED} ") == pytest.approx(1.9 + silence(FINISHED))


def test_after_the_end_its_name_means_the_end_of_the_next_turn(user: User) -> None:
    user.voice(1.0, 1.0)
    came, stop = known(user.voice(2.0, 0.0)), user.hang()
    assert user.voice(came - 0.01, 0.0) == came
    assert user.voice(came, 0.0) is None
    user.voice(came + 1.1, 0.0)
    user.voice(10.0, 1.0)
    assert user.voice(11.0, 0.0) == pytest.approx(11.0 + silence(""))
    assert stop.value == came


@pytest.mark.parametrize(("after", "resumed"), [(0.0, True), (0.95, True), (1.05, False)])
def test_a_turn_may_be_resumed_for_a_second_after_its_end(user: User, after: float, resumed: bool) -> None:
    user.voice(1.0, 1.0)
    came, stop = known(user.voice(2.0, 0.0)), user.hang()
    user.voice(came + after, 1.0)
    assert stop.value == (None if resumed else came)
    end = user.voice(5.0, 0.0)
    assert stop.value == (end if resumed else came)


def test_all_dependents_wait_for_the_end_of_a_turn_that_is_resumed_several_times(user: User) -> None:
    user.voice(1.0, 1.0)
    stops = []
    for begin in (2.0, 4.0, 6.0):
        came = known(user.voice(begin, 0.0))
        stops.append(user.hang())
        user.voice(came + 0.5, 1.0)
    assert [stop.value for stop in stops] == [None, None, None]
    end = user.voice(8.0, 0.0)
    assert [stop.value for stop in stops] == [end, end, end]


@pytest.mark.parametrize("text", ["", PLAIN, OPEN, FINISHED + " Yes."])
def test_words_after_the_end_move_nothing_without_voice(user: User, text: str) -> None:
    user.voice(1.0, 1.0)
    user.words(2.0, FINISHED)
    came, stop = known(user.voice(3.0, 0.0)), user.hang()
    assert user.words(came + 0.1, text) is None
    assert stop.value == came


def test_the_words_of_a_turn_do_not_count_for_the_next_one(user: User) -> None:
    user.voice(1.0, 1.0)
    user.words(1.5, FINISHED)
    user.voice(2.0, 0.0)
    user.voice(9.0, 1.0)
    assert user.voice(10.0, 0.0) == pytest.approx(10.0 + silence(""))


def test_the_same_words_after_a_closed_turn_are_a_new_turn(user: User) -> None:
    came, stop = known(user.words(1.0, FINISHED)), user.hang()
    assert user.words(came + 0.9, FINISHED) is None
    assert user.words(came + 1.1, FINISHED) == pytest.approx(came + 1.1 + silence(FINISHED))
    assert stop.value == came


def test_withdrawn_words_are_no_turn(user: User) -> None:
    assert user.words(1.0, "") is None
    assert user.words(2.0, "um") is not None
    assert user.words(2.3, " ") is None
    assert user.words(3.0, FINISHED) == pytest.approx(3.0 + silence(FINISHED))


def test_the_first_voice_activity_after_the_end_resumes_the_turn_only_if_the_user_speaks(user: User) -> None:
    came, stop = known(user.words(1.0, FINISHED)), user.hang()
    user.voice(came + 0.1, 0.0)
    assert stop.value == came
    user.voice(came + 0.2, 1.0)
    assert stop.value is None


def test_an_empty_text_after_the_end_closes_the_turn(user: User) -> None:
    came, stop = known(user.words(1.0, FINISHED)), user.hang()
    assert user.words(came + 0.1, "") is None
    assert user.words(came + 0.2, FINISHED) == pytest.approx(came + 0.2 + silence(FINISHED))
    assert stop.value == came


def test_another_turn_model_can_be_used(stage: AnticipatorHarness) -> None:
    class Punctual:
        def end(self, turn: Turn) -> GlobalTime | None:
            return GlobalTime(60.0)

    user = User(stage, model=Punctual())
    assert user.voice(1.0, 1.0) == 60.0


@given(st.sampled_from(["", PLAIN, FINISHED, OPEN]), st.floats(0.5, 0.999), st.floats(0.01, 10.0))
def test_the_end_is_where_the_probability_reaches_the_certainty(words: str, certainty: float, pause: float) -> None:
    prior = {FINISHED: 0.85, OPEN: 0.1}.get(words, 0.5)
    waited = silence(words, certainty, pause)
    reached = prior / (prior + (1 - prior) * exp(-waited / pause))
    assert reached == pytest.approx(max(certainty, prior))
    assert waited <= silence(words, 0.999, pause)


@pytest.mark.parametrize(
    "wrong", [{"certainty": 0.4}, {"certainty": 1.0}, {"certainty": float("nan")}, {"pause": 0.0}, {"pause": 11.0}]
)
def test_a_parameter_out_of_range_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(RealizerError, match=next(iter(wrong))):
        SpeechStop(CONTEXT, **wrong)
