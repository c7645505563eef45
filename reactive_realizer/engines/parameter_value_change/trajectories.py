"""Ways from one value to another (thesis, equations 8.2 and 8.3): the share of the way after a share of the time."""


def instant(share: float) -> float:
    """There at once."""
    return 1.0


def linear(share: float) -> float:
    """At an even pace."""
    return share


def ease_in_ease_out(share: float) -> float:
    """Slow at both ends: Hermite's cubic with slope 0 there."""
    return share * share * (3.0 - 2.0 * share)
