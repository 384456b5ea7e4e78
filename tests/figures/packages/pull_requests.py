"""Plays pull requests in a package of xacro files: `pull_requests.py URDD`.

Ten changes of a right package, each checked by the recipes of docs/ci.md as they stand (the hook of pre-commit, the
command of GitLab, the last step of action.yml), in a folder with git and with `urdd` and `xacro` alone on PATH. Each
has to fail, and to name the line that was changed. The package itself has to pass. Needs the packages xacro and PyYAML.
"""

from __future__ import annotations

import json
import os
import re
import shlex
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[3]

FILES = {
    "package.xml": "<package><name>arm_description</name></package>\n",
    "urdd.toml": """\
[[robot]]
path = "urdf/arm.urdf.xacro"
args = { prefix = ["left_", "right_"] }
""",
    "urdf/arm.urdf.xacro": """\
<?xml version="1.0"?>
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="prefix" default=""/>
  <xacro:property name="prefix" value="$(arg prefix)"/>
  <xacro:include filename="arm_macro.xacro"/>
  <xacro:include filename="arm.ros2_control.xacro"/>
  <xacro:property name="limits" value="${xacro.load_yaml('../config/limits.yaml')}"/>
  <link name="base">
    <inertial><mass value="4"/><inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/></inertial>
    <visual><geometry><box size="0.3 0.3 0.3"/></geometry></visual>
    <collision><geometry><box size="0.3 0.3 0.3"/></geometry></collision>
  </link>
  <xacro:bar
    name="${prefix}upper"
    parent="base"
    mass="2.5"
    velocity="2.0"
    limits="${limits['upper']}"/>
  <xacro:bar
    name="${prefix}fore"
    parent="${prefix}upper"
    mass="1.5"
    velocity="2.0"
    limits="${limits['fore']}"/>
  <xacro:control prefix="${prefix}"/>
</robot>
""",
    "urdf/arm_macro.xacro": """\
<?xml version="1.0"?>
<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="bar" params="name parent mass velocity limits">
    <link name="${name}">
      <inertial>
        <origin xyz="0 0 0.2"/>
        <mass value="${mass}"/>
        <inertia ixx="0.03" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.004"/>
      </inertial>
      <visual>
        <origin xyz="0 0 0.2"/>
        <geometry><mesh filename="package://arm_description/meshes/bar.stl"/></geometry>
      </visual>
      <collision>
        <origin xyz="0 0 0.2"/>
        <geometry><box size="0.08 0.08 0.4"/></geometry>
      </collision>
    </link>
    <joint name="${name}_joint" type="revolute">
      <origin xyz="0 0 0.4"/>
      <parent link="${parent}"/>
      <child link="${name}"/>
      <axis xyz="0 1 0"/>
      <limit lower="${limits['lower']}" upper="${limits['upper']}" effort="50" velocity="${velocity}"/>
    </joint>
  </xacro:macro>
</robot>
""",
    "urdf/arm.ros2_control.xacro": """\
<?xml version="1.0"?>
<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="control" params="prefix">
    <ros2_control name="arm" type="system">
      <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
      <joint name="${prefix}upper_joint"><command_interface name="position"/><state_interface name="position"/></joint>
      <joint name="${prefix}fore_joint"><command_interface name="position"/><state_interface name="position"/></joint>
    </ros2_control>
  </xacro:macro>
</robot>
""",
    "config/limits.yaml": """\
upper:
  lower: -1.5
  upper: 1.5
fore:
  lower: -2.0
  upper: 2.0
""",
    "config/arm.srdf.xacro": """\
<?xml version="1.0"?>
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <group name="stand"><link name="base"/></group>
</robot>
""",
}

# What is changed, the file, what stands there, what stands there then.
CHANGES = [
    ("name", "urdf/arm_macro.xacro", '<child link="${name}"/>', '<child link="${name}_link"/>'),
    (
        "argument",
        "urdf/arm.urdf.xacro",
        '<xacro:arg name="prefix" default=""/>\n  <xacro:property name="prefix" value="$(arg prefix)"/>',
        '<xacro:arg name="side" default=""/>\n  <xacro:property name="prefix" value="$(arg side)"/>',
    ),
    ("mass", "urdf/arm.urdf.xacro", 'mass="2.5"', 'mass="-2.5"'),
    ("limit", "urdf/arm_macro.xacro", "lower=\"${limits['lower']}\"", 'lower="7"'),
    ("mesh", "urdf/arm_macro.xacro", "meshes/bar.stl", "meshes/bars.stl"),
    ("macro", "urdf/arm.urdf.xacro", 'mass="1.5"', 'weight="1.5"'),
    ("YAML", "config/limits.yaml", "  lower: -2.0", "  lower: -2,0"),
    ("SRDF", "config/arm.srdf.xacro", '<link name="base"/>', '<link name="bsae"/>'),
    ("controller", "urdf/arm.ros2_control.xacro", '<joint name="${prefix}fore_joint">', '<joint name="${prefix}four_joint">'),
    ("velocity", "urdf/arm.urdf.xacro", 'velocity="2.0"', 'velocity="200.0"'),
]


def bar() -> bytes:
    """An STL of the box 0.08 x 0.08 x 0.4 about its centre."""
    corners = [(x, y, z) for x in (-0.04, 0.04) for y in (-0.04, 0.04) for z in (-0.2, 0.2)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [(a, b, c) for a, b, c, _ in faces] + [(a, c, d) for a, _, c, d in faces]
    body = b"".join(
        struct.pack("<12fH", 0, 0, 0, *(number for corner in triangle for number in corners[corner]), 0)
        for triangle in triangles
    )
    return bytes(80) + struct.pack("<I", len(triangles)) + body


def recipes() -> dict[str, list[str]]:
    """The commands that docs/ci.md and action.yml have, for a whole package."""
    page = (ROOT / "docs/ci.md").read_text(encoding="utf-8")
    blocks = [yaml.safe_load(text) for text in re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)]
    blocks = [block for block in blocks if isinstance(block, dict)]
    local = next(block for block in blocks if block.get("repos", [{}])[0].get("repo") == "local")
    hook = next(hook for hook in local["repos"][0]["hooks"] if hook["id"] == "urdd-lint")
    gitlab = next(block["urdd"] for block in blocks if "urdd" in block)
    command = next(line for line in gitlab["script"] if line.startswith("urdd lint"))
    action = next(
        step["with"]
        for block in blocks
        for job in block.get("jobs", {}).values()
        for step in job["steps"]
        if "urdd@" in step.get("uses", "")
    )
    words = ["urdd", "lint", "--format", "github", "--fail-on", action["fail-on"], *action["arguments"].split("\n")]
    return {
        "pre-commit": [*shlex.split(hook["entry"]), *hook["args"]],
        "GitLab": [word if word != "urdf/" else "." for word in shlex.split(command)],
        "action": [*words, "--", "."],
    }


def annotations(urdd: Path, environment: dict[str, str], folder: Path) -> set[tuple[str, int]]:
    """The places that annotations of the package name."""
    words = [str(urdd), "lint", "--xacro", "--fail-on", "warning", "--format", "github", "."]
    said = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True, check=False).stdout
    return {(file, int(line)) for file, line in re.findall(r"^::\w+ file=([^,:]*),line=(\d+)", said, re.MULTILINE)}


def main(words: list[str]) -> None:
    if len(words) != 1:
        sys.exit(__doc__)
    urdd = Path(words[0]).resolve()
    results, right = [], 0
    with tempfile.TemporaryDirectory() as outside:
        tools = Path(outside) / "bin"
        tools.mkdir()
        (tools / "urdd").symlink_to(urdd)
        environment = {
            "PATH": os.pathsep.join([str(tools), str(Path(sys.executable).parent), "/usr/bin", "/bin"]),
            "HOME": outside,
        }
        for change in [None, *CHANGES]:
            folder = Path(outside) / "package"
            subprocess.run(["rm", "-rf", str(folder)], check=True)
            for name, text in FILES.items():
                file = folder / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            (folder / "meshes").mkdir()
            (folder / "meshes/bar.stl").write_bytes(bar())
            subprocess.run(["git", "init", "--quiet", str(folder)], check=True)
            at = None
            if change:
                _, name, before, after = change
                text = (folder / name).read_text(encoding="utf-8")
                assert before in text, change
                at = (name, text[: text.index(before)].count("\n") + 1)
                (folder / name).write_text(text.replace(before, after, 1), encoding="utf-8")
            statuses = {}
            for recipe, command in recipes().items():
                done = subprocess.run(
                    command, cwd=folder, env=environment, capture_output=True, text=True, check=False
                )
                statuses[recipe] = done.returncode
                if change is None and done.returncode != 0:
                    sys.exit(f"the package itself: {command}: {done.stdout}{done.stderr}")
            if change is None:
                continue
            found = annotations(urdd, environment, folder)
            is_told, fails = at in found, all(status in (1, 2) for status in statuses.values())
            right += is_told and fails
            results.append({"change": change[0], "at": at, "told": is_told, "statuses": statuses, "places": sorted(found)})
    for result in results:
        print(json.dumps(result))
    print(f"{right} of {len(CHANGES)} changes fail and are told at the changed line")
    sys.exit(right != len(CHANGES))


if __name__ == "__main__":
    main(sys.argv[1:])
