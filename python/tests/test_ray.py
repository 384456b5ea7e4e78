"""A repository of robots, with Ray and two workers on this machine."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

from conftest import REPOSITORY, ROBOTS


def test_two_workers_make_every_robot(tmp_path: Path) -> None:
    sources = tmp_path / "robots"
    sources.mkdir()
    for name in ("gripper", "six_axis_arm", "planar_base_arm"):
        (sources / f"{name}.urdf").write_bytes((ROBOTS / f"{name}.urdf").read_bytes())
    (sources / "bad.urdf").write_text("<robot/>")
    script = REPOSITORY / "python" / "examples" / "many_robots_ray.py"
    environment = {**os.environ, "RAY_USAGE_STATS_ENABLED": "0", "RAY_ENABLE_UV_RUN_RUNTIME_ENV": "0"}
    found = subprocess.run(
        [sys.executable, script, "--workers", "2", tmp_path / "urdds", sources],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert found.returncode == 0, found.stderr
    told = {Path(one["robot"]).stem: one for one in map(json.loads, found.stdout.splitlines())}
    assert set(told) == {"bad", "gripper", "six_axis_arm", "planar_base_arm"}
    assert "error" in told.pop("bad")
    assert all(one["verdict"] == "pass" for one in told.values())
