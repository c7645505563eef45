"""How far a hand has come when it points: an S of time whose slope is a bell (thesis 4.2.2)."""

import math


def sigmoid(progress: float, steepness: float, asymmetry: float) -> float:
    """The share of the way that is done, 0..1, after a share of its time.

    The speed grows from 0 to its one peak and falls to 0 again, a bell: reaching hands move so, and mostly slow down
    for longer than they speed up (R. Plamondon and A. Alimi, "Speed/accuracy trade-offs in target-directed movements",
    Behavioral and Brain Sciences 20, 1997). Each half of the bell is half of that of the symmetric S
    ``t^k / (t^k + (1 - t)^k)``, stretched alike in time and in way, so that speed and acceleration agree where they
    meet.

    Args:
        progress: share of the time that has passed; held within 0 and 1.
        steepness: k, how many times as fast as the mean the hand is at its peak; above 1. From 2 on it sets out and
            arrives softly.
        asymmetry: by how much longer it speeds up than it slows down, as a share of the time; between -1 and 1.
    """
    t = min(1.0, max(0.0, progress))
    rising = 0.5 * (1.0 + asymmetry)
    if t <= rising:
        return 2.0 * rising * _symmetric(0.5 * t / rising, steepness)
    falling = 1.0 - rising
    return 1.0 - 2.0 * falling * _symmetric(0.5 * (1.0 - t) / falling, steepness)


def _symmetric(t: float, steepness: float) -> float:
    done, left = math.pow(t, steepness), math.pow(1.0 - t, steepness)
    return done / (done + left)
