"""Time warps: the completed share of the way to a key pose after a share of its time."""

from reactive_realizer.bml.vocabulary import WarpKind


def warped(share: float, kind: WarpKind, steepness: float) -> float:
    """The completed share of a way after a share of its time, both from 0 to 1; in between, it may be more than 1.

    Both families are cubic Hermite splines whose slope at the beginning is the steepness. A TAN warp has the same slope
    at the end, so a steepness below 1 eases in and out; an EXP warp has its reciprocal there, so a steepness above 1
    eases out, and one below eases in. Outside of limits, a way is not one-way, as the authors intend (Heloir and Kipp
    2010, fig. 2, which leaves the functions open): an EXP warp overshoots from about 4 on, and begins with a swing in
    the opposite direction below a quarter; a TAN warp goes back for a while in the middle above 3, and from about 9 on
    swings beyond both ends.
    """
    end = steepness if kind is WarpKind.TAN else 1.0 / steepness
    left = 1.0 - share
    return share * (left * left * steepness + share * (3.0 - 2.0 * share) - share * left * end)
