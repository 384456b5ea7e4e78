"""Compares an imported folder with MuJoCo's compiled model. Every figure here is MuJoCo's."""

import itertools
import tomllib
import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import trimesh

from kinematics import Urdf, floats, of_quaternion, origin, pose

EXACT, MESHED = 1e-9, 1e-5
COUNT = 100
FREE, BALL, SLIDE, HINGE = range(4)
PLANE, HFIELD, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH, SDF = 0, 1, 2, 3, 4, 5, 6, 7, 8


class Wrong(list):
    def say(self, what, found=None, expected=None):
        self.append(what if found is None else f"{what}: {found}, MuJoCo has {expected}")


def compare(model, folder):
    urdf = Urdf(next(folder.glob("*.urdf")))
    wrong = Wrong()
    links = urdf.bodies()
    bodies = robot(model, links)
    named = [model.body(body).name for body in bodies]
    if links[0] == "world" and named[0] != "world":
        # The root is the world.
        bodies = [0, *bodies]
    by_body = dict(zip(bodies, links))
    if len(links) < len(bodies):
        wrong.say("bodies", len(links), len(bodies))
        return wrong, {}
    for body, link in by_body.items():
        name = model.body(body).name
        if body and name and name != link:
            wrong.say("body", link, name)
    if wrong:
        return wrong, {}
    joints = moving(model, urdf, bodies, wrong)
    if wrong:
        return wrong, {}
    far = poses(model, urdf, by_body, joints, wrong)
    masses(model, urdf, by_body, wrong)
    ranges(model, urdf, joints, wrong)
    forces(model, folder, joints, wrong)
    robot_geoms = [g for g in range(model.ngeom) if model.geom_bodyid[g] in by_body and model.geom_bodyid[g]]
    for body, link in by_body.items():
        if body:
            shapes(model, urdf, body, link, robot_geoms, wrong)
    companions(model, folder, by_body, joints, wrong)
    sites(model, urdf, by_body, links[len(bodies):], wrong)
    return wrong, {"bodies": len(bodies), "joints": len(joints), "far": far}


def robot(model, links):
    """The bodies of the trees of which a name is among the links."""
    names = set(links)
    roots = [body for body in range(1, model.nbody) if model.body_parentid[body] == 0]
    trees = {root: [b for b in range(1, model.nbody) if model.body_rootid[b] == root] for root in roots}
    chosen = [
        root for root in roots
        if len(roots) == 1 or any(model.body(body).name in names for body in trees[root])
    ]
    if not chosen:
        # Nothing has a name: as docs/import.md chooses.
        def size(root):
            moving = [j for j in range(model.njnt) if model.jnt_bodyid[j] in trees[root] and model.jnt_type[j] != FREE]
            return len(moving), len(trees[root]), -root
        chosen = [max(roots, key=size)]
    return sorted(body for root in chosen for body in trees[root])


def moving(model, urdf, bodies, wrong):
    """The joints of MuJoCo, each with that of the URDF."""
    inside = set(bodies)
    own = [j for j in range(model.njnt) if model.jnt_bodyid[j] in inside and model.jnt_type[j] != FREE]
    kinds = {BALL: ["spherical"], SLIDE: ["prismatic"], HINGE: ["revolute", "continuous"]}
    if len(own) != len(urdf.moving):
        wrong.say("joints", len(urdf.moving), len(own))
    pairs = {}
    for joint, element in zip(own, urdf.moving):
        name = model.joint(joint).name
        if name and name != element.get("name"):
            wrong.say("joint", element.get("name"), name)
        if element.get("type") not in kinds[model.jnt_type[joint]]:
            wrong.say(f"type of {name}", element.get("type"), kinds[model.jnt_type[joint]])
        pairs[joint] = element
    return pairs


def poses(model, urdf, by_body, joints, wrong):
    random = np.random.default_rng(7)
    values, all_qpos = {}, np.tile(model.qpos0, (COUNT, 1))
    for joint, element in joints.items():
        at = model.jnt_qposadr[joint]
        if model.jnt_type[joint] == BALL:
            quaternions = random.normal(size=(COUNT, 4))
            quaternions /= np.linalg.norm(quaternions, axis=1)[:, None]
            all_qpos[:, at:at + 4] = quaternions
            values[element.get("name")] = of_quaternion(quaternions)
        else:
            low, high = model.jnt_range[joint] if model.jnt_limited[joint] else (-3.0, 3.0)
            all_qpos[:, at] = random.uniform(low, high, COUNT)
            values[element.get("name")] = all_qpos[:, at]
    following = followers(model, joints)
    for element in (element for element in joints.values() if element.find("mimic") is not None):
        name = element.get("name")
        if name not in {joints[first].get("name") for first in following}:
            wrong.say("mimic without an equality", name, "none")
    for _ in following:
        for first, (second, data) in following.items():
            if joints[first].find("mimic") is None:
                continue
            a, b = model.jnt_qposadr[first], model.jnt_qposadr[second]
            x = all_qpos[:, b] - model.qpos0[b]
            all_qpos[:, a] = model.qpos0[a] + sum(data[k] * x**k for k in range(5))
    found = urdf.poses(values, COUNT)
    data = mujoco.MjData(model)
    expected = {body: np.tile(np.eye(4), (COUNT, 1, 1)) for body in by_body}
    for turn in range(COUNT):
        data.qpos[:] = all_qpos[turn]
        mujoco.mj_kinematics(model, data)
        for body in by_body:
            expected[body][turn, :3, :3] = data.xmat[body].reshape(3, 3)
            expected[body][turn, :3, 3] = data.xpos[body]
    root = np.linalg.inv(expected[next(iter(by_body))])
    far = 0.0
    for body, link in by_body.items():
        difference = np.abs(found[link] - root @ expected[body]).max()
        far = max(far, difference)
        if not difference <= EXACT:
            wrong.say(f"pose of {link}: differs by {difference:.2e}")
            break
    return far


def followers(model, joints):
    """Equalities of two joints of the robot that are active: the joint that follows, and by what."""
    return {
        model.eq_obj1id[eq]: (model.eq_obj2id[eq], model.eq_data[eq])
        for eq in range(model.neq)
        if model.eq_type[eq] == mujoco.mjtEq.mjEQ_JOINT and model.eq_active0[eq]
        and model.eq_obj1id[eq] in joints and model.eq_obj2id[eq] in joints
    }


def masses(model, urdf, by_body, wrong):
    for body, link in by_body.items():
        if body == 0:
            continue
        mass, centre, inertia = urdf.inertial(link)
        axes = of_quaternion(model.body_iquat[body])
        expected = axes @ np.diag(model.body_inertia[body]) @ axes.T
        geoms = [g for g in range(model.ngeom) if model.geom_bodyid[g] == body]
        limit = MESHED if any(model.geom_type[g] in (MESH, SDF) for g in geoms) else EXACT
        if any(model.geom_dataid[g] >= 0 for g in geoms) or model.nmesh:
            limit = MESHED
        if abs(mass - model.body_mass[body]) > limit * max(model.body_mass[body], 1e-12):
            wrong.say(f"mass of {link}", mass, model.body_mass[body])
        elif model.body_mass[body] > 0:
            reach = np.sqrt(np.trace(expected) / model.body_mass[body]) + np.linalg.norm(model.body_ipos[body])
            if np.abs(centre - model.body_ipos[body]).max() > limit * max(reach, 1e-9):
                wrong.say(f"centre of {link}", centre, model.body_ipos[body])
        if np.abs(inertia - expected).max() > limit * max(np.abs(expected).max(), 1e-15):
            wrong.say(f"inertia of {link}", inertia.tolist(), expected.tolist())


def ranges(model, urdf, joints, wrong):
    for joint, element in joints.items():
        if model.jnt_type[joint] == BALL:
            continue
        limit = element.find("limit")
        found = [limit.get("lower"), limit.get("upper")]
        if model.jnt_limited[joint]:
            found = [float(of or "nan") for of in found]
            if not np.abs(np.array(found) - model.jnt_range[joint]).max() <= EXACT:
                wrong.say(f"range of {element.get('name')}", found, model.jnt_range[joint])
        elif element.get("type") == "revolute":
            wrong.say(f"range of {element.get('name')}", found, None)
        dynamics = element.find("dynamics")
        damping = float(dynamics.get("damping", 0)) if dynamics is not None else 0.0
        friction = float(dynamics.get("friction", 0)) if dynamics is not None else 0.0
        dof = model.jnt_dofadr[joint]
        added = sum(
            model.actuator_gear[a, 0] ** 2 * np.ravel(model.actuator_damping[a])[0] for a in range(model.nu)
            if model.actuator_trntype[a] in (0, 1) and model.actuator_trnid[a, 0] == joint
        )
        # `springdamper` gives MuJoCo a damping that the file does not say.
        if abs(damping - added - np.ravel(model.dof_damping[dof])[0]) > EXACT and model.jnt_stiffness[joint] == 0:
            wrong.say(f"damping of {element.get('name')}", damping, model.dof_damping[dof])
        if abs(friction - model.dof_frictionloss[dof]) > EXACT:
            wrong.say(f"friction of {element.get('name')}", friction, model.dof_frictionloss[dof])


def forces(model, folder, joints, wrong):
    """The greatest force of each joint, and its gains, by what the compiled model says."""
    setup = {}
    for path in folder.glob("*.export.toml"):
        setup = tomllib.loads(path.read_text()).get("actuators", {}).get("joint", {})
    of = {joint: [] for joint in joints}
    for actuator in range(model.nu):
        if model.actuator_trntype[actuator] in (0, 1) and model.actuator_trnid[actuator, 0] in of:
            of[model.actuator_trnid[actuator, 0]].append(actuator)
    for joint, element in joints.items():
        if model.jnt_type[joint] == BALL:
            continue
        name = element.get("name")
        low, high, kp, kv = 0.0, 0.0, 0.0, 0.0
        for a in of[joint]:
            gear = model.actuator_gear[a, 0]
            fixed = model.actuator_gaintype[a] == 0
            plain = fixed and model.actuator_biastype[a] == 0 and model.actuator_dyntype[a] == 0
            least, most = model.actuator_forcerange[a] if model.actuator_forcelimited[a] else (-np.inf, np.inf)
            if plain and model.actuator_ctrllimited[a]:
                least, most = np.clip(np.sort(model.actuator_gainprm[a, 0] * model.actuator_ctrlrange[a]), least, most)
            ends = np.sort(model.actuator_gear[a, 0] * np.array([least, most]))
            low, high = low + ends[0], high + ends[1]
            if fixed and model.actuator_biastype[a] == 1:
                kp -= gear**2 * model.actuator_biasprm[a, 1]
                kv -= gear**2 * model.actuator_biasprm[a, 2]
        if not of[joint] or np.isinf(low + high):
            low, high = -np.inf, np.inf
        if model.jnt_actfrclimited[joint]:
            low, high = np.clip([low, high], *model.jnt_actfrcrange[joint])
        total = max(-low, high)
        expected = 1000.0 if np.isinf(total) else total
        found = float(element.find("limit").get("effort"))
        if abs(found - expected) > EXACT * max(1, expected):
            wrong.say(f"effort of {name}", found, expected)
        armature = model.dof_armature[model.jnt_dofadr[joint]]
        armature += sum(model.actuator_gear[a, 0] ** 2 * model.actuator_armature[a] for a in of[joint])
        if element.find("mimic") is not None:
            continue
        for key, expected in (("kp", kp), ("kv", kv), ("armature", armature)):
            found = setup.get(name, {}).get(key, 0.0)
            if abs(found - expected) > 1e-6 * max(1, abs(expected)):
                wrong.say(f"{key} of {name}", found, expected)


def is_seen(model, geom, geoms, solid, all_geoms):
    """As in MuJoCo's viewer: groups 0 to 2, and not transparent; but what only is seen goes before what it covers."""
    shown = {g for g in all_geoms if model.geom_group[g] <= 2} or set(all_geoms)
    material, rgba = model.geom_matid[geom], model.geom_rgba[geom]
    if material >= 0 and (rgba == [0.5, 0.5, 0.5, 1]).all():
        rgba = model.mat_rgba[material]
    if geom not in shown or rgba[3] == 0:
        return False
    looks = {g for g in shown if is_look(model, g) and model.geom_group[g] <= 2}
    over = [g for g in geoms if g in looks]
    if geom not in solid or not over or model.geom_group[geom] in {model.geom_group[g] for g in looks}:
        return True
    boxes = [box(model, g) for g in over]
    least, most = np.min([of[0] for of in boxes], 0), np.max([of[1] for of in boxes], 0)
    margin = 0.25 * (most - least).max()
    own = box(model, geom)
    return bool((own[0] < least - margin).any() or (own[1] > most + margin).any())


def is_look(model, geom):
    paired = geom in model.pair_geom1 or geom in model.pair_geom2
    return not (model.geom_contype[geom] or model.geom_conaffinity[geom] or paired)


def box(model, geom):
    centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
    axes = of_quaternion(model.geom_quat[geom])
    corners = [centre + half * signs for signs in itertools.product((-1, 1), repeat=3)]
    if model.geom_type[geom] == MESH:
        mesh = model.geom_dataid[geom]
        first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        corners = np.asarray(model.mesh_vert[first:first + count], float)
    points = np.array(corners) @ axes.T + model.geom_pos[geom]
    return points.min(0), points.max(0)


def shapes(model, urdf, body, link, robot_geoms, wrong):
    geoms = [g for g in range(model.ngeom) if model.geom_bodyid[g] == body and model.geom_type[g] not in (PLANE, HFIELD)]
    element = urdf.links[link]
    paired = {*model.pair_geom1, *model.pair_geom2}
    solid = [g for g in geoms if model.geom_contype[g] or model.geom_conaffinity[g] or g in paired]
    seen = [g for g in geoms if is_seen(model, g, geoms, solid, robot_geoms)]
    for kind, wanted in (("collision", solid), ("visual", seen)):
        parts = [part for geom in wanted for part in expand(model, geom)]
        found = element.findall(kind)
        if len(found) != len(parts):
            wrong.say(f"number of {kind}s of {link}", len(found), len(parts))
            continue
        for part, (shape, size, at, points) in zip(found, parts):
            same(urdf, part, shape, size, at, points, f"{kind} of {link}", wrong)


def expand(model, geom):
    """A shape of MuJoCo as shapes of a URDF: its kind, its sizes, its pose, and points of a mesh."""
    at = pose(of_quaternion(model.geom_quat[geom]), model.geom_pos[geom])
    kind, (a, b, c) = model.geom_type[geom], model.geom_size[geom]
    up = pose(np.eye(3), [0, 0, b])
    down = pose(np.eye(3), [0, 0, -b])
    if kind == SPHERE:
        return [("sphere", [a], at, None)]
    if kind == CYLINDER:
        return [("cylinder", [a, 2 * b], at, None)]
    if kind == CAPSULE:
        ends = [("sphere", [a], at @ end, None) for end in (up, down)]
        return [("cylinder", [a, 2 * b], at, None), *ends]
    if kind == BOX:
        return [("box", [2 * a, 2 * b, 2 * c], at, None)]
    if kind == ELLIPSOID:
        return [("mesh", [a, b, c], at, None)]
    mesh = model.geom_dataid[geom]
    first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
    points = np.asarray(model.mesh_vert[first:first + count], float) @ at[:3, :3].T + at[:3, 3]
    return [("mesh", None, None, points)]


def same(urdf, part, shape, size, at, points, what, wrong):
    element = part.find("geometry")[0]
    if element.tag != shape:
        return wrong.say(what, element.tag, shape)
    own = origin(part)
    if points is not None:
        mesh = trimesh.load(urdf.path.parent / element.get("filename"), force="mesh", process=False)
        vertices = np.asarray(mesh.vertices)[np.unique(np.asarray(mesh.faces))]
        used = vertices * (floats(element.get("scale"), 3) if element.get("scale") else 1.0)
        used = used @ own[:3, :3].T + own[:3, 3]
        box = lambda of: np.array([of.min(0), of.max(0)])
        extent = np.linalg.norm(np.ptp(points, axis=0))
        if np.abs(box(used) - box(points)).max() > MESHED * max(extent, 1e-6):
            wrong.say(f"box around a mesh, {what}", box(used).tolist(), box(points).tolist())
        return None
    attributes = {"sphere": ["radius"], "cylinder": ["radius", "length"], "box": ["size"], "mesh": ["scale"]}
    found = [float(word) for name in attributes[shape] for word in element.get(name).split()]
    limit = MESHED if "mesh" == shape else EXACT
    if np.abs(np.array(found) - size).max() > limit * max(size):
        wrong.say(f"size, {what}", found, size)
    if np.abs(own - at).max() > MESHED * 1e-3:
        wrong.say(f"pose, {what}", own.tolist(), at.tolist())
    return None


def companions(model, folder, by_body, joints, wrong):
    root = None
    for path in folder.glob("*.srdf"):
        root = ET.parse(path).getroot()
    states = root.findall("group_state") if root is not None else []
    # `nkey` of `<size>` adds keys that nobody wrote.
    written = [k for k in range(model.nkey) if model.key(k).name or not np.array_equal(model.key_qpos[k], model.qpos0)]
    if len(states) < len(written):
        wrong.say("named configurations", len(states), model.nkey)
    for key, state in zip(range(model.nkey), states):
        name = model.key(key).name
        if name and name != state.get("name"):
            wrong.say("configuration", state.get("name"), name)
        found = {of.get("name"): of.get("value").split() for of in state.findall("joint")}
        for joint, element in joints.items():
            if element.find("mimic") is not None or model.jnt_type[joint] == BALL:
                continue
            value = model.key_qpos[key][model.jnt_qposadr[joint]]
            if not abs(float(found.get(element.get("name"), ["nan"])[0]) - value) <= EXACT:
                wrong.say(f"{element.get('name')} in {name}", found.get(element.get("name")), value)
    found = set()
    for pair in root.findall("disable_collisions") if root is not None else []:
        found.add(frozenset((pair.get("link1"), pair.get("link2"))))
    expected = {frozenset((by_body[a], by_body[b])) for a, b in apart(model, by_body)}
    if found != expected:
        wrong.say("pairs that never collide", sorted(map(sorted, found - expected))[:4], sorted(map(sorted, expected - found))[:4])


def apart(model, by_body):
    """Pairs of bodies with shapes that collide, of which no two shapes ever do."""
    types, affinities = {}, {}
    paired = {
        frozenset((int(model.geom_bodyid[a]), int(model.geom_bodyid[b])))
        for a, b in zip(model.pair_geom1, model.pair_geom2)
    }
    solid = {*model.pair_geom1, *model.pair_geom2}
    for geom in range(model.ngeom):
        body = int(model.geom_bodyid[geom])
        if model.geom_type[geom] in (PLANE, HFIELD) or body not in by_body:
            continue
        if body == 0:
            continue
        if not (model.geom_contype[geom] or model.geom_conaffinity[geom] or geom in solid):
            continue
        types.setdefault(body, []).append(int(model.geom_contype[geom]))
        affinities.setdefault(body, []).append(int(model.geom_conaffinity[geom]))
    excluded = {(int(s) >> 16, int(s) & 0xFFFF) for s in model.exclude_signature}
    for a, b in excluded | {(b, a) for a, b in excluded}:
        if a < b and a in by_body and b in by_body and frozenset((a, b)) not in paired:
            yield a, b
    for a, b in itertools.combinations(sorted(types), 2):
        if frozenset((a, b)) in paired:
            continue
        meets = any(
            (t & g) | (u & f)
            for t, f in zip(types[a], affinities[a]) for u, g in zip(types[b], affinities[b])
        )
        wa, wb = model.body_weldid[a], model.body_weldid[b]
        pa, pb = (model.body_weldid[model.body_parentid[w]] for w in (wa, wb))
        adjacent = wa == wb or wa != 0 and wb != 0 and (wa == pb or wb == pa)
        if not meets or adjacent or (a, b) in excluded or (b, a) in excluded:
            yield a, b


def sites(model, urdf, by_body, links, wrong):
    """Sites and cameras: as many links, each where MuJoCo has it."""
    known = {}
    for kind, count in (("site", model.nsite), ("camera", model.ncam)):
        for index in range(count):
            of = getattr(model, kind)(index)
            body = int(of.bodyid[0])
            if body in by_body and body:
                known.setdefault(of.name, []).append((body, pose(of_quaternion(of.quat), of.pos)))
    if sum(map(len, known.values())) != len(links):
        wrong.say("sites and cameras", len(links), sum(map(len, known.values())))
    for link in links:
        joint = urdf.into[link]
        for body, at in known.get(link, [])[:1]:
            if len(known[link]) > 1:
                continue
            if joint.find("parent").get("link") != by_body[body] or np.abs(origin(joint) - at).max() > EXACT:
                wrong.say(f"frame {link}", origin(joint).tolist(), at.tolist())
