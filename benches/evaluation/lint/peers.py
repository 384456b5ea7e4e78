"""A URDF of inertias and joints alone, in MuJoCo and in Pinocchio."""

from __future__ import annotations

import re
from typing import Any

import mujoco
import numpy as np
import pinocchio
from model import Robot
from shapes import link_shapes

START, STEPS, STEP, FREQUENCY = 0.05, 1000, 0.002, 10.0  # rad or m, -, s, rad/s
REFUSALS = {
    "A \\+ B >= C": "triangle inequality",
    "positive eigenvalues": "not positive definite",
    "mjMINVAL": "mass or inertia too small",
    "missing element|required attribute": "incomplete",
}
UNSTABLE, GROWS = "unstable", "grows"  # MuJoCo's warning; energy by 10 % of the kinetic, or 1 rad with a PD
Rng = np.random.default_rng
WARNINGS = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
mujoco.set_mju_user_warning(lambda _: None)  # otherwise it writes MUJOCO_LOG.TXT


def text(values: Any) -> str:
    return " ".join(repr(float(x)) for x in values)


class Model:
    """A URDF of inertias and joints alone, as both peers read it."""

    def __init__(self, robot: Robot, inertials: dict[str, str], floats: bool, boxed: set[str]) -> None:
        at = {name: f"L{i}" for i, name in enumerate(robot.links)}
        parts = []
        for name, new in at.items():
            shapes = link_shapes(robot)[name] if name in boxed and not inertials[name] else []
            points, box = [p for kind, p in shapes if kind == "collision" and p is not None], ""
            if points:
                low, high = np.concatenate(points).min(axis=0), np.concatenate(points).max(axis=0)
                size = text(np.maximum(high - low, 1e-4))
                box = f'<origin xyz="{text((low + high) / 2)}"/><geometry><box size="{size}"/></geometry>'
                box = f"<collision>{box}</collision>"
            parts.append(f'<link name="{new}">{inertials[name]}{box}</link>')
        for i, joint in enumerate(robot.joints.values()):
            kind = "revolute" if joint.type == "continuous" else joint.type
            rpy, axis = pinocchio.rpy.matrixToRpy(joint.origin[:3, :3]), joint.axis or (1, 0, 0)
            parts.append(
                f'<joint name="J{i}" type="{kind}"><parent link="{at[joint.parent]}"/><child link="{at[joint.child]}"/>'
                f'<origin xyz="{text(joint.origin[:3, 3])}" rpy="{text(rpy)}"/><axis xyz="{text(axis)}"/>'
                '<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'
            )
        if floats:
            parts.append('<link name="world"/><joint name="F" type="floating"><parent link="world"/>')
            parts.append(f'<child link="{at[robot.roots[0]]}"/></joint>')
        self.xml = f'<robot name="r">{"".join(parts)}</robot>'
        self.refused = ""
        self.model: Any = None
        try:
            self.model = mujoco.MjModel.from_xml_string(self.xml)
        except ValueError as error:
            kinds = (kind for pattern, kind in REFUSALS.items() if re.search(pattern, str(error)))
            self.refused = next(kinds, "other: " + str(error).splitlines()[0])
        self.pinocchio = self.facts()

    def facts(self) -> dict[str, Any] | None:
        """Pinocchio: M's diagonal at zero, whether M is definite, its condition, gravity's torques; None if refused."""
        try:
            model = pinocchio.buildModelFromXML(self.xml)
        except (ValueError, RuntimeError):
            return None
        data, rng, definite, condition, gravity = model.createData(), Rng(1), True, 0.0, []
        zero = pinocchio.neutral(model)
        diagonal = pinocchio.crba(model, data, zero).diagonal().copy()
        for _ in range(20):
            q = pinocchio.integrate(model, zero, rng.uniform(-1.5, 1.5, model.nv))
            upper = np.triu(pinocchio.crba(model, data, q))
            if model.nv:
                values = np.linalg.eigvalsh(upper + np.triu(upper, 1).T)
                definite &= bool(values[0] > 1e-14 * values[-1])
                condition = max(condition, values[-1] / values[0] if values[0] > 0 else np.inf)
            gravity.append(pinocchio.computeGeneralizedGravity(model, data, q).copy())
        return {"diagonal": diagonal, "definite": definite, "condition": condition, "gravity": np.array(gravity)}

    def moved(self, gains: Any = None) -> tuple[str, Any]:
        """Two seconds in MuJoCo, free under gravity, or with a PD and without it: what goes wrong, the joints' path."""
        m = self.model
        flags = mujoco.mjtDisableBit
        m.opt.timestep, m.opt.enableflags = STEP, int(mujoco.mjtEnableBit.mjENBL_ENERGY)
        m.opt.disableflags = int(flags.mjDSBL_CONTACT | flags.mjDSBL_LIMIT)
        if gains is not None:
            m.opt.disableflags |= int(flags.mjDSBL_GRAVITY)
        d, single = mujoco.MjData(m), m.jnt_type >= int(mujoco.mjtJoint.mjJNT_SLIDE)
        at, dof = m.jnt_qposadr[single], m.jnt_dofadr[single]
        d.qpos[at] = Rng(1).uniform(-START, START, len(at))
        d.qvel[:] = 0 if len(at) else 0.1
        energy, kinetic, path = [], [], []
        for _ in range(STEPS):
            if gains is not None:
                d.qfrc_applied[dof] = -gains[dof] * (FREQUENCY**2 * d.qpos[at] + 2 * FREQUENCY * d.qvel[dof])
            mujoco.mj_step(m, d)
            if any(d.warning[int(kind)].number for kind in WARNINGS) or not np.isfinite(d.qpos).all():
                return UNSTABLE, None
            energy.append(d.energy.sum())
            kinetic.append(d.energy[1])
            path.append(d.qpos[at].copy())
        if gains is not None:
            return GROWS if len(at) and np.abs(path).max() > 20 * START else "", np.array(path)
        return GROWS if max(energy) - energy[0] > 0.1 * max(*kinetic, 1e-9) else "", np.array(path)

    def gains(self) -> Any:
        """The diagonal of M at zero."""
        d, full = mujoco.MjData(self.model), np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_forward(self.model, d)
        mujoco.mj_fullM(self.model, d, full)
        return full.diagonal().copy()

    def said(self, gains: Any = None) -> dict[str, Any]:
        """What both peers say of the whole robot; the gains are those of the PD, if they are not its own."""
        facts = self.pinocchio
        row: dict[str, Any] = {"mujoco": self.refused, "pinocchio": facts is not None}
        if facts is not None and len(facts["diagonal"]):
            row |= {"definite": facts["definite"], "condition": facts["condition"], "least": facts["diagonal"].min()}
        if self.model is not None and self.model.nv:
            gains = gains if gains is not None else self.gains()
            row |= {"free": self.moved()[0], "pd": self.moved(gains)[0]}
        return row
