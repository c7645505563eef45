"""Curves through points, as functions of formulas."""

from collections.abc import Sequence


def hermite(x: float, start_speed: float, end_speed: float, *points: float) -> float:
    """A cubic curve through points that lie one unit of x apart, the first at x = 0; constant outside.

    Between its neighbors a point is passed with half their difference as speed (Catmull and Rom 1974).

    Args:
        x: where on the curve, 0 to len(points) - 1.
        start_speed: slope at the first point, per unit of x.
        end_speed: slope at the last point, per unit of x.
        points: values, two or more.
    """
    last = len(points) - 1
    if x >= last:
        return points[last]
    if x < 0.0:
        return points[0]
    i = int(x)
    enter = start_speed if i == 0 else 0.5 * (points[i + 1] - points[i - 1])
    leave = end_speed if i + 1 == last else 0.5 * (points[i + 2] - points[i])
    return _cubic(x - i, points[i], points[i + 1], enter, leave)


def tcbspline(t: float, start_speed: float, end_speed: float, *keys: float) -> float:
    """A curve through keys with tension, continuity and bias; the last value after the last key.

    D. Kochanek and R. Bartels, "Interpolating splines with local tension, continuity, and bias control" (SIGGRAPH
    1984), with their correction for unequal intervals. The order of the arguments is AsapRealizer's.

    Args:
        t: where on the curve.
        start_speed: slope at the first key, per first interval.
        end_speed: slope at the last key, per last interval.
        keys: value and time of the first key; value, time, tension, continuity and bias of each between; value and
            time of the last. Tension, continuity and bias are from -1 to 1; with 0 each it is a Catmull-Rom curve.
    """
    values = (keys[0], *keys[2:-2:5], keys[-2])
    times = (keys[1], *keys[3:-2:5], keys[-1])
    right = next((i for i, time in enumerate(times) if time > t), None)
    if right is None:
        return values[-1]
    if right == 0:
        return values[0]
    left = right - 1
    interval = times[right] - times[left]
    enter, leave = start_speed, end_speed
    # Slopes are per interval; the corrections make them equal per unit of t on both sides of a key.
    if left > 0:
        enter = _tangent(values, keys, left, -1.0) * 2.0 * interval / (times[right] - times[left - 1])
    if right + 1 < len(values):
        leave = _tangent(values, keys, right, 1.0) * 2.0 * interval / (times[right + 1] - times[left])
    return _cubic((t - times[left]) / interval, values[left], values[right], enter, leave)


def _tangent(values: Sequence[float], keys: Sequence[float], i: int, arriving: float) -> float:
    """Slope at an inner key, per interval; arriving is 1 for the side before the key and -1 for the side after."""
    tension, continuity, bias = keys[5 * i - 1 : 5 * i + 2]
    before = (1.0 - tension) * (1.0 - arriving * continuity) * (1.0 + bias)
    after = (1.0 - tension) * (1.0 + arriving * continuity) * (1.0 - bias)
    return 0.5 * (before * (values[i] - values[i - 1]) + after * (values[i + 1] - values[i]))


def _cubic(u: float, a: float, b: float, enter: float, leave: float) -> float:
    """The cubic from a to b over u in 0..1 with given slopes at its ends."""
    rest = 1.0 - u
    return rest * rest * ((1.0 + 2.0 * u) * a + u * enter) + u * u * ((1.0 + 2.0 * rest) * b - rest * leave)
