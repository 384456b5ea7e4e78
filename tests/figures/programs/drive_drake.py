#!/usr/bin/env python3
"""Driver of Drake 1.51.1.

plant, scene_graph = AddMultibodyPlantSceneGraph(DiagramBuilder(), time_step=0.001)
Parser(plant).AddModels(file) ; plant.Finalize()
PACKAGES: each folder goes to package_map().PopulateFromFolder(folder).
"""

import json, os, sys, tempfile

proto = os.fdopen(os.dup(1), "w", buffering=1, encoding="utf-8", errors="surrogateescape")
catch = tempfile.TemporaryFile()
os.dup2(catch.fileno(), 1)
os.dup2(catch.fileno(), 2)
import logging  # noqa
import numpy as np  # noqa
from pydrake.systems.framework import DiagramBuilder  # noqa
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph  # noqa
from pydrake.multibody.parsing import Parser  # noqa
from pydrake.multibody.tree import BodyIndex, FrameIndex, JointIndex  # noqa
import pydrake.geometry as pg  # noqa


class Keep(logging.Handler):
    lines = []

    def emit(self, record):
        Keep.lines.append("%s: %s" % (record.levelname, record.getMessage()))


log = logging.getLogger("drake")
for h in list(log.handlers):
    log.removeHandler(h)
log.addHandler(Keep())
log.propagate = False

TYPES = {
    "weld": "fixed",
    "revolute": "revolute",
    "prismatic": "prismatic",
    "planar": "planar",
    "quaternion_floating": "floating",
    "rpy_floating": "floating",
    "ball_rpy": "spherical",
}


def num(x):
    s = "%.7g" % float(x)
    return "0" if s == "-0" else s


def nums(v):
    return " ".join(num(x) for x in v)


def pose(X):
    q = X.rotation().ToQuaternion()
    q = np.array([q.w(), q.x(), q.y(), q.z()])
    q[np.abs(q) < 1e-12] = 0
    if q[0] < 0 or (q[0] == 0 and ([x for x in q[1:] if x] or [0])[0] < 0):
        q = -q
    return nums(X.translation()) + " " + nums(q)


def shape_of(s):
    if isinstance(s, pg.Box):
        return "box " + nums([s.width(), s.depth(), s.height()])
    if isinstance(s, pg.Cylinder):
        return "cylinder " + nums([s.radius(), s.length()])
    if isinstance(s, pg.Sphere):
        return "sphere " + num(s.radius())
    if isinstance(s, pg.Capsule):
        return "capsule " + nums([s.radius(), s.length()])
    if isinstance(s, (pg.Mesh, pg.Convex)):
        f = s.source()
        f = f.path() if f.is_path() else "?"
        try:
            sc = s.scale3()
        except Exception:
            sc = [s.scale()] * 3
        return "mesh %s %s" % (f, nums(sc))
    return str(type(s).__name__)


def facts_of(plant, sg, models):
    f = {}
    insp = sg.model_inspector()
    for model in models:
        f["robot"] = plant.GetModelInstanceName(model)
    bodies = list(plant.GetBodyIndices(models[0])) if models else []
    for bi in [BodyIndex(0)] + bodies:
        b = plant.get_body(bi)
        name = b.name()
        vis = plant.GetVisualGeometriesForBody(b)
        col = plant.GetCollisionGeometriesForBody(b)
        k = "link/" + name
        if bi == BodyIndex(0):
            if not vis and not col:
                continue
        f[k] = 1
        if bi != BodyIndex(0):
            M = b.default_spatial_inertia()
            m, c = M.get_mass(), M.get_com()
            f[k + "/inertial/mass"] = num(m)
            if m > 0:
                f[k + "/inertial"] = 1
                f[k + "/inertial/com"] = nums(c)
                I = M.Shift(c).CalcRotationalInertia().CopyToFullMatrix3()
                sc = max(1e-30, np.abs(I).max())
                I[np.abs(I) < 1e-12 * sc] = 0
                f[k + "/inertial/inertia"] = nums([I[0, 0], I[0, 1], I[0, 2], I[1, 1], I[1, 2], I[2, 2]])
        for word, ids in (("visual", vis), ("collision", col)):
            f["%s/%s" % (k, word)] = len(ids)
            for i, g in enumerate(ids):
                q = "%s/%s/%d" % (k, word, i)
                f[q + "/geometry"] = shape_of(insp.GetShape(g))
                f[q + "/origin"] = pose(insp.GetPoseInFrame(g))
                n = insp.GetName(g)
                f[q + "/name"] = n.split("::", 1)[-1]
                if word == "visual":
                    p = insp.GetIllustrationProperties(g)
                    if p is not None and p.HasProperty("phong", "diffuse"):
                        c = p.GetProperty("phong", "diffuse")
                        f[q + "/color"] = nums([c.r(), c.g(), c.b(), c.a()] if hasattr(c, "r") else c)
                    if p is not None and p.HasProperty("phong", "diffuse_map"):
                        f[q + "/texture"] = str(p.GetProperty("phong", "diffuse_map"))
    for model in models:
        for ji in plant.GetJointIndices(model):
            j = plant.get_joint(ji)
            q = "joint/" + j.name()
            t = j.type_name()
            if t == "quaternion_floating":
                continue  # the free body that Finalize adds
            f[q] = TYPES.get(t, t)
            f[q + "/parent"] = j.parent_body().name()
            f[q + "/child"] = j.child_body().name()
            X = j.frame_on_parent().GetFixedPoseInBodyFrame()
            if t == "planar":  # Drake turns both frames so that z is the axis
                X = X.multiply(j.frame_on_child().GetFixedPoseInBodyFrame().inverse())
            f[q + "/origin"] = pose(X)
            if t == "revolute":
                f[q + "/axis"] = nums(j.revolute_axis())
            if t == "prismatic":
                f[q + "/axis"] = nums(j.translation_axis())
            if t == "planar":
                f[q + "/axis"] = nums(j.frame_on_child().GetFixedPoseInBodyFrame().rotation().matrix()[:, 2])
            if t in ("revolute", "prismatic"):
                lo, up = j.position_lower_limits()[0], j.position_upper_limits()[0]
                if t == "revolute" and np.isinf(lo) and np.isinf(up):
                    f[q] = "continuous"
                if np.isfinite(lo):
                    f[q + "/lower"] = num(lo)
                if np.isfinite(up):
                    f[q + "/upper"] = num(up)
                if np.isfinite(j.velocity_upper_limits()[0]):
                    f[q + "/velocity"] = num(j.velocity_upper_limits()[0])
                if np.isfinite(j.acceleration_upper_limits()[0]):
                    f[q + "/acceleration"] = num(j.acceleration_upper_limits()[0])
            if t in ("revolute", "prismatic", "planar"):
                d = j.default_damping_vector() if hasattr(j, "default_damping_vector") else [j.default_damping()]
                f[q + "/damping"] = nums(d)
        for ai in plant.GetJointActuatorIndices(model):
            a = plant.get_joint_actuator(ai)
            f["transmission/" + a.name()] = "joint %s effort %s" % (a.joint().name(), num(a.effort_limit()))
            f["joint/%s/effort" % a.joint().name()] = num(a.effort_limit())
    f["constraints"] = plant.num_constraints() if hasattr(plant, "num_constraints") else 0
    try:
        for c in plant.get_coupler_constraint_specs().values():
            j0, j1 = plant.get_joint(c.joint0_index), plant.get_joint(c.joint1_index)
            f["joint/%s/mimic" % j0.name()] = "%s %s %s" % (j1.name(), num(c.gear_ratio), num(c.offset))
    except AttributeError:
        pass
    return f


for line in sys.stdin:
    path = os.path.abspath(line.rstrip("\n"))
    catch.seek(0, 2)
    start = catch.tell()
    Keep.lines = []
    out = {"verdict": "loads", "why": "", "facts": {}}
    try:
        builder = DiagramBuilder()
        plant, sg = AddMultibodyPlantSceneGraph(builder, time_step=0.001)
        parser = Parser(plant)
        for folder in os.environ.get("PACKAGES", "").split(os.pathsep):
            if folder:
                parser.package_map().PopulateFromFolder(folder)
        models = parser.AddModels(path)
        plant.Finalize()
    except BaseException as e:
        if isinstance(e, KeyboardInterrupt):
            raise
        out["verdict"] = "refuses"
        out["why"] = (type(e).__name__ + ": " + " ".join(str(e).split()))[:300]
    else:
        try:
            out["facts"] = facts_of(plant, sg, models)
        except Exception as e:
            out["facts_error"] = repr(e)[:300]
    catch.seek(start)
    t = catch.read().decode("utf-8", "replace")
    s = Keep.lines + [x for x in t.splitlines() if x.strip()]
    if s:
        out["said"] = s[:50]
    proto.write(json.dumps(out) + "\n")
    proto.flush()
