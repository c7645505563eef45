"""Chooses the prints of a walking figure's feet, and how long each foot stands."""

import math

from reactive_realizer.clock.units import GlobalTime
from reactive_realizer.embodiment.place import Place, between_headings
from reactive_realizer.embodiment.vector import distance, subtract
from reactive_realizer.engines.animation.walking.manner import WALK
from reactive_realizer.engines.animation.walking.progression import Progression
from reactive_realizer.engines.animation.walking.walking_foot import FootShape, WalkingFoot

_CLOSE = 0.055
"""Distance of an ankle from the middle in walking ahead, m: the prints are nearer to a line than at rest."""

_ROLLING = 0.08
"""Distance by which a foot lands closer to the hips than it leaves them in walking ahead, m, because its sole rolls."""

_HIP_TURN = 0.25
"""Way of a foot at the side of a figure that turns, m/rad."""

_LEAD = 0.6
"""Distance by which a foot leads in a side step, relative to the distance that the figure moves in a step."""

_WORTH = 0.1
"""A foot does not step to a print that is nearer than this, m, as long as the figure walks on."""

_FURTHEST, _FURTHEST_RUNNING = 0.75, 0.62
"""Distance to which a standing foot is left behind in a step of the other one, relative to the reach of its leg."""

_MOST_TURNED = 1.0
"""Largest turn of a figure relative to its standing foot, rad."""

_PARTS = tuple(part / 20 for part in range(20, 9, -1))
"""Parts of a step that are tried for that: a figure that speeds up or turns takes shorter steps."""

_FURTHEST_AHEAD = 0.5
"""How far ahead of where it stands at rest a foot comes down at most, relative to the reach of its leg.

A figure that speeds up will soon be much farther: its foot would come down where the leg does not reach it.
"""


def time_in_reach(
    progression: Progression, standing: WalkingFoot, now: GlobalTime, period: float, *, flies: bool
) -> float:
    """Return the time of a step, shorter if the foot that stands meanwhile would be left behind too far, s.

    Args:
        progression: of the figure, at the present time.
        standing: the foot that stands, or is about to.
        now: the present time, at which the other foot leaves the ground, s.
        period: usual time of the step, s.
        flies: whether both feet leave the ground.
    """
    shape = standing.shape
    furthest = shape.leg * (_FURTHEST_RUNNING if flies else _FURTHEST)
    for part in _PARTS:
        place = progression.ahead(now, GlobalTime(now + part * period)).place
        x, _, z = subtract((shape.hip, 0.0, shape.place[2]), place.to_own(standing.goal.position))
        turned = abs(between_headings(standing.goal.heading, place.heading))
        if math.hypot(x, z) <= furthest and (flies or turned <= _MOST_TURNED):
            break
    return part * period


def is_worth_a_step(foot: WalkingFoot, target: Place) -> bool:
    """Return whether a print is so far from where a foot stands that it steps there, as long as the figure walks on."""
    way = distance(foot.print.position, target.position)
    return way + _HIP_TURN * abs(between_headings(foot.print.heading, target.heading)) > _WORTH


def share_ahead(progression: Progression) -> float:
    """Return how much a figure moves as in walking ahead, 0 to 1."""
    forward, _ = progression.forward
    return min(1.0, max(0.0, forward / WALK.speed))


def landing(
    progression: Progression, shape: FootShape, now: GlobalTime, until: GlobalTime, period: float, support: float
) -> Place:
    """Return the print of a foot that comes down at a time: the frame passes over it in the middle of its stance.

    In steps aside and turns, the foot on that side goes ahead, and the other one follows to its side.

    Args:
        progression: of the figure, at the present time.
        shape: of the foot.
        now: the present time, s.
        until: when it comes down, s.
        period: time from step to step, s.
        support: how long both feet are on the ground, relative to that; negative in flight.
    """
    x, y, z = shape.place
    side = math.copysign(1.0, x)
    there = progression.ahead(now, until)
    aside = share_aside(there, until, period) * side
    lead = _LEAD * abs(aside) * period if aside > 0.0 else 0.0
    stance = (1.0 - abs(aside)) * 0.5 * (1.0 + support) * period + lead
    later = there.ahead(until, GlobalTime(until + stance))
    ahead = share_ahead(later)
    narrow = min(1.0, 2.0 * ahead)
    print_ = later.place.to_world((x + narrow * (side * _CLOSE - x), y, z - ahead * _ROLLING))
    to_x, _, to_z = there.place.to_own(print_)
    within_reach = (to_x, y, min(to_z, z + _FURTHEST_AHEAD * shape.leg))
    return Place(there.place.to_world(within_reach), later.place.heading)


def share_aside(progression: Progression, now: GlobalTime, period: float) -> float:
    """Return how much a progression at a time goes aside or turns in a period, s, -1 (right) to 1 (left)."""
    after = progression.ahead(now, GlobalTime(now + period))
    x, _, z = progression.place.to_own(after.place.position)
    turn = _HIP_TURN * (after.heading.at - progression.heading.at)
    whole = math.hypot(x, z) + abs(turn)
    return 0.0 if whole < 1e-6 else max(-1.0, min(1.0, (x + turn) / whole))
