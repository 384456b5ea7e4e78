"""Pinocchio's model of a robot, with our shapes as its collision geometry and our skips as its pairs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ._answers import Box, ConvexMesh, ShapeKind, Spheres
from ._arrays import Floats, configurations, positions
from ._joints import (
    Joint,
    in_plane_basis,
    joints_of,
    pose,
    quaternion_of,
    right_jacobian,
    rotation_vector_of,
)
from ._kinematics import RobotKinematics
from ._need import need
from ._proximity import Proximity
from ._shapes import shapes as shapes_of
from ._start import brief
from .errors import ConfigurationError

if TYPE_CHECKING:
    from .modules import Origin


@dataclass(frozen=True)
class _Place:
    """The indices of a joint's values in Pinocchio's vectors."""

    joint: Joint
    q: int
    v: int


@dataclass(frozen=True, repr=False)
class PinocchioRobot:
    """A robot for Pinocchio. The order of its joints is Pinocchio's own: :meth:`q` and :meth:`dofs` map configurations.

    Mimic joints are separate joints here; :meth:`q` sets them. Each link has a body frame of its name.
    """

    model: Any
    """``pinocchio.Model``."""
    collision_model: Any
    """``pinocchio.GeometryModel`` of the shapes, named ``link/piece``, with the pairs that are not skipped; None
    if no shapes were requested."""
    dof_names: tuple[str, ...]
    """The DOFs here."""
    _places: tuple[_Place, ...]

    def __repr__(self) -> str:
        return brief(self, dofs=self.dof_names, joints=tuple(self.model.names)[1:])

    def q(self, q: ArrayLike) -> Floats:
        """(..., nq): Pinocchio's configuration of one of ours (..., dofs)."""
        rows, batch = configurations(q, self.dof_names)
        found = np.zeros((len(rows), self.model.nq))
        for place in self._places:
            joint, at = place.joint, place.q
            if joint.kind in ("Revolute", "Prismatic"):
                found[:, at : at + 1] = joint.position(rows)
            elif joint.kind == "Continuous":
                angle = joint.position(rows)
                found[:, at : at + 2] = np.concatenate([np.cos(angle), np.sin(angle)], axis=1)
            elif joint.kind == "Planar":
                x, y, turn = rows[:, joint.dofs].T
                found[:, at : at + 4] = np.stack([x, y, np.cos(turn), np.sin(turn)], axis=1)
            elif joint.kind == "Spherical":
                found[:, at : at + 4] = np.roll(quaternion_of(rows[:, joint.dofs]), -1, axis=1)
            else:
                found[:, at : at + 3] = rows[:, joint.dofs[:3]]
                found[:, at + 3 : at + 7] = np.roll(quaternion_of(rows[:, joint.dofs[3:]]), -1, axis=1)
        return found.reshape(*batch, self.model.nq)

    def dofs(self, q: ArrayLike) -> Floats:
        """(..., dofs): our configuration of one of Pinocchio's (..., nq). Ignores the values of mimic joints."""
        rows, batch = positions(q, self.model.nq, "Pinocchio's")
        found = np.zeros((len(rows), len(self.dof_names)))
        for place in self._places:
            joint, at = place.joint, place.q
            if joint.mimic is not None:
                continue
            if joint.kind in ("Revolute", "Prismatic"):
                found[:, joint.dofs[0]] = rows[:, at]
            elif joint.kind == "Continuous":
                found[:, joint.dofs[0]] = np.arctan2(rows[:, at + 1], rows[:, at])
            elif joint.kind == "Planar":
                found[:, joint.dofs[:2]] = rows[:, at : at + 2]
                found[:, joint.dofs[2]] = np.arctan2(rows[:, at + 3], rows[:, at + 2])
            else:
                slides = 0 if joint.kind == "Spherical" else 3
                found[:, joint.dofs[:slides]] = rows[:, at : at + slides]
                xyzw = rows[:, at + slides : at + slides + 4]
                found[:, joint.dofs[slides:]] = rotation_vector_of(np.roll(xyzw, 1, axis=1))
        return found.reshape(*batch, len(self.dof_names))

    def tangent(self, q: ArrayLike) -> Floats:
        """(nv, dofs): maps velocities of our DOFs to Pinocchio's, in one of our configurations. Our Jacobian is
        Pinocchio's (``LOCAL_WORLD_ALIGNED``) times this."""
        rows, batch = configurations(q, self.dof_names)
        if batch:
            raise ConfigurationError(f"expected one configuration, of the shape ({len(self.dof_names)},)")
        found = np.zeros((self.model.nv, len(self.dof_names)))
        for place in self._places:
            joint, at = place.joint, place.v
            if joint.mimic is not None:
                dof, multiplier, _ = joint.mimic
                if dof is not None:
                    found[at, dof] = multiplier
            elif joint.kind in ("Revolute", "Prismatic", "Continuous"):
                found[at, joint.dofs[0]] = 1.0
            elif joint.kind == "Planar":
                # Pinocchio's velocity is along the axes of the turned frame.
                turn = rows[0, joint.dofs[2]]
                cos, sin = np.cos(turn), np.sin(turn)
                found[at : at + 3, joint.dofs] = [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]
            else:
                slides = 0 if joint.kind == "Spherical" else 3
                vector = rows[0, joint.dofs[slides:]]
                if slides:
                    found[at : at + 3, joint.dofs[:3]] = _rotation(vector).T
                found[at + slides : at + slides + 3, joint.dofs[slides:]] = right_jacobian(vector)
        return found


def to_pinocchio(robot: RobotKinematics, shapes: ShapeKind | None = "pieces") -> PinocchioRobot:
    """As :meth:`urdd.Robot.to_pinocchio`."""
    pin = need("pinocchio", "pinocchio", "to_pinocchio")
    bounds = robot.modules.bounds
    model = pin.Model()
    model.name = robot.name
    root = robot.modules.chain.root_idx
    # For each link: the joint that moves it, its pose in that joint's frame, and its parent frame.
    links: dict[int, tuple[int, Floats, int]] = {root: (0, np.eye(4), 0)}
    frames = {root: _add_body(pin, model, robot.link_names[root], 0, np.eye(4), 0)}
    kept: list[tuple[Joint, int]] = []
    for joint in joints_of(robot.modules):
        above, place, _ = links[joint.parent]
        if joint.kind == "Fixed":
            at = place @ joint.origin
            frame = model.addFrame(
                pin.Frame(joint.name, above, frames[joint.parent], pin.SE3(at), pin.FrameType.FIXED_JOINT)
            )
            links[joint.child] = (above, at, frame)
        else:
            kind, basis = _joint_model(pin, joint)
            number = model.addJoint(above, kind, pin.SE3(place @ joint.origin @ basis), joint.name)
            frame = model.addJointFrame(number, frames[joint.parent])
            links[joint.child] = (number, basis.T, frame)
            kept.append((joint, number))
        number, at, frame = links[joint.child]
        frames[joint.child] = _add_body(pin, model, robot.link_names[joint.child], number, at, frame)
    for index, link in enumerate(robot.modules.urdf.links):
        if link.inertial is not None and link.inertial.mass is not None:
            number, at, _ = links[index]
            tensor = link.inertial.inertia
            six = [0.0] * 6
            if tensor is not None:
                named = (tensor.ixx, tensor.ixy, tensor.iyy, tensor.ixz, tensor.iyz, tensor.izz)
                six = [value or 0.0 for value in named]
            ixx, ixy, iyy, ixz, iyz, izz = six
            matrix = np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
            own = pin.Inertia(link.inertial.mass.value, np.zeros(3), matrix)
            model.appendBodyToJoint(
                number, own.se3Action(pin.SE3(at @ _origin(link.inertial.origin))), pin.SE3.Identity()
            )
    places: list[_Place] = []
    for joint, number in kept:
        places.append(_Place(joint, model.joints[number].idx_q, model.joints[number].idx_v))
    found = PinocchioRobot(model, None, robot.dof_names, tuple(places))
    _set_limits(found, model, bounds.dof_lower_bounds, bounds.dof_upper_bounds)
    _set_effort(found, model, bounds.dof_velocity_limits, bounds.dof_effort_limits)
    if shapes is None:
        return found
    geometry = _geometry(pin, robot, model, shapes, links, frames)
    return PinocchioRobot(model, geometry, robot.dof_names, tuple(places))


def _add_body(pin: Any, model: Any, name: str, joint: int, place: Floats, above: int) -> int:
    frame: int = model.addFrame(pin.Frame(name, joint, above, pin.SE3(place), pin.FrameType.BODY))
    return frame


def _joint_model(pin: Any, joint: Joint) -> tuple[Any, Floats]:
    """Pinocchio's joint, and its frame in our joint's frame."""
    basis = np.eye(4)
    if joint.kind in ("Revolute", "Continuous", "Prismatic"):
        aligned = {(1.0, 0.0, 0.0): "X", (0.0, 1.0, 0.0): "Y", (0.0, 0.0, 1.0): "Z"}
        letter = aligned.get((float(joint.axis[0]), float(joint.axis[1]), float(joint.axis[2])))
        begin, unaligned = {
            "Revolute": ("JointModelR", "JointModelRevoluteUnaligned"),
            "Continuous": ("JointModelRUB", "JointModelRevoluteUnboundedUnaligned"),
            "Prismatic": ("JointModelP", "JointModelPrismaticUnaligned"),
        }[joint.kind]
        if letter is not None:
            return getattr(pin, begin + letter)(), basis
        return getattr(pin, unaligned)(joint.axis), basis
    if joint.kind == "Planar":
        basis[:3, :3] = in_plane_basis(joint.axis)
        return pin.JointModelPlanar(), basis
    if joint.kind == "Spherical":
        return pin.JointModelSpherical(), basis
    return pin.JointModelFreeFlyer(), basis


def _origin(origin: Origin | None) -> Floats:
    found = np.eye(4)
    if origin is None:
        return found
    roll, pitch, yaw = origin.rpy or (0.0, 0.0, 0.0)
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    found[:3, :3] = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    found[:3, 3] = origin.xyz or (0.0, 0.0, 0.0)
    return found


def _rotation(rotation_vector: Floats) -> Floats:
    return pose([0.0, 0.0, 0.0], quaternion_of(rotation_vector).tolist())[:3, :3]


def _set_limits(robot: PinocchioRobot, model: Any, lower: list[float], upper: list[float]) -> None:
    below, above = np.full(model.nq, -np.inf), np.full(model.nq, np.inf)
    for place in robot._places:
        joint, at = place.joint, place.q
        if joint.kind in ("Revolute", "Prismatic") and joint.mimic is None:
            below[at], above[at] = lower[joint.dofs[0]], upper[joint.dofs[0]]
        elif joint.kind in ("Revolute", "Prismatic"):
            ends = [joint.position(np.array(bounds))[0] for bounds in (lower, upper)]
            below[at], above[at] = min(ends), max(ends)
        elif joint.kind in ("Planar", "Floating"):
            slides = 2 if joint.kind == "Planar" else 3
            for k in range(slides):
                below[at + k], above[at + k] = lower[joint.dofs[k]], upper[joint.dofs[k]]
            below[at + slides : at + joint_size(joint)], above[at + slides : at + joint_size(joint)] = -1.0, 1.0
        else:
            below[at : at + joint_size(joint)], above[at : at + joint_size(joint)] = -1.0, 1.0
    model.lowerPositionLimit, model.upperPositionLimit = below, above


def joint_size(joint: Joint) -> int:
    """The length of a joint's part of Pinocchio's configuration."""
    return {"Continuous": 2, "Planar": 4, "Spherical": 4, "Floating": 7}.get(joint.kind, 1)


def _set_effort(robot: PinocchioRobot, model: Any, speeds: list[float | None], efforts: list[float | None]) -> None:
    speed, effort = np.full(model.nv, np.inf), np.full(model.nv, np.inf)
    for place in robot._places:
        if place.joint.mimic is None and len(place.joint.dofs) == 1:
            (dof,) = place.joint.dofs
            speed[place.v] = np.inf if speeds[dof] is None else speeds[dof]
            effort[place.v] = np.inf if efforts[dof] is None else efforts[dof]
    model.velocityLimit, model.effortLimit = speed, effort


def _geometry(
    pin: Any,
    robot: RobotKinematics,
    model: Any,
    kind: ShapeKind,
    links: dict[int, tuple[int, Floats, int]],
    frames: dict[int, int],
) -> Any:
    coal = need("coal", "pinocchio", "to_pinocchio")
    geometry = pin.GeometryModel()
    numbers_of: dict[tuple[int, int], int] = {}

    def add(link: str, piece: int, shape: Any, place: Floats) -> None:
        index = robot.link(link)
        joint, at, _ = links[index]
        thing = pin.GeometryObject(f"{link}/{piece}", joint, frames[index], pin.SE3(at @ place), shape)
        numbers_of[index, piece] = geometry.addGeometryObject(thing)

    shapes = shapes_of(robot, kind)
    if isinstance(shapes, Spheres):
        for link, piece, centre, radius in zip(*shapes, strict=True):
            place = np.eye(4)
            place[:3, 3] = centre
            add(link, int(piece), coal.Sphere(float(radius)), place)
    else:
        for shape in shapes:
            if isinstance(shape, Box):
                add(shape.link, shape.piece, coal.Box(*(2 * shape.half_extents).tolist()), shape.pose)
            else:
                add(shape.link, shape.piece, _convex(coal, shape), np.eye(4))
    for (a, i), (b, j) in Proximity(robot, kind).pair_indices.tolist():
        geometry.addCollisionPair(pin.CollisionPair(numbers_of[a, i], numbers_of[b, j]))
    return geometry


def _convex(coal: Any, mesh: ConvexMesh) -> Any:
    vertices = coal.StdVec_Vec3s()
    vertices.extend(list(mesh.vertices))
    triangles = coal.StdVec_Triangle()
    for face in mesh.faces.tolist():
        triangles.append(coal.Triangle(*face))
    return coal.Convex(vertices, triangles)
