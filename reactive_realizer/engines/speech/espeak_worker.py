"""The speech worker, ``python -m`` of this module: answers requests until its input ends.

Its first message lists the voices. It forks a child for each request, always from the same initial state: so the same
text gives the same bytes, which espeak-ng does not guarantee for the second utterance of a process, and a text that
crashes the library ends only one child.
"""

import os
import signal
import traceback
from collections.abc import Callable
from functools import partial

from reactive_realizer.engines.speech.espeak_library import EspeakLibrary
from reactive_realizer.engines.speech.worker_messages import WorkerMessage, WorkerPipe, failure

_TIME_LIMIT = 5
"""Time limit of one child, s, shorter than that of the worker; the longest text allowed takes less than one."""


def main() -> None:
    """Answers the requests on standard input, in order, on standard output."""
    pipe = WorkerPipe()
    library = EspeakLibrary()
    pipe.send(WorkerMessage({"voices": library.voices(), "variants": library.variants()}).encode())
    for request in pipe.requests():
        pipe.send(_in_child(partial(_speak, library, request)))


def _speak(library: EspeakLibrary, request: WorkerMessage) -> bytes:
    spoken = library.synthesize(request.header["ssml"], request.header["voice"])
    times = {"words": spoken.words, "marks": spoken.marks, "phonemes": spoken.phonemes}
    return WorkerMessage({"sample_rate": library.sample_rate, **times}, bytes(spoken.audio)).encode()


def _in_child(work: Callable[[], bytes]) -> bytes:
    """The result of work done in a child process, or the failure of that process."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        _be_child(work, writing)
    os.close(writing)
    with open(reading, "rb") as pipe:
        answer = pipe.read()
    exit_status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return answer if exit_status == 0 else failure(exit_status).encode()


def _be_child(work: Callable[[], bytes], writing: int) -> None:
    exit_status = 1
    try:
        signal.setitimer(signal.ITIMER_REAL, _TIME_LIMIT)
        with open(writing, "wb") as pipe:
            pipe.write(work())
        exit_status = 0
    except BrokenPipeError:
        pass  # the worker was killed
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(exit_status)  # the child must not return to the loop of its parent


if __name__ == "__main__":
    main()
