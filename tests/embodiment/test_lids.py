"""The lids of a frame, from expressions, gaze and blinks."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reactive_realizer.embodiment.lids import with_lids

SHARE = st.floats(0.0, 1.0)


@given(SHARE, SHARE)
def test_a_blink_closes_what_the_expression_leaves_open_and_opens_no_more(own: float, blink: float) -> None:
    closed = with_lids({"eyeBlinkLeft": own}, {}, {"eyeBlinkLeft": blink})["eyeBlinkLeft"]
    assert max(own, blink) <= closed + 1e-12 <= 1.0 + 2e-12
    assert with_lids({"eyeBlinkLeft": own}, {}, {})["eyeBlinkLeft"] == pytest.approx(own)


@pytest.mark.parametrize(
    ("face", "blink"), [({"eyeBlinkLeft": 0.4}, {}), ({}, {"eyeBlinkLeft": 0.4}), ({"eyeBlinkLeft": 1.0}, {})]
)
def test_as_far_as_lids_are_closed_they_neither_follow_the_gaze_nor_are_wide(
    face: dict[str, float], blink: dict[str, float]
) -> None:
    gaze = {"eyeLookDownLeft": 0.5, "eyeLookDownRight": 0.5}
    lids = with_lids({**face, "eyeWideLeft": 0.3}, gaze, blink)
    opened = 1.0 - lids["eyeBlinkLeft"]
    assert lids["eyeLookDownLeft"] == pytest.approx(0.5 * opened)
    assert lids["eyeWideLeft"] == pytest.approx(0.3 * opened)
    assert lids["eyeLookDownRight"] == 0.5


def test_without_a_closed_lid_face_and_gaze_add_up() -> None:
    face = {"eyeWideLeft": 0.2, "jawOpen": 0.4}
    assert with_lids(face, {"eyeWideLeft": 0.5}, {}) == {"eyeWideLeft": 0.7, "jawOpen": 0.4}
