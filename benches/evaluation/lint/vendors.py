#!/usr/bin/env python3
"""What `urdd lint . --xacro` says in ROS 2 repositories of vendors, as their users have them: whole, without ROS.

    python3 benches/evaluation/lint/vendors.py target/release/urdd FOLDER

FOLDER has a checkout of each of REPOSITORIES, by its name without the owner, and xacro is on the PATH. Writes
benches/results/lint_vendors.json. Files that a checkout lacks (large files that were not fetched) make LNT029, LNT034 and
LNT035, which are no fault of a vendor: they are counted apart.
"""

from __future__ import annotations

import collections
import json
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import results  # noqa: E402

REPOSITORIES = [
    "UniversalRobots/Universal_Robots_ROS2_Description", "frankarobotics/franka_description", "xArm-Developer/xarm_ros2",
    "ROBOTIS-GIT/open_manipulator", "ROBOTIS-GIT/turtlebot3", "clearpathrobotics/clearpath_common", "turtlebot/turtlebot4",
    "iRobotEducation/create3_sim", "ros-controls/ros2_control_demos", "doosan-robotics/doosan-robot2", "husarion/husarion_ugv_ros",
    "kroshu/kuka_robot_descriptions", "lbr-stack/lbr_fri_ros2_stack", "Kinovarobotics/ros2_kortex",
    "PickNikRobotics/ros2_robotiq_gripper", "pal-robotics/tiago_robot",
]  # fmt: skip
OF_CHECKOUT = {"LNT029", "LNT034", "LNT035"}
COLUMNS = [
    "repository", "robots", "parts of robots", "need arguments", "not expanded", "errors, warnings, infos", "of the checkout"
]  # fmt: skip


def row(urdd: str, name: str, folder: Path) -> tuple[list[str], collections.Counter[str]]:
    done = subprocess.run([urdd, "lint", ".", "--xacro", "--format", "json"], cwd=folder, capture_output=True, text=True)
    parts = sum(int(count) for count in re.findall(r"^urdd: (\d+) files? (?:defines?|makes?) ", done.stderr, re.MULTILINE))
    report = json.loads(done.stdout) if done.stdout else {"urdds": []}
    codes: collections.Counter[str] = collections.Counter()
    severities: collections.Counter[str] = collections.Counter()
    of_checkout = robots = needing = 0
    for one in report["urdds"]:
        own = {finding["code"] for finding in one["findings"]}
        needing += "LNT065" in own
        robots += one["verdict"] != "unreadable" and "LNT065" not in own
        for finding in one["findings"]:
            count = len(finding["places"]) or 1
            codes[finding["code"]] += count
            if finding["code"] in OF_CHECKOUT:
                of_checkout += count
            elif finding["code"] != "LNT065":
                severities[finding["severity"]] += count
    unreadable = sum(one["verdict"] == "unreadable" for one in report["urdds"])
    found = ", ".join(str(severities[severity]) for severity in ("error", "warning", "info"))
    cells = [robots, parts, needing, unreadable, found, of_checkout]
    return [name, *map(str, cells)], codes


def main() -> None:
    urdd, folder = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
    rows, codes = [], collections.Counter[str]()
    for name in REPOSITORIES:
        cells, own = row(urdd, name, folder / name.partition("/")[2])
        print(*cells, dict(own), sep=" | ", flush=True)
        rows.append(cells)
        codes += own
    by_code = [[code, f"{count:,}"] for code, count in sorted(codes.items())]
    version = subprocess.run([urdd, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    results.write(
        "lint_vendors",
        {"repositories": {"columns": COLUMNS, "rows": rows}, "codes": {"columns": ["rule", "findings"], "rows": by_code}},
        version,
        how=f"the newest commits of {results.datetime.date.today().isoformat()}",
    )


if __name__ == "__main__":
    main()
