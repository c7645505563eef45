"""Rotations as unit quaternions (w, x, y, z): plain tuples of floats.

Products read from right to left, as for matrices: `multiply(a, b)` turns by b first, then by a.
"""

import math

from reactive_realizer.embodiment.vector import Vec3, cross, dot, unit

Quat = tuple[float, float, float, float]

IDENTITY: Quat = (1.0, 0.0, 0.0, 0.0)

_NEARLY_PARALLEL = 1.0 - 1e-9


def multiply(a: Quat, b: Quat) -> Quat:
    """Return the rotation b followed by a."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def conjugate(q: Quat) -> Quat:
    """Return the inverse rotation."""
    return (q[0], -q[1], -q[2], -q[3])


def difference(a: Quat, b: Quat) -> Quat:
    """Return the turn d from a to b, in the axes of a: b = a d."""
    return multiply(conjugate(a), b)


def normalize(q: Quat) -> Quat:
    """Return the unit quaternion along q.

    Raises:
        ArithmeticError: q is zero, or too long to be normalized in floats.
    """
    factor = 1.0 / math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    if not factor:
        raise OverflowError(q)
    return (q[0] * factor, q[1] * factor, q[2] * factor, q[3] * factor)


def rotate(q: Quat, v: Vec3) -> Vec3:
    """Return the vector v turned by q."""
    w, x, y, z = q
    vx, vy, vz = v
    # v + 2 w (q x v) + 2 q x (q x v): 18 products fewer than q v q*
    tx = 2.0 * (y * vz - z * vy)
    ty = 2.0 * (z * vx - x * vz)
    tz = 2.0 * (x * vy - y * vx)
    return (
        vx + w * tx + y * tz - z * ty,
        vy + w * ty + z * tx - x * tz,
        vz + w * tz + x * ty - y * tx,
    )


def angle(q: Quat) -> float:
    """Return the angle of q, rad, 0 to pi."""
    return 2.0 * math.atan2(math.sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), abs(q[0]))


def slerp(a: Quat, b: Quat, fraction: float) -> Quat:
    """Return the rotation at a fraction of the shorter arc from a to b, at constant speed (Shoemake 1985)."""
    cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
    sign = 1.0
    if cosine < 0.0:
        cosine, sign = -cosine, -1.0
    if cosine > _NEARLY_PARALLEL:
        of_a, of_b = 1.0 - fraction, fraction * sign
    else:
        theta = math.acos(cosine)
        sine = math.sin(theta)
        of_a, of_b = math.sin((1.0 - fraction) * theta) / sine, sign * math.sin(fraction * theta) / sine
    w, x = of_a * a[0] + of_b * b[0], of_a * a[1] + of_b * b[1]
    y, z = of_a * a[2] + of_b * b[2], of_a * a[3] + of_b * b[3]
    # Rounding errors would add up over thousands of frames that start from the last pose: one Newton step to length 1.
    factor = 1.5 - 0.5 * (w * w + x * x + y * y + z * z)
    return (w * factor, x * factor, y * factor, z * factor)


def power(q: Quat, fraction: float) -> Quat:
    """Return a fraction of the turn q, about the same axis."""
    return slerp(IDENTITY, q, fraction)


def from_axis_angle(axis: Vec3, radians: float) -> Quat:
    """Return the right-handed turn about a unit axis."""
    sine = math.sin(0.5 * radians)
    return (math.cos(0.5 * radians), sine * axis[0], sine * axis[1], sine * axis[2])


def from_rotation_vector(v: Vec3) -> Quat:
    """Return the turn about the direction of v by its length, rad."""
    radians = math.sqrt(dot(v, v))
    # sin(x/2)/x, by its series near 0/0.
    share = math.sin(0.5 * radians) / radians if radians > 1e-6 else 0.5
    return (math.cos(0.5 * radians), share * v[0], share * v[1], share * v[2])


def rotation_vector(q: Quat) -> Vec3:
    """Return the axis of the shorter turn to q, scaled to its angle, rad, 0 to pi."""
    sine = math.sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    radians = 2.0 * math.atan2(sine, abs(q[0]))
    factor = math.copysign(radians / sine if sine > 1e-9 else 2.0, q[0])
    return (factor * q[1], factor * q[2], factor * q[3])


def from_euler(x: float, y: float, z: float) -> Quat:
    """Return the rotation of a ProcAnimation's `rotation="x;y;z"`, rad.

    AsapRealizer reads it as yaw-pitch-roll: about z first, then x, then y, all about the parent's axes: Ry Rx Rz.
    """
    cx, sx = math.cos(0.5 * x), math.sin(0.5 * x)
    cy, sy = math.cos(0.5 * y), math.sin(0.5 * y)
    cz, sz = math.cos(0.5 * z), math.sin(0.5 * z)
    return (
        cx * cy * cz + sx * sy * sz,
        sx * cy * cz + cx * sy * sz,
        cx * sy * cz - sx * cy * sz,
        cx * cy * sz - sx * sy * cz,
    )


def between(a: Vec3, b: Vec3) -> Quat:
    """Return the smallest turn from the unit vector a to the unit vector b."""
    cosine = dot(a, b)
    if cosine < -_NEARLY_PARALLEL:
        # Half a turn about any perpendicular axis, built from the coordinate axis that a is least parallel to.
        _, across = min((abs(part), i) for i, part in enumerate(a))
        helper: Vec3 = (float(across == 0), float(across == 1), float(across == 2))
        return (0.0, *unit(cross(a, helper)))
    x, y, z = cross(a, b)
    return normalize((1.0 + cosine, x, y, z))


def from_frames(a: Vec3, a_side: Vec3, b: Vec3, b_side: Vec3) -> Quat:
    """Return the rotation that takes the unit vector a to b, and the side of a to the side of b.

    Args:
        a: a unit vector.
        a_side: a unit vector perpendicular to a.
        b: a unit vector, where a goes.
        b_side: a unit vector perpendicular to b, where a_side goes.
    """
    swing = between(a, b)
    side = rotate(swing, a_side)
    twist = math.atan2(dot(cross(side, b_side), b), dot(side, b_side))
    return multiply(from_axis_angle(b, twist), swing)


def twist(q: Quat, axis: Vec3) -> Quat:
    """Return the part of q that turns about a unit axis; the rest, `multiply(q, conjugate(twist))`, is the swing."""
    along = q[1] * axis[0] + q[2] * axis[1] + q[3] * axis[2]
    size = math.hypot(q[0], along)
    if size < 1e-9:
        # q swings by half a turn, so any twist fits: choose none.
        return IDENTITY
    along /= size
    return (q[0] / size, along * axis[0], along * axis[1], along * axis[2])
