"""The voice espeak-ng: times of its utterances, and isolation of its process."""

import asyncio
import os
import signal
import subprocess
import sys
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from reactive_realizer.engine.asking_client import asked_by
from reactive_realizer.engine.tts import Utterance, completed
from reactive_realizer.engines.speech.espeak_voice import EspeakVoice
from reactive_realizer.engines.speech.worker_messages import MessageDecoder
from reactive_realizer.engines.speech.worker_process import WorkerProcess
from reactive_realizer.errors import RealizerError

pytestmark = pytest.mark.speech

SENTENCE = "Please put the red box on the green table, Dr. Smith."
LONG = "hello world " * 400


@pytest.fixture
async def voice() -> AsyncIterator[EspeakVoice]:
    voice = EspeakVoice()
    await voice.start()
    yield voice
    await voice.close()


async def spoken(voice: EspeakVoice, text: str, voice_name: str | None = None, **marks: int) -> Utterance:
    return await completed(voice.synthesize(text, tuple(marks.items()), voice_name))


async def test_every_word_starts_before_the_end_of_the_audio(voice: EspeakVoice) -> None:
    utterance = await spoken(voice, SENTENCE)
    starts = [word.start for word in utterance.words]
    assert [word.text for word in utterance.words] == [word.strip(".,") for word in SENTENCE.split()]
    assert starts == sorted(set(starts))
    assert starts[0] == 0.0
    assert starts[-1] < utterance.duration


async def test_a_mark_has_the_time_of_its_word(voice: EspeakVoice) -> None:
    utterance = await spoken(voice, SENTENCE, red=SENTENCE.index("red"), table=SENTENCE.index("table"))
    times = {word.text: word.start for word in utterance.words}
    assert dict(utterance.marks) == {"red": times["red"], "table": times["table"]}


async def test_phonemes_cover_the_whole_utterance(voice: EspeakVoice) -> None:
    phonemes = (await spoken(voice, "Red box.")).phonemes
    assert "".join(phoneme.symbol for phoneme in phonemes) == "ɹˈɛdbˈɑːks"  # noqa: RUF001
    assert all(phoneme.duration >= 0.0 for phoneme in phonemes)


async def test_the_same_text_gives_the_same_bytes_in_another_worker(voice: EspeakVoice) -> None:
    other = EspeakVoice()
    try:
        assert await spoken(other, SENTENCE) == await spoken(voice, SENTENCE)
    finally:
        await other.close()


async def test_the_audio_does_not_depend_on_when_the_worker_was_started() -> None:
    """The breath of a voice is random noise, by default seeded with the second in which the worker starts."""
    heard = set()
    for _ in range(2):
        voice = EspeakVoice()
        try:
            heard.add((await spoken(voice, SENTENCE, "en-us+f3")).audio)
            await asyncio.sleep(1.0)  # until another second
        finally:
            await voice.close()
    assert len(heard) == 1


async def test_another_voice_gives_other_audio(voice: EspeakVoice) -> None:
    default = await spoken(voice, SENTENCE)
    variant = await spoken(voice, SENTENCE, "EN-US+f3")
    scottish = await spoken(voice, SENTENCE, "en-gb-scotland")
    assert len({default.audio, variant.audio, scottish.audio}) == 3


async def test_the_voices_can_be_listed(voice: EspeakVoice) -> None:
    assert {"en-us", "en-gb", "nl"} <= set(await voice.voices())


@pytest.mark.parametrize("name", ["klingon!", "en-us+nobody", "../../etc/passwd", "en-us+../x", "+f3"])
async def test_the_error_of_an_unknown_voice_lists_known_ones(voice: EspeakVoice, name: str) -> None:
    with pytest.raises(RealizerError) as failure:
        await spoken(voice, "hello", name)
    assert failure.value.fault.code == "unknown-voice"
    assert f"'{name}'" in str(failure.value)
    assert "en-us" in str(failure.value)


async def test_killing_the_worker_fails_the_request_that_it_works_on_and_a_new_one_answers_the_others(
    voice: EspeakVoice,
) -> None:
    pending = [asyncio.ensure_future(spoken(voice, LONG)) for _ in range(3)]
    await until_sent(voice)
    os.kill(worker_of(voice), signal.SIGKILL)
    failed, *others = await asyncio.gather(*pending, return_exceptions=True)
    assert isinstance(failed, RealizerError)
    assert (failed.fault.code, failed.fault.details["reason"]) == ("voice-failed", "SIGKILL")
    assert all(isinstance(other, Utterance) for other in others)
    assert (voice.worker.alive, voice.worker.restarts) == (True, 1)


async def test_closing_the_voice_fails_all_requests_and_starts_no_worker(voice: EspeakVoice) -> None:
    pending = [asyncio.ensure_future(spoken(voice, LONG)) for _ in range(3)]
    await until_sent(voice)
    await voice.close()
    outcomes = await asyncio.gather(*pending, return_exceptions=True)
    assert all(isinstance(outcome, RealizerError) for outcome in outcomes)
    assert (voice.worker.alive, voice.worker.restarts) == (False, 0)


async def test_killing_an_idle_worker_fails_no_request(voice: EspeakVoice) -> None:
    os.kill(worker_of(voice), signal.SIGKILL)
    await process_of(voice).ended
    assert (await spoken(voice, "hello")).audio
    assert voice.worker.restarts == 1


async def test_two_requests_after_the_end_of_a_worker_start_one_new_worker(voice: EspeakVoice) -> None:
    os.kill(worker_of(voice), signal.SIGKILL)
    await process_of(voice).ended
    await asyncio.gather(spoken(voice, "one"), spoken(voice, "two"))
    assert voice.worker.restarts == 1


async def test_a_worker_that_hangs_is_killed_and_a_new_one_answers_the_next_request() -> None:
    voice = EspeakVoice(patience=1.0)
    await voice.start()
    try:
        os.kill(worker_of(voice), signal.SIGSTOP)
        async with asyncio.timeout(20):
            one, two = await asyncio.gather(spoken(voice, "one"), spoken(voice, "two"), return_exceptions=True)
        assert isinstance(one, RealizerError)
        assert (one.fault.code, one.fault.details["reason"]) == ("voice-failed", "no answer")
        assert isinstance(two, Utterance)
        assert voice.worker.restarts == 1
    finally:
        await voice.close()


async def test_the_time_limit_of_the_worker_is_for_each_reply(voice: EspeakVoice) -> None:
    process = process_of(voice)
    first, second = (process.request({"ssml": "<speak>one</speak>", "voice": "gmw/en"}) for _ in range(2))
    deadline = process._watch.when()
    await first
    assert process._watch.when() > deadline
    await second
    assert process._watch.cancelled()


async def test_killing_a_child_fails_one_utterance_and_the_worker_goes_on(voice: EspeakVoice) -> None:
    pending, later = asyncio.ensure_future(spoken(voice, LONG)), asyncio.ensure_future(spoken(voice, "hello"))
    os.kill(await child_of(worker_of(voice)), signal.SIGKILL)
    with pytest.raises(RealizerError) as failure:
        await pending
    assert failure.value.fault.details["reason"] == "SIGKILL"
    assert (await later).audio
    assert (voice.worker.alive, voice.worker.restarts) == (True, 0)


async def test_canceling_a_request_does_not_affect_the_others(
    voice: EspeakVoice, caplog: pytest.LogCaptureFixture
) -> None:
    canceled, other = asyncio.ensure_future(spoken(voice, LONG)), asyncio.ensure_future(spoken(voice, "one two"))
    await child_of(worker_of(voice))
    canceled.cancel()
    assert [word.text for word in (await other).words] == ["one", "two"]
    assert caplog.text == ""


async def test_a_request_canceled_while_it_waits_is_never_sent(
    voice: EspeakVoice, monkeypatch: pytest.MonkeyPatch
) -> None:
    transport = process_of(voice)._transport
    pipe = transport.get_pipe_transport(0)
    assert isinstance(pipe, asyncio.WriteTransport)
    asked: list[bytes] = []
    first_asked, write = asyncio.Event(), pipe.write

    def note(request: bytes) -> None:
        asked.append(request)
        first_asked.set()
        write(request)

    monkeypatch.setattr(pipe, "write", note)
    first, *others = [asyncio.ensure_future(spoken(voice, text)) for text in ("one", LONG, LONG, "two")]
    await first_asked.wait()
    for speech in others[:2]:
        speech.cancel()
    await asyncio.gather(first, others[-1])
    assert len(asked) == 2


async def test_clients_take_turns(voice: EspeakVoice) -> None:
    spoken_in_order = list[str]()

    async def speak(client: str, number: int) -> None:
        await spoken(voice, f"{client} {number}.")
        spoken_in_order.append(client)

    async with asyncio.TaskGroup() as group:
        for client, many in (("first", 6), ("second", 2), ("third", 1)):
            with asked_by(client):
                for number in range(many):
                    group.create_task(speak(client, number))
    # The first one was sent before there were others.
    assert spoken_in_order == ["first", "first", "second", "third", "first", "second", *["first"] * 3]


async def test_a_closed_voice_has_no_process(voice: EspeakVoice) -> None:
    worker = worker_of(voice)
    await voice.close()
    assert not voice.worker.alive
    with pytest.raises(ProcessLookupError):
        os.kill(worker, 0)


async def test_the_error_without_the_package_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reactive_realizer.engines.speech.espeak_voice.find_spec", lambda name: None)
    with pytest.raises(RealizerError) as failure:
        await EspeakVoice().start()
    assert "reactive-realizer[espeak]" in str(failure.value)


def test_a_child_that_hangs_is_killed() -> None:
    hang = (
        "import signal, sys; from reactive_realizer.engines.speech import espeak_worker as worker; "
        "worker._TIME_LIMIT = 0.01; sys.stdout.buffer.write(worker._in_child(signal.pause))"
    )
    answer = subprocess.run([sys.executable, "-c", hang], check=True, stdout=subprocess.PIPE).stdout
    assert [message.header for message in MessageDecoder().feed(answer)] == [{"failed": "SIGALRM"}]


def test_the_worker_ends_when_its_input_ends() -> None:
    command = [sys.executable, "-m", "reactive_realizer.engines.speech.espeak_worker"]
    assert subprocess.run(command, check=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL).returncode == 0


def test_only_the_worker_loads_the_library() -> None:
    check = "import sys, reactive_realizer.engines.speech.espeak_voice; sys.exit('espeakng_loader' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", check], check=False).returncode == 0


async def until_sent(voice: EspeakVoice) -> None:
    """Let tasks send their requests, the first of which the worker answers."""
    for _ in range(20):
        await asyncio.sleep(0)
    assert process_of(voice).busy


def process_of(voice: EspeakVoice) -> WorkerProcess:
    assert voice.worker.process
    return voice.worker.process


def worker_of(voice: EspeakVoice) -> int:
    return process_of(voice).pid


async def child_of(process: int) -> int:
    """The child of a worker, as soon as there is one."""
    while not (children := children_of(process)):  # noqa: ASYNC110 - nothing signals a fork
        await asyncio.sleep(0)
    return children[0]


def children_of(process: int) -> list[int]:
    return [int(child) for child in Path(f"/proc/{process}/task/{process}/children").read_text().split()]
