"""Exports hundreds of robots in every format, and loads each file with every program for it that PyPI or Debian has.

    pip install mujoco==4.0.0 pin==4.1.0 drake==1.51.1 yourdfpy==0.0.60 example-robot-data==6.0.0 pybullet==3.2.7 \\
        newton==1.8.0 newton-usd-schemas==0.6.0 usd-core==26.8 xacro==2.1.1 rtb-data==2.0.0 pyyaml numpy trimesh
    g++ -O1 sdf.cpp -o sdf_load $(pkg-config --cflags --libs sdformat12)      # Debian's libsdformat-dev
    SDF_LOAD=$PWD/sdf_load python3 tests/figures/exports/corpus.py target/release/urdd FOLDER [--only REGEX] [--shapes] [--write]

The robots: all of example-robot-data, those of rtb-data, those of pybullet_data, and every EVERY-th of its thousand random
objects. FOLDER gets `results.jsonl`, a line for each robot in the order of their names, and keeps the files of each failure.
A run that was ended goes on where it was, with the same program. Two robots at a time; each program loads in a process of
its own, which is started anew after a crash, after SECONDS, or beyond BYTES.

A file counts as loaded where its program accepts it, the poses of all links are ours in CONFIGURATIONS configurations, and,
in MuJoCo, 500 steps stay finite without a warning. Exits with 1 where a file that was written does not load, or we refuse a
robot, without being in `exceptions.json`; where an exception there is none any more; and where fewer than GOAL load.
`--write` writes the tables of docs/export.md, of all robots; with `--exports`, the rows of these, and the line below the
tables says of which run the others are.
"""

import argparse
import ast
import collections
import concurrent.futures
import ctypes
import hashlib
import importlib.metadata
import json
import os
import pathlib
import queue
import re
import resource
import select
import shutil
import subprocess
import sys
import tempfile
import warnings
import xml.etree.ElementTree as ET

import programs

HERE = pathlib.Path(__file__).resolve().parent
EVERY = 7
CONFIGURATIONS = 10
LANES = 2
SECONDS = 180
BYTES = 8 << 30
STEPS = 500
GOAL = 0.99
# Robots that a row of the tables names.
MOST = 8
# Between formats in a cell.
LIST = ", "

# Spheres are measured in fewer configurations than by default, which takes a fifth of the time.
FEW = ("--samples", "1000")
# What is exported: the format, the file, options. `used` is what a person would simulate.
EXPORTS = {
    "srdf": ("srdf", "r.srdf"),
    "urdf": ("urdf", "urdf/r.urdf"),
    "drake": ("drake", "drake/r.urdf", "--package", "r_description"),
    "mjcf": ("mjcf", "mjcf/r.xml"),
    "mjcf-simulated": ("mjcf", "used/r.xml", "--actuators", "position", "--scene", "--setup", "guessed.toml"),
    "sdf": ("sdf", "sdf/r.sdf"),
    "usd": ("usd", "usd/r.usda", "--actuators", "position"),
    "spherized": ("spherized", "spherized/r.urdf", *FEW),
    "curobo": ("curobo", "r.yml", "--config", *FEW),
    "foam": ("foam", "r.json", *FEW),
    "moveit": ("moveit", "r_moveit_config"),
}
# With `--shapes`: the same of other collision geometry. What has less than a format takes is counted in MJCF.
SHAPES = {
    "mjcf-source": ("mjcf", "source/r.xml", "--shapes", "source"),
    "drake-source": ("drake", "source_drake/r.urdf", "--shapes", "source"),
    "sdf-source": ("sdf", "source_sdf/r.sdf", "--shapes", "source"),
    "mjcf-fit": ("mjcf", "fit/r.xml", "--fit"),
}
# Whose collision geometry is counted, by type.
COUNTED = {"mjcf-source": "the source", "mjcf-fit": "fitted"}
KINDS = ["box", "cylinder", "capsule", "sphere", "mesh"]
TITLES = {
    "urdd": "(URDD)", "srdf": "SRDF", "urdf": "URDF", "drake": "Drake", "drake-directive": "Drake, model directive", "mjcf": "MJCF",
    "mjcf-simulated": "MJCF, position actuators and scene", "sdf": "SDF", "usd": "USD", "spherized": "URDF with spheres", "curobo": "cuRobo's YAML",
    "foam": "Foam's JSON", "moveit": "MoveIt's package",
    "mjcf-source": "MJCF, shapes of the source", "drake-source": "Drake, shapes of the source", "sdf-source": "SDF, shapes of the source",
    "mjcf-fit": "MJCF, fitted primitives",
}  # fmt: skip
# Which program loads what: the export, the file where it is another one, the greatest difference of poses.
LOADS = {
    "MuJoCo": [("mjcf", None), ("mjcf-simulated", "used/r_scene.xml"), ("mjcf-source", None), ("mjcf-fit", None)],
    "Newton": [("mjcf", None), ("urdf", None), ("usd", None)],
    "usd-core": [("usd", None)],
    "Pinocchio": [("urdf", None), ("spherized", None), ("srdf", None), ("moveit", None)],
    "yourdfpy": [("urdf", None), ("spherized", None)],
    "PyBullet": [("urdf", None), ("spherized", None)],
    "Drake": [("drake", None), ("drake", "drake/r.dmd.yaml"), ("sdf", None), ("drake-source", None), ("sdf-source", None)],
    "libsdformat": [("sdf", None), ("sdf-source", None)],
    "xacro, YAML": [("moveit", None)],
    "YAML": [("curobo", None)],
    "JSON": [("foam", None)],
}
# What PyPI calls the programs that it has.
PACKAGES = {
    "MuJoCo": "mujoco", "Newton": "newton", "usd-core": "usd-core", "Pinocchio": "pin", "yourdfpy": "yourdfpy",
    "PyBullet": "pybullet", "Drake": "drake",
}  # fmt: skip
SITE = pathlib.Path(importlib.metadata.distribution("example-robot-data").locate_file(""))
# Where mesh names of example-robot-data begin.
ENVIRONMENT = os.environ | {"ROS_PACKAGE_PATH": str(SITE / "cmeel.prefix/share")}
# PyBullet and Newton compute in binary32, which USD has for frames of joints; what yourdfpy computes by rounds angles near a right one.
TOLERANCE = collections.defaultdict(lambda: 1e-9, {"usd-core": 1e-6}, Newton=1e-4, PyBullet=1e-6, yourdfpy=1e-7)


def robots():
    """Name and file of each robot, in the order of the names."""
    packages = {
        "example-robot-data": "cmeel.prefix/share/example-robot-data/robots",
        "pybullet_data": "",
        "rtb-data": "rtbdata",
    }
    for package, below in packages.items():
        folder = SITE / (below or package)
        assert folder.is_dir(), folder
        found = sorted(folder.rglob("*.urdf"))
        objects = [file for file in found if "random_urdfs" in file.parts]
        for file in sorted({*found} - {*objects} | {*objects[::EVERY]}):
            yield f"{package}/{file.relative_to(folder).with_suffix('')}", file


# What each program does with a file. Each raises where it refuses it, and gives the greatest difference of poses.


def load_mujoco(urdd, file):
    loaded = programs.Mujoco(urdd, file)
    difference = urdd.difference(loaded, CONFIGURATIONS)
    loaded.steps(STEPS)
    return difference


def load_newton(urdd, file):
    return urdd.difference(programs.Newton(urdd, file), CONFIGURATIONS)


def load_usd(urdd, file):
    return urdd.difference(programs.Usd(urdd, file), CONFIGURATIONS)


def load_pinocchio(urdd, file):
    import pinocchio as pin

    if file.is_dir():
        (urdf,), (srdf,) = file.glob("config/*.urdf"), file.glob("config/*.srdf")
        folders = [str(file.parent)]
    else:
        urdf, srdf = (file.with_name("urdf") / "r.urdf", file) if file.suffix == ".srdf" else (file, None)
        folders = [str(urdf.parent)]
    loaded = programs.Pinocchio(urdd, urdf)
    geometry = pin.buildGeomFromUrdf(loaded.model, str(urdf), pin.GeometryType.COLLISION, folders)
    if file.parent.name == "urdf":
        pin.buildGeomFromUrdf(loaded.model, str(urdf), pin.GeometryType.VISUAL, folders)
    if srdf:
        geometry.addAllCollisionPairs()
        before = len(geometry.collisionPairs)
        pin.removeCollisionPairs(loaded.model, geometry, str(srdf))
        pin.loadReferenceConfigurations(loaded.model, str(srdf))
        named = {
            frozenset((pair.get("link1"), pair.get("link2")))
            for pair in ET.parse(srdf).getroot().iter("disable_collisions")
        }
        links = [loaded.model.frames[of.parentFrame].name for of in geometry.geometryObjects]
        left = [(links[pair.first], links[pair.second]) for pair in geometry.collisionPairs]
        if still := [pair for pair in left if frozenset(pair) in named]:
            raise ValueError(f"{len(still)} of {before} pairs are still checked: {still[0]}")
    return urdd.difference(loaded, CONFIGURATIONS)


def load_yourdfpy(urdd, file):
    return urdd.difference(programs.Yourdfpy(urdd, file, meshes=file.parent.name == "urdf"), CONFIGURATIONS)


def load_pybullet(urdd, file):
    return urdd.difference(programs.Pybullet(urdd, file), CONFIGURATIONS)


def load_drake(urdd, file):
    return urdd.difference(programs.Drake(urdd, file), CONFIGURATIONS)


def load_libsdformat(urdd, file):
    loaded = programs.Libsdformat(urdd, file)
    zero = next(sample for sample in urdd.samples if sample["kind"] == "Zero")
    # libsdformat has no kinematics: the poses where all joints are at 0, those that follow too.
    still = {name: [0.0] * len(value) for name, value in urdd.values(zero["configuration"]).items()}
    if still != urdd.values(zero["configuration"]):
        raise programs.NotComparable("a joint that follows is not at 0 where its driver is")
    return programs.worst(loaded.place(still), zero["link_poses"])


def load_moveit(_urdd, folder):
    """Expands what MoveIt expands: nothing may change but what is escaped from it. Reads the rest."""
    import xacro
    import yaml

    for file in [*folder.glob("config/*.urdf"), *folder.glob("config/*.srdf"), folder / "package.xml"]:
        expanded = xacro.process_file(str(file)).toxml()
        kept = re.sub(r"\$\$(?=[{(])", "$", file.read_text("utf-8"))
        if ET.canonicalize(expanded, strip_text=True) != ET.canonicalize(kept, strip_text=True):
            raise ValueError(f"xacro changes {file.name}")
    for file in [*folder.rglob("*.yaml"), *folder.rglob("*.rviz")]:
        yaml.safe_load(file.read_text("utf-8"))
    for file in folder.rglob("*.py"):
        ast.parse(file.read_text("utf-8"))


def load_curobo(urdd, file):
    import yaml

    kinematics = yaml.safe_load(file.read_text("utf-8"))["robot_cfg"]["kinematics"]
    links = {
        *kinematics["collision_spheres"],
        *kinematics["collision_link_names"],
        kinematics["base_link"],
        kinematics["ee_link"],
    }
    joints = {*kinematics["cspace"]["joint_names"], *(kinematics["lock_joints"] or {})}
    if strange := links - {*urdd.names, "attached_object"} | joints - {joint["name"] for joint in urdd.joints}:
        raise ValueError(f"names that the robot does not have: {sorted(strange)}")


def load_foam(urdd, file):
    said = json.loads(file.read_text("utf-8"))
    if strange := {*said["links"]} - {*urdd.names}:
        raise ValueError(f"names that the robot does not have: {sorted(strange)}")


LOADERS = {
    "MuJoCo": load_mujoco, "Newton": load_newton, "usd-core": load_usd, "Pinocchio": load_pinocchio, "yourdfpy": load_yourdfpy,
    "PyBullet": load_pybullet, "Drake": load_drake, "libsdformat": load_libsdformat, "xacro, YAML": load_moveit,
    "YAML": load_curobo, "JSON": load_foam,
}  # fmt: skip


def counted(file):
    """How many shapes of which type an MJCF collides with."""
    geoms = [geom for geom in ET.parse(file).getroot().iter("geom") if geom.get("class") == "collision"]
    return collections.Counter(geom.get("type", "sphere") for geom in geoms)


def bound():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))


def work(program):
    """The process that loads files for one program: a line of JSON for each line on standard input."""
    answers = os.fdopen(os.dup(1), "w")
    log = tempfile.TemporaryFile()
    os.dup2(log.fileno(), 1)
    os.dup2(log.fileno(), 2)
    # MuJoCo writes its warnings to a file where it runs.
    os.chdir(tempfile.gettempdir())
    warnings.simplefilter("ignore")
    flush = ctypes.CDLL(None).fflush
    for line in sys.stdin:
        job = json.loads(line)
        os.ftruncate(log.fileno(), 0)
        os.lseek(log.fileno(), 0, os.SEEK_SET)
        try:
            said = {"poses": LOADERS[program](programs.Urdd(None, job["urdd"]), pathlib.Path(job["file"]))}
            if said["poses"] is not None and not said["poses"] <= TOLERANCE[program]:
                said["refused"] = f"poses differ by {said['poses']:.1e}"
        except programs.NotComparable as reason:
            said = {"poses": None, "not compared": str(reason)}
        except BaseException as error:
            flush(None)
            printed = os.pread(log.fileno(), 20000, 0).decode("utf-8", "replace")
            said = {"refused": f"{type(error).__name__}: {error}"[:1000], "printed": printed[-1000:]}
        answers.write(json.dumps(said) + "\n")
        answers.flush()


class Worker:
    """A program's process, which is started when it is first asked, and anew after it ended."""

    def __init__(self, program):
        self.program, self.process = program, None

    def ask(self, job):
        if self.process is None:
            command = [sys.executable, __file__, "--worker", self.program]
            self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, preexec_fn=bound)
        self.process.stdin.write(json.dumps(job).encode() + b"\n")
        self.process.stdin.flush()
        if select.select([self.process.stdout], [], [], SECONDS)[0]:
            if line := self.process.stdout.readline():
                return json.loads(line)
            said = f"its process ended with status {self.process.wait()}"
        else:
            said = f"not done in {SECONDS} s"
        self.end()
        return {"refused": said}

    def end(self):
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process = None


class Lane:
    """What one robot at a time uses: a worker for each program."""

    def __init__(self, urdd, folder, exports):
        self.urdd, self.folder, self.exports = urdd, folder, exports
        self.workers = {program: Worker(program) for program in LOADS}

    def run(self, *arguments):
        try:
            done = subprocess.run(
                [self.urdd, *map(str, arguments)],
                env=ENVIRONMENT,
                capture_output=True,
                text=True,
                timeout=10 * SECONDS,
                preexec_fn=bound,
            )
        except subprocess.TimeoutExpired:
            return "not done in time"
        said = (
            [line for line in done.stderr.splitlines() if line.startswith("error")] or done.stderr.splitlines() or [""]
        )
        return said[-1] if done.returncode else None

    def robot(self, name, file):
        """Everything of one robot: what was refused by us, and what each program says."""
        folder = self.folder / name.replace("/", "__")
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        said = {"robot": name, "refused": {}, "loads": []}
        plain = lambda text: text.replace(f"{folder}/", "").replace(str(file), file.name)
        if refused := self.run("generate", file, "-o", folder / "urdd"):
            said["refused"]["urdd"] = plain(refused)
        else:
            self.run("export", "init", folder / "urdd", "-o", folder / "guessed.toml")
            for export, (form, target, *options) in self.exports.items():
                (folder / target).parent.mkdir(exist_ok=True)
                options = [folder / option if option == "guessed.toml" else option for option in options]
                if refused := self.run("export", form, folder / "urdd", "-o", folder / target, *options):
                    said["refused"][export] = plain(refused)
                elif export in COUNTED:
                    said.setdefault("shapes", {})[export] = counted(folder / target)
            for program, files in LOADS.items():
                for export, other in files:
                    if export not in self.exports or export in said["refused"]:
                        continue
                    job = {"urdd": str(folder / "urdd"), "file": str(folder / (other or self.exports[export][1]))}
                    answer = self.workers[program].ask(job)
                    for key in answer.keys() & {"refused", "printed"}:
                        answer[key] = plain(answer[key])
                    said["loads"].append(
                        {
                            "export": f"{export}-directive" if other and other.endswith(".dmd.yaml") else export,
                            "program": program,
                            **answer,
                        }
                    )
        if not any("refused" in load for load in said["loads"]):
            shutil.rmtree(folder)
        return said


def measure(urdd, folder, only, exports):
    """The results of all robots; what is in FOLDER of the same program is not done again."""
    file = folder / "results.jsonl"
    digest = hashlib.sha256(urdd.read_bytes()).hexdigest()
    head = json.dumps({"urdd": digest, "exports": [*exports]})
    before = file.read_text().splitlines() if file.is_file() else []
    before = [json.loads(line) for line in before[1:]] if before[:1] == [head] else []
    done = {one["robot"]: one for one in before}
    lanes = queue.SimpleQueue()
    every = [Lane(urdd, folder, exports) for _ in range(LANES)]
    for lane in every:
        lanes.put(lane)

    def one(robot):
        if robot[0] in done:
            return done[robot[0]]
        lane = lanes.get()
        try:
            return lane.robot(*robot)
        finally:
            lanes.put(lane)

    chosen = [robot for robot in robots() if re.search(only, robot[0])]
    results = []
    with file.open("w") as out, concurrent.futures.ThreadPoolExecutor(LANES) as pool:
        print(head, file=out)
        for said in pool.map(one, chosen):
            results.append(said)
            print(json.dumps(said), file=out, flush=True)
            bad = [
                f"{load['export']} {load['program']}: {load['refused']}" for load in said["loads"] if "refused" in load
            ]
            print(
                f"{len(results)}/{len(chosen)}", said["robot"], *said["refused"].items(), *bad, sep="\n    ", flush=True
            )
    for lane in every:
        for worker in lane.workers.values():
            worker.end()
    return results


def judge(results, exports, is_whole):
    """The tables by name, and what is wrong: failures that no exception has, exceptions that are none any more, too many."""
    exceptions = json.loads((HERE / "exceptions.json").read_text())
    wrong, rows, named = [], {}, collections.defaultdict(set)

    def excepted(robot, export, program, message):
        for at, one in enumerate(exceptions):
            if (
                program == one["program"]
                and export in one["exports"]
                and re.search(one["robots"], robot)
                and one["says"] in message
            ):
                named[at].add(robot)
                return
        wrong.append(f"{robot}: {export}: {program}: {message}")

    for said in results:
        for export, message in said["refused"].items():
            excepted(said["robot"], export, "urdd", message)
        for load in said["loads"]:
            row = rows.setdefault((load["export"], load["program"]), collections.Counter())
            row["written"] += 1
            if "refused" in load:
                excepted(said["robot"], load["export"], load["program"], load["refused"] + load.get("printed", ""))
                continue
            row["loaded"] += 1
            row["not compared"] += "not compared" in load
            if load["poses"] is not None:
                row["poses"] = max(row["poses"], load["poses"])
    if is_whole:
        asked = lambda one: {"urdd", *exports} & {*one["exports"]}
        wrong += [
            f"not an exception any more: {one}" for at, one in enumerate(exceptions) if at not in named and asked(one)
        ]
    written, loaded = (sum(row[key] for row in rows.values()) for key in ("written", "loaded"))
    if loaded < GOAL * written:
        wrong.append(f"{loaded} of {written} loads, fewer than {GOAL}")
    table = {"columns": ["format", "program", "written", "loaded", "poses"], "rows": []}
    for (export, program), row in sorted(
        rows.items(), key=lambda item: [*exports].index(item[0][0].removesuffix("-directive"))
    ):
        poses = f"{row['poses']:.0e}" if "poses" in row else "\u2013"
        if row["not compared"]:
            poses += f", {row['not compared']} not compared"
        table["rows"].append([TITLES[export], program, f"{row['written']:,}", f"{row['loaded']:,}", poses])
    reasons = [
        [
            one["program"],
            LIST.join(TITLES[export] for export in one["exports"]),
            ", ".join(sorted(named[at])[:MOST])
            + (f" and {len(named[at]) - MOST} more" if len(named[at]) > MOST else ""),
            one["why"],
        ]
        for at, one in enumerate(exceptions)
        if at in named
    ]
    columns = ["format", "robots", "reason"]
    kept = {"columns": ["collision geometry", *KINDS], "rows": []}
    for export in [export for export in COUNTED if export in exports]:
        of = [said["shapes"][export] for said in results if export in said.get("shapes", {})]
        numbers = [(sum(kind in one for one in of), sum(one.get(kind, 0) for one in of)) for kind in KINDS]
        row = [f"{many:,} in {having:,}" if many else "0" for having, many in numbers]
        kept["rows"].append([f"{COUNTED[export]}, {len(of):,} robots", *row])
    return {
        **({"shapes": kept} if kept["rows"] else {}),
        "robots": f"{len(results):,}",
        "loads": f"{loaded:,} of {written:,}",
        "corpus": table,
        "refused": {"columns": columns, "rows": [row[1:] for row in reasons if row[0] == "urdd"]},
        "exceptions": {"columns": ["program", *columns], "rows": [row for row in reasons if row[0] != "urdd"]},
    }, wrong


def merged(items, before, exports):
    """The tables of a run of some formats, with the rows that an earlier run has of the others."""
    ran = {TITLES[name] for name in TITLES if name.removesuffix("-directive") in {"urdd", *exports}}
    is_of = lambda formats: formats in ran or {*formats.split(LIST)} <= ran
    order = [*TITLES.values()]
    all_of = {}
    for name, formats in (("corpus", 0), ("refused", 0), ("exceptions", 1)):
        kept = [row for row in before[name]["rows"] if not is_of(row[formats])]
        rows = [row for row in items[name]["rows"] if row not in kept]
        all_of[name] = {**items[name], "rows": kept + rows}
    all_of["corpus"]["rows"].sort(key=lambda row: order.index(row[0]))
    written, loaded = (
        sum(int(row[column].replace(",", "")) for row in all_of["corpus"]["rows"]) for column in (2, 3)
    )
    return {"robots": items["robots"], "loads": f"{loaded:,} of {written:,}", **all_of}


def write(items, exports, only):
    sys.path.insert(0, str(HERE.parents[2] / "benches"))
    import results as pages

    how = f"poses: the greatest difference in {CONFIGURATIONS} configurations"
    of_shapes = {*exports} == {*SHAPES}
    if only:
        how = f"{how}; robots whose names match `{only}`"
    loading = [name for name, files in LOADS.items() if {export for export, _ in files} & {*exports}]
    versions = [f"{PACKAGES[name]} {importlib.metadata.version(PACKAGES[name])}" for name in loading if name in PACKAGES]
    if "libsdformat" in loading:
        versions.append("libsdformat 12.3")
    if not of_shapes and {*exports} != {*EXPORTS}:
        earlier = json.loads((pages.FOLDER / "exports.json").read_text("utf-8"))
        made, these = earlier["made"], f"this run: {LIST.join(TITLES[name] for name in exports)}; all else: "
        origin = f"{made['date']}, commit {made['commit']}"
        if "this run: " in made["how"]:
            if these not in made["how"]:
                sys.exit("the tables have rows of two runs already, of other formats: run all formats")
            origin = made["how"].partition(these)[2]
        how = f"{how}; {these}{origin}"
        items = merged(items, earlier["items"], exports)
        before = made["programs"].split(", ")
        versions = before + [version for version in versions if version not in before]
    if of_shapes:
        # What is refused is refused with other shapes too.
        items = {name: item for name, item in items.items() if name not in ("refused", "exceptions")}
    pages.write("exports_of_shapes" if of_shapes else "exports", items, *versions, how=how)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdd", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", default="", metavar="REGEX", help="robots whose names match")
    parser.add_argument("--exports", help=f"of these, separated by commas: {','.join(EXPORTS)}")
    parser.add_argument("--shapes", action="store_true", help="exports with other shapes instead")
    parser.add_argument("--write", action="store_true", help="write the tables")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    every = SHAPES if arguments.shapes else EXPORTS
    exports = {name: every[name] for name in (arguments.exports or ",".join(every)).split(",")}
    found = measure(arguments.urdd.resolve(), arguments.folder.resolve(), arguments.only, exports)
    items, wrong = judge(found, exports, not arguments.only)
    sys.path.insert(0, str(HERE.parents[2] / "benches"))
    import results as pages

    for name, item in items.items():
        print(f"\n{name}: {item}" if isinstance(item, str) else f"\n{name}:\n{pages.markdown(item)}")
    print(*(f"\nwrong: {one}" for one in wrong), sep="", flush=True)
    if arguments.write and (arguments.shapes or not arguments.only):
        write(items, exports, arguments.only)
    sys.exit(bool(wrong))


if __name__ == "__main__":
    work(sys.argv[2]) if sys.argv[1:2] == ["--worker"] else main()
