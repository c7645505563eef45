"""Mixed dynamics: a figure with some joints that are moved, and others that move physically (thesis, chapter 3)."""

import logging
import math
from collections.abc import Collection, Iterable, Sequence
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from reactive_realizer.embodiment.body import Body, Skeleton
from reactive_realizer.embodiment.joints import ROOT, SIDES
from reactive_realizer.embodiment.quaternion import Quat, conjugate, difference, multiply, rotate, rotation_vector
from reactive_realizer.embodiment.vector import Vec3, add, scale, subtract
from reactive_realizer.physics.controllers.controller import PhysicalController
from reactive_realizer.physics.joint_limits import LimitSpring
from reactive_realizer.physics.links import Links
from reactive_realizer.physics.mjcf import TO_WORLD, inertia, mjcf
from reactive_realizer.physics.segments import LIMITS
from reactive_realizer.physics.static_friction import StaticFriction

logger = logging.getLogger(__name__)

# MuJoCo would write its warnings, such as that of a huge acceleration, to a file in the current folder.
mujoco.set_mju_user_warning(lambda text: logger.debug("MuJoCo: %s", text))

SUBSTEP = 0.0025
"""Default time of a step, s."""

_ARMATURE = 1e6
"""Inertia that is added to each degree of freedom of a kinematic joint, kg m^2 or kg.

Beside it, that of the body is negligible: no force of the rest of the body disturbs the joint.
"""

_FASTEST = 1000.0
"""Speed that no joint reaches, rad/s or m/s."""

_LYING = 0.5
"""Height of the center of mass of a figure that has fallen, in multiples of its height when it stands."""

_PERIOD = 0.02
"""Time for which what springs and controllers exert stays, s: a frame."""

FEET = tuple(f"{side}_ankle" for side in SIDES)

_ROOT_BODY = 1
"""Index of the body that all others belong to; 0 is the world."""


class Exploded(Exception):
    """The state of a simulation is none that a body can have."""


class Simulation:
    """Simulates a figure in its own frame, at rest in the default pose at first.

    Any set of joints is kinematic: they follow a given body. The others are physical: they
    move by torques, gravity, contact with the floor, and what the moving kinematic joints exert on them. This solves
    the hybrid equation of motion (thesis 3.1) exactly: the accelerations of kinematic joints and the torques of
    physical joints are known, and the others follow. A kinematic joint has an armature beside which all other inertia
    is negligible, and a servo whose torque accelerates this armature to the wanted velocity in the first step; the
    coupling of both kinds of joints is in MuJoCo's inertia matrix. Unlike the thesis's method (3.2 to 3.7), this needs
    no accelerations of an earlier step.

    Attributes:
        joints: of the segments, the root first.
        model: of MuJoCo. Its frame is turned by `TO_WORLD`.
        data: of MuJoCo.
        mass: of the figure, kg.
        inertia: that turns about each degree of freedom in the default pose, kg m^2, or kg, (nv,).
        substep: time of a step, s.
        period: time for which what springs and controllers exert stays, s.
        touching: indices of the geoms that touch, at the beginning of the present period.
        reaction: factor of what moving kinematic limbs exert on the physical segments to which they are attached, apart
            from their weight (k of thesis 3.1). It is 1 unless a controller sets it, in each period anew.
    """

    def __init__(
        self, skeleton: Skeleton, weight: float | None = None, substep: float = SUBSTEP, floating: bool = False
    ) -> None:
        """Prepare a simulation in which all joints are physical.

        Args:
            skeleton: of the figure.
            weight: kg; None for the usual one of its stature.
            substep: time of a step, s.
            floating: whether it floats freely, without gravity and floor.
        """
        self.model = _model(skeleton, weight)
        self.model.opt.timestep = substep
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
        if floating:
            self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_GRAVITY | mujoco.mjtDisableBit.mjDSBL_CONTACT
        self.data = mujoco.MjData(self.model)
        self.joints = tuple(self.model.joint(index).name for index in range(self.model.njnt))
        self._skeleton = skeleton
        self.inertia: Sequence[float] = inertia(self.model).tolist()
        self.substep = substep
        self.period = max(1, round(_PERIOD / substep)) * substep
        self.touching: Collection[int] = ()
        self._links = {joint: Links(skeleton, joint) for joint in self.joints}
        addresses = zip(self.joints, self.model.jnt_qposadr.tolist(), self.model.jnt_dofadr.tolist(), strict=True)
        self._addresses = {joint: (position, degree) for joint, position, degree in addresses}
        self._greatest = {joint: max(self.inertia[self.degrees(joint)]) for joint in self.joints}
        self._damping, self._limited = self.model.dof_damping.tolist(), self.model.jnt_limited.copy()
        self._wanted, self._present = self.data.qpos.copy(), self.data.qpos.tolist()
        self._speeds = np.zeros(self.model.nv)
        self._bodies = {joint: int(self.model.body(joint).id) for joint in self.joints}
        self._friction = StaticFriction(self.model, [self._bodies[foot] for foot in FEET if foot in self._bodies])
        self._pushes: list[_Push] = []
        self.reaction = 1.0
        self._gravity = np.zeros(3) if floating else self.model.opt.gravity.copy()
        self.mass = float(self.model.body_subtreemass[_ROOT_BODY])
        self.kinematic = ()
        mujoco.mj_forward(self.model, self.data)
        self._standing = float(self.data.subtree_com[_ROOT_BODY, 2])

    @property
    def kinematic(self) -> Collection[str]:
        """The joints that are kinematic. They can be changed before any step; poses and velocities stay."""
        return self._kinematic

    @kinematic.setter
    def kinematic(self, joints: Collection[str]) -> None:
        """Choose the kinematic joints.

        Raises:
            KeyError: no segment turns about one of the joints.
        """
        if unknown := set(joints).difference(self.joints):
            raise KeyError(*sorted(unknown))
        self._kinematic = tuple(joint for joint in self.joints if joint in joints)
        self._positions = _indices(self.positions(joint) for joint in self._kinematic)
        self._degrees = _indices(self.degrees(joint) for joint in self._kinematic)
        parents = ((self._bodies[joint], int(self.model.body_parentid[self._bodies[joint]])) for joint in joints)
        moved = {self._bodies[joint] for joint in self.joints if joint not in joints}
        self._limbs = [(limb, parent) for limb, parent in sorted(parents) if parent in moved]
        self._limits = {
            joint: LimitSpring(LIMITS[joint], self._about(joint), self.rotation(joint))
            for joint in self.joints
            if joint not in joints and joint != ROOT
        }
        model = self.model
        model.dof_armature[:], model.jnt_limited[:] = 0.0, self._limited
        model.dof_armature[self._degrees] = _ARMATURE
        for joint in self._kinematic:
            model.joint(joint).limited = 0
        # A servo exerts the torque gain * (wanted - present velocity): the wanted one is there after one step.
        gain = _ARMATURE / self.substep
        model.actuator_gainprm[:, 0] = model.actuator_biasprm[:, 2] = 0.0
        model.actuator_gainprm[self._degrees, 0], model.actuator_biasprm[self._degrees, 2] = gain, -gain

    def segments(self, joints: Iterable[str]) -> frozenset[str]:
        """Return the joints of the segments that any of some joints turns."""
        turned = set(joints)
        return frozenset(joint for joint, links in self._links.items() if not turned.isdisjoint(links.joints))

    def degrees(self, joint: str) -> slice:
        """Return the slice of a joint's degrees of freedom in velocities and torques: three, of the root six."""
        _, first = self._addresses[joint]
        return slice(first, first + (6 if joint == ROOT else 3))

    def positions(self, joint: str) -> slice:
        """Return the slice of a joint's generalized coordinates: w x y z, of the root x y z before them."""
        first, _ = self._addresses[joint]
        return slice(first, first + (7 if joint == ROOT else 4))

    def _about(self, joint: str) -> Vec3:
        """Return the inertia that turns about the axes of a ball joint in the default pose, kg m^2."""
        x, y, z = self.inertia[self.degrees(joint)]
        return (x, y, z)

    def place(self, body: Body) -> None:
        """Put all joints at rest in the pose of a body."""
        self.data.qpos[:], self.data.qvel[:] = self._coordinates(body, self.joints), 0.0
        mujoco.mj_forward(self.model, self.data)

    def advance(
        self,
        body: Body,
        controllers: Sequence[PhysicalController] = (),
        steps: int = 1,
        torques: NDArray[np.float64] | None = None,
    ) -> None:
        """Simulate some steps.

        Args:
            body: with the rotations of the kinematic joints, and the root if it is kinematic, at the end of the last
                step. They move there at constant velocities.
            controllers: of physical joints; the torques of several on one joint add up.
            steps: their number.
            torques: on each degree of freedom, Nm or N, in the axes of its segment, in addition; those of kinematic
                joints have no effect.

        Raises:
            Exploded: it cannot go on.
        """
        model, data = self.model, self.data
        wanted = self._coordinates(body, self._kinematic)
        self._wanted[self._positions] = wanted
        # MuJoCo's semi-implicit Euler integrator ends at the wanted positions with these velocities.
        mujoco.mj_differentiatePos(model, self._speeds, steps * self.substep, data.qpos, self._wanted)
        data.ctrl[:] = self._speeds
        most = round(self.period / self.substep)
        for done in range(0, steps, most):
            ahead = min(most, steps - done)
            self._push(ahead * self.substep)
            self._exert(body, controllers, torques)
            mujoco.mj_step(model, data, ahead)
        data.qpos[self._positions], data.qvel[self._degrees] = wanted, self._speeds[self._degrees]
        # Without np.isfinite and np.max, which take longer for so few numbers. No comparison with NaN is true.
        if not (math.isfinite(sum(data.qpos.tolist())) and all(abs(speed) < _FASTEST for speed in data.qvel.tolist())):
            raise Exploded

    def _push(self, duration: float) -> None:
        """Set the forces of pushes for some time, s; one that ends within this time is weaker, with the same effect."""
        data = self.data
        data.xfrc_applied[:] = 0.0
        self._pushes = [push for push in self._pushes if push.until > data.time]
        for push in self._pushes:
            data.xfrc_applied[push.body, :3] += min(1.0, (push.until - data.time) / duration) * push.force

    def _exert(
        self, body: Body, controllers: Sequence[PhysicalController], torques: NDArray[np.float64] | None
    ) -> None:
        """Set the torques that the present state causes, and add its forces, for a period."""
        model, data, own = self.model, self.data, self._degrees
        self.touching = frozenset(data.contact.geom.ravel().tolist())
        self._friction.act(data, self.touching)
        forces = [0.0] * model.nv if torques is None else torques.tolist()
        damping = self._damping.copy()
        self._present = data.qpos.tolist()
        for joint, spring in self._limits.items():
            spring.act(self._turned(joint), self.period, self._addresses[joint][1], forces, damping)
        self.reaction = 1.0
        for controller in controllers:
            controller.act(self, body, forces, damping)
        self._scale_reactions()
        model.dof_damping[:], data.qfrc_applied[:] = damping, forces
        model.dof_damping[own] = data.qfrc_applied[own] = 0.0

    def _scale_reactions(self) -> None:
        """Add what the factor `reaction` changes in what kinematic limbs exert in the next period.

        Their accelerations are known; those of the physical joints are of the last step.
        """
        if self.reaction == 1.0:
            return
        data, own = self.data, self._degrees
        data.qacc[own] = (self._speeds[own] - data.qvel[own]) / self.period
        mujoco.mj_rnePostConstraint(self.model, data)
        for limb, parent in self._limbs:
            place = data.xipos[parent]
            weight = -self.model.body_subtreemass[limb] * self._gravity
            force = data.cfrc_int[limb, 3:] - weight
            torque = data.cfrc_int[limb, :3] + np.cross(data.subtree_com[_ROOT_BODY] - place, data.cfrc_int[limb, 3:])
            torque -= np.cross(data.subtree_com[limb] - place, weight)
            data.xfrc_applied[parent] += (1.0 - self.reaction) * np.concatenate((force, torque))

    def body(self, shown: Body) -> Body:
        """Return a body with physical joints as they are simulated, and all others as in a given body.

        Joints within a segment, such as those of the spine, stay as they are in the given body, and the segment's joint
        gives the segment the simulated rotation.
        """
        physical = [joint for joint in self.joints if joint not in self._kinematic]
        rotations = {joint: self._links[joint].local(shown, self.rotation(joint)) for joint in physical}
        if ROOT not in physical:
            return shown.posed(rotations)
        x, y, z = self.data.qpos[:3].tolist()
        root = subtract(rotate(conjugate(TO_WORLD), (x, y, z)), self._skeleton.offset(ROOT))
        return shown.posed(rotations, root)

    def rotation(self, joint: str) -> Quat:
        """Return the simulated rotation of a segment in its parent segment, or of the root in the figure's frame."""
        w, x, y, z = self.data.qpos[self.positions(joint)][-4:].tolist()
        return multiply(conjugate(TO_WORLD), (w, x, y, z)) if joint == ROOT else (w, x, y, z)

    def push(self, joint: str, force: Vec3, duration: float) -> None:
        """Push a segment at its center of mass from now on.

        Args:
            joint: of the segment, or within it.
            force: N, in the figure's frame.
            duration: s.
        """
        turned = np.array(rotate(TO_WORLD, force))
        segment: str | None = joint
        while segment is not None and segment not in self._bodies:
            segment = self._skeleton.parent(segment)
        self._pushes.append(_Push(self._bodies[segment or ROOT], turned, self.data.time + duration))

    @property
    def fallen(self) -> bool:
        """Whether the figure lies on the floor: its center of mass is at less than half its height when it stands."""
        return bool(self.data.subtree_com[_ROOT_BODY, 2] < _LYING * self._standing)

    def body_of(self, joint: str) -> int:
        """Return MuJoCo's index of the body of a segment."""
        return self._bodies[joint]

    def center_of_mass(self) -> tuple[Vec3, Vec3]:
        """Return the place of the center of mass of the figure, m, and its velocity, m/s, in MuJoCo's world."""
        x, y, z = self.data.subtree_com[_ROOT_BODY].tolist()
        vx, vy, vz = self.data.subtree_linvel[_ROOT_BODY].tolist()
        return (x, y, z), (vx, vy, vz)

    def press(self, body: int, point: Vec3, force: Vec3) -> None:
        """Have the joints from the root to a body press on the ground in this period, by the torques -J^T F.

        J is the Jacobian of the point in these joints. The force on the body, and its opposite at the same point of the
        root, amount to these torques, and MuJoCo computes them in each step.

        Args:
            body: MuJoCo's index.
            point: at which the ground is pressed, m, in MuJoCo's world.
            force: that the ground should exert, N, in MuJoCo's world.
        """
        fx, fy, fz = force
        for index, sign in ((body, -1.0), (_ROOT_BODY, 1.0)):
            x, y, z = self.data.xipos[index].tolist()
            x, y, z = point[0] - x, point[1] - y, point[2] - z
            wrench = fx, fy, fz, y * fz - z * fy, z * fx - x * fz, x * fy - y * fx
            self.data.xfrc_applied[index] += [sign * part for part in wrench]

    def hold(
        self, joint: str, goal: Body, frequencies: Vec3, ratio: float, torques: list[float], damping: list[float]
    ) -> None:
        """Add springs and dampers that hold a joint in the pose of a body, as `pull` does.

        Args:
            joint: of a segment, but not the root.
            goal: the pose.
            frequencies: angular frequencies of the springs, rad/s: their stiffness is in proportion to the greatest
                inertia that turns about an axis of the joint, because limbs would twist otherwise.
            ratio: of damping, 1 for critical.
            torques: to add to, (nv,).
            damping: to add to, (nv,).
        """
        inertia = self._greatest[joint]
        x, y, z = frequencies
        stiffness = (inertia * x * x, inertia * y * y, inertia * z * z)
        dampers = scale(frequencies, 2.0 * ratio * inertia)
        self.pull(joint, self.wanted(joint, goal), stiffness, dampers, torques, damping)

    def pull(
        self, joint: str, wanted: Quat, stiffness: Vec3, dampers: Vec3, torques: list[float], damping: list[float]
    ) -> None:
        """Add springs and dampers about the axes of a joint, which are stable however stiff (`PhysicalController.act`).

        Args:
            joint: of a segment, but not the root.
            wanted: its rotation without forces.
            stiffness: of the springs, Nm/rad.
            dampers: Nms/rad.
            torques: to add to, (nv,).
            damping: to add to, (nv,).
        """
        _, first = self._addresses[joint]
        period = self.period
        x, y, z = rotation_vector(difference(self._turned(joint), wanted))
        of_x, of_y, of_z = stiffness
        torques[first] += of_x * x
        torques[first + 1] += of_y * y
        torques[first + 2] += of_z * z
        damping[first] += of_x * period + dampers[0]
        damping[first + 1] += of_y * period + dampers[1]
        damping[first + 2] += of_z * period + dampers[2]

    def angular_momentum(self) -> NDArray[np.float64]:
        """Return the angular momentum about the center of mass, kg m^2/s, in MuJoCo's world, (3,)."""
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_subtreeVel(self.model, self.data)
        momentum: NDArray[np.float64] = self.data.subtree_angmom[_ROOT_BODY].copy()
        return momentum

    def wanted(self, joint: str, body: Body) -> Quat:
        """Return the rotation of a segment in its parent segment in a body; that of the root in MuJoCo's world."""
        rotation = self._links[joint].rotation(body)
        return multiply(TO_WORLD, rotation) if joint == ROOT else rotation

    def _turned(self, joint: str) -> Quat:
        """Return the rotation of a segment at the beginning of the present period, in its parent segment."""
        first, _ = self._addresses[joint]
        w, x, y, z = self._present[first : first + 4]
        return (w, x, y, z)

    def _coordinates(self, body: Body, joints: Iterable[str]) -> list[float]:
        """Return the generalized coordinates of joints in the pose of a body."""
        coordinates: list[float] = []
        for joint in joints:
            rotation = self._links[joint].rotation(body)
            if joint == ROOT:
                coordinates += rotate(TO_WORLD, add(self._skeleton.offset(ROOT), body.root))
                coordinates += multiply(TO_WORLD, rotation)
            else:
                coordinates += rotation
        return coordinates


def _model(skeleton: Skeleton, weight: float | None) -> mujoco.MjModel:
    """Return the model of a figure with a servo for each degree of freedom, in their order.

    A sensor has MuJoCo compute velocities of centers of mass in each step.
    """
    spec = mujoco.MjSpec.from_string(mjcf(skeleton, weight).decode())
    for joint in spec.joints:
        for axis in range(6 if joint.type == mujoco.mjtJoint.mjJNT_FREE else 3):
            servo = spec.add_actuator(target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
            servo.gear = [float(axis == each) for each in range(6)]
            servo.biastype = mujoco.mjtBias.mjBIAS_AFFINE
    spec.add_sensor(type=mujoco.mjtSensor.mjSENS_SUBTREELINVEL, objtype=mujoco.mjtObj.mjOBJ_BODY, objname=ROOT)
    return spec.compile()


class _Push(NamedTuple):
    """A push: the index of a body, the force, N, in MuJoCo's world, and when it ends, s."""

    body: int
    force: NDArray[np.float64]
    until: float


def _indices(slices: Iterable[slice]) -> NDArray[np.intp]:
    """Return all indices of slices in one array."""
    return np.array([index for each in slices for index in range(each.start, each.stop)], dtype=np.intp)
