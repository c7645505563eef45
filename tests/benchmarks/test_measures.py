"""Each benchmark has all its numbers, or None, under the names that the pages use."""

import importlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

from reactive_realizer.engines.speech.piper.voice import PLACE

ROOT = Path(__file__).parents[2]

SIZES = ("10", "1000", "100000")
SMALLEST: dict[str, dict[str, Any]] = {
    "animation": {"most": 1},
    "endurance": {"hours": 0.004},
    "generated": {"blocks": 1},
    "idle": {"seconds": 0.05, "most": 1},
    "latency": {"runs": 2},
    "load": {"seconds": 0.05, "behaviors": 20, "viewers": 2},
    "motion": {"scenes": 2},
    "physics": {"seconds": 0.05, "most": 1},
    "propagation": {"largest": 1000},
    "punctuality": {"seconds": 0.5},
    "scheduling": {"most": 2},
    "session": {"blocks": 4},
    "speech": {"runs": 1, "texts": {words: words + " {}" for words in ("5", "11", "60")}},
}
KEYS: dict[str, set[str]] = {
    "animation": {*(f"us_per_character_frame.{n}" for n in ("1", "10", "50", "100")), "characters_at_50fps", "walk_us"},
    "endurance": {"blocks", "objects.1", "drift_s"},
    "generated": {
        *(f"{strategy}.blocks" for strategy in ("convex", "embr", "smartbody")),
        *(
            f"{strategy}.broken.{law}"
            for strategy in ("convex", "embr", "smartbody")
            for law in ("order", "before_block", "past", "prediction", "equation", "unnamed", "endless", "escape")
        ),
    },
    "idle": {"posts_per_s", *(f"cpu_ms_per_s.{n}" for n in ("0", "1", "100"))},
    "latency": {"tick_ms", *(f"{what}_ms.{part}" for what in ("predict", "activate") for part in ("p50", "p99"))},
    "load": {
        *(
            f"{what}.{load}"
            for what in ("tick_p99_ms", "tick_cpu_ms")
            for load in ("nothing", "chain_1000", "burst_50_blocks", "parallel_1000", "predict_1000", "postures_20")
        ),
        *(
            f"{audience}.{what}"
            for audience in ("viewers_200", "viewers_500", "characters_10")
            for what in ("cpu_share", "frames_arrived", "late_p99_ms")
        ),
    },
    "motion": {
        *(
            f"{law}.{part}"
            for law in ("wrist_m_s2", "wrist_rad_s2", "elbow_rad_s2", "head_deg_s", "hand_depth_cm")
            for part in ("p50", "p90", "p99", "max")
        ),
        *(f"{way}_deg" for way in ("pronation", "supination", "radial", "ulnar")),
        *(f"walking.{law}.{part}" for law in ("wrist_m_s2", "foot_slide_cm") for part in ("p50", "p90", "p99", "max")),
    },
    "physics": {
        *(f"momentum_error.{whose}.{step}" for whose in ("ours", "all_physical") for step in ("5", "2.5", "1")),
        *(
            f"momentum_error.baseline.{step}.{setting}"
            for step in ("5", "2.5", "1")
            for setting in ("as_published", "k_0.5", "averaged_0.3", "averaged_0.15")
        ),
        *(f"us_per_tick.{crowd}.{what}" for crowd in ("1", "10", "30", "100") for what in ("one_thread", "all")),
        *(f"realtime_characters.{step}" for step in ("2.5", "5")),
        "switch_jump.rad",
        "switch_jump.rad_s",
    },
    "propagation": {
        *(f"{whose}_ns.{shape}.{n}" for whose in ("cell", "reactivex") for shape in ("fanout", "chain") for n in SIZES),
        "block_move_1000_ms",
        "offset_chain_us.1",
        "offset_chain_us.10",
    },
    "punctuality": {"tick_ms", *(f"{crowd}.{part}_ms" for crowd in ("1", "20") for part in ("p50", "p99"))},
    "scheduling": {
        *(
            f"strategies.{name}.{n}.{part}_ms"
            for name in ("smartbody", "embr", "convex")
            for n in ("1", "5", "20", "100")
            for part in ("median", "p99")
        ),
        *(f"chain.{n}" for n in ("10", "50", "100", "200")),
    },
    "session": {"first_100_ms", "last_100_ms", "retained_bytes_per_block"},
    "speech": {
        "loop_lag_p99_ms",
        *(
            f"{voice}.{when}.{words}.{what}_ms"
            for voice in ("espeak", "kokoro")
            for when in ("cold", "cached", "prepared")
            for words in ("5", "11", "60")
            for what in ("first_audio", "plan")
        ),
    },
}
SPEAKING = {"speech": pytest.mark.kokoro}


@pytest.mark.parametrize("name", [pytest.param(name, marks=SPEAKING.get(name, ())) for name in SMALLEST])
def test_a_benchmark_has_all_its_numbers_and_aims_only_for_these(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(ROOT)
    monkeypatch.delenv(PLACE, raising=False)
    module = importlib.import_module(f"benchmarks.{name}")
    numbers = dict(_numbers(module.measure(**SMALLEST[name])))
    assert numbers.keys() == KEYS[name]
    assert all(value is None or value >= 0.0 for key, value in numbers.items() if "retained" not in key)
    assert set(module.AIMS) <= numbers.keys()


def test_every_benchmark_is_tested() -> None:
    modules = {path.stem for path in (ROOT / "benchmarks").glob("*.py") if not path.stem.startswith("_")}
    assert modules == {*SMALLEST, "lipsync"}, "lipsync, which needs a browser, is tested in tests/browser"


def _numbers(result: Mapping[str, object], prefix: str = "") -> Iterator[tuple[str, float | None]]:
    for key, value in result.items():
        if isinstance(value, Mapping):
            yield from _numbers(value, f"{prefix}{key}.")
        else:
            assert value is None or isinstance(value, int | float)
            yield prefix + key, value
