"""An attentive speaker (thesis 10.4): prepared utterances start at the release that follows their activation."""

import asyncio

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.assembly.scene import SceneOptions
from reactive_realizer.embodiment.audio import AudioMove, AudioStart
from reactive_realizer.testing.feedback_list import FeedbackList
from reactive_realizer.testing.pilot import open_pilot

STRATEGIES = st.sampled_from(["convex", "embr", "smartbody"])
SPEECH = '<speech id="s" start="anticipators:spacebar:release"><text>go <sync id="on"/>on</text></speech>'
NOD = '<head id="n" lexeme="NOD" start="s:on"/>'
LENGTH = 0.3
"""Duration of the speech with the text voice, s."""
COUNT, PLAYED = 6, 6.0
"""Utterances, and the length of a session, s."""
MOMENTS = st.integers(10, round(PLAYED * 100)).map(lambda ticks: ticks / 100)
"""Of events and activations, s: after all utterances are planned."""


async def play(
    strategy: str, releases: list[float], activations: list[float], following: str, **attributes: str
) -> FeedbackList:
    """Play six prepared utterances.

    Args:
        strategy: of scheduling.
        releases: times of the events, s.
        activations: times at which the first utterances are activated, s.
        following: BML in each utterance, with the number of the next one.
        attributes: of each block, with the number of the one before.
    """
    async with open_pilot(SceneOptions(voice="text", strategy=strategy, verify=True)) as pilot:
        for number in range(COUNT):
            others = following.format(next=number + 1) if number + 1 < COUNT else ""
            own = {name.replace("_", ":"): value.format(last=number - 1) for name, value in attributes.items()}
            pilot.block(f"u{number}", SPEECH + NOD + others, **{"bmla:preplan": "true"}, **(own if number else {}))
        inputs = sorted([(time, -1) for time in releases] + [(time, n) for n, time in enumerate(activations)])
        for time, number in inputs:
            await pilot.advance(max(0.0, time - pilot.now))
            if number < 0:
                pilot.event("spacebar", "release")
            else:
                pilot.block(f"go{number}", f'<bmla:activate id="a" target="u{number}"/>')
        await pilot.advance(PLAYED + COUNT - pilot.now)
        return pilot.feedback


def check(told: FeedbackList, number: int, expected: float | None) -> None:
    """Whether an utterance started at an expected time, and was played whole; None if it was not to start."""
    assert told.reached(f"u{number}:s:start") == (expected is not None), number
    if expected is not None:
        start = told.time(f"u{number}:s:start")
        assert expected - 1e-6 <= start <= expected + 0.01 + 1e-6
        assert told.time(f"u{number}:s:end") == pytest.approx(start + LENGTH)
        assert told.time(f"u{number}:n:start") == pytest.approx(told.time(f"u{number}:s:on"))
        assert told.status(f"u{number}") == "DONE"
    assert told.warnings == []


def first(releases: list[float], since: float | None) -> float | None:
    """The first release since a time."""
    return None if since is None else min((time for time in releases if time >= since - 1e-6), default=None)


@settings(max_examples=10)
@given(STRATEGIES, st.lists(MOMENTS, max_size=12), MOMENTS)
def test_each_utterance_starts_at_the_first_release_after_the_end_of_the_one_before(
    strategy: str, releases: list[float], begin: float
) -> None:
    go_on = '<bmla:activate id="next" target="u{next}" start="s:end"/>'
    told = asyncio.run(play(strategy, releases, [begin], go_on))
    since: float | None = begin
    for number in range(COUNT):
        since = first(releases, since)
        check(told, number, since)
        since = None if since is None else told.time(f"u{number}:s:end")


@settings(max_examples=10)
@given(
    STRATEGIES,
    st.lists(MOMENTS, min_size=1, max_size=12),
    st.lists(MOMENTS, min_size=COUNT, max_size=COUNT).map(sorted),
)
def test_a_release_while_the_utterance_before_is_spoken_is_kept(
    strategy: str, releases: list[float], activations: list[float]
) -> None:
    told = asyncio.run(play(strategy, releases, activations, "", bmla_appendAfter="u{last}"))
    end: float | None = 0.0
    for number, activation in enumerate(activations):
        release = first(releases, activation)
        start = None if release is None or end is None else max(release, end)
        check(told, number, start)
        end = None if start is None else told.time(f"u{number}:end")


@pytest.mark.parametrize("release", [1.0, 2.2])
async def test_every_word_of_a_prepared_utterance_is_heard(release: float) -> None:
    """The user stops, with a release, before or after the previous speech has ended."""
    async with open_pilot(SceneOptions(voice="espeak")) as pilot:
        pilot.block("first", '<speech id="s"><text>Let me tell you something.</text></speech>')
        pilot.block("second", SPEECH, composition="APPEND")
        await pilot.advance(release)
        pilot.event("spacebar", "release")
        await pilot.advance(4)
        *_, start = (sound.start for sound in pilot.sounds if isinstance(sound, AudioStart | AudioMove))
        assert start == pytest.approx(max(pilot.feedback.time("second:start"), release))
        assert pilot.feedback.time("second:s:start") == pytest.approx(start)
