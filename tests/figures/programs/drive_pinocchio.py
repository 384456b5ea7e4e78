#!/usr/bin/env python3
"""Driver: Pinocchio 4.1 (buildModelFromUrdf, then buildGeomFromUrdf for collisions and visuals). Protocol: paths on
stdin, JSON lines on stdout.
package_dirs = the URDF's folder, then the folders of PACKAGES (Pinocchio looks for relative file names there, not beside
the URDF). PIN_MODE=plain (default) | mimic (mimic=True) | root (JointModelFreeFlyer) | nodirs (no package_dirs) | model
(no geometry)."""

import json, os, re, resource, sys, tempfile

out = os.fdopen(os.dup(1), "w", buffering=1)
log = tempfile.TemporaryFile(mode="w+b")
os.dup2(log.fileno(), 1)
os.dup2(log.fileno(), 2)
import numpy as np
import pinocchio as pin
import coal

resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
PACKAGES = [x for x in os.environ.get("PACKAGES", "").split(os.pathsep) if x]
MODE = os.environ.get("PIN_MODE", "plain")


def num(v):
    v = float(v)
    return "%.7g" % (v if v != 0 else 0.0)


def clean(v, scale=1.0):
    return [0.0 if abs(float(x)) < 1e-13 * max(scale, 1e-300) else float(x) for x in v]


def nums(v):
    return " ".join(num(x) for x in v)


def pose(M):
    w, x, y, z = 0, 0, 0, 0
    q = pin.Quaternion(M.rotation)
    w, x, y, z = clean([q.w, q.x, q.y, q.z])
    if w < 0 or (w == 0 and (x < 0 or (x == 0 and (y < 0 or (y == 0 and z < 0))))):
        w, x, y, z = -w, -x, -y, -z
    t = M.translation
    return nums(clean(t, max(1.0, float(np.max(np.abs(t)))))) + " " + nums([w, x, y, z])


def inertia(facts, key, mass, com, I):
    if mass == 0 and not np.any(I):
        return
    facts[key] = "1"
    facts[key + "/mass"] = num(mass)
    facts[key + "/com"] = nums(clean(com))
    s = float(np.max(np.abs(I))) if np.all(np.isfinite(I)) else 1.0
    facts[key + "/inertia"] = nums(clean([I[0, 0], I[0, 1], I[0, 2], I[1, 1], I[1, 2], I[2, 2]], s * 10))


def shape(g, o, base):
    if o.meshPath in ("BOX", "SPHERE", "CYLINDER", "CAPSULE") or isinstance(g, (coal.Capsule,)):
        if isinstance(g, coal.Box):
            return "box " + nums(2 * g.halfSide)
        if isinstance(g, coal.Sphere):
            return "sphere " + num(g.radius)
        if isinstance(g, coal.Cylinder):
            return "cylinder " + nums([g.radius, 2 * g.halfLength])
        if isinstance(g, coal.Capsule):
            return "capsule " + nums([g.radius, 2 * g.halfLength])
    f = o.meshPath
    for b in [base, *PACKAGES]:
        if f.startswith(b + "/"):
            f = f[len(b) + 1 :]
            break
    return "mesh %s %s" % (f, nums(o.meshScale))


TYPES = [
    ("JointModelRUB", "continuous"),
    ("JointModelRevoluteUnbounded", "continuous"),
    ("JointModelR", "revolute"),
    ("JointModelPlanar", "planar"),
    ("JointModelP", "prismatic"),
    ("JointModelFreeFlyer", "floating"),
    ("JointModelMimic", "mimic"),
]


def collect(m, geoms, base):
    f = {"robot": m.name}
    T = pin.FrameType
    q0 = pin.neutral(m)
    frames = list(m.frames)
    bodies = {i: x for i, x in enumerate(frames) if x.type == T.BODY}
    fixed = [x for i, x in enumerate(frames) if x.type == T.FIXED_JOINT and i > 0]
    for i, x in bodies.items():
        key = "link/" + x.name
        f[key] = "1"
        up = frames[x.parentFrame]
        if x.parentFrame == 0:
            Y = x.inertia
            inertia(f, key + "/inertial", Y.mass, Y.lever, Y.inertia)
        elif up.type == T.FIXED_JOINT:
            Y = up.inertia
            inertia(f, key + "/inertial", Y.mass, Y.lever, Y.inertia)
        else:
            Y = m.inertias[x.parentJoint]
            rest = [
                z
                for z in fixed
                if z.parentJoint == x.parentJoint and (z.inertia.mass != 0 or np.any(z.inertia.inertia))
            ]
            if not rest:
                inertia(f, key + "/inertial", Y.mass, Y.lever, Y.inertia)
            else:  # take the fixed children off again: first moments and inertia about the joint's origin are sums

                def params(Y):
                    c = np.array(Y.lever)
                    return Y.mass, Y.mass * c, np.array(Y.inertia) + Y.mass * (c @ c * np.eye(3) - np.outer(c, c))

                M, h, I = params(Y)
                M0, I0 = M, np.max(np.abs(I))
                for z in rest:
                    a, b, c = params(z.placement.act(z.inertia))
                    M, h, I = M - a, h - b, I - c
                if abs(M) < 1e-12 * abs(M0) and np.max(np.abs(I)) < 1e-12 * I0:
                    continue
                c = h / M if M else h
                I = I - M * (c @ c * np.eye(3) - np.outer(c, c))
                c = [round(v, 12) for v in c]
                d = 12 - int(np.floor(np.log10(I0))) - 1 if I0 > 0 and np.isfinite(I0) else 12
                I = np.round(I, min(max(d, 0), 20))
                inertia(f, key + "/inertial", round(M, 12), c, I)
    child = {}
    for x in bodies.values():
        child[x.parentFrame] = x.name
    for i, x in enumerate(frames):
        if i == 0 or x.type not in (T.JOINT, T.FIXED_JOINT):
            continue
        key = "joint/" + x.name
        up = frames[x.parentFrame]
        if x.parentFrame != 0:
            f[key + "/parent"] = up.name
        if i in child:
            f[key + "/child"] = child[i]
        if x.type == T.FIXED_JOINT:
            f[key] = "fixed"
            f[key + "/origin"] = pose(up.placement.inverse() * x.placement)
            continue
        j = m.joints[x.parentJoint]
        f[key + "/origin"] = pose(up.placement.inverse() * m.jointPlacements[x.parentJoint])
        s = j.shortname()
        t = next((t for p, t in TYPES if s.startswith(p)), s)
        f[key] = t
        if t in ("revolute", "continuous", "prismatic"):
            if s[-1] in "XYZ":
                f[key + "/axis"] = {"X": "1 0 0", "Y": "0 1 0", "Z": "0 0 1"}[s[-1]]
            else:
                d = j.createData()
                j.calc(d, q0)
                S = np.array(d.S).reshape(6, -1)[:, 0]
                f[key + "/axis"] = nums(clean(S[:3] if t == "prismatic" else S[3:]))
        if t == "mimic":
            e = j.extract() if hasattr(j, "extract") else None
            k = list(m.mimicking_joints).index(x.parentJoint)
            f[key + "/mimic"] = "%s %s" % (m.names[list(m.mimicked_joints)[k]], nums([e.scaling, e.offset]))
        if j.nq == 1 and j.nv == 1 and t != "mimic":
            f[key + "/lower"] = num(m.lowerPositionLimit[j.idx_q])
            f[key + "/upper"] = num(m.upperPositionLimit[j.idx_q])
        if j.nv == 1 and t != "mimic":
            f[key + "/effort"] = num(m.upperEffortLimit[j.idx_v])
            f[key + "/velocity"] = num(m.upperVelocityLimit[j.idx_v])
            f[key + "/friction"] = num(m.upperDryFrictionLimit[j.idx_v])
            f[key + "/damping"] = num(m.damping[j.idx_v])
            for a, k in (
                ("upperAccelerationLimit", "acceleration"),
                ("lowerAccelerationLimit", "deceleration"),
                ("upperJerkLimit", "jerk"),
            ):
                if hasattr(m, a):
                    f[key + "/" + k] = num(abs(getattr(m, a)[j.idx_v]))
    for kind, g in geoms.items():
        for x in bodies.values():
            f["link/%s/%s" % (x.name, kind)] = "0"
        for o in g.geometryObjects:
            link = frames[o.parentFrame].name
            key = "link/%s/%s" % (link, kind)
            f[key] = str(int(f[key]) + 1)
            n = o.name.rsplit("_", 1)[1]
            e = "%s/%s" % (key, n)
            f[e + "/geometry"] = shape(o.geometry, o, base)
            f[e + "/origin"] = pose(frames[o.parentFrame].placement.inverse() * o.placement)
            if o.overrideMaterial:
                f[e + "/color"] = nums(o.meshColor)
            if o.meshTexturePath:
                t = o.meshTexturePath
                f[e + "/texture"] = t[len(base) + 1 :] if t.startswith(base + "/") else t
            if hasattr(o.geometry, "num_tris"):
                f[e + "/triangles"] = str(o.geometry.num_tris)
    return f


for line in sys.stdin:
    path = line.rstrip("\n")
    log.seek(0)
    log.truncate()
    base = os.path.dirname(os.path.abspath(path))
    dirs = [base, *PACKAGES]
    r = {"verdict": "refuses", "why": "", "facts": {}}
    stage, geoms = "model", {}
    try:
        if MODE == "mimic":
            m = pin.buildModelFromUrdf(path, True)
        elif MODE == "root":
            m = pin.buildModelFromUrdf(path, pin.JointModelFreeFlyer())
        else:
            m = pin.buildModelFromUrdf(path)
        if MODE != "model":
            for stage, t in (("collision", pin.GeometryType.COLLISION), ("visual", pin.GeometryType.VISUAL)):
                geoms[stage] = (
                    pin.buildGeomFromUrdf(m, path, t)
                    if MODE == "nodirs"
                    else pin.buildGeomFromUrdf(m, path, t, package_dirs=dirs)
                )
        r["verdict"] = "loads"
        stage = "facts"
        r["facts"] = collect(m, geoms, base)
    except Exception as e:
        t = " ".join(str(e).split())
        if r["verdict"] == "loads":
            r["facts_error"] = t[:200]
        else:
            r["why"] = "%s: %s: %s" % (stage, type(e).__name__, t[:300])
    log.seek(0)
    said = [" ".join(x.split()) for x in log.read().decode("utf-8", "replace").splitlines()]
    said = [x for x in said if x and not x.startswith("at line ")]
    if said:
        r["said"] = said[:40]
        if "does not contain a valid URDF model" in r["why"]:
            r["why"] = "urdfdom: " + next((x for x in said if x.startswith("Error")), said[0])
    out.write(json.dumps(r) + "\n")
    out.flush()
