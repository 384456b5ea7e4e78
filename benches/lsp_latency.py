"""How long `urdd lsp` takes from a key stroke to its findings, without the delay that it waits for more key strokes.

    python3 benches/lsp_latency.py target/release/urdd

Prints a table: lines of the URDF, bytes, milliseconds (median and longest of the key strokes), and those of a completion
and of a hover right after one. Nothing is installed.
"""

import json
import statistics
import subprocess
import sys
import time

KEY_STROKES = 30
LINK = """  <link name="link_{i}">
    <inertial>
      <origin xyz="0 0 0.05" rpy="0 0 0"/>
      <mass value="1.{i}"/>
      <inertia ixx="0.003" ixy="0" ixz="0" iyy="0.003" iyz="0" izz="0.003"/>
    </inertial>
    <collision>
      <origin xyz="0 0 0.05" rpy="0 0 0"/>
      <geometry><box size="0.1 0.1 0.1"/></geometry>
    </collision>
    <visual>
      <geometry><mesh filename="meshes/link_{k}.stl"/></geometry>
    </visual>
  </link>
  <joint name="joint_{i}" type="revolute">
    <origin xyz="0 0 0.1" rpy="0 0 0"/>
    <parent link="{parent}"/>
    <child link="link_{i}"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
  </joint>
"""


def robot(lines: int) -> str:
    """A chain with branches: ten links one after the other, again and again."""
    count = lines // LINK.count("\n")
    parts = ['<robot name="bench">\n  <link name="base"/>\n']
    for i in range(count):
        parent = "base" if i % 10 == 0 else f"link_{i - 1}"
        parts.append(LINK.format(i=i, k=i % 20, parent=parent))
    parts.append("</robot>\n")
    return "".join(parts)


class Server:
    def __init__(self, program: str) -> None:
        self.process = subprocess.Popen([program, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.number = 0
        self.ask("initialize", {"processId": None, "capabilities": {}, "initializationOptions": {"debounce": 0}})
        self.notify("initialized", {})

    def send(self, message: dict) -> None:
        text = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(text) + text)
        self.process.stdin.flush()

    def notify(self, method: str, params: dict) -> None:
        self.send({"method": method, "params": params})

    def receive(self) -> dict:
        length = 0
        while line := self.process.stdout.readline().strip():
            if line.startswith(b"Content-Length: "):
                length = int(line.split()[1])
        return json.loads(self.process.stdout.read(length))

    def ask(self, method: str, params: dict) -> object:
        self.number += 1
        self.send({"id": self.number, "method": method, "params": params})
        while (message := self.receive()).get("id") != self.number:
            pass
        return message["result"]

    def findings(self, version: int) -> list:
        while True:
            params = self.receive().get("params", {})
            if params.get("version") == version and "diagnostics" in params:
                return params["diagnostics"]


def measure(program: str, lines: int) -> None:
    server = Server(program)
    uri = f"file:///tmp/urdd_bench/bench_{lines}.urdf"
    text = robot(lines)
    item = {"uri": uri, "languageId": "urdf", "version": 1, "text": text}
    server.notify("textDocument/didOpen", {"textDocument": item})
    server.findings(1)
    rows = text.split("\n")
    middle = next(i for i in range(len(rows) // 2, len(rows)) if "<mass value=" in rows[i])
    column = rows[middle].index('value="') + 7
    at = {"line": middle, "character": column}
    times: dict[str, list[float]] = {"findings": [], "completion": [], "hover": []}
    for stroke in range(KEY_STROKES):
        version = stroke + 2
        change = {"range": {"start": at, "end": at}, "text": "1"}
        if stroke % 2:
            change = {"range": {"start": at, "end": {"line": middle, "character": column + 1}}, "text": ""}
        document = {"uri": uri, "version": version}
        begun = time.perf_counter()
        server.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
        server.findings(version)
        times["findings"].append(time.perf_counter() - begun)
        for method in ("completion", "hover"):
            begun = time.perf_counter()
            link = {"line": middle - 3, "character": 4} if method == "completion" else {"line": 1, "character": 16}
            server.ask(f"textDocument/{method}", {"textDocument": {"uri": uri}, "position": link})
            times[method].append(time.perf_counter() - begun)
    server.ask("shutdown", {})
    server.notify("exit", {})
    server.process.wait()
    cells = [f"{statistics.median(t) * 1e3:.1f} ({max(t) * 1e3:.1f})" for t in times.values()]
    print(f"| {len(rows)} | {len(text)} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    print("| lines | bytes | findings, ms (longest) | completion, ms | hover, ms |\n|---|---|---|---|---|")
    for lines in (200, 2_000, 20_000):
        measure(sys.argv[1], lines)
