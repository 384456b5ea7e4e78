"""A URDD, and what it exports as each program loads it: `peers.py` compares contacts, `corpus.py` loads hundreds of robots.

Each class below loads a file, raises where its program refuses it, and has `place(values)`, which gives the pose of each
link of the URDD in its root link, as translation and rotation matrix, for the values of each joint by name.
"""

import json
import os
import pathlib
import subprocess

import numpy as np


class NotComparable(Exception):
    """The file is loaded, but the program has no joint of this kind, or reads it otherwise."""


def quaternion_of_vector(v):
    """Rotation vector to quaternion w, x, y, z."""
    angle = np.linalg.norm(v)
    if angle == 0.0:
        return np.array([1.0, 0.0, 0.0, 0.0])
    return np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * np.asarray(v) / angle])


def matrix_of_quaternion(w, x, y, z):
    w, x, y, z = np.array([w, x, y, z]) / np.linalg.norm([w, x, y, z])
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def matrix_of_vector(v):
    return matrix_of_quaternion(*quaternion_of_vector(v))


def rpy_of_matrix(r):
    return [
        np.arctan2(r[2, 1], r[2, 2]),
        np.arctan2(-r[2, 0], np.hypot(r[0, 0], r[1, 0])),
        np.arctan2(r[1, 0], r[0, 0]),
    ]


def worst(poses, expected):
    """The greatest difference of positions (m) and of rotation matrices."""
    difference = 0.0
    for (p, r), pose in zip(poses, expected, strict=True):
        of_one = (
            np.abs(p - np.array(pose["position"])).max(),
            np.abs(r - matrix_of_quaternion(*pose["quaternion_wxyz"])).max(),
        )
        # Not `max`, which drops a NaN.
        difference = float(np.maximum.reduce([difference, *of_one]))
    return difference


def in_root(root, poses):
    """Poses (translation, matrix) in one of them."""
    p0, r0 = root
    return [(r0.T @ (p - p0), r0.T @ r) for p, r in poses]


class Urdd:
    def __init__(self, program, root):
        self.program = program
        self.root = pathlib.Path(root)
        self.paths = {m["name"]: m["path"] for m in json.loads((self.root / "urdd.json").read_text())["modules"]}
        self.dof = self.document("dof_module")
        self.samples = self.document("kinematics_samples_module")["samples"]
        self.links = self.document("urdf_module")["links"]
        self.names = [link["name"] for link in self.links]
        self.joints = self.document("urdf_module")["joints"]
        children = {joint["child"]["link"] for joint in self.joints}
        self.base = next(name for name in self.names if name not in children)
        self.kinds = {joint["joint_type"] for joint in self.joints}
        self.mass = sum(((link["inertial"] or {}).get("mass") or {}).get("value", 0.0) for link in self.links)

    def document(self, module):
        return json.loads((self.root / self.paths[module] / "module.json").read_text())

    def values(self, q):
        """The values of each joint by name, by the URDD's own resolved mimics."""
        values = {}
        dofs, mimics = self.dof["joint_idx_to_dof_idxs_mapping"], self.dof["joint_idx_to_mimic_mapping"]
        for joint, of_joint, mimic in zip(self.joints, dofs, mimics):
            values[joint["name"]] = [q[dof] for dof in of_joint] or [0.0]
            if mimic:
                driver = 0.0 if mimic["dof_idx"] is None else q[mimic["dof_idx"]]
                values[joint["name"]] = [mimic["multiplier"] * driver + mimic["offset"]]
        return values

    def difference(self, loaded, count=None):
        """The greatest difference of poses in the URDD's kinematics samples, or in the first of them."""
        return float(
            np.maximum.reduce(
                [
                    worst(loaded.place(self.values(sample["configuration"])), sample["link_poses"])
                    for sample in self.samples_of(loaded)[:count]
                ]
            )
        )

    def samples_of(self, loaded):
        """The samples that a program can be in: where it fixes a joint with equal limits, only those that have it there."""
        if not getattr(loaded, "holds", False):
            return self.samples
        limits = {joint["name"]: joint["limit"] or {} for joint in self.joints}
        held = {name: limit["lower"] for name, limit in limits.items() if limit and limit["lower"] == limit["upper"]}
        kinds = {joint["name"]: joint["joint_type"] for joint in self.joints}
        held = {name: lower for name, lower in held.items() if kinds[name] in ("Revolute", "Prismatic")}

        def is_held(sample):
            values = self.values(sample["configuration"])
            mimics = {joint["name"] for joint in self.joints if joint["mimic"]}
            return all(values[name] == [lower or 0.0] for name, lower in held.items() if name not in mimics)

        return [sample for sample in self.samples if is_held(sample)]

    def export(self, kind, file, *more):
        command = [self.program, "export", kind, str(self.root), "-o", str(file), "--force", *more]
        done = subprocess.run(command, capture_output=True, text=True)
        if "cannot hold the name" in done.stderr:
            raise ValueError(done.stderr)
        assert done.returncode == 0, done.stderr
        return file.read_text()

    def collisions(self, count):
        """Of sampled configurations the values, and the pairs of pieces in contact."""
        command = [self.program, "check-collisions", str(self.root), "--random", str(count), "--format", "json"]
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode in (0, 1), done.stderr
        for line in done.stdout.splitlines():
            said = json.loads(line)
            pairs = {tuple(sorted(zip(pair["links"], pair["pieces"]))) for pair in said["touching"]}
            yield said["values"], pairs

    def single(self, name):
        """Refuses joints of several DOFs, which `name` reads otherwise or not at all."""
        if kinds := sorted(self.kinds & {"Planar", "Floating", "Spherical"}):
            raise NotComparable(
                f"joints of several DOFs ({', '.join(kinds)}), which {name} reads otherwise or not at all"
            )


class Mujoco:
    def __init__(self, urdd, file):
        import mujoco

        self.mujoco = mujoco
        self.model = model = mujoco.MjModel.from_xml_path(str(file))
        self.data = mujoco.MjData(model)
        named = {mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, body): body for body in range(model.nbody)}
        self.links = [named[name] for name in urdd.names]
        self.root = named[urdd.base]

    def place(self, values):
        mujoco, model, data = self.mujoco, self.model, self.data
        for joint in range(model.njnt):
            name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_JOINT, joint)
            at, kind = model.jnt_qposadr[joint], model.jnt_type[joint]
            if kind == mujoco.mjtJoint.mjJNT_FREE:
                continue
            if kind == mujoco.mjtJoint.mjJNT_BALL:
                data.qpos[at : at + 4] = quaternion_of_vector(values[name][-3:])
            elif name in values:
                data.qpos[at] = values[name][0]
            else:
                owner, part = name.rsplit("/", 1)
                data.qpos[at] = values[owner][{"trans_x": 0, "trans_y": 1, "trans_z": 2, "rot": 2}[part]]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        pose = lambda body: (data.xpos[body].copy(), data.xmat[body].reshape(3, 3).copy())
        return in_root(pose(self.root), [pose(link) for link in self.links])

    def steps(self, count):
        """Simulates; raises where something diverges."""
        self.mujoco.mj_resetData(self.model, self.data)
        if self.model.nkey:
            self.mujoco.mj_resetDataKeyframe(self.model, self.data, 0)
        for _ in range(count):
            self.mujoco.mj_step(self.model, self.data)
        warned = [self.mujoco.mjtWarning(at).name for at, warning in enumerate(self.data.warning) if warning.number]
        if warned or not np.isfinite(self.data.qpos).all():
            raise ValueError(f"after {count} steps: {', '.join(warned) or 'positions are not finite'}")


class Pinocchio:
    def __init__(self, urdd, file):
        import pinocchio as pin

        self.pin, self.names = pin, urdd.names
        # Pinocchio takes a mimic only where its driver comes first in its own, alphabetical, order; otherwise it reads the
        # joint as one that moves freely, and is given the position that the URDD resolves.
        self.followed = True
        try:
            self.model = pin.buildModelFromUrdf(str(file), pin.JointModelFreeFlyer(), mimic=True)
        except ValueError as error:
            if "parent joint of the mimic joint is not in" not in str(error):
                raise
            self.followed = False
            self.model = pin.buildModelFromUrdf(str(file), pin.JointModelFreeFlyer())
        self.data = self.model.createData()

    def configuration(self, values):
        pin, model = self.pin, self.model
        q = pin.neutral(model)
        for idx in range(2, model.njoints):
            joint, value = model.joints[idx], values[model.names[idx]]
            if joint.shortname().startswith("JointModelMimic"):
                continue
            if joint.nq == 1:
                q[joint.idx_q] = value[0]
            elif joint.nq == 4:
                raise NotComparable("a planar joint is read without its axis")
            elif joint.nq == 2:
                q[joint.idx_q : joint.idx_q + 2] = [np.cos(value[0]), np.sin(value[0])]
            else:
                w, x, y, z = quaternion_of_vector(value[3:])
                q[joint.idx_q : joint.idx_q + 7] = [*value[:3], x, y, z, w]
        return q

    def place(self, values):
        pin = self.pin
        pin.framesForwardKinematics(self.model, self.data, self.configuration(values))
        frames = [self.data.oMf[self.model.getFrameId(name, pin.FrameType.BODY)] for name in self.names]
        return [(frame.translation.copy(), frame.rotation.copy()) for frame in frames]


class Yourdfpy:
    def __init__(self, urdd, file, meshes=False):
        import yourdfpy

        self.names = urdd.names
        self.robot = yourdfpy.URDF.load(
            str(file), load_meshes=meshes, load_collision_meshes=meshes, build_collision_scene_graph=meshes
        )
        urdd.single("yourdfpy")

    def place(self, values):
        self.robot.update_cfg({name: values[name][0] for name in self.robot.actuated_joint_names})
        poses = [self.robot.get_transform(name, self.robot.base_link) for name in self.names]
        return [(pose[:3, 3], pose[:3, :3]) for pose in poses]


class Drake:
    """A URDF of ours for Drake, an SDF, or a model directive beside the package.xml of the URDF."""

    def __init__(self, urdd, file):
        from pydrake.all import AddMultibodyPlantSceneGraph, DiagramBuilder, Parser

        self.urdd, self.is_sdf = urdd, pathlib.Path(file).suffix == ".sdf"
        builder = DiagramBuilder()
        self.plant, self.scene = AddMultibodyPlantSceneGraph(builder, 0.001)
        parser = Parser(self.plant)
        if (package := pathlib.Path(file).with_name("package.xml")).is_file():
            parser.package_map().AddPackageXml(str(package))
        (self.model,) = parser.AddModels(str(file))
        self.plant.Finalize()
        diagram = builder.Build()
        self.context_of_all = diagram.CreateDefaultContext()
        self.context = self.plant.GetMyMutableContextFromRoot(self.context_of_all)

    def body(self, name):
        return self.plant.world_body() if name == "world" else self.plant.GetBodyByName(name, self.model)

    def place(self, values):
        q = self.plant.GetPositions(self.context)

        def put(name, of_joint):
            # In SDF, a joint that has a link's name is renamed.
            name = name if self.plant.HasJointNamed(name, self.model) else f"{name}_joint"
            joint = self.plant.GetJointByName(name, self.model)
            start = joint.position_start()
            q[start : start + joint.num_positions()] = of_joint[: joint.num_positions()]

        for joint in self.urdd.joints:
            kind, value, name = joint["joint_type"], values[joint["name"]], joint["name"]
            if kind == "Planar" and self.is_sdf:
                for part, v in zip(("trans_x", "trans_y", "rot"), value):
                    put(f"{name}/{part}", [v])
            elif kind in ("Floating", "Spherical"):
                for part, v in zip("xyz", value[:-3]):
                    put(f"{name}/trans_{part}", [v])
                put(name, rpy_of_matrix(matrix_of_vector(value[-3:])))
            else:
                put(name, value)
        self.plant.SetPositions(self.context, q)
        back = self.body(self.urdd.base).EvalPoseInWorld(self.context).inverse()
        poses = [back @ self.body(name).EvalPoseInWorld(self.context) for name in self.urdd.names]
        return [(pose.translation(), pose.rotation().matrix()) for pose in poses]


class Pybullet:
    def __init__(self, urdd, file):
        import pybullet

        self.bullet, self.urdd = pybullet, urdd
        if pybullet.isConnected():
            pybullet.resetSimulation()
        else:
            pybullet.connect(pybullet.DIRECT)
        self.body = pybullet.loadURDF(str(file), useFixedBase=True)
        infos = [pybullet.getJointInfo(self.body, at) for at in range(pybullet.getNumJoints(self.body))]
        self.joints = {info[1].decode(): at for at, info in enumerate(infos)}
        self.links = {info[12].decode(): at for at, info in enumerate(infos)}
        if urdd.kinds & {"Planar", "Floating"}:
            raise NotComparable("PyBullet has no planar and no floating joints")

    def place(self, values):
        for joint in self.urdd.joints:
            at, value = self.joints[joint["name"]], values[joint["name"]]
            if joint["joint_type"] == "Spherical":
                w, x, y, z = quaternion_of_vector(value)
                self.bullet.resetJointStateMultiDof(self.body, at, [x, y, z, w])
            elif joint["joint_type"] != "Fixed":
                self.bullet.resetJointState(self.body, at, value[0])
        base = self.bullet.getBasePositionAndOrientation(self.body)
        # The base is where its centre of mass is.
        local = self.bullet.getDynamicsInfo(self.body, -1)[3:5]
        base = self.bullet.multiplyTransforms(*base, *self.bullet.invertTransform(*local))
        poses = {
            name: self.bullet.getLinkState(self.body, at, computeForwardKinematics=True)[4:6]
            for name, at in self.links.items()
        }
        poses = [poses.get(name, base) for name in self.urdd.names]
        pose = lambda p, q: (np.array(p), matrix_of_quaternion(q[3], *q[:3]))
        return in_root(pose(*base), [pose(*one) for one in poses])


def names_of_usd(stage):
    """The prims of a robot of ours by the names that they show, by kind: links and joints."""
    from pxr import UsdPhysics

    links, joints = {}, {}
    for prim in stage.Traverse():
        kind = links if prim.HasAPI(UsdPhysics.RigidBodyAPI) else joints if prim.IsA(UsdPhysics.Joint) else None
        if kind is not None:
            kind[prim.GetDisplayName() or prim.GetName()] = prim
    return links, joints


class Usd:
    """A USD by Pixar's library: valid by its own rules, and the poses that its joints say, computed in binary64."""

    def __init__(self, urdd, file):
        from pxr import Usd, UsdPhysics, UsdValidation

        self.urdd, self.physics, self.holds = urdd, UsdPhysics, True
        self.stage = Usd.Stage.Open(str(file))
        validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
        errors = UsdValidation.ValidationContext(validators).Validate(self.stage)
        if errors:
            raise ValueError(f"{len(errors)} errors of validation: {errors[0].GetErrorAsString()}")
        parsed = UsdPhysics.UsdPhysicsLoadStageFromPrimRange(self.stage, ["/"])
        for paths, described in parsed.values():
            for path, one in zip(paths, described, strict=True):
                if not one.isValid:
                    raise ValueError(f"UsdPhysics does not take {path}")
        self.links, self.joints = names_of_usd(self.stage)
        bodies = {str(path) for path in parsed[UsdPhysics.ObjectType.RigidBody][0]}
        if {*self.links} != {*urdd.names} or {str(prim.GetPath()) for prim in self.links.values()} != bodies:
            raise ValueError("its bodies are not the links")
        if missing := {joint["name"] for joint in urdd.joints} - {*self.joints}:
            raise ValueError(f"without the joints {sorted(missing)}")

    def frames(self, joint):
        frame = lambda position, rotation: (np.array(position), matrix_of_quaternion(rotation.real, *rotation.imaginary))
        of = self.physics.Joint(joint)
        first = frame(of.GetLocalPos0Attr().Get(), of.GetLocalRot0Attr().Get())
        return first, frame(of.GetLocalPos1Attr().Get(), of.GetLocalRot1Attr().Get())

    def motion(self, prim, value):
        kind = prim.GetTypeName()
        if kind == "PhysicsFixedJoint":
            return np.zeros(3), np.eye(3)
        if kind == "PhysicsSphericalJoint":
            return np.zeros(3), matrix_of_vector(value)
        if kind == "PhysicsJoint":
            free = lambda axis: self.physics.LimitAPI(prim, axis).GetLowAttr().Get() == -np.inf
            along = [free(f"trans{axis}") for axis in "XYZ"]
            about = [free(f"rot{axis}") for axis in "XYZ"]
            if all(along + about):
                return np.array(value[:3]), matrix_of_vector(value[3:])
            if along + about != [True, True, False, False, False, True]:
                raise ValueError(f"{prim.GetPath()} is neither planar nor floating")
            return np.array([*value[:2], 0.0]), matrix_of_vector([0.0, 0.0, value[2]])
        axis = np.eye(3)["XYZ".index(prim.GetAttribute("physics:axis").Get())] * value[0]
        return (axis, np.eye(3)) if kind == "PhysicsPrismaticJoint" else (np.zeros(3), matrix_of_vector(axis))

    def place(self, values):
        after = lambda a, b: (a[0] + a[1] @ b[0], a[1] @ b[1])
        back = lambda a: (-a[1].T @ a[0], a[1].T)
        poses = {self.urdd.base: (np.zeros(3), np.eye(3))}
        left = list(self.urdd.joints)
        while left:
            joint = next(joint for joint in left if joint["parent"]["link"] in poses)
            left.remove(joint)
            prim = self.joints[joint["name"]]
            first, second = self.frames(prim)
            moved = after(first, self.motion(prim, values[joint["name"]]))
            poses[joint["child"]["link"]] = after(poses[joint["parent"]["link"]], after(moved, back(second)))
        return [poses[name] for name in self.urdd.names]


WORLD = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])


class Newton:
    """A URDF, an MJCF or a USD. Its numbers are binary32."""

    def __init__(self, urdd, file, prepare=None, floor=False):
        import newton
        import warp

        warp.config.quiet = True
        self.newton = newton
        self.builder = builder = newton.ModelBuilder()
        if prepare:
            prepare(builder)
        self.is_usd = self.holds = pathlib.Path(file).suffix.startswith(".usd")
        if self.is_usd:
            from pxr import Usd

            # Newton's own resolver reads no state of joints; PhysX' does.
            resolvers = [newton.usd.SchemaResolverNewton(), newton.usd.SchemaResolverPhysx()]
            builder.add_usd(str(file), schema_resolvers=resolvers)
            self.stage = Usd.Stage.Open(str(file))
            links, joints = names_of_usd(self.stage)
            at = lambda prims: {str(prim.GetPath()): name for name, prim in prims.items()}
            links, joints = at(links), at(joints)
            self.joints = [joints.get(label) for label in builder.joint_label]
            self.bodies = {links[label]: body for body, label in enumerate(builder.body_label)}
        else:
            add = builder.add_mjcf if pathlib.Path(file).suffix == ".xml" else builder.add_urdf
            add(str(file))
            # A label is a path that ends in the name.
            ends = lambda label, names: max(
                (name for name in names if label.endswith(f"/{name}")), key=len, default=None
            )
            self.joints = [ends(label, {joint["name"] for joint in urdd.joints}) for label in builder.joint_label]
            self.bodies = {ends(label, urdd.names): body for body, label in enumerate(builder.body_label)}
        self.turns = {joint["name"]: joint["joint_type"] in ("Revolute", "Continuous") for joint in urdd.joints}
        if floor:
            builder.add_ground_plane()
        self.urdd, self.model = urdd, builder.finalize()
        self.state = self.model.state()

    def position(self, values):
        """Newton's coordinates."""
        q = self.model.joint_q.numpy()
        starts = self.model.joint_q_start.numpy()
        for at, name in enumerate(self.joints):
            count = starts[at + 1] - starts[at]
            if not name or not count:
                continue
            value = values[name]
            if count == 4:
                w, x, y, z = quaternion_of_vector(value)
                value = [x, y, z, w]
            elif count == 6:
                # Newton turns about x, then about the y that was turned, then about the z that was: as fixed axes the
                # other way round.
                r = matrix_of_vector(value[3:])
                value = [
                    *value[:3],
                    np.arctan2(-r[1, 2], r[2, 2]),
                    np.arctan2(r[0, 2], np.hypot(r[0, 0], r[0, 1])),
                    np.arctan2(-r[0, 1], r[0, 0]),
                ]
            elif self.turns[name]:
                # In binary32, many turns leave nothing of an angle.
                value = [np.arctan2(np.sin(value[0]), np.cos(value[0]))]
            q[starts[at] : starts[at + 1]] = value
        return q

    def place(self, values):
        if not self.is_usd:
            self.urdd.single("Newton")
        self.model.joint_q.assign(self.position(values))
        self.newton.eval_fk(self.model, self.model.joint_q, self.model.joint_qd, self.state)
        poses = self.state.body_q.numpy().astype(float)
        pose = lambda body: (body[:3], matrix_of_quaternion(body[6], *body[3:6]))
        # A link called `world` is MuJoCo's own, which is no body here.
        poses = [pose(poses[self.bodies[name]] if name in self.bodies else WORLD) for name in self.urdd.names]
        return in_root(poses[self.urdd.names.index(self.urdd.base)], poses)


class Libsdformat:
    """Links of an SDF as the program of `sdf.cpp` prints them, which SDF_LOAD names: poses where all joints are at 0."""

    def __init__(self, urdd, file):
        done = subprocess.run([os.environ["SDF_LOAD"], str(file)], capture_output=True, text=True)
        if done.returncode:
            raise ValueError(done.stderr)
        self.warned = done.stderr
        self.links = {link["link"]: link for link in map(json.loads, done.stdout.splitlines())}
        self.urdd = urdd

    def place(self, _values):
        world = (np.zeros(3), np.eye(3))
        pose = lambda v: (np.array(v[:3]), matrix_of_quaternion(*v[3:]))
        poses = [pose(self.links[name]["pose"]) if name != "world" else world for name in self.urdd.names]
        return in_root(poses[self.urdd.names.index(self.urdd.base)], poses)
