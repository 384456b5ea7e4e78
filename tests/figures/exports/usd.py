"""Simulates what `urdd export usd` writes in Newton, and compares it with the URDD, and with what other converters write.

    pip install "newton[sim]==1.8.0" newton-usd-schemas==0.6.0 usd-core==26.8 scipy trimesh pillow pycollada urdf2any==0.3.0
    pip install urdf-usd-converter==0.3.4                  # in an environment of its own: it brings its own USD
    python3 tests/figures/exports/usd.py target/release/urdd URDD... [--converter PYTHON] [--write]

For each URDD, with a fixed base:

- Pixar's library takes the file (`programs.Usd`): no error of its validation, each link a body, each joint there; poses.
- Newton has the URDD's poses in random configurations, masses, centres and inertias, limits, mimics, begins in the default
  configuration, and after 2 s with
  position drives on a processor (`SolverMuJoCo(use_mujoco_cpu=True)`) each joint is near where its drive holds it.
- Contacts: MuJoCo, as Newton set it up, finds in sampled configurations the pairs of pieces that `urdd check-collisions` finds,
  and none in the default one. What is within BAND of contact is left out, and what MuJoCo does not check by itself: links
  that are fixed to each other, and those that a joint connects; and links that the file names as filtered as a whole.

A URDD named `NAME` whose source is at ../shared/robots/NAME/robot.urdf is converted by the others too, and `gripper`, which
has mimics; what they write is measured in the same way. `--write` writes the tables of docs/export.md. Exits with 1 where ours differs.
"""

import argparse
import importlib.metadata
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import warnings

# Before a stage is opened: USD reads what it knows of schemas once.
import newton_usd_schemas  # noqa: F401
import numpy as np
import programs

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
SOURCES = ROOT.parent / "shared" / "robots"
# Poses (m, and elements of rotation matrices), relative differences of masses and inertias, and limits (rad or m): Newton
# has binary32.
POSES, RELATIVE, LIMITS = 1e-6, 1e-5, 1e-5
BAND = 1e-5
SAMPLES = 50
STEP, SECONDS = 0.002, 2.0
# Robots of ours that other converters are not asked about.
OURS = ("hand", "planar_base_arm", "toy_all_joints", "welding_arm")
SAG = 0.1
COLUMNS = ["robot", "by", "loads in Newton", "poses", "inertias", "colours", "mimics", "contacts at rest", "MB", "s"]


def inertia_of(link):
    """Mass, centre and inertia about the centre, in the link's frame, as the URDF says them."""
    inertial = link["inertial"] or {}
    mass = (inertial.get("mass") or {}).get("value") or 0.0
    of = inertial.get("inertia") or {}
    get = lambda name: of.get(name) or 0.0
    tensor = np.array(
        [
            [get("ixx"), get("ixy"), get("ixz")],
            [get("ixy"), get("iyy"), get("iyz")],
            [get("ixz"), get("iyz"), get("izz")],
        ]
    )
    origin = inertial.get("origin") or {}
    turn = np.eye(3)
    for axis, angle in zip(np.eye(3), origin.get("rpy") or [0.0] * 3):
        turn = programs.matrix_of_vector(axis * angle) @ turn
    return mass, np.array(origin.get("xyz") or [0.0] * 3), turn @ tensor @ turn.T


class Measured(programs.Newton):
    """What a converter wrote, in Newton."""

    def __init__(self, urdd, file, *, floor=False):
        import newton


        with warnings.catch_warnings(record=True) as self.warned:
            warnings.simplefilter("always")
            super().__init__(urdd, file, prepare=newton.solvers.SolverMuJoCo.register_custom_attributes, floor=floor)

    def poses(self):
        """The greatest difference of poses, of the links that are bodies here; and how many are not. A root link that is
        none is where the world is."""
        there = [at for at, name in enumerate(self.urdd.names) if name in self.bodies]
        worst = 0.0
        for sample in self.urdd.samples_of(self):
            poses = self.place(self.urdd.values(sample["configuration"]))
            worst = max(
                worst, programs.worst([poses[at] for at in there], [sample["link_poses"][at] for at in there])
            )
        return worst, len(self.urdd.names) - len(there)

    def inertias(self):
        """The greatest relative difference of a mass, and of an inertia, of the links that have one."""
        worst = 0.0
        for link in self.urdd.links:
            mass, centre, tensor = inertia_of(link)
            if not mass or not np.any(tensor):
                continue
            if link["name"] not in self.bodies:
                return np.inf
            body = self.bodies[link["name"]]
            theirs = np.array(self.builder.body_inertia[body]).reshape(3, 3)
            worst = max(
                worst,
                abs(self.builder.body_mass[body] - mass) / mass,
                np.abs(np.array(self.builder.body_com[body]) - centre).max(),
                np.abs(theirs - tensor).max() / np.abs(tensor).max(),
            )
        return worst

    def limits(self):
        """The greatest difference of a limit of a joint of one DOF."""
        worst = 0.0
        starts = [*self.builder.joint_qd_start, len(self.builder.joint_limit_lower)]
        known = {joint["name"]: joint for joint in self.urdd.joints}
        for at, name in enumerate(self.joints):
            joint = known.get(name)
            if joint and joint["joint_type"] in ("Revolute", "Prismatic") and starts[at + 1] > starts[at]:
                said = joint["limit"]
                ours = [self.builder.joint_limit_lower[starts[at]], self.builder.joint_limit_upper[starts[at]]]
                worst = max(worst, *np.abs(np.array(ours) - [said["lower"] or 0.0, said["upper"] or 0.0]))
        return worst

    def moved_by(self, body):
        """The joint that moves a body, or `None`."""
        while body >= 0:
            joint = self.builder.joint_child.index(body)
            if self.builder.joint_type[joint] != self.newton.JointType.FIXED:
                return joint
            body = self.builder.joint_parent[joint]
        return None

    def is_checked(self, *links):
        """Whether MuJoCo checks two links: not if they are fixed to each other, or one moves right after the other."""
        one, other = (self.moved_by(self.bodies[link]) for link in links)
        # What is fixed to the world is a body too, as Newton sets MuJoCo up.
        follows = lambda a, b: b is not None and self.moved_by(self.builder.joint_parent[b]) == a
        return one != other and not follows(one, other) and not follows(other, one)

    def driven(self):
        """The coordinates of joints of one DOF that have a drive."""
        of = self.builder
        starts = zip(of.joint_q_start, of.joint_qd_start, strict=True)
        kinds = (self.newton.JointType.REVOLUTE, self.newton.JointType.PRISMATIC)
        joints = zip(of.joint_type, starts, strict=True)
        return [q for kind, (q, qd) in joints if kind in kinds and of.joint_target_ke[qd] > 0]

    def solver(self):
        return self.newton.solvers.SolverMuJoCo(self.model, use_mujoco_cpu=True)

    def set(self, values):
        q = self.position(values)
        self.model.joint_q.assign(q)
        self.model.joint_qd.zero_()
        self.newton.eval_fk(self.model, self.model.joint_q, self.model.joint_qd, self.state)
        self.state.joint_q.assign(q)
        self.state.joint_qd.zero_()

    def touching(self, solver, values):
        """The pairs of pieces that MuJoCo finds in contact, by the names of their prims, with their distances."""
        import mujoco

        self.set(values)
        solver._update_mjc_data(solver.mj_data, self.model, self.state)
        mujoco.mj_forward(solver.mj_model, solver.mj_data)
        shapes = solver.mjc_geom_to_newton_shape.numpy()[0]
        found = {}
        for contact in solver.mj_data.contact:
            pair = tuple(sorted(self.builder.shape_label[shapes[geom]] for geom in (contact.geom1, contact.geom2)))
            found[pair] = min(found.get(pair, np.inf), contact.dist)
        return found

    def simulate(self, values):
        """Simulates from a configuration; the joint coordinates before and after, and the state."""
        self.set(values)
        solver = self.solver()
        before, now, then = self.position(values), self.model.state(), self.model.state()
        for state in (now, then):
            state.joint_q.assign(before)
            state.joint_qd.zero_()
        self.newton.eval_fk(self.model, now.joint_q, now.joint_qd, now)
        control = self.model.control()
        for _ in range(round(SECONDS / STEP)):
            now.clear_forces()
            solver.step(now, then, control, None, STEP)
            now, then = then, now
        return before, now.joint_q.numpy(), now


def colours(file):
    """The number of colours, opacities and textures that are bound to what is rendered."""
    from pxr import Gf, Usd, UsdGeom, UsdShade

    found = set()
    stage = Usd.Stage.Open(str(file))
    for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()):
        if not prim.IsA(UsdGeom.Gprim) and not prim.IsA(UsdGeom.Subset):
            continue
        if UsdGeom.Imageable(prim) and UsdGeom.Imageable(prim).ComputePurpose() == "guide":
            continue
        material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
        surface = material.ComputeSurfaceSource()[0] if material else None
        if not surface:
            continue
        color = surface.GetInput("diffuseColor")
        value, opacity = color.Get() if color else None, surface.GetInput("opacity")
        opacity = opacity.Get() if opacity else None
        connected = color.GetConnectedSources()[0] if color else []
        if connected:
            image = UsdShade.Shader(connected[0].source).GetInput("file")
            value = str(image.Get().path) if image else str(connected[0].source.GetPath())
        found.add((tuple(round(c, 4) for c in value) if isinstance(value, Gf.Vec3f) else value, opacity))
    return len(found)


def size(folder):
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()) / 1e6


def default(urdd):
    """The default configuration: 0, or the bound nearest to it."""
    bounds = urdd.document("bounds_module")
    return np.clip(0.0, bounds["dof_lower_bounds"], bounds["dof_upper_bounds"]).tolist()


def row(urdd, by, file, seconds):
    """A row of the table, of a file in a folder of its own."""
    try:
        loaded = Measured(urdd, file)
        poses, missing = loaded.poses()
        inertias = loaded.inertias()
        rest = loaded.touching(loaded.solver(), urdd.values(default(urdd)))
        contacts = str(sum(distance < -BAND for distance in rest.values()))
        _, after, _ = loaded.simulate(urdd.values(default(urdd)))
        loads = "yes" if np.isfinite(after).all() else "diverges"
        if missing:
            loads += f", without {missing} links"
        mimics = sum(joint >= 0 for joint in loaded.builder.joint_mimic_joint)
        cells = [loads, f"{poses:.0e}", f"{inertias:.0e}", str(colours(file)), str(mimics), contacts]
    except Exception as error:
        print(f"{urdd.root.name}: {by}: {type(error).__name__}: {error}", flush=True)
        cells = [f"no: {type(error).__name__}", *["\u2013"] * 5]
    return [urdd.root.name, by, *cells, f"{size(file.parent):.1f}", seconds]


def timed(*command, **more):
    start = time.perf_counter()
    done = subprocess.run([str(one) for one in command], capture_output=True, text=True, **more)
    return time.perf_counter() - start, done


def check(program, root, folder, wrong):
    """Everything of our own file; the seconds that it took."""
    urdd = programs.Urdd(program, root)
    name = urdd.root.name
    file = folder / "ours" / f"{name}.usda"
    file.parent.mkdir(parents=True)
    seconds, done = timed(program, "export", "usd", root, "-o", file, "--actuators", "position")
    if done.returncode:
        wrong.append(f"{name}: {done.stderr}")
        return urdd, file, seconds
    expect = lambda what, value, most: value <= most or wrong.append(f"{name}: {what}: {value:.2e}, more than {most}")
    expect("poses of the file", urdd.difference(programs.Usd(urdd, file)), POSES)
    loaded = Measured(urdd, file)
    wrong += [f"{name}: Newton warns: {one.message}" for one in loaded.warned]
    poses, missing = loaded.poses()
    # In binary32, from the root to the last link.
    expect("poses in Newton", poses, 10 * POSES)
    expect("links that are no bodies", missing, 0)
    followers = sum(mimic is not None for mimic in urdd.dof["joint_idx_to_mimic_mapping"])
    expect("mimics that are not there", followers - sum(of >= 0 for of in loaded.builder.joint_mimic_joint), 0)
    expect("inertias", loaded.inertias(), RELATIVE)
    expect("limits", loaded.limits(), LIMITS)
    begins, before = loaded.position(urdd.values(default(urdd))), np.array(loaded.builder.joint_q)
    expect("joints that do not begin in the default configuration", np.abs(begins - before).max(), LIMITS)
    solver = loaded.solver()
    # What the file itself names as filtered as a whole is lost.
    named = {frozenset(pair) for pair in re.findall(r"links `([^`]*)` and `([^`]*)` are disabled as a whole", done.stderr)}
    path = {
        (link, piece): f"{prim.GetPath()}/collisions/piece_{piece}"
        for link, prim in programs.names_of_usd(loaded.stage)[0].items()
        for piece in range(1000)
    }
    missed = more = 0
    for _, (values, pairs) in zip(range(SAMPLES), urdd.collisions(SAMPLES)):
        theirs = loaded.touching(solver, urdd.values(list(values)))
        of = lambda pair: (pair[0][0], pair[1][0])
        pairs = {pair for pair in pairs if loaded.is_checked(*of(pair)) and frozenset(of(pair)) not in named}
        ours = {tuple(sorted(path[one] for one in pair)) for pair in pairs}
        missed += len(ours - {*theirs})
        more += sum(distance < -BAND for pair, distance in theirs.items() if pair not in ours)
    print(f"{name}: contacts: {missed} missed, {more} more", flush=True)
    expect("contacts that are not the URDD's", more, 0)
    expect("contacts that Newton misses", missed, 0)
    expect("contacts at rest", sum(d < -BAND for d in loaded.touching(solver, urdd.values(default(urdd))).values()), 0)
    before, after, _ = loaded.simulate(urdd.values(default(urdd)))
    driven = loaded.driven()
    sag = np.abs(after - before)[driven].max() if driven else 0.0
    print(f"{name}: poses {poses:.0e}, inertias {loaded.inertias():.0e}, sags by {sag:.3f}", flush=True)
    # Joints of several DOFs have no drive, and what they carry falls.
    if not urdd.kinds & {"Planar", "Floating", "Spherical"}:
        expect("a joint sags by", sag if np.isfinite(sag) else np.inf, SAG)
    return urdd, file, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdd", type=pathlib.Path)
    parser.add_argument("roots", type=pathlib.Path, nargs="+")
    parser.add_argument("--converter", metavar="PYTHON", help="the Python that has urdf-usd-converter")
    parser.add_argument("--write", action="store_true", help="write the tables")
    arguments = parser.parse_args()
    wrong, rows = [], []
    with tempfile.TemporaryDirectory() as made:
        for root in arguments.roots:
            folder = pathlib.Path(made) / root.name
            urdd, file, seconds = check(arguments.urdd.resolve(), root, folder, wrong)
            places = (SOURCES / root.name / "robot.urdf", ROOT / "conformance" / "robots" / f"{root.name}.urdf")
            source = next((place for place in places if place.is_file() and root.name not in OURS), None)
            if source is None:
                continue
            generated, _ = timed(arguments.urdd.resolve(), "generate", source, "-o", folder / "urdd")
            rows.append(row(urdd, "urdd", file, f"{generated:.1f} + {seconds:.1f}"))
            other = folder / "urdf2any" / "robot.usda"
            other.parent.mkdir()
            seconds, _ = timed(pathlib.Path(sys.executable).with_name("urdf2any"), source, "-o", other)
            rows.append(row(urdd, "urdf2any", other, f"{seconds:.1f}"))
            if arguments.converter:
                other = folder / "converter"
                seconds, _ = timed(pathlib.Path(arguments.converter).with_name("urdf_usd_converter"), source, other)
                file = next(iter(sorted(other.glob("*.usd*"))), other / "none.usda")
                rows.append(row(urdd, "urdf-usd-converter", file, f"{seconds:.1f}"))
            print(*map(" | ".join, rows[-3:]), sep="\n", flush=True)
    table = {"columns": COLUMNS, "rows": rows}
    sys.path.insert(0, str(ROOT / "benches"))
    import results as pages

    print(pages.markdown(table))
    print(*(f"wrong: {one}" for one in wrong), sep="\n")
    if arguments.write:
        names = ("newton", "mujoco", "usd-core", "urdf2any")
        versions = [f"{name} {importlib.metadata.version(name)}" for name in names]
        how = "MB: all files; s: of urdd, to generate and to export"
        pages.write("usd", {"peers": table}, *versions, "urdf-usd-converter 0.3.4", how=how)
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
