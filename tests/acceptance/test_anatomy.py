"""Arms keep the limits of joints of people, from frames."""

from reactive_realizer.testing.motion_laws import arm_ranges
from reactive_realizer.testing.pilot import RealizerPilot

LEXEMES = ("OFFER", "REFUSE", "CONDUIT", "SELF", "WAVE", "ONE", "CONTAINER", "FLICK", "CHOP", "HEART", "GREET")


async def test_forearms_and_hands_keep_their_limits_in_all_gestures_and_between_them(still: RealizerPilot) -> None:
    for mode in ("LEFT_HAND", "RIGHT_HAND"):
        for lexeme in LEXEMES:
            hand = "" if lexeme == "HEART" else f'mode="{mode}"'
            still.block(f"{lexeme}{mode}", f'<gesture id="g" lexeme="{lexeme}" {hand}/>', composition="REPLACE")
            await still.advance(1.3)
    assert still.feedback.warnings == []
    ranges = arm_ranges(still.bodies())
    assert max(ranges["pronation_deg"], ranges["supination_deg"]) < 85
    assert ranges["radial_deg"] < 25
    assert ranges["ulnar_deg"] < 35
