"""Has MoveIt's own readers read the packages of `urdd export moveit`, and compares what is in them with the sources of each release.

    pip install pyyaml==6.0.3 xacro==2.1.1
    urdd generate ROBOT.urdf -o URDD            # for each robot
    python3 tests/figures/exports/moveit.py target/release/urdd SOURCES URDD...

SOURCES has Git clones (bare ones too), with the branches `humble` and `jazzy` where there are such: `moveit2`, `ros2_control`,
`ros2_controllers`, `launch_param_builder`.

For each URDD and release, the package's launch file runs with that release's `moveit_configs_utils`; `launch`, `launch_ros` and
`ament_index_python` are stand-ins that record. What it starts is then held to the sources:

- each parameter has a type that ROS knows (no empty list);
- planners, adapters, solvers and controllers are plugins of that release, and MoveIt's controllers of a type that it knows;
- parameters have the names, types and rules of the schemas that `generate_parameter_library` makes readers of;
- what controllers command and read is in the mock hardware of the URDF, and nothing is commanded by two;
- what is started is a dependency of the package.

At the end a package of each release is held to the other, which has to fail. Exits with 1 where something differs.
"""

import io
import pathlib
import re
import runpy
import subprocess
import sys
import tarfile
import tempfile
import types
import xml.etree.ElementTree as ET

import yaml

RELEASES = ("humble", "jazzy")
# Schemas of controllers, in ros2_controllers.
SCHEMAS = {
    "joint_trajectory_controller/JointTrajectoryController": "joint_trajectory_controller/src/joint_trajectory_controller_parameters.yaml",
    "position_controllers/GripperActionController": "gripper_controllers/src/gripper_action_controller_parameters.yaml",
    "parallel_gripper_action_controller/GripperActionController": "parallel_gripper_controller/src/gripper_action_controller_parameters.yaml",
    "velocity_controllers/JointGroupVelocityController": "forward_command_controller/src/forward_command_controller_parameters.yaml",
    "effort_controllers/JointGroupEffortController": "forward_command_controller/src/forward_command_controller_parameters.yaml",
    "joint_state_broadcaster/JointStateBroadcaster": "joint_state_broadcaster/src/joint_state_broadcaster_parameters.yaml",
}
COMMANDS = {"velocity_controllers": ["velocity"], "effort_controllers": ["effort"]}
TYPES = {"string": str, "double": float, "int": int, "bool": bool}


class Sources:
    """The sources of a release."""

    def __init__(self, folder, release, target):
        self.folder, self.release, self.target = folder, release, target

    def git(self, repository, *command):
        done = subprocess.run(["git", "-C", self.folder / repository, *command], capture_output=True, check=True)
        return done.stdout

    def branch(self, repository):
        has = self.git(repository, "branch", "--list", self.release)
        return self.release if has else "HEAD"

    def text(self, repository, path):
        return self.git(repository, "show", f"{self.branch(repository)}:{path}").decode()

    def has(self, repository, path):
        return bool(self.git(repository, "ls-tree", self.branch(repository), path))

    def unpack(self, repository, path):
        """A folder of it, on the disk."""
        with tarfile.open(fileobj=io.BytesIO(self.git(repository, "archive", self.branch(repository), path))) as archive:
            archive.extractall(self.target, filter="data")

    def plugins(self):
        """The names of all plugins."""
        names = set()
        for repository in ("moveit2", "ros2_control", "ros2_controllers"):
            found = self.git(repository, "grep", "-hoE", "<class[^>]* name=\"[^\"]+\"|<class name=\"[^\"]+\"", self.branch(repository), "--", "*.xml")
            names |= set(re.findall(r'name="([^"]+)"', found.decode()))
        return names


def stand_ins(shares):
    """Modules of ROS that record what is started."""
    class Recorded:
        def __init__(self, *positional, **named):
            self.positional, self.named = positional, named

    def module(name, **members):
        parts = name.split(".")
        for count in range(1, len(parts) + 1):
            sys.modules.setdefault(".".join(parts[:count]), types.ModuleType(".".join(parts[:count])))
        sys.modules[name].__dict__.update(members)

    module("ament_index_python.packages", get_package_share_directory=lambda name: str(shares[name]), get_package_share_path=lambda name: shares[name])
    module("launch", LaunchDescription=Recorded)
    module("launch.some_substitutions_type", SomeSubstitutionsType=object)
    module("launch_ros.parameter_descriptions", ParameterValue=Recorded)
    module("launch_ros.actions", Node=Recorded)
    # Expands xacro when a launch argument is given, which these packages have none of.
    module("moveit_configs_utils.substitutions", Xacro=Recorded)


def started(package, sources):
    """The nodes that the launch file of a package starts, by their executables."""
    for name in [name for name in sys.modules if name.split(".")[0] in ("moveit_configs_utils", "launch_param_builder")]:
        del sys.modules[name]
    shares = {package.name: package, "moveit_configs_utils": sources.target / "moveit_configs_utils"}
    stand_ins(shares)
    utils = sys.modules["moveit_configs_utils"]
    utils.__path__ = [str(sources.target / "moveit_configs_utils/moveit_configs_utils")]
    sys.path[:0] = [str(sources.target)]
    try:
        utils.MoveItConfigsBuilder = __import__("moveit_configs_utils.moveit_configs_builder", fromlist=["x"]).MoveItConfigsBuilder
        description = runpy.run_path(str(package / "launch/demo.launch.py"))["generate_launch_description"]()
    finally:
        del sys.path[0]
    return [node.named for node in description.positional[0]]


def leaves(value, path=""):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, f"{path}.{key}" if path else str(key))
    else:
        yield path, value


def typed(value):
    """Whether ROS has a type for a parameter."""
    if isinstance(value, list):
        return bool(value) and len({type(one) for one in value}) == 1 and typed(value[0])
    return isinstance(value, (bool, int, float, str))


def schema(parameters, rules, where):
    """What parameters have that a schema has not, or otherwise."""
    for name, value in parameters.items():
        rule = rules.get(name) or next((inner for key, inner in rules.items() if key.startswith("__map_")), None)
        if rule is None:
            yield f"{where}: no parameter `{name}`"
        elif "type" not in rule:
            yield from schema(value, rule, f"{where}.{name}")
        else:
            kind = rule["type"].removesuffix("_array")
            values = value if rule["type"].endswith("_array") else [value]
            if isinstance(value, list) != rule["type"].endswith("_array") or any(type(one) is not TYPES[kind] for one in values):
                yield f"{where}.{name}: {value!r} is no {rule['type']}"
                continue
            for check, given in (rule.get("validation") or {}).items():
                given = given[0] if isinstance(given, list) and given else given
                holds = {
                    "unique<>": lambda: len(set(values)) == len(values),
                    "size_gt<>": lambda: len(values) > given,
                    "subset_of<>": lambda: set(values) <= set(given),
                    "one_of<>": lambda: value in given,
                    "not_empty<>": lambda: bool(value),
                    "gt<>": lambda: value > given,
                    "gt_eq<>": lambda: value >= given, "gt_eq": lambda: value >= given,
                }.get(check, lambda: True)()
                if not holds:
                    yield f"{where}.{name}: {value!r} breaks {check} {given}"


def judge(package, sources):
    """All that is wrong with a package in a release."""
    nodes = started(package, sources)
    plugins = sources.plugins()
    needed = {node.text for node in ET.parse(package / "package.xml").iter("exec_depend")}
    yield from (f"package.xml lacks {node['package']}" for node in nodes if node["package"] not in needed)
    group, manager = (next(node for node in nodes if node["executable"] == name) for name in ("move_group", "ros2_control_node"))
    moveit = group["parameters"][0]
    yield from (f"{path}: ROS has no type for {value!r}" for path, value in leaves(moveit) if not typed(value))

    ompl = moveit["ompl"]
    if sources.has("moveit2", "moveit_ros/planning/planning_pipeline/res/planning_pipeline_parameters.yaml"):
        rules = yaml.safe_load(sources.text("moveit2", "moveit_ros/planning/planning_pipeline/res/planning_pipeline_parameters.yaml"))["planning_pipeline_parameters"]
        own = {name: value for name, value in ompl.items() if name in rules or "plugin" in name or "adapter" in name}
        yield from schema(own, rules, "ompl")
        used = [*own.get("planning_plugins", ["none"]), *own.get("request_adapters", []), *own.get("response_adapters", [])]
    else:
        # Humble: `planning_pipeline.cpp` reads two texts.
        own = {name: value for name, value in ompl.items() if "plugin" in name or "adapter" in name}
        yield from schema(own, {"planning_plugin": {"type": "string"}, "request_adapters": {"type": "string"}}, "ompl")
        used = [str(ompl.get("planning_plugin")), *str(ompl.get("request_adapters", "")).split()]
    solvers = moveit["robot_description_kinematics"]
    if sources.has("moveit2", "moveit_ros/planning/kinematics_plugin_loader/src/kinematics_parameters.yaml"):
        rules = yaml.safe_load(sources.text("moveit2", "moveit_ros/planning/kinematics_plugin_loader/src/kinematics_parameters.yaml"))["kinematics"]
        for name, solver in solvers.items():
            yield from schema(solver, rules, f"kinematics.{name}")
    used += [solver["kinematics_solver"] for solver in solvers.values()]
    limit = {f"{has}_{what}": {"type": kind} for what in ("velocity", "acceleration", "jerk") for has, kind in (("max", "double"),)}
    limit |= {f"has_{what}_limits": {"type": "bool"} for what in ("velocity", "acceleration", "jerk")}
    for name, joint in moveit["robot_description_planning"]["joint_limits"].items():
        yield from schema(joint, limit, f"joint_limits.{name}")

    simple = dict(moveit.get("moveit_simple_controller_manager", {}))
    known = re.findall(r'type == "(\w+)"', sources.text("moveit2", "moveit_plugins/moveit_simple_controller_manager/src/moveit_simple_controller_manager.cpp"))
    named = simple.pop("controller_names", [])
    if sorted(named) != sorted(simple):
        yield f"controller_names {named}, and {sorted(simple)}"
    yield from (f"{name}: MoveIt has no controllers of type {one['type']}" for name, one in simple.items() if one["type"] not in known)

    controllers = yaml.safe_load(pathlib.Path(manager["parameters"][-1]).read_text())
    robot = ET.fromstring(moveit["robot_description"])
    hardware = robot.findall("ros2_control")
    if len(hardware) != 1 or hardware[0].findtext("hardware/plugin") != "mock_components/GenericSystem":
        yield "the URDF's hardware is not the mock of ros2_control"
    used += [one.findtext("hardware/plugin") for one in hardware]
    has = {(joint.get("name"), kind, one.get("name")) for one in hardware for joint in one.findall("joint") for kind in ("command", "state") for one in joint.findall(f"{kind}_interface")}
    commanded = set()
    kinds = {name: one["type"] for name, one in controllers["controller_manager"]["ros__parameters"].items() if isinstance(one, dict)}
    for name, kind in kinds.items():
        used.append(kind)
        parameters = controllers.get(name, {}).get("ros__parameters", {})
        if not sources.has("ros2_controllers", SCHEMAS[kind]):
            yield f"{name}: this release has no {kind}"
            continue
        rules = next(iter(yaml.safe_load(sources.text("ros2_controllers", SCHEMAS[kind])).values()))
        yield from schema(parameters, rules, name)
        joints = parameters.get("joints", [parameters["joint"]] if "joint" in parameters else [])
        commands = parameters.get("command_interfaces", COMMANDS.get(kind.split("/")[0], ["position"]))
        states = parameters.get("state_interfaces", ["position", "velocity"] if "Gripper" in kind else [])
        for joint in joints:
            wanted = {(joint, "command", one) for one in commands}
            yield from (f"{name}: the hardware has no {one}" for one in (wanted | {(joint, "state", one) for one in states}) - has)
            yield from (f"{name}: {one} is commanded by two" for one in wanted & commanded)
            commanded |= wanted
        if name in simple and sorted(simple[name]["joints"]) != sorted(joints):
            yield f"{name}: MoveIt and ros2_control have other joints"
    yield from (f"{name}: nothing of ros2_control has this name" for name in simple if name not in kinds)
    for node in nodes:
        if node["executable"] == "spawner" and node["arguments"][0] not in kinds:
            yield f"{node['arguments'][0]} is started, and not configured"
    yield from (f"this release has no plugin {name}" for name in used if name not in plugins)


def main(program, folder, *urdds):
    work = pathlib.Path(tempfile.mkdtemp(prefix="urdd_moveit_"))
    sources = {release: Sources(pathlib.Path(folder), release, work / release) for release in RELEASES}
    for one in sources.values():
        one.target.mkdir()
        one.unpack("moveit2", "moveit_configs_utils")
        one.unpack("launch_param_builder", "launch_param_builder")
    wrong, read, refused = [], 0, 0
    for place, urdd in enumerate(urdds):
        for release in RELEASES:
            package = work / f"robot_{place}_{release}"
            done = subprocess.run([program, "export", "moveit", urdd, "-o", package, "--ros", release], capture_output=True, text=True)
            if done.returncode:
                refused += 1
                print(f"{urdd}, {release}: {done.stderr.splitlines()[-1]}")
                continue
            read += 1
            wrong += [f"{urdd}, {release}: {fault}" for fault in judge(package, sources[release])]
            other = RELEASES[1 - RELEASES.index(release)]
            if not list(judge(package, sources[other])):
                wrong.append(f"{urdd}: the package for {release} is one for {other} too")
    print("\n".join(wrong))
    print(f"{read} packages were read by moveit_configs_utils, {refused} refused, {len(wrong)} faults")
    return int(bool(wrong) or not read)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
