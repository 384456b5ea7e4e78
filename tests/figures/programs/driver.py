"""Runs a driver: a process that reads paths and answers with one line of JSON each."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import threading
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Program:
    name: str
    letter: str
    version: str
    command: tuple[str, ...]
    by_hand: bool = False


@dataclass(frozen=True)
class Answer:
    """Verdict: loads, refuses, crashes, or hangs. `content` says which file it is about."""

    verdict: str
    why: str = ""
    said: tuple[str, ...] = ()
    facts: dict[str, str] = field(default_factory=dict)
    content: str = ""


def programs(drivers: Path, peers: Path, venvs: Path) -> dict[str, Program]:
    read = tomllib.loads((HERE / "programs.toml").read_text("utf-8"))
    places = {"drivers": drivers, "peers": peers, "venvs": venvs}
    return {
        name: Program(
            name,
            of["letter"],
            of["version"],
            tuple(part.format(**places) for part in of["command"]),
            of.get("by_hand", False),
        )
        for name, of in read.items()
    }


class Driver:
    """Starts the process again after it has ended, and ends it when a file takes too long."""

    def __init__(self, program: Program, packages: str, seconds: float) -> None:
        self.program, self.packages, self.seconds = program, packages, seconds
        self.process: subprocess.Popen[bytes] | None = None
        self.lines: queue.Queue[bytes | None] = queue.Queue()

    def __enter__(self) -> Driver:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def start(self) -> subprocess.Popen[bytes]:
        self.lines = queue.Queue()
        process = subprocess.Popen(
            self.program.command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=os.environ | {"PACKAGES": self.packages, "PYTHONUNBUFFERED": "1"},
        )
        threading.Thread(target=self.listen, args=(process, self.lines), daemon=True).start()
        self.process = process
        return process

    @staticmethod
    def listen(process: subprocess.Popen[bytes], lines: queue.Queue[bytes | None]) -> None:
        assert process.stdout
        for line in process.stdout:
            lines.put(line)
        lines.put(None)

    def stop(self) -> None:
        if self.process:
            self.process.kill()
            self.process.wait()
            self.process = None

    def ask(self, path: Path) -> Answer:
        process = self.process if self.process and self.process.poll() is None else self.start()
        assert process.stdin
        try:
            process.stdin.write(f"{path}\n".encode())
            process.stdin.flush()
            line = self.lines.get(timeout=self.seconds)
        except queue.Empty:
            self.stop()
            return Answer("hangs", f"no answer in {self.seconds:.0f} s")
        except BrokenPipeError:
            line = None
        if line is None:
            status = process.wait()
            self.stop()
            return Answer("crashes", f"exit status {status}")
        read = json.loads(line.decode("utf-8", "replace"))
        facts = {key: str(value) for key, value in read.get("facts", {}).items()}
        return Answer(read["verdict"], read.get("why", ""), tuple(read.get("said", ())), facts)
