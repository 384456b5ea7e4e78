"""Checks by spheres beside VAMP's: the same spheres, pairs, configurations, motions and obstacles, one thread, one run.

    git clone https://github.com/KavrakiLab/vamp /tmp/vamp && apt-get install clang libeigen3-dev
    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install numpy
    cargo build --release --bench spheres
    /tmp/peers/bin/python benches/spheres_vamp.py /tmp/vamp target/release/urdd target/release/deps/spheres-... [panda
    ur5 fetch]

For each robot, a URDD is made of VAMP's spherized URDF, whose spheres and pairs (of the generated header) go to both
programs. 10,000 configurations are asked one after another, and 5,000 motions of 0.5 rad with 32 configurations for
each radian: alone, among 20 boxes, and among 10,000 and 100,000 points on the faces of the boxes. Microseconds, the
least of nine rounds. The answers of both must be the same but for those that are within 1e-5 m of a contact; among
points, VAMP may miss contacts, as its tree misses contacts of spheres that are larger than its robot's largest. Baxter
is left out: its two arms have the same spheres, so that its header does not tell which is which. Motions are checked in
as many configurations, at other places of the way.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import numpy

HERE = pathlib.Path(__file__).parent
SORT = """#pragma once
#include <algorithm>
template <class A, class B, class C> void pdqsort(A a, B b, C c) { std::sort(a, b, c); }
template <class A, class B, class C> void pdqsort_branchless(A a, B b, C c) { std::sort(a, b, c); }
template <class A, class B> void pdqsort_branchless(A a, B b) { std::sort(a, b); }
"""


def main() -> None:
    vamp, program, ours, *robots = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "pdqsort.h").write_text(SORT)
        built = folder / "vamp"
        flags = ["-std=c++17", "-O3", "-mavx2", "-DNDEBUG"]
        flags += [f"-I{folder}", f"-I{vamp}/src/impl", "-I/usr/include/eigen3"]
        subprocess.run(["clang++", *flags, str(HERE / "spheres_vamp.cpp"), "-o", str(built)], check=True)
        generator = numpy.random.default_rng(1)
        boxes = make_boxes(generator)
        put(folder / "boxes.bin", boxes)
        for count in (10_000, 100_000):
            put(folder / f"points{count}.bin", make_points(generator, boxes, count))
        for robot in robots or ["panda", "ur5", "fetch"]:
            prepare(folder, pathlib.Path(vamp), program, robot, generator)
            for kind in ("self", "boxes", "points10000", "points100000"):
                subprocess.run([str(built), str(folder), robot, kind], check=True)
                subprocess.run([ours, str(folder), robot, kind], check=True)


def put(path: pathlib.Path, values: numpy.ndarray) -> None:
    """Numbers that are the same in 32 bits."""
    values.astype(numpy.float32).astype(float).tofile(path)


def prepare(
    folder: pathlib.Path, vamp: pathlib.Path, program: str, robot: str, generator: numpy.random.Generator
) -> None:
    urdf = vamp / "resources" / robot / f"{robot}_spherized.urdf"
    text = re.sub(r"<visual>.*?</visual>", "", urdf.read_text(), flags=re.S)
    (folder / f"{robot}.urdf").write_text(text)
    target = folder / robot
    modules = ["--modules", "chain,dof,bounds,urdf"]
    subprocess.run([program, "generate", str(folder / f"{robot}.urdf"), "-o", str(target), *modules], check=True)
    links = []
    for link in ElementTree.fromstring(text).findall("link"):
        spheres = []
        for one in link.findall("collision"):
            sphere = one.find("geometry/sphere")
            if sphere is not None:
                origin = one.find("origin")
                at = "0 0 0" if origin is None else origin.get("xyz", "0 0 0")
                spheres.append([*map(float, at.split()), float(sphere.get("radius", "0"))])
        if spheres:
            links.append((link.get("name"), spheres))
    header = (vamp / "src/impl/vamp/robots" / f"{robot}.hh").read_text()
    code = header[header.index("inline static bool fkcc(") : header.index("inline static bool fkcc_attach(")]
    links = in_order(links, code)
    of_sphere = [k for k, (_, spheres) in enumerate(links) for _ in spheres]
    pairs = set()
    for found in re.finditer(r"sphere_sphere_self_collision<decltype\(x\[0\]\)>\((.*?)\)\)", code, re.S):
        numbers = [int(number) // 4 for number in re.findall(r"y\[(\d+)\]", found.group(1))]
        if len(numbers) == 8 and max(numbers) < len(of_sphere):
            pairs.add(tuple(sorted((of_sphere[numbers[0]], of_sphere[numbers[4]]))))
    joints = re.findall(r'"(.*?)"', re.search(r"joint_names = \{(.*?)\};", header, re.S).group(1))
    data = {"links": links, "pairs": sorted(pairs), "joints": joints}
    (folder / f"{robot}.json").write_text(json.dumps(data))

    def row(name: str) -> numpy.ndarray:
        found = re.search(name + r"\{(.*?)\};", header, re.S)
        return numpy.array([float(value) for value in found.group(1).split(",")])

    size, least = row("s_m"), row("s_a")
    put(folder / f"{robot}_q.bin", least + size * generator.random((10_000, len(size))))
    starts = least + size * generator.random((5_000, len(size)))
    way = generator.normal(size=starts.shape)
    ends = starts + 0.5 * way / numpy.linalg.norm(way, axis=1)[:, None]
    put(folder / f"{robot}_e.bin", numpy.stack([starts, ends], 1))


def in_order(links: list, code: str) -> list:
    """The links in the order of the header, which has the radii of all spheres; of links with the same, by name."""
    found = re.finditer(r"y\[(\d+)\] = (-?[\d.e+-]+);", code)
    radii = {int(place) // 4: float(value) for place, value in (one.groups() for one in found) if int(place) % 4 == 3}

    def rest(first: int, left: list) -> list | None:
        if not left:
            return []
        for link in left:
            if all(abs(radii.get(first + k, -1.0) - sphere[3]) < 1e-6 for k, sphere in enumerate(link[1])):
                others = rest(first + len(link[1]), [one for one in left if one is not link])
                if others is not None:
                    return [link, *others]
        return None

    # The root comes first.
    return [links[0], *(rest(len(links[0][1]), sorted(links[1:])) or links[1:])]


def make_boxes(generator: numpy.random.Generator) -> numpy.ndarray:
    """(20, 9): centres at least 0.45 m from the z axis, roll, pitch and yaw, half extents."""
    boxes: list[numpy.ndarray] = []
    while len(boxes) < 20:
        centre = generator.uniform([-1.0, -1.0, 0.0], [1.0, 1.0, 1.2])
        if numpy.hypot(centre[0], centre[1]) >= 0.45:
            boxes.append(numpy.r_[centre, generator.uniform(-3, 3, 3), generator.uniform(0.03, 0.15, 3)])
    return numpy.array(boxes)


def make_points(generator: numpy.random.Generator, boxes: numpy.ndarray, count: int) -> numpy.ndarray:
    """(count, 3): on the faces of the boxes."""
    points = generator.uniform(-1, 1, (count, 3))
    rows, axes = numpy.arange(count), generator.integers(3, size=count)
    points[rows, axes] = numpy.sign(points[rows, axes])
    found = numpy.empty_like(points)
    for k, box in enumerate(boxes):
        (sr, sp, sy), (cr, cp, cy) = numpy.sin(box[3:6]), numpy.cos(box[3:6])
        roll = numpy.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
        pitch = numpy.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
        yaw = numpy.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
        own = slice(k, None, len(boxes))
        found[own] = box[:3] + (points[own] * box[6:9]) @ (yaw @ pitch @ roll).T
    return found


if __name__ == "__main__":
    main()
