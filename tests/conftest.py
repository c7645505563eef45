"""What the tests of every room share: the browser, and real input that lies beside the checkout."""

import os
import shutil
from pathlib import Path

import pytest
from hypothesis import settings

from reactive_realizer.server.routes_page import STATIC

# So that an assertion of a contract says what it compared.
pytest.register_assert_rewrite(
    *(f"reactive_realizer.testing.{kind}_contract" for kind in ("anticipator", "engine", "strategy", "tts"))
)

# The same examples on every run and machine, however slow it is.
settings.register_profile("same", derandomize=True, deadline=None, database=None)
settings.load_profile("same")

SHARED_CASES = Path(__file__).resolve().parents[2] / "shared" / "cases"
WITHOUT_BROWSER = os.environ.get("BROWSER") == "none"


def pytest_report_header() -> list[str]:
    return ["BROWSER=none: the browser tests are left out"] if WITHOUT_BROWSER else []


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if not WITHOUT_BROWSER:
        return
    left_out = [item for item in items if item.get_closest_marker("browser")]
    items[:] = [item for item in items if item not in left_out]
    config.hook.pytest_deselected(items=left_out)


@pytest.fixture(scope="session")
def chromium() -> str:
    """The path of a Chromium to show the page: $BROWSER if it names one, else the first on the PATH."""
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
def shared_cases() -> Path:
    """The BML scripts and bindings of other realizers, which may lie beside the checkout and are not ours to commit."""
    if not SHARED_CASES.is_dir():
        pytest.skip("no ../shared/cases beside this checkout")
    return SHARED_CASES


@pytest.fixture(scope="session")
def tests_data() -> Path:
    """Our own data for tests."""
    return Path(__file__).parent / "data"
