"""References to sync points."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.bml.sync_ref import SyncRef
from reactive_realizer.errors import RealizerError
from reactive_realizer.limits import Limits

LIMITS = Limits()

MEANINGS = {
    "3": SyncRef(None, None, None, 3.0),
    "-1": SyncRef(None, None, None, -1.0),
    "- 1": SyncRef(None, None, None, -1.0),
    "+2": SyncRef(None, None, None, 2.0),
    " .5 ": SyncRef(None, None, None, 0.5),
    "2.": SyncRef(None, None, None, 2.0),
    "1e3": SyncRef(None, None, None, 1000.0),
    "bml1:2.5": SyncRef("bml1", None, None, 2.5),
    "bml:start": SyncRef(None, None, None, 0.0),
    "bml:start+1": SyncRef(None, None, None, 1.0),
    "bml1:bml:start": SyncRef("bml1", None, None, 0.0),
    "speech1:start": SyncRef(None, "speech1", "start", 0.0),
    "Speech1:strokeStart": SyncRef(None, "Speech1", "strokeStart", 0.0),
    "g1:end+0.5": SyncRef(None, "g1", "end", 0.5),
    "g1:end + 0.5": SyncRef(None, "g1", "end", 0.5),
    "g1:end -.5": SyncRef(None, "g1", "end", -0.5),
    "g1 : end": SyncRef(None, "g1", "end", 0.0),
    "g1:end+1e-3": SyncRef(None, "g1", "end", 0.001),
    "bml2:g1:relax-1": SyncRef("bml2", "g1", "relax", -1.0),
    "bml:g1:relax": SyncRef(None, "g1", "relax", 0.0),
    "nod1:stroke:2": SyncRef(None, "nod1", "stroke:2", 0.0),
    "nod1:stroke:2 + 1": SyncRef(None, "nod1", "stroke:2", 1.0),
    "bml1:nod1:stroke:12": SyncRef("bml1", "nod1", "stroke:12", 0.0),
    "speech-1:sync-a-0.5": SyncRef(None, "speech-1", "sync-a", -0.5),
    "my-block:speech-1:sync-a": SyncRef("my-block", "speech-1", "sync-a", 0.0),
    "anticipators:metronome:tick3+0.2": SyncRef("anticipators", "metronome", "tick3", 0.2),
    "anticipators:exercise:3": SyncRef("anticipators", "exercise", "3", 0.0),
}


def test_a_reference_is_parsed(subtests: pytest.Subtests) -> None:
    for text, meaning in MEANINGS.items():
        with subtests.test(text):
            assert SyncRef.parse(text, LIMITS) == meaning


def test_a_known_name_that_looks_like_an_offset_is_read_as_a_name() -> None:
    assert SyncRef.parse("speech1:s-1", LIMITS) == SyncRef(None, "speech1", "s", -1.0)
    assert SyncRef.parse("speech1:s-1", LIMITS, {"s-1"}) == SyncRef(None, "speech1", "s-1", 0.0)
    assert SyncRef.parse("speech1:s-1-0.5", LIMITS, {"s-1"}) == SyncRef(None, "speech1", "s-1", -0.5)
    assert SyncRef.parse("speech1:s-1+0", LIMITS) == SyncRef(None, "speech1", "s-1", 0.0)


def test_the_text_of_a_reference_is_unambiguous() -> None:
    assert str(SyncRef(None, "speech1", "s-1", 0.0)) == "speech1:s-1+0"
    assert str(SyncRef("b", "speech1", "end", -2.0)) == "b:speech1:end-2"
    assert str(SyncRef.parse("-0", LIMITS)) == "0"


NO_REFERENCES = [
    "",
    " ",
    "speech1",
    ":",
    "speech1:",
    ":start",
    "speech1:start+",
    "speech1:start+x",
    "speech1:start+nan",
    "speech1:st art",
    "a:b:c:d",
    "a:b:c:stroke:1",
    "nan",
    "inf",
    "-infinity",
    "1_000",
    "٣",
    "1,5",
    "x:stroke:" + "9" * 5_000,
    "x:y" + " " * 100_000 + "z",
]


def test_a_text_that_is_not_a_reference_is_refused(subtests: pytest.Subtests) -> None:
    for text in NO_REFERENCES:
        with subtests.test(repr(text[:20])):
            with pytest.raises(RealizerError) as refused:
                SyncRef.parse(text, LIMITS)
            assert refused.value.fault.code == "not-a-reference"


ENDS_OF_ITS_BLOCK = ["bml:end", "bml:relax", "b:bml:end", "b:end", "b:stroke", "b1:bml:attackPeak", "bml:bml:relax"]


def test_a_reference_to_the_end_of_its_own_block_is_refused(subtests: pytest.Subtests) -> None:
    for text in ENDS_OF_ITS_BLOCK:
        with subtests.test(text):
            with pytest.raises(RealizerError) as refused:
                SyncRef.parse(text, LIMITS).read_in("b", {"g1"})
            assert refused.value.fault.code == "only-block-start"


BLOCK_POINTS = {
    "b1:start": SyncRef("b1", None, None),
    "b1:start+1": SyncRef("b1", None, None, 1.0),
    "b1:relax": SyncRef("b1", None, "relax"),
    "b1:end - 0.5": SyncRef("b1", None, "end", -0.5),
    "b1:bml:end": SyncRef("b1", None, "end"),
    "g1:bml:end": SyncRef("g1", None, "end"),
    "b:start": SyncRef(None, None, None),
    "b:1": SyncRef(None, None, None, 1.0),
    "g1:end": SyncRef(None, "g1", "end"),
    "g1:stroke": SyncRef(None, "g1", "stroke"),
    "g2:stroke": SyncRef("g2", None, "stroke"),
    "b1:bml:ready": SyncRef("b1", None, "ready"),
    "g2:attackPeak": SyncRef(None, "g2", "attackPeak"),
    "b1:g1:end": SyncRef("b1", "g1", "end"),
}


def test_behaviors_of_the_own_block_take_precedence_over_other_blocks(subtests: pytest.Subtests) -> None:
    for text, meaning in BLOCK_POINTS.items():
        with subtests.test(text):
            assert SyncRef.parse(text, LIMITS).read_in("b", {"g1"}) == meaning


def test_the_text_of_a_point_of_a_block_has_no_bml() -> None:
    assert str(SyncRef("b1", None, "relax", 0.5)) == "b1:relax+0.5"
    assert str(SyncRef("b1", None, None, 0.25)) == "b1:start+0.25"
    assert str(SyncRef("b1", None, None)) == "b1:start"


def test_an_offset_above_the_limit_is_refused(subtests: pytest.Subtests) -> None:
    for text in ["1e999", "-86401", "g1:end+1e9", "bml1:100000"]:
        with subtests.test(text):
            with pytest.raises(RealizerError) as refused:
                SyncRef.parse(text, LIMITS)
            assert refused.value.fault.code == "absurd-time"


ids = st.from_regex(r"[A-Za-z_][A-Za-z0-9_.-]{0,12}", fullmatch=True).filter(lambda name: name not in {"bml", "stroke"})
offsets = st.floats(-LIMITS.time_seconds, LIMITS.time_seconds).map(lambda seconds: seconds + 0.0)
points = ids | st.integers(1, 9999).map(lambda number: f"stroke:{number}")
absolute = st.builds(SyncRef, st.none() | ids, st.none(), st.none(), offsets)
relative = st.builds(SyncRef, st.none() | ids, ids, points, offsets | st.just(0.0))


def read_in_a_block(read: SyncRef, written: SyncRef) -> SyncRef:
    """The reference as read in a block that has its behavior."""
    return read.read_in("stands-here", {written.behavior} if written.behavior else ())


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@settings(derandomize=True, max_examples=300)
@given(absolute | relative)
def test_the_text_of_a_reference_is_parsed_to_the_same_reference(ref: SyncRef) -> None:
    assert read_in_a_block(SyncRef.parse(str(ref), LIMITS), ref) == ref


@pytest.mark.no_cover  # others cover the same lines, and tracing so many cases takes long
@settings(derandomize=True, max_examples=300)
@given(st.text() | st.text("ab1:+-. e", max_size=20))
def test_any_text_is_parsed_or_raises_a_realizer_error(text: str) -> None:
    try:
        ref = SyncRef.parse(text, LIMITS)
    except RealizerError:
        return
    assert read_in_a_block(SyncRef.parse(str(ref), LIMITS), ref) == read_in_a_block(ref, ref)
