"""Gestures of EMBOTS: the sync points in the comments of a script, and what is no part of the gesture."""

import pytest

from reactive_realizer.bml.embr.lexeme import read_lexeme
from reactive_realizer.bml.vocabulary import BodyGroup
from reactive_realizer.errors import RealizerError

RIGHT = "BEGIN POSITION_CONSTRAINT\nBODY_GROUP:rarm\nJOINT:rhand\nTARGET:-0.1;-0.25;{}\nEND"
LEFT = "BEGIN POSITION_CONSTRAINT\nBODY_GROUP:larm\nJOINT:lhand\nTARGET:0.1;-0.25;{}\nEND"


def script(*poses: tuple[str, int, int, str]) -> str:
    """A script of poses: label, time and hold in ms, constraints."""
    written = (
        f"BEGIN K_POSE {f'# --- SYNC:{label}' if label else ''}\nTIME_POINT:+{time}\nHOLD:{hold}\n{inside}\nEND"
        for label, time, hold, inside in poses
    )
    return "\n".join(["BEGIN K_POSE_SEQUENCE # --- LEXEME:x", *written, "END"])


STROKE = script(
    ("start", 200, 0, RIGHT.format(-0.3)),
    ("ready", 700, 100, RIGHT.format(0.1)),
    ("", 1000, 0, RIGHT.format(0.2)),
    ("stroke_end", 1300, 200, RIGHT.format(0.3)),
    ("end", 2000, 0, RIGHT.format(-0.3)),
)
HOLD = script(
    ("start", 200, 40, RIGHT.format(-0.3)), ("ready", 600, 900, RIGHT.format(0.1)), ("end", 2000, 0, RIGHT.format(-0.3))
)


def test_a_stroke_is_between_the_holds_of_two_poses_and_times_count_from_the_start() -> None:
    lexeme = read_lexeme(STROKE)
    assert lexeme.points == {"ready": 0.5, "strokeStart": 0.6, "strokeEnd": 1.1, "relax": 1.3}
    assert lexeme.holds == ((0.5, 0.6), (0.8, 0.8), (1.1, 1.3))
    assert lexeme.notes == ()


def test_rest_poses_are_left_out() -> None:
    (arm,) = read_lexeme(STROKE).groups
    assert [pose.time for pose in arm.poses] == [0.5, 0.8, 1.1]


def test_the_hold_of_a_gesture_without_a_stroke_is_its_stroke() -> None:
    assert read_lexeme(HOLD).points == {"ready": 0.4, "strokeEnd": 1.3, "relax": 1.3}


def test_written_points_come_before_implied_ones() -> None:
    lexeme = read_lexeme(
        script(
            ("ready", 500, 100, RIGHT.format(0.1)),
            ("stroke_start", 700, 0, RIGHT.format(0.2)),
            ("stroke", 900, 0, RIGHT.format(0.3)),
            ("stroke_end", 1200, 100, RIGHT.format(0.2)),
            ("relax", 1500, 0, RIGHT.format(0.1)),
        )
    )
    times = {"ready": 0.5, "strokeStart": 0.7, "stroke": 0.9, "strokeEnd": 1.2, "relax": 1.5}
    assert lexeme.points == times


def test_each_body_group_has_the_poses_that_have_its_constraints() -> None:
    both = f"{RIGHT.format(0.1)}\n{LEFT.format(0.1)}"
    groups = read_lexeme(script(("ready", 500, 0, both), ("stroke_end", 900, 0, LEFT.format(0.2)))).groups
    assert {each.group: len(each.poses) for each in groups} == {BodyGroup.RIGHT_ARM: 1, BodyGroup.LEFT_ARM: 2}


def test_labels_that_several_poses_have_are_named() -> None:
    poses = (
        ("start", 100, 0, RIGHT.format(-0.3)),
        ("start", 200, 0, RIGHT.format(-0.2)),
        ("ready", 700, 100, RIGHT.format(0.1)),
        ("ready", 1000, 100, RIGHT.format(0.2)),
        ("end", 2000, 0, RIGHT.format(-0.3)),
    )
    lexeme = read_lexeme(script(*poses))
    assert [(note.line, note.sentence) for note in lexeme.notes] == [
        (11, "SYNC:start is given twice; the first one counts"),
        (29, "SYNC:ready is given twice; this one counts"),
    ]
    assert lexeme.points["ready"] == 0.9


def test_an_unknown_label_and_a_face_are_named_with_their_lines_and_the_rest_is_read() -> None:
    smile = "BEGIN MORPH_TARGET\nMORPH_KEY:ExpSmileClosed\nMORPH_VALUE:1\nEND"
    lexeme = read_lexeme(script(("raedy", 500, 0, f"{RIGHT.format(0.1)}\n{smile}")))
    assert sorted((note.line, note.code) for note in lexeme.notes) == [
        (2, "embr-unknown-name"),
        (10, "embr-not-realized"),
    ]
    assert lexeme.points == {}
    assert len(lexeme.groups) == 1


@pytest.mark.parametrize("text", ["", "TIME_RESET", script(), script(("ready", 500, 0, ""))])
def test_a_file_without_a_gesture_is_refused(text: str) -> None:
    with pytest.raises(RealizerError) as refused:
        read_lexeme(text)
    assert refused.value.fault.code == "embr-no-sequence"


def test_a_pose_with_a_bad_time_and_a_second_sequence_are_named() -> None:
    lexeme = read_lexeme(STROKE.replace("+1000", "nan") + "\n" + HOLD)
    assert [(note.line, note.code) for note in sorted(lexeme.notes, key=lambda note: note.line or 0)] == [
        (21, "embr-bad-value"),
        (48, "embr-not-realized"),
    ]
    assert lexeme.points == {"ready": 0.5, "strokeStart": 0.6, "strokeEnd": 1.1, "relax": 1.3}


def test_a_file_whose_poses_all_have_a_fault_is_refused_with_the_first_one() -> None:
    with pytest.raises(RealizerError) as refused:
        read_lexeme(script(("ready", 500, 0, RIGHT.format(0.1).replace("rarm", "rleg"))))
    assert (refused.value.fault.code, refused.value.fault.line) == ("embr-unknown-name", 6)


def test_a_file_may_begin_with_a_mark_of_its_encoding() -> None:
    assert read_lexeme(STROKE.encode("utf-8-sig")) == read_lexeme(STROKE)


def test_a_gesture_with_too_many_poses_is_refused() -> None:
    with pytest.raises(RealizerError, match="201 poses; at most 200"):
        read_lexeme(script(*(("", 100 * number, 0, RIGHT.format(0.1)) for number in range(1, 202))))
