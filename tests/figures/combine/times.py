"""How long `urdd combine` takes beside `urdd generate` of the URDF that it composes: processor seconds of one thread.

    python3 tests/figures/combine/times.py target/release/urdd ../shared

Parts are URDDs, made before and not counted. Each number is the least of three runs.
"""

import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

RUNS = 3

program, shared = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
ours = Path(__file__).resolve().parents[3] / "conformance" / "robots"
folder = Path(tempfile.mkdtemp(prefix="urdd-times-"))


def run(*arguments):
    """User seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    command = [program, *map(str, arguments)]
    environment = os.environ | {"RAYON_NUM_THREADS": "1"}
    subprocess.run(command, cwd=folder, env=environment, check=True, capture_output=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def least(*arguments, fresh=None):
    times = []
    for _ in range(RUNS):
        if fresh:
            shutil.rmtree(folder / fresh, ignore_errors=True)
        times.append(run(*arguments))
    return min(times)


def recipe(name, parts):
    text = f'name = "{name}"\n'
    for part, source, at in parts:
        text += f'\n[[part]]\nid = "{part}"\nsource = "{source}"\n'
        if at is None:
            text += 'prefix = ""\n'
        else:
            text += f'attach = {{ to = "{at}", xyz = [0, 0, 0.1] }}\n'
    (folder / f"{name}.toml").write_text(text)


for name in ["b1", "ur5", "xarm7"]:
    run("generate", shared / "robots" / name / "robot.urdf", "-o", name)
for name in ["gripper", "hand", "quadruped"]:
    run("generate", ours / f"{name}.urdf", "-o", name)
for name in ["z1", "robotiq_140"]:
    # Legacy URDDs, whose URDFs name packages that are nowhere.
    recipe(name, [(name, shared / "corpus" / name, None)])
    run("combine", f"{name}.toml", "-o", name, "--allow-folder", shared / "corpus")

ROBOTS = {
    "b1_z1_robotiq_140": [
        ("b1", "b1", None),
        ("z1", "z1", "b1/trunk"),
        ("robotiq_140", "robotiq_140", "z1/link06"),
    ],
    "b1_xarm7_gripper": [
        ("b1", "b1", None),
        ("xarm7", "xarm7", "b1/trunk"),
        ("gripper", "gripper", "xarm7/link7"),
    ],
    "ur5_hand": [("ur5", "ur5", None), ("hand", "hand", "ur5/wrist_3_link")],
    "quadruped_hand": [("quadruped", "quadruped", None), ("hand", "hand", "quadruped/trunk")],
}

print("| robot | links, pieces | from nothing | combined | of that, validating the parts | meshes, from nothing | meshes, combined |")
print("|---|---|---|---|---|---|---|")
for name, parts in ROBOTS.items():
    recipe(name, parts)
    sources = [source for _, source, _ in parts]
    one = ["--threads", "1"]
    target = f"{name}_made"
    combined = least("combine", f"{name}.toml", "-o", target, *one, fresh=target)
    urdf = folder / target / f"{name}.urdf"
    anew = least("generate", urdf, "-o", "anew", *one, fresh="anew")
    same = 0
    for file in sorted((folder / target).rglob("*.glb")):
        other = folder / "anew" / file.relative_to(folder / target)
        same += other.read_bytes() == file.read_bytes()
    glbs = len(list((folder / target).rglob("*.glb")))
    checked = sum(least("validate", source) for source in sources)
    geometry = ["--modules", "geometry", *one]
    meshes = least("combine", f"{name}.toml", "-o", "g", *geometry, fresh="g") - checked
    meshes_anew = least("generate", urdf, "-o", "h", *geometry, fresh="h")
    assert same == glbs, (name, same, glbs)
    links = len(json.loads((folder / target / "urdf_module" / "module.json").read_text())["links"])
    pieces = len(list((folder / target).glob("**/convex_decomposition_meshes_module/**/*.glb")))
    print(
        f"| {name} | {links}, {pieces} | {anew:.2f} | {combined:.2f} ({combined / anew:.2f}) | {checked:.2f} "
        f"| {meshes_anew:.2f} | {meshes:.2f} ({meshes / meshes_anew:.2f}) |",
        flush=True,
    )
shutil.rmtree(folder)
