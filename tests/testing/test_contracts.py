"""A contract finds what breaks it: each of these is wrong in one way, and the test that says so fails."""

import asyncio
from collections.abc import Callable
from dataclasses import replace
from itertools import count
from types import MappingProxyType

import pytest

from reactive_realizer.bml.behaviors import Wait
from reactive_realizer.engine.effects import Play
from reactive_realizer.engine.engine import DefaultEngine
from reactive_realizer.engine.player import Player
from reactive_realizer.engines.speech.text_voice import TextVoice
from reactive_realizer.engines.wait.wait_engine import WaitEngine
from reactive_realizer.errors import error
from reactive_realizer.pegboard.anticipator import Anticipator
from reactive_realizer.planunit.parameter import Parameter, Range
from reactive_realizer.reactive.cell import Source
from reactive_realizer.testing.anticipator_contract import AnticipatorContract
from reactive_realizer.testing.anticipator_stand import Told
from reactive_realizer.testing.engine_contract import EngineContract
from reactive_realizer.testing.tts_contract import Speaker, TTSContract

ELEMENT = '<wait id="w" duration="1"/>'


def broken(contract: type, test: str, *arguments: object) -> None:
    """Run one test of a contract, which is to fail."""
    with pytest.raises((AssertionError, ArithmeticError, KeyError)):
        getattr(contract(), test)(*arguments)


# --- engines


class TickTimed(WaitEngine):
    """Says when it looked, not when it was."""

    def play(self, tick):
        play = super().play(tick)
        return replace(play, reached=tuple(replace(each, time=tick.time) for each in play.reached))


class Repeating(WaitEngine):
    """Says everything twice."""

    def play(self, tick):
        play = super().play(tick)
        return replace(play, reached=play.reached * 2)


class Hasty(WaitEngine):
    """Plays what it was asked to plan."""

    def plan(self, block, behavior, prepared):
        unit = super().plan(block, behavior, prepared)
        self.player.add(unit)
        return unit


class OneOff(WaitEngine):
    """Has one unit a behavior, for all plans of it."""

    def plan(self, block, behavior, prepared):
        self.made = getattr(self, "made", None) or super().plan(block, behavior, prepared)
        return self.made


class Greedy(WaitEngine):
    """Takes every behavior for its own."""

    def supports(self, behavior):
        return True


class Boastful(WaitEngine):
    """Says that something may be changed that is not there."""

    parameters = MappingProxyType({Wait: {"size": Range(0.0, 1.0)}})


class Resizable(WaitEngine):
    """Lets something be changed."""

    parameters = MappingProxyType({Wait: {"size": Range(0.0, 1.0)}})

    def __init__(self, context):
        super().__init__(context)
        self.graph = context.graph

    def plan(self, block, behavior, prepared):
        unit = super().plan(block, behavior, prepared)
        unit.parameters["size"] = Parameter(unit, Source(self.graph, "size", 1.0), Range(0.0, 1.0))
        return unit


class Meddling(Resizable):
    """Writes while it plays."""

    def play(self, tick):
        for unit in self.player.playing:
            unit.parameters["size"].set(tick.time % 1.0)
        return super().play(tick)


class Sticky(WaitEngine):
    """Keeps the face that it made."""

    weight = 0.0

    def face(self, tick):
        self.weight = 1.0 if self.player.playing else self.weight
        return {"jawOpen": self.weight}


class Moody(WaitEngine):
    """Is never the same."""

    moods = count()

    def face(self, tick):
        return {"jawOpen": next(self.moods) / 1e6}


class Invisible(WaitEngine):
    """Shows what is no number."""

    def face(self, tick):
        return {"jawOpen": float("nan")}


class Silent(WaitEngine):
    """Drops what is too much for it, and does not say so."""

    def add(self, unit):
        if not self.player.units:
            super().add(unit)


class Fragile(WaitEngine):
    """Fails with its units."""

    def __init__(self, context):
        super().__init__(context)
        self.player = Player()
        self.player._fail = self.fall

    def fall(self, unit, failure, now):
        raise failure


class Forgetful(WaitEngine):
    """Does not say whom it lost."""

    def fail(self, time, fault):
        super().fail(time, fault)
        return Play()


class Deaf(WaitEngine):
    """Does not let go, and plays whatever is in its list."""

    def remove(self, unit):
        pass

    def play(self, tick):
        for unit in self.player.units:
            unit.state = type(unit.state).LURKING if not unit.begun else unit.state
        return super().play(tick)


class Impatient(Deaf):
    """Does not wait for blocks."""

    remove = DefaultEngine.remove


def engine_contract(engine: Callable) -> type[EngineContract]:
    class Contract(EngineContract):
        elements = (ELEMENT,)

        def engine(self, context):
            return engine(context)

    return Contract


@pytest.mark.parametrize(
    ("engine", "test", "arguments"),
    [
        (TickTimed, "test_every_point_is_reached_once_in_order_with_the_time_of_its_peg", (1,)),
        (Repeating, "test_every_point_is_reached_once_in_order_with_the_time_of_its_peg", (37,)),
        (Hasty, "test_what_is_not_in_its_plan_is_not_played", ()),
        (OneOff, "test_one_preparation_is_good_for_two_plans", ()),
        (Greedy, "test_it_knows_its_own_behaviors_and_no_others", ()),
        (Boastful, "test_what_may_be_changed_while_it_plays_is_declared_and_may_be_changed", ()),
        (Meddling, "test_playing_writes_nothing", ()),
        (Sticky, "test_what_is_interrupted_is_not_heard_of_again_and_goes_back_to_rest", (0.3,)),
        (Moody, "test_playing_a_tick_again_changes_nothing", ()),
        (Moody, "test_the_same_again_is_the_same", ()),
        (Moody, "test_what_is_removed_before_it_starts_leaves_nothing", ()),
        (Invisible, "test_what_it_shows_can_be_shown", ()),
        (Silent, "test_of_two_at_once_one_is_played_and_the_other_too_or_is_dropped_with_a_reason", ()),
        (Fragile, "test_a_behavior_that_fails_drops_itself_alone_whatever_the_point", ()),
        (Forgetful, "test_when_it_fails_as_a_whole_its_behaviors_are_dropped_and_it_plays_on", ()),
        (Deaf, "test_what_is_removed_before_it_starts_leaves_nothing", ()),
        (Impatient, "test_a_behavior_whose_block_has_not_started_waits_for_it", ()),
    ],
)
def test_an_engine_that_breaks_its_contract_is_found(engine, test, arguments) -> None:
    broken(engine_contract(engine), test, ELEMENT, *arguments)


# --- anticipators


class Clock(Anticipator):
    """Predicts a hit in a second when it is told of a throw."""

    kind = "clock"
    events = ("throw",)

    def event(self, name, value, now):
        if name == "throw":
            self.predict("hit", now + 1.0, now)


class Late(Clock):
    """Says when it was, around the base."""

    def event(self, name, value, now):
        if name == "throw":
            self._board.predicted(self.id, "hit").set(now - 0.1)


class Magic(Clock):
    """Has a number for what it does not know."""

    def forecast(self, sync):
        return -1.0

    def event(self, name, value, now):
        self.predict("hit", None, now)


class Intruder(Clock):
    """Knows when others' points are."""

    def event(self, name, value, now):
        self._board.predicted("other", "hit").set(now + 1.0)


class Trembling(Clock):
    """Predicts anew what it has predicted."""

    def event(self, name, value, now):
        self.calls = getattr(self, "calls", 0) + 1
        self.predict("hit", now + 1.0 + self.calls / 1e6, now)


class Restless(Clock):
    """Predicts as time goes by."""

    def advance(self, now):
        self.predict("hit", now + 1.0, now)


class Excitable(Clock):
    """Takes any event for its own."""

    def check(self, name, value):
        pass


class Lenient(Clock):
    """Refuses nothing."""


class Resentful(Clock):
    """Is another one after it has refused."""

    patience = 1.0

    def check(self, name, value):
        super().check(name, value)
        if value is not None and value < 0:
            self.patience = 2.0
            raise error("not-a-number")

    def event(self, name, value, now):
        self.predict("hit", now + self.patience, now)


class Littering(Clock):
    """Has a name for each event."""

    def event(self, name, value, now):
        self.predict(f"hit{now}", now + 1.0, now)


class Gullible(Clock):
    """Takes predictions from others though it makes its own."""

    def check_prediction(self):
        pass


class Demanding(Clock):
    """Cannot be made without a word."""

    def __init__(self, id, board, word):  # noqa: A002
        super().__init__(id, board)


class Chancy(Clock):
    """Is never the same."""

    chances = count()

    def event(self, name, value, now):
        self.predict("hit", now + 1.0 + next(self.chances) / 1e6, now)


def anticipator_contract(kind: Callable) -> type[AnticipatorContract]:
    class Contract(AnticipatorContract):
        points = ("hit",)
        events = (Told("throw"), Told("throw", 1.0))
        refused = (Told("throw", -1.0),)

        def anticipator(self, id, board):  # noqa: A002
            return kind(id, board, "word") if kind is Demanding else kind(id, board)

    return Contract


@pytest.mark.parametrize(
    ("kind", "test"),
    [
        (Late, "test_no_point_is_ever_set_before_now_and_unknown_is_none"),
        (Magic, "test_a_name_that_it_does_not_know_is_never_known"),
        (Intruder, "test_it_writes_no_points_but_its_own"),
        (Trembling, "test_an_event_that_is_told_twice_at_once_moves_nothing_the_second_time"),
        (Restless, "test_what_is_never_told_anything_changes_nothing_as_time_goes_by"),
        (Resentful, "test_what_it_refuses_is_refused_with_a_reason_and_leaves_it_as_it_was"),
        (Littering, "test_a_thousand_events_a_second_are_taken_and_leave_nothing_lying_about"),
        (Demanding, "test_what_the_human_file_may_say_of_it_are_numbers_and_names_with_defaults"),
        (Chancy, "test_the_same_events_make_the_same_predictions"),
    ],
)
def test_an_anticipator_that_breaks_its_contract_is_found(kind, test) -> None:
    broken(anticipator_contract(kind), test)


@pytest.mark.parametrize(
    ("kind", "test"),
    [
        (Lenient, "test_what_it_refuses_is_refused_with_a_reason_and_leaves_it_as_it_was"),
        (Excitable, "test_events_that_it_does_not_know_are_refused"),
        (Gullible, "test_others_may_say_when_its_points_are_only_if_it_is_of_the_kind_that_is_told"),
    ],
)
def test_an_anticipator_that_refuses_nothing_is_found(kind, test) -> None:
    with pytest.raises(pytest.fail.Exception, match="DID NOT RAISE"):
        getattr(anticipator_contract(kind)(), test)()


# --- voices

TEXT = "Please put the red box on the green table, Dr. Smith."


class Shifted(TextVoice):
    """Counts characters from one."""

    def synthesize(self, text, marks, voice=None):
        said = super().synthesize(text, marks, voice)
        return replace(said, words=tuple(replace(word, first=word.first + 1) for word in said.words))


class Backward(TextVoice):
    """Says the last word first."""

    def synthesize(self, text, marks, voice=None):
        said = super().synthesize(text, marks, voice)
        return replace(said, words=said.words[::-1])


class Markless(TextVoice):
    """Leaves out the marks at the end."""

    def synthesize(self, text, marks, voice=None):
        return super().synthesize(text, tuple(mark for mark in marks if mark[1] < len(text)), voice)


class Tired(TextVoice):
    """Speaks ever slower."""

    spoken = count(1)

    def synthesize(self, text, marks, voice=None):
        said = super().synthesize(text, marks, voice)
        return replace(said, duration=said.duration * next(self.spoken))


class Short(TextVoice):
    """Has too little sound."""

    def synthesize(self, text, marks, voice=None):
        return replace(super().synthesize(text, marks, voice), audio=bytes(100))


class Confused(TextVoice):
    """Answers with what was asked for last."""

    async def synthesize(self, text, marks, voice=None):
        self.asked = text
        await asyncio.sleep(0)
        return super().synthesize(self.asked, marks, voice)


class Unsorted(TextVoice):
    """Lists its voices as they come."""

    async def voices(self):
        return ("b", "a")


class Mute(TextVoice):
    """Never speaks again after it did not know a voice."""

    refused = False

    async def voices(self):
        return ("a",)

    def synthesize(self, text, marks, voice=None):
        self.refused |= voice not in (None, "a")
        if self.refused:
            raise AssertionError("nobody's")
        return super().synthesize(text, marks, voice)


@pytest.mark.parametrize(
    ("voice", "test", "arguments"),
    [
        (Shifted, "test_words_stand_in_the_text_in_its_order_and_begin_in_time", (TEXT,)),
        (Backward, "test_words_stand_in_the_text_in_its_order_and_begin_in_time", (TEXT,)),
        (Markless, "test_a_mark_at_every_place_has_a_time_in_their_order", (TEXT,)),
        (Tired, "test_the_same_text_is_the_same_utterance_whatever_was_said_between", ()),
        (Tired, "test_a_speech_that_is_called_off_leaves_the_next_one_alone", ()),
        (Short, "test_sound_and_sounds_last_as_long_as_the_utterance", (TEXT,)),
        (Confused, "test_what_is_asked_for_at_once_is_not_mixed_up", ()),
        (Unsorted, "test_the_names_of_voices_are_sorted_and_speak", ()),
        (Mute, "test_an_unknown_voice_is_named_in_an_error_and_the_next_text_is_spoken", ()),
    ],
)
def test_a_voice_that_breaks_its_contract_is_found(voice, test, arguments) -> None:
    with asyncio.Runner() as runner:
        broken(TTSContract, test, Speaker(voice(), runner), *arguments)
