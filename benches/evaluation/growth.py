"""How time and memory grow with large inputs of one kind.

    python benches/evaluation/growth.py [KIND ...] [--urdd PROGRAM] [--commands lint,generate,import,validate]

Each kind is an input that somebody else could write, large in one or two respects; the second is twice the first, and the
third twice the second. The exponent is that of the last two: 1 for what grows as its input, 2 for what grows
with its square. Time is processor time, user; memory is the largest resident set. Short runs are scaled up first, until
the smallest takes a while: below it, the program's start counts. What ends with a refusal is shown as such.
"""

from __future__ import annotations

import argparse
import math
import os
import struct
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from robots import program, version_of
from results import write

Files = dict[str, str | bytes]
MASS = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
LONG = 40  # bytes of a long name for each element


def urdf(inside: str) -> Files:
    return {"r.urdf": f'<robot name="r">{inside}</robot>'}


def joint(child: int | str, parent: int | str, inside: str = "", kind: str = "fixed") -> str:
    return f'<joint name="j{child}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>'


def links(n: int, inside: str = "") -> str:
    return "".join(f'<link name="{i}">{inside}</link>' for i in range(n))


def tree(n: int, above: Callable[[int], int], kind: str = "fixed", inside: str = "", link: str = "") -> Files:
    joints = "".join(joint(i, above(i), inside, kind) for i in range(1, n))
    return urdf(links(n, link) + joints)


def shape(kind: str) -> str:
    return f"<geometry>{kind}</geometry>"


def stl(triangles: int, seed: int = 0) -> bytes:
    def corner(i: int) -> list[float]:
        a, b = i * 0.61803 + seed, i * 0.41421 + seed
        return [math.cos(a) * math.sin(b), math.sin(a) * math.sin(b), math.cos(b)]

    faces = b"".join(struct.pack("<12fH", 0, 0, 0, *corner(3 * i), *corner(3 * i + 1), *corner(3 * i + 2), 0) for i in range(triangles))
    return bytes(80) + struct.pack("<I", triangles) + faces


def mujoco(body: str, before: str = "", after: str = "") -> Files:
    return {"r.xml": f"<mujoco>{before}<worldbody>{body}</worldbody>{after}</mujoco>"}


def sdf(inside: str) -> Files:
    return {"r.sdf": f'<sdf version="1.10"><model name="m">{inside}</model></sdf>'}


def long(n: int) -> str:
    return "x" * (n * LONG)


LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
CYLINDER = shape('<cylinder radius="1" length="1"/>')
BOX = shape('<box size="1 1 1"/>')
ATTRIBUTES = " ".join(f"a{i}='1'" for i in range(100))
BACKSLASH = "\\"
BALL = shape('<sphere radius="1"/>')
VISUAL_MESH = "<visual>" + shape('<mesh filename="{}"{}/>') + "</visual>"

#: A large URDF: of a size of n. All are given to `lint` and `validate`; those that are robots to `generate --modules core`.
URDFS: dict[str, Callable[[int], Files]] = {
    "links in a line": lambda n: tree(n, lambda i: i - 1, "revolute", LIMIT),
    "links in a star": lambda n: tree(n, lambda _: 0, "revolute", LIMIT),
    "links in a comb": lambda n: tree(n, lambda i: i - 1 if i % 2 else max(i - 2, 0), "continuous"),
    "fixed links with masses": lambda n: tree(n, lambda i: i - 1, link=MASS + "<visual>" + BALL + "</visual>"),
    "links without joints": lambda n: urdf(links(n)),
    "a link for many joints": lambda n: urdf(links(2) + "".join(joint(1, 0).replace('"j1"', f'"j{i}"') for i in range(n))),
    "joints to unknown links": lambda n: urdf(links(n) + "".join(joint(f"{i}x", f"x{i}") for i in range(n))),
    "links of one name": lambda n: urdf('<link name="a"/>' * n),
    "`world` at the end of a line": lambda n: {
        "r.urdf": tree(n, lambda i: i - 1)["r.urdf"].replace(f'"{n - 1}"', '"world"')  # type: ignore[union-attr]
    },
    "visuals": lambda n: urdf(f'<link name="a">{"<visual/>" * n}</link>'),
    "visuals with a long name of their link": lambda n: urdf(f'<link name="{long(n)}">{"<visual/>" * n}</link>'),
    "collisions with a long name": lambda n: urdf(f'<link name="{long(n)}">{"<collision/>" * n}</link>'),
    "inertials with a long name": lambda n: urdf(f'<link name="{long(n)}">{"<inertial/>" * n}</link>'),
    "limits with a long name of their joint": lambda n: urdf(
        links(2) + f'<joint name="{long(n)}" type="revolute"><parent link="0"/><child link="1"/>{"<limit/>" * n}</joint>'
    ),
    "mimics of a long name": lambda n: urdf(
        links(n + 1)
        + f'<joint name="{long(n)}" type="revolute"><parent link="0"/><child link="{n}"/>{LIMIT}</joint>'
        + "".join(joint(i, 0, f'<mimic joint="{"y" * 9}"/>' + LIMIT, "revolute") for i in range(1, n))
    ),
    "unknown elements with a long name around": lambda n: urdf(f'<link name="{long(n)}">{"<vsual/>" * n}</link>'),
    "attributes with a long name around": lambda n: urdf(f'<link name="{long(n)}">' + '<visual nmae="a" Name="b"/>' * n + "</link>"),
    "meshes in a long element": lambda n: urdf(f'<link name="a"/><{long(n)}>' + '<mesh filename="/x"/>' * n + f"</{long(n)}>"),
    "a long namespace": lambda n: {"r.urdf": f'<robot name="r" xmlns="{long(n)}"><link name="a">{"<visual/>" * n}</link></robot>'},
    "a long prefix": lambda n: {"r.urdf": f'<robot name="r" xmlns:{long(n)}="u"><link name="a"><{long(n)}:a/>{"<visual/>" * n}</link></robot>'},
    "a long name of the robot": lambda n: {"r.urdf": f'<robot name="{long(n)}"><link name="a">{"<visual/>" * n}</link></robot>'},
    "a long folder of meshes": lambda n: urdf(
        f'<mujoco><compiler meshdir="{long(n)}" strippath="false"/></mujoco><link name="a">'
        + "".join(VISUAL_MESH.format(f"{i}.stl", "") for i in range(n)) + "</link>"
    ),
    "one material with a long colour": lambda n: urdf(
        f'<material name="m"><color rgba="{long(n)}"/></material><link name="a">'
        + f'<visual>{BALL}<material name="m"><color rgba="1 0 0 1"/></material></visual>' * n + "</link>"
    ),
    "spheres": lambda n: urdf(f'<link name="a">{MASS}{f"<visual>{BALL}</visual>" * n}</link>'),
    "spheres of many sizes": lambda n: urdf(
        f'<link name="a">{MASS}' + "".join(f'<visual><origin xyz="{i} {i * i % 97} 0"/><geometry><sphere radius="{i + 1}"/></geometry></visual>' for i in range(n)) + "</link>"
    ),
    "collision cylinders": lambda n: urdf(f'<link name="a">{MASS}' + f"<collision>{CYLINDER}</collision>" * n + "</link>"),
    "collision boxes": lambda n: urdf(f'<link name="a">{MASS}' + f"<collision>{BOX}</collision>" * n + "</link>"),
    "links with spheres, fixed": lambda n: tree(n, lambda _: 0, link=MASS + f"<visual>{BALL}</visual><collision>{BALL}</collision>"),
    "links with spheres, moving": lambda n: tree(n, lambda _: 0, "continuous", link=MASS + f"<visual>{BALL}</visual><collision>{BALL}</collision>"),
    "materials": lambda n: urdf('<link name="a"/>' + "".join(f'<material name="{i}"><color rgba="{i % 9} 0 0 1"/></material>' for i in range(n))),
    "materials of one name": lambda n: urdf('<link name="a"/>' + '<material name="m"><color rgba="1 0 0 1"/></material>' * n),
    "unknown materials": lambda n: urdf('<link name="a">' + "".join(f'<visual>{BALL}<material name="m{i}"/></visual>' for i in range(n)) + "</link>"),
    "a chain of mimics": lambda n: tree(n, lambda i: i - 1, "continuous", '<mimic joint="j1"/>'),
    "mimics of mimics": lambda n: urdf(links(n + 1) + "".join(joint(i, i - 1, f'<mimic joint="j{i + 1}"/>' + LIMIT, "revolute") for i in range(1, n + 1))),
    "unknown mimics": lambda n: tree(n, lambda i: i - 1, "continuous", '<mimic joint="x"/>'),
    "comments": lambda n: urdf('<link name="a"/>' + "<!--x-->" * n),
    "comments that allow": lambda n: urdf('<link name="a">' + "<!-- urdd: allow LNT001 x -->\n<visual/>\n" * n + "</link>"),
    "comments that allow one element": lambda n: urdf("<!-- urdd: allow LNT001 x -->\n" * n + f'<link name="a">{"<visual/>" * (n // 4)}</link>'),
    "attributes": lambda n: urdf('<link name="a"/>' + ("<link " + " ".join(f'a{i}="1"' for i in range(200)) + "/>") * n),
    "misspelt attributes": lambda n: urdf('<link name="a">' + '<visual naem="1"><origin xzy="0 0 0"/></visual>' * n + "</link>"),
    "misspelt elements": lambda n: urdf(links(n, "<inertail/><colision/>")),
    "colons in an attribute": lambda n: urdf(f'<link name="a"/><foo bar="{"a:" * n}"/>'),
    "equal elements": lambda n: urdf(f'<link name="a"><visual><geometry>{"<box/>" * n}</geometry>{"<geometry/>" * n}</visual></link>'),
    "transmissions": lambda n: urdf(links(2) + joint(1, 0) + "".join(f'<transmission name="t{i}"><joint name="k{i}"/><actuator name="a{i}"/></transmission>' for i in range(n))),
    "transmissions of as many joints": lambda n: urdf(
        tree(n, lambda _: 0)["r.urdf"][16:-8] + "".join(f'<transmission name="t{i}"><joint name="k{i}"/></transmission>' for i in range(n))  # type: ignore[operator]
    ),
    "joints of ros2_control": lambda n: urdf(links(2) + joint(1, 0) + '<ros2_control name="c" type="system">' + "".join(f'<joint name="k{i}"/>' for i in range(n)) + "</ros2_control>"),
    "gazebo references": lambda n: urdf('<link name="l"/>' + "".join(f'<gazebo reference="x{i}"><mu1>1</mu1></gazebo>' for i in range(n))),
    "gazebo references to one link": lambda n: urdf('<link name="l"/>' + '<gazebo reference="l"><mu1>1</mu1></gazebo>' * n),
    "gazebo without references": lambda n: urdf('<link name="l"/>' + '<gazebo><plugin name="p" filename="f"/></gazebo>' * n),
    "one mesh by many spellings": lambda n: {
        **urdf('<link name="a">' + "".join(VISUAL_MESH.format("./" * (i % 40) + "." + "/" * (i // 40 + 1) + "m.stl", "") for i in range(n)) + "</link>"),
        "m.stl": stl(20),
    },
    "one mesh by many scales": lambda n: {
        **urdf(f'<link name="a">{MASS}' + "".join(VISUAL_MESH.format("m.stl", f' scale="1 1 {i + 1}"') for i in range(n)) + "</link>"),
        "m.stl": stl(20),
    },
    "many meshes": lambda n: {
        **urdf(f'<link name="a">{MASS}' + "".join(VISUAL_MESH.format(f"{i}.stl", "") for i in range(n)) + "</link>"),
        **{f"{i}.stl": stl(20, i) for i in range(n)},
    },
    "missing meshes": lambda n: urdf('<link name="a">' + "".join(VISUAL_MESH.format(f"package://p{i}/{i}.stl", "") for i in range(n)) + "</link>"),
    "missing textures": lambda n: urdf('<link name="a"/>' + "".join(f'<material name="{i}"><texture filename="{i}.png"/></material>' for i in range(n))),
    "backslashes": lambda n: urdf('<link name="a">' + "".join(VISUAL_MESH.format(f"m{BACKSLASH}{i}.stl", "") for i in range(n)) + "</link>"),
    "pairs of an SRDF": lambda n: {
        **tree(n // 20 + 2, lambda _: 0),
        "r.srdf": '<robot name="r">' + "".join(f'<disable_collisions link1="{i % 7}" link2="l{i}"/>' for i in range(n)) + "</robot>",
    },
    "groups of an SRDF": lambda n: {
        **urdf('<link name="a"/>'),
        "r.srdf": '<robot name="r">' + "".join(f'<group name="g{i}"><group name="h{i}"/></group>' for i in range(n)) + "</robot>",
    },
    "one long line of numbers": lambda n: urdf(f'<link name="a"><visual><origin xyz="{"0 " * n}"/></visual></link>'),
    "text that is no XML": lambda n: urdf("<link name='a'>" + "<visual>" * n),
}

BODY = "<body><geom size='1'/>"
#: A large MJCF or SDF, for `import` and `lint`.
OTHERS: dict[str, Callable[[int], Files]] = {
    "MJCF: bodies": lambda n: mujoco("".join(f"<body name='b{i}'><joint/><geom size='1'/></body>" for i in range(n)).join([BODY, "</body>"])),
    "MJCF: replicas": lambda n: mujoco(f"{BODY}<replicate count='{n}' offset='1 0 0'><body name='b'><geom size='1'/></body></replicate></body>"),
    "MJCF: replicas of a long name": lambda n: mujoco(f"{BODY}<replicate count='{n}' offset='1 0 0'><body name='{long(n)}'/></replicate></body>"),
    "MJCF: replicas and keys": lambda n: mujoco(f"{BODY}<replicate count='{n}' offset='1 0 0'><body><joint/><geom size='1' mass='1'/></body></replicate></body>", "", "<keyframe>" + "<key/>" * n + "</keyframe>"),
    "MJCF: replicas and excludes": lambda n: mujoco(f"{BODY}<replicate count='{n}' offset='1 0 0'><body name='b'/></replicate></body>", "", "<contact>" + "<exclude body1='b' body2='b'/>" * n + "</contact>"),
    "MJCF: defaults and attributes": lambda n: mujoco(
        BODY + "<geom class='c29' size='1'/>" * n + "</body>",
        "<default>" + "".join(f"<default class='c{i}'><geom {ATTRIBUTES}/>" for i in range(30)) + "</default>" * 31,
    ),
    "MJCF: includes": lambda n: {
        **mujoco(BODY + "</body>", "", "".join(f"<include file='{i}.xml'/>" for i in range(n))),
        **{f"{i}.xml": "<mujoco/>" for i in range(n)},
    },
    "MJCF: one include by many names": lambda n: {
        **mujoco(BODY + "</body>", "", "".join(f"<include file='.{'/' * (i % 40 + 1)}{'./' * (i // 40)}b.xml'/>" for i in range(n))),
        "b.xml": f"<mujoco><!--{'x' * 100 * n}--></mujoco>",
    },
    "MJCF: sites": lambda n: mujoco(BODY + "".join(f"<site name='s{i}'/>" for i in range(n)) + "</body>"),
    "MJCF: nameless sites": lambda n: mujoco(f"<body name='{long(n)}'><geom size='1'/>{'<site/>' * n}</body>"),
    "MJCF: nameless bodies": lambda n: mujoco(f"<body name='{long(n)}'><geom size='1'/>{'<body/>' * n}</body>"),
    "MJCF: geoms": lambda n: mujoco("<body>" + "<geom size='1'/>" * n + "</body>"),
    "MJCF: assets of one mesh": lambda n: {
        **mujoco(
            "<body>" + "".join(f"<geom type='mesh' mesh='m{i}'/>" for i in range(n)) + "</body>",
            "<asset>" + "".join(f"<mesh name='m{i}' file='a.stl' scale='1 1 {i + 1}' refquat='1 2 3 4'/>" for i in range(n)) + "</asset>",
        ),
        "a.stl": stl(n),
    },
    "SDF: links": lambda n: sdf("".join(f"<link name='{i}'/>" for i in range(n)) + "".join(f"<joint name='j{i}' type='fixed'><parent>{i - 1}</parent><child>{i}</child></joint>" for i in range(1, n))),
    "SDF: a long prefix": lambda n: sdf(f"<link name='r'/><model name='{long(n)}'>" + "".join(f"<link name='{i}'/>" for i in range(n)) + "</model>"),
    "SDF: sensors": lambda n: sdf(f"<link name='{long(n)}'>" + "<sensor name='x' type='camera'/>" * n + "</link>"),
    "SDF: nested models": lambda n: {"r.sdf": '<sdf version="1.10">' + f"<model name='{long(n // 60)}'><link name='b'/>" * 60 + "".join(f"<link name='a{i}'/>" for i in range(n)) + "</model>" * 60 + "</sdf>"},
    "SDF: submeshes": lambda n: {
        **sdf("<link name='l'>" + "".join(f"<visual name='{i}'><geometry><mesh><uri>a.obj</uri><submesh><name>s{i}</name></submesh></mesh></geometry></visual>" for i in range(n)) + "</link>"),
        "a.obj": "\n".join(f"o s{i}\nv {i} 0 0\nv {i} 1 0\nv {i} 0 1\nf {3 * i + 1} {3 * i + 2} {3 * i + 3}" for i in range(n)),
    },
    "SDF: includes": lambda n: {
        **sdf("<link name='l'/>" + "".join(f"<include><uri>s.sdf</uri><name>i{i}</name></include>" for i in range(n))),
        "s.sdf": f"<sdf version='1.10'><model name='s'><link name='k'/>{'<!--x-->' * n}</model></sdf>",
    },
    "SDF: visuals": lambda n: sdf("<link name='l'>" + "".join(f"<visual name='{i}'><geometry><box><size>1 1 1</size></box></geometry></visual>" for i in range(n)) + "</link>"),
}

#: What is asked of a file.
COMMANDS = {
    "lint": ["lint", "FILE", "--format", "json"],
    "validate": ["validate", "FILE", "--format", "json"],
    "generate": ["generate", "--modules", "core", "FILE", "-o", "out"],
    "import": ["import", "FILE", "-o", "out"],
}
#: The largest input, bytes, and the longest run, seconds.
LARGEST, LONGEST = 4_000_000, 60.0


class Run(NamedTuple):
    size: int
    seconds: float
    megabytes: float
    status: int


def run(urdd: Path, files: Files, command: list[str]) -> Run:
    with tempfile.TemporaryDirectory() as scratch:
        for name, content in files.items():
            (Path(scratch) / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        words = [next(iter(files)) if word == "FILE" else word for word in command]
        child = subprocess.Popen([urdd, *words], cwd=scratch, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + LONGEST * 3
        while not (done := os.wait4(child.pid, os.WNOHANG))[0]:
            time.sleep(0.01)
            if time.monotonic() > end:
                child.kill()
        child.returncode = os.waitstatus_to_exitcode(done[1])
        size = sum(len(content) for content in files.values())
        return Run(size, done[2].ru_utime, done[2].ru_maxrss / 1e3, child.returncode)


def measure(urdd: Path, make: Callable[[int], Files], command: list[str], least: float) -> list[Run]:
    """Three runs, each of twice the input of the one before; the first takes a while."""
    n = 250
    first = run(urdd, make(n), command)
    while first.seconds < least and first.size < LARGEST / 8:
        n *= 2
        first = run(urdd, make(n), command)
    runs = [first]
    for times in (2, 4):
        if runs[-1].seconds > LONGEST:
            break
        runs.append(run(urdd, make(times * n), command))
    return runs


def exponent(runs: list[Run], value: Callable[[Run], float]) -> float:
    """Of the last two runs: by their sizes where the last is more than twice as large, as with names that grow too."""
    if len(runs) < 2:
        return math.inf
    (before, last) = runs[-2:]
    return math.log(max(value(last), 1e-9) / max(value(before), 1e-9)) / math.log(max(2.0, last.size / before.size))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", help="of these alone: parts of their names")
    parser.add_argument("--urdd", type=Path, help="the program; otherwise it is built")
    parser.add_argument("--commands", default="lint,generate,validate,import")
    parser.add_argument("--least", type=float, default=0.3, help="seconds that the smallest input takes")
    parser.add_argument("--write", action="store_true", help="writes benches/results/growth.json")
    given = parser.parse_args()
    urdd = program(given.urdd)
    wanted = given.commands.split(",")
    rows = []
    print(f"{'kind':44} {'command':9} {'MB':>6} {'s':>7} {'MB mem':>7} {'×':>6} {'t^':>5} {'m^':>5}  status")
    for kinds, commands in ((URDFS, ["lint", "validate", "generate"]), (OTHERS, ["lint", "import"])):
        for name, make in kinds.items():
            if given.kinds and not any(part in name for part in given.kinds):
                continue
            for command in (one for one in commands if one in wanted):
                runs = measure(urdd, make, COMMANDS[command], given.least)
                last = runs[-1]
                time_, memory = exponent(runs, lambda one: one.seconds), exponent(runs, lambda one: one.megabytes)
                status = "refused" if last.status == 2 or (last.status and command in ("generate", "import")) else str(last.status)
                above = " <<<" if time_ > 1.2 and last.seconds > 1 or memory > 1.2 or last.status < 0 else ""
                ratio = last.megabytes * 1e6 / last.size
                print(f"{name:44} {command:9} {last.size / 1e6:6.2f} {last.seconds:7.2f} {last.megabytes:7.0f} {ratio:6.0f} {time_:5.2f} {memory:5.2f}  {status}{above}", flush=True)
                rows.append([name, command, f"{last.size / 1e6:.2f}", f"{last.seconds:.2f}", f"{last.megabytes:.0f}", f"{time_:.2f}", f"{memory:.2f}", status])
    if given.write:
        table = {"columns": ["kind", "command", "input, MB", "s", "memory, MB", "exponent of time", "of memory", "status"], "rows": rows}
        worst = max((float(row[5]) for row in rows if row[7] != "refused"), default=0.0)
        write("growth", {"all": table, "worst": f"{worst:.2f}"}, version_of(urdd, given.urdd is not None), how="user time, largest resident set")  # type: ignore[dict-item]


if __name__ == "__main__":
    main()
