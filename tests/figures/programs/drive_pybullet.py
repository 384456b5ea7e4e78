#!/usr/bin/env python3
"""Driver: PyBullet (pybullet.loadURDF in DIRECT, default flags). Protocol: paths on stdin, JSON lines on stdout.
"""

import atexit, json, os, re, sys, tempfile

out = os.fdopen(os.dup(1), "w", buffering=1)
log = tempfile.TemporaryFile(mode="w+b")
os.dup2(log.fileno(), 1)
os.dup2(log.fileno(), 2)
import numpy as np
import pybullet as p

# The working folder holds nothing: meshes must be found from the URDF's own place.
EMPTY = tempfile.mkdtemp(prefix="pb_cwd_")
atexit.register(lambda: (os.chdir("/"), os.rmdir(EMPTY)))
PACKAGES = [x for x in os.environ.get("PACKAGES", "").split(os.pathsep) if x]


def num(v):
    v = float(v)
    return "%.7g" % (v + 0.0 if v != 0 else 0.0)


def nums(v):
    return " ".join(num(x) for x in v)


def fd(v, r):
    """Numbers that went through single precision or an eigen-decomposition: rounded."""
    return [round(float(x), r) if np.isfinite(x) else float(x) for x in v]


def quat_mul(a, b):  # xyzw
    return p.multiplyTransforms([0, 0, 0], a, [0, 0, 0], b)[1]


def mat(q):
    return np.array(p.getMatrixFromQuaternion(q)).reshape(3, 3)


def pose(pos, q):
    x, y, z, w = q
    if w < 0 or (w == 0 and (x < 0 or (x == 0 and (y < 0 or (y == 0 and z < 0))))):
        x, y, z, w = -x, -y, -z, -w
    return nums([*pos, w, x, y, z])


def text(b):
    return b.decode("utf-8", "replace") if isinstance(b, bytes) else str(b)


JOINT = {0: "revolute", 1: "prismatic", 2: "spherical", 3: "planar", 4: "fixed", 5: "point2point", 6: "gear"}


def geometry(kind, dims, file):
    if kind == p.GEOM_BOX:
        return "box " + nums(dims)
    if kind == p.GEOM_SPHERE:
        return "sphere " + num(dims[0])
    if kind == p.GEOM_CYLINDER:
        return "cylinder %s %s" % (num(dims[1]), num(dims[0]))
    if kind == p.GEOM_CAPSULE:
        return "capsule %s %s" % (num(dims[1]), num(dims[0]))
    if kind == p.GEOM_MESH:
        return "mesh %s %s" % (os.path.basename(text(file)), nums(dims))
    if kind == p.GEOM_PLANE:
        return "plane " + nums(dims)
    return "type%d %s" % (kind, nums(dims))


def facts(body):
    f = {}
    base, robot = p.getBodyInfo(body)
    n = p.getNumJoints(body)
    links = {-1: text(base)}
    info = {}
    for j in range(n):
        info[j] = p.getJointInfo(body, j)
        links[j] = text(info[j][12])
    f["robot"] = text(robot)
    dyn = {i: p.getDynamicsInfo(body, i) for i in links}
    frame = {}
    bpos, born = p.getBasePositionAndOrientation(body)
    ipos, iorn = p.invertTransform(dyn[-1][3], dyn[-1][4])
    frame[-1] = p.multiplyTransforms(bpos, born, ipos, iorn)
    for j in range(n):
        s = p.getLinkState(body, j, computeForwardKinematics=1)
        frame[j] = (s[4], s[5])
    for i, name in links.items():
        k = "link/" + name
        f[k] = "1"
        d = dyn[i]
        f[k + "/inertial"] = "1"
        f[k + "/inertial/mass"] = num(d[0])
        f[k + "/inertial/com"] = nums(d[3])
        r = mat(d[4])
        m = r @ np.diag(d[2]) @ r.T
        f[k + "/inertial/inertia"] = nums([m[0, 0], m[0, 1], m[0, 2], m[1, 1], m[1, 2], m[2, 2]])
        shapes = p.getCollisionShapeData(body, i)
        f[k + "/collision"] = str(len(shapes))
        for c, s in enumerate(shapes):
            f[f"{k}/collision/{c}/geometry"] = geometry(s[2], s[3], s[4])
            # given in the link's inertial frame
            f[f"{k}/collision/{c}/origin"] = pose(*p.multiplyTransforms(d[3], d[4], s[5], s[6]))
    count = {i: 0 for i in links}
    for s in p.getVisualShapeData(body):
        i = s[1]
        if i not in count:
            continue
        k = f"link/{links[i]}/visual/{count[i]}"
        count[i] += 1
        f[k + "/geometry"] = geometry(s[2], s[3], s[4])
        f[k + "/origin"] = pose(s[5], s[6])
        f[k + "/color"] = nums(s[7])
    for i, name in links.items():
        f[f"link/{name}/visual"] = str(count[i])
    for j in range(n):
        a = info[j]
        k = "joint/" + text(a[1])
        f[k] = JOINT.get(a[2], str(a[2]))
        f[k + "/parent"] = links.get(a[16], "?")
        f[k + "/child"] = links[j]
        inv = p.invertTransform(*frame[a[16]])
        f[k + "/origin"] = pose(*p.multiplyTransforms(*inv, *frame[j]))
        if a[2] in (0, 1, 3):
            f[k + "/axis"] = nums(mat(dyn[j][4]) @ np.array(a[13]))
        f[k + "/lower"] = num(a[8])
        f[k + "/upper"] = num(a[9])
        f[k + "/effort"] = num(a[10])
        f[k + "/velocity"] = num(a[11])
        f[k + "/damping"] = num(a[6])
        f[k + "/friction"] = num(a[7])
    return f


HEAD = re.compile(r"b3(?:Error|Warning|Printf)\[[^\]\n]*\]:\n?")


def messages(text):
    """Bullet writes `b3Error[file,line]:`, a line end and the message, without one behind it."""
    out = []
    for part in HEAD.split(text):
        for x in part.splitlines():
            x = x.strip()
            if x and not x.startswith("pybullet build time") and not x.startswith("Error: InMemoryFile::"):
                out.append(x)
    return out


def main():
    for line in sys.stdin:
        path = os.path.abspath(line.rstrip("\n"))
        os.makedirs(EMPTY, exist_ok=True)
        os.chdir(EMPTY)
        log.seek(0)
        log.truncate()
        client = p.connect(p.DIRECT)
        r = {}
        try:
            if PACKAGES:
                p.setAdditionalSearchPath(PACKAGES[0])
            body = p.loadURDF(path)
            r["verdict"] = "loads"
            r["why"] = ""
            r["facts"] = facts(body)
        except p.error as e:
            if r.get("verdict") == "loads":
                r["facts"] = {}
                r["why"] = "facts: " + str(e)
            else:
                r = {"verdict": "refuses", "why": str(e), "facts": {}}
        except (RuntimeError, ValueError, TypeError, np.linalg.LinAlgError, OverflowError) as e:
            r = {"verdict": "loads" if r else "refuses", "why": "facts: %r" % e, "facts": {}}
        try:
            p.disconnect(client)
        except p.error:
            pass
        log.flush()
        log.seek(0)
        said = messages(log.read().decode("utf-8", "replace"))
        r["said"] = said[:40]
        if r["verdict"] == "refuses":
            # "No inertial data" is said of every link without one, loading or not, with the link's name behind it
            told = [
                x
                for i, x in enumerate(said)
                if not x.startswith("No inertial data") and not (i and said[i - 1].startswith("No inertial data"))
            ]
            if told:
                r["why"] = " ".join(told[:4]) if told[0].endswith((":", "Joint", "joint")) else told[0]
        out.write(json.dumps(r) + "\n")
        out.flush()


main()
