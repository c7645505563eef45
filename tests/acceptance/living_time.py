"""What tests of constraints that live write: short forms of BML, and scripts of what moves when."""

from reactive_realizer.testing.pilot import RealizerPilot

HIT, GO = "anticipators:t:hit", "anticipators:t:go"
LOST = "no longer holds"
WELL = '<speech id="s"{}><text>Well <sync id="m"/>then, my friend.</text></speech>'
BEAT = '<gesture id="g" lexeme="BEAT"{}/>'


def syncs(points: dict[str, str]) -> str:
    return "".join(f' {sync}="{ref}"' for sync, ref in points.items())


def wait(id_: str, duration: float, **points: str) -> str:
    return f'<wait id="{id_}" duration="{duration}"{syncs(points)}/>'


def nod(id_: str, **points: str) -> str:
    return f'<head id="{id_}" lexeme="NOD"{syncs(points)}/>'


def brows(id_: str, **points: str) -> str:
    """A behavior without shortest durations."""
    return f'<faceLexeme id="{id_}" lexeme="RAISE_BROWS" amount="1"{syncs(points)}/>'


def after(ref: str, *points: str) -> str:
    return order("after", ref, points)


def before(ref: str, *points: str) -> str:
    return order("before", ref, points)


def order(kind: str, ref: str, points: tuple[str, ...]) -> str:
    inside = "".join(f'<sync ref="{point}"/>' for point in points)
    return f'<constraint><{kind} ref="{ref}">{inside}</{kind}></constraint>'


def synchronize(*refs: str) -> str:
    return "<constraint><synchronize>" + "".join(f'<sync ref="{ref}"/>' for ref in refs) + "</synchronize></constraint>"


def texts(pilot: RealizerPilot) -> list[str]:
    return [line.text for line in pilot.feedback.of("warningFeedback")]


async def moves(pilot: RealizerPilot, *script: float | tuple[str, float | None]) -> None:
    """Numbers are seconds to play; pairs are predictions."""
    for step in script:
        if isinstance(step, tuple):
            pilot.predict("t", *step)
        else:
            await pilot.advance(step)
