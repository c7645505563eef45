"""What tests of constraints that live write: short forms of BML, and scripts of what moves when."""

HIT, GO = "anticipators:t:hit", "anticipators:t:go"
LOST = "cannot be kept any more"
WELL = '<speech id="s"{}><text>Well <sync id="m"/>then, my friend.</text></speech>'
BEAT = '<gesture id="g" lexeme="BEAT"{}/>'


def syncs(points):
    return "".join(f' {sync}="{ref}"' for sync, ref in points.items())


def wait(id_, duration, **points):
    return f'<wait id="{id_}" duration="{duration}"{syncs(points)}/>'


def nod(id_, **points):
    return f'<head id="{id_}" lexeme="NOD"{syncs(points)}/>'


def after(ref, *points):
    return order("after", ref, points)


def before(ref, *points):
    return order("before", ref, points)


def order(kind, ref, points):
    inside = "".join(f'<sync ref="{point}"/>' for point in points)
    return f'<constraint><{kind} ref="{ref}">{inside}</{kind}></constraint>'


def synchronize(*refs):
    return "<constraint><synchronize>" + "".join(f'<sync ref="{ref}"/>' for ref in refs) + "</synchronize></constraint>"


def texts(pilot):
    return [line.element.text for line in pilot.feedback.of("warningFeedback")]


async def moves(pilot, *script):
    """Numbers are seconds to play; pairs are predictions."""
    for step in script:
        if isinstance(step, tuple):
            pilot.predict("t", *step)
        else:
            await pilot.advance(step)
