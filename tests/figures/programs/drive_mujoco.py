#!/usr/bin/env python3
"""Driver of MuJoCo 4.0.0 and 3.3.7.

Verdict: mujoco.MjModel.from_xml_path(file). Facts: the same file as MjSpec (before static bodies
are fused, visuals are discarded as always), and that spec compiled with fusestatic off; where this
second compilation fails (a fixed link without mass may pass only fused), inertias come from the
model of the verdict, for the bodies that are left in it.
PACKAGES is not used: MuJoCo knows no packages.
MuJoCo 3.3 keeps of a mesh's file name the part behind the last / alone, and looks for it beside the URDF
(strippath, in a URDF always on). For versions before 4 this driver therefore puts links to every mesh below
the URDF's folder (and below PACKAGES) into one folder, with a copy of the URDF, as a user of 3.3 does;
MUJOCO_FLAT=0 in the environment switches that off.
"""

import json, os, sys, tempfile

proto = os.fdopen(os.dup(1), "w", buffering=1, encoding="utf-8", errors="surrogateescape")
catch = tempfile.TemporaryFile()
os.dup2(catch.fileno(), 1)
os.dup2(catch.fileno(), 2)
home = os.getcwd()
os.chdir(tempfile.mkdtemp(prefix="mj_"))  # MUJOCO_LOG.TXT goes there
import mujoco, numpy as np  # noqa


def num(x):
    s = "%.7g" % float(x)
    return "0" if s == "-0" else s


def nums(v):
    return " ".join(num(x) for x in v)


def quat(q):
    q = np.array(q, float)
    n = np.linalg.norm(q)
    if n > 0:
        q = q / n
    if q[0] < 0 or (abs(q[0]) < 1e-12 and (q[1] < 0 or (q[1] == 0 and (q[2] < 0 or (q[2] == 0 and q[3] < 0))))):
        q = -q
    q[np.abs(q) < 1e-12] = 0
    return q


def pose(p, q):
    return nums(p) + " " + nums(quat(q))


JT = {
    mujoco.mjtJoint.mjJNT_FREE: "floating",
    mujoco.mjtJoint.mjJNT_BALL: "spherical",
    mujoco.mjtJoint.mjJNT_SLIDE: "prismatic",
    mujoco.mjtJoint.mjJNT_HINGE: "revolute",
}


def geometry(g, spec):
    t = g.type
    s = g.size
    if t == mujoco.mjtGeom.mjGEOM_BOX:
        return "box " + nums(2 * np.array(s))
    if t == mujoco.mjtGeom.mjGEOM_CYLINDER:
        return "cylinder " + nums([s[0], 2 * s[1]])
    if t == mujoco.mjtGeom.mjGEOM_CAPSULE:
        return "capsule " + nums([s[0], 2 * s[1]])
    if t == mujoco.mjtGeom.mjGEOM_SPHERE:
        return "sphere " + nums(s[:1])
    if t == mujoco.mjtGeom.mjGEOM_MESH:
        for m in spec.meshes:
            if m.name == g.meshname or (not m.name and os.path.splitext(os.path.basename(m.file))[0] == g.meshname):
                return "mesh %s %s" % (m.file, nums(m.scale))
        return "mesh ? " + g.meshname
    return str(t)


def facts_of(path, model):
    f = {}
    spec = mujoco.MjSpec.from_file(path)
    f["robot"] = spec.modelname
    for b in spec.bodies:
        if b.name == "world":
            continue
        k = "link/" + b.name
        f[k] = 1
        if b.explicitinertial:
            f[k + "/inertial"] = 1
        n = 0
        for g in b.geoms:
            c = "%s/collision/%d" % (k, n)
            n += 1
            f[c + "/geometry"] = geometry(g, spec)
            f[c + "/origin"] = pose(g.pos, g.quat)
            if g.name:
                f[c + "/name"] = g.name
            f[c + "/color"] = nums(g.rgba)
        f[k + "/collision"] = n
        for j in b.joints:
            q = "joint/" + j.name
            f[q] = JT.get(j.type, str(j.type))
            f[q + "/parent"] = b.parent.name
            f[q + "/child"] = b.name
            f[q + "/origin"] = pose(b.pos, b.quat)
    world = [b for b in spec.bodies if b.name == "world"]
    for w in world:
        if w.geoms:
            f["link/world/collision"] = len(w.geoms)
    try:
        spec.compiler.fusestatic = False
    except Exception:
        spec.fusestatic = False
    full = model
    try:
        full = spec.compile()
    except Exception:
        full = None
    if full is None:
        # only fused does it compile: masses of links from the spec, no inertias
        for b in spec.bodies:
            if b.name != "world" and b.explicitinertial:
                f["link/%s/inertial/mass" % b.name] = num(b.mass)
                f["link/%s/inertial/com" % b.name] = nums(b.ipos)
    M = mujoco
    for i in range(1, full.nbody if full is not None else 0):
        name = full.body(i).name
        k = "link/" + name
        if f.get(k + "/inertial") or full.body_mass[i] > 0:
            f[k + "/inertial/mass"] = num(full.body_mass[i])
            f[k + "/inertial/com"] = nums(full.body_ipos[i])
            R = np.zeros(9)
            M.mju_quat2Mat(R, full.body_iquat[i])
            R = R.reshape(3, 3)
            I = R @ np.diag(full.body_inertia[i]) @ R.T
            scale = max(1e-30, np.abs(I).max())
            I[np.abs(I) < 1e-9 * scale] = 0
            f[k + "/inertial/inertia"] = nums([I[0, 0], I[0, 1], I[0, 2], I[1, 1], I[1, 2], I[2, 2]])
    full = model if full is None else full
    for i in range(full.njnt):
        q = "joint/" + full.joint(i).name
        if full.jnt_type[i] in (2, 3):
            f[q + "/axis"] = nums(full.jnt_axis[i])
        if full.jnt_limited[i]:
            f[q + "/lower"] = num(full.jnt_range[i][0])
            f[q + "/upper"] = num(full.jnt_range[i][1])
        elif f.get(q) == "revolute":
            f[q] = "continuous"
        if full.jnt_actfrclimited[i]:
            f[q + "/effort"] = num(full.jnt_actfrcrange[i][1])
        d = full.jnt_dofadr[i]
        f[q + "/damping"] = num(np.ravel(full.dof_damping[d])[0])
        f[q + "/friction"] = num(full.dof_frictionloss[d])
    for i in range(full.neq):
        if full.eq_type[i] == mujoco.mjtEq.mjEQ_JOINT:
            a, b = full.eq_obj1id[i], full.eq_obj2id[i]
            if b >= 0:
                f["joint/%s/mimic" % full.joint(a).name] = "%s %s %s" % (
                    full.joint(b).name,
                    num(full.eq_data[i][1]),
                    num(full.eq_data[i][0]),
                )
    return f


FLAT = int(mujoco.__version__.split(".")[0]) < 4 and os.environ.get("MUJOCO_FLAT") != "0"
FLATS = {}


def flat(path):
    """A folder with links to all meshes, side by side, and with the URDF."""
    folder = os.path.dirname(path)
    if folder not in FLATS:
        made = tempfile.mkdtemp(prefix="mjflat_")
        for top in [folder] + [x for x in os.environ.get("PACKAGES", "").split(os.pathsep) if x]:
            for d, ds, fs in os.walk(top):
                ds.sort()
                for n in sorted(fs):
                    if (
                        not n.lower().endswith((".urdf", ".xml", ".json", ".py"))
                        and len(os.listdir(made)) < 1500
                        and not os.path.lexists(os.path.join(made, n))
                    ):
                        os.symlink(os.path.join(d, n), os.path.join(made, n))
        FLATS[folder] = made
    there = os.path.join(FLATS[folder], os.path.basename(path))
    if os.path.lexists(there):
        os.unlink(there)
    with open(path, "rb") as f, open(there, "wb") as g:
        g.write(f.read())
    return there


def said(fresh):
    catch.seek(fresh)
    t = catch.read().decode("utf-8", "replace")
    catch.seek(0, 2)
    out = []
    for line in t.splitlines():
        line = line.strip()
        if line and line not in out:
            out.append(line)
    return out[:50]


for line in sys.stdin:
    path = line.rstrip("\n")
    if not os.path.isabs(path):
        path = os.path.join(home, path)
    catch.seek(0, 2)
    start = catch.tell()
    out = {"verdict": "loads", "why": "", "facts": {}}
    try:
        if FLAT:
            path = flat(path)
        model = mujoco.MjModel.from_xml_path(path)
    except Exception as e:  # ValueError; FatalError for mju_error
        out["verdict"] = "refuses"
        out["why"] = " ".join(str(e).split())[:300]
        model = None
    s = said(start)
    if model is not None:
        try:
            out["facts"] = facts_of(path, model)
        except Exception as e:
            out["facts_error"] = repr(e)[:300]
    if s:
        out["said"] = s
    proto.write(json.dumps(out) + "\n")
    proto.flush()
