"""The command line, as a user runs it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import sysconfig
import time
from pathlib import Path

import pytest

import urdd
from conftest import ROBOTS

PROGRAM = Path(sysconfig.get_path("scripts")) / ("urdd.exe" if sys.platform == "win32" else "urdd")


def run(*words: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False, timeout=120)


def test_it_is_the_program() -> None:
    assert run("--version").stdout == f"urdd {urdd.__version__}\n"
    module = subprocess.run([sys.executable, "-m", "urdd", "--version"], capture_output=True, text=True, check=True)
    assert module.stdout == f"urdd {urdd.__version__}\n"
    assert "Usage: urdd" in run("--help").stdout
    wrong = run("cheese")
    assert wrong.returncode == 2
    assert "cheese" in wrong.stderr


def test_its_status_says_what_came_of_it(urdds: Path, tmp_path: Path) -> None:
    good = run("validate", urdds / "gripper")
    assert (good.returncode, good.stderr) == (0, "")
    assert "gripper pass" in good.stdout
    (tmp_path / "bad.urdf").write_text("<robot/>")
    assert run("validate", tmp_path / "bad.urdf").returncode == 1
    assert run("validate", tmp_path).returncode == 2
    report = json.loads(run("validate", urdds / "gripper", "--format", "json").stdout)
    assert report["urdds"][0]["verdict"] == "pass"


def test_named_configurations(tmp_path: Path) -> None:
    path = tmp_path / "gripper"
    urdd.generate(ROBOTS / "gripper.urdf", path, modules=["core"])
    assert urdd.load(path).named_configurations == {}
    for words in (["open", "motor=0.5"], ["shut"]):
        made = run("configurations", "set", path, *words)
        assert (made.returncode, made.stderr) == (0, "")
    named = urdd.load(path).named_configurations
    assert {name: values.tolist() for name, values in named.items()} == {"open": [0.5], "shut": [0.0]}
    assert list(named) == ["open", "shut"]
    refused = run("configurations", "set", path, "wide", "motor=5")
    assert refused.returncode == 2
    assert "its bounds are 0 and 4" in refused.stderr


def test_generate(tmp_path: Path) -> None:
    made = run("generate", ROBOTS / "gripper.urdf", "-o", tmp_path / "gripper", "--modules", "core")
    assert made.returncode == 0, made.stderr
    assert urdd.load(tmp_path / "gripper").num_dofs == 1


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no signals")
@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_control_c_stops_it(number: signal.Signals, status: int, tmp_path: Path) -> None:
    words: list[str | Path] = ["generate", ROBOTS / "welding_arm.urdf", "-o", tmp_path / "out", "--samples", "100000"]
    with subprocess.Popen([PROGRAM, *words], stderr=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 60
        while not any(tmp_path.iterdir()) and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(number)
        _, told = process.communicate(timeout=60)
    assert process.returncode == status
    assert "stopped by a signal" in told
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no signals")
def test_control_c_stops_the_page(urdds: Path) -> None:
    words: list[str | Path] = ["view", urdds / "gripper", "--no-open"]
    with subprocess.Popen([PROGRAM, *words], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert "http://127.0.0.1:" in process.stdout.readline()
        process.send_signal(signal.SIGINT)
        try:
            process.communicate(timeout=60)
        finally:
            process.kill()
    assert process.returncode == 0


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no signals")
def test_control_c_stops_what_listens_to_no_signals() -> None:
    """Python's own handler would only record it."""
    words: list[str | Path] = ["conformance", "validator", "--", "sh", "-c", "sleep 9", "{dir}"]
    with subprocess.Popen([PROGRAM, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        time.sleep(2)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        try:
            process.communicate(timeout=60)
        finally:
            process.kill()
    assert process.returncode in (-signal.SIGINT, 130)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no /dev/full")
def test_output_that_cannot_be_written(urdds: Path) -> None:
    command = f'"{PROGRAM}" validate "{urdds / "gripper"}"'
    full = subprocess.run(f"{command} > /dev/full", shell=True, capture_output=True, text=True, check=False)
    assert full.returncode == 2
    assert "cannot be written" in full.stderr
    closed = subprocess.run(f"{command} >&-", shell=True, capture_output=True, text=True, check=False)
    assert closed.returncode == 2
    assert "it is closed" in closed.stderr
    left = subprocess.run(f"{command} | true", shell=True, capture_output=True, text=True, check=False)
    assert (left.returncode, left.stderr) == (0, "")


def test_threads_of_the_environment() -> None:
    code = "import urdd; print(urdd.num_threads())"
    environment = {**os.environ, "RAYON_NUM_THREADS": "3"}
    found = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert found.stdout == "3\n"
