"""How bodies of primitives move in MuJoCo with the shapes of the source and with pieces: `shapes.py URDD_PROGRAM`.

Each robot is made here, generated, and exported with `--shapes pieces` and `--shapes source`. MuJoCo's contacts have no
rolling friction, and sliding friction of 1.

- A ball and a wheel roll down a plane of 10 degrees for 2 s: the closed form of rolling without slip is
  s = g sin(a) t^2 / (2 (1 + I / (m r^2))).
- A box stands on a box for 2 s: both stay where they are.
- A foot, which is a capsule, is turned about its axis over a plane: it touches where the axis is as high as its radius.

Prints a table.
"""

import math
import pathlib
import subprocess
import sys
import tempfile

import mujoco

RADIUS, ANGLE, SECONDS, STEP, GRAVITY = 0.1, math.radians(10), 2.0, 0.001, 9.81


def link(inertia, collision):
    xx, yy, zz = inertia
    moments = f'<inertia ixx="{xx}" iyy="{yy}" izz="{zz}" ixy="0" ixz="0" iyz="0"/>'
    inertial = f'<inertial><mass value="1"/>{moments}</inertial>'
    return f'<robot name="it"><link name="it">{inertial}{collision}</link></robot>'


def shape(geometry, origin=""):
    return f"<collision>{origin}<geometry>{geometry}</geometry></collision>"


SIDEWAYS = f'<origin xyz="0 0 0" rpy="{math.pi / 2} 0 0"/>'
CYLINDER = f'<cylinder radius="{RADIUS}" length="0.1"/>'
END = f'<sphere radius="{RADIUS}"/>'
ROBOTS = {
    "ball": link([0.004] * 3, shape(END)),
    "wheel": link([0.0033, 0.005, 0.0033], shape(CYLINDER, SIDEWAYS)),
    "box": link([0.0067] * 3, shape('<box size="0.2 0.2 0.2"/>')),
    "foot": link([0.005] * 3, shape(CYLINDER, SIDEWAYS)
                 + shape(END, '<origin xyz="0 0.05 0"/>') + shape(END, '<origin xyz="0 -0.05 0"/>')),
}


def compiled(file, angle=0.0, copies=1):
    """The models of a robot on a plane, one above the other, each with a free joint."""
    scene = mujoco.MjSpec()
    scene.option.timestep = STEP
    scene.option.gravity = [GRAVITY * math.sin(angle), 0, -GRAVITY * math.cos(angle)]
    scene.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[100, 100, 1])
    for copy in range(copies):
        frame = scene.worldbody.add_frame(pos=[0, 0, RADIUS * (1 + 2 * copy)])
        scene.attach(mujoco.MjSpec.from_file(str(file)), frame=frame, prefix=f"{copy}_")
        scene.body(f"{copy}_it").pos = [0, 0, 0]
    for geom in scene.geoms:
        geom.condim, geom.friction = 3, [1, 0, 0]
    return scene.compile()


def moved(model):
    data = mujoco.MjData(model)
    for _ in range(round(SECONDS / STEP)):
        mujoco.mj_step(model, data)
    return data


def rolled(file):
    model = compiled(file, ANGLE)
    data = moved(model)
    share = 1 + model.body_inertia[1].max() / (model.body_mass[1] * RADIUS**2)
    return data.qpos[0], GRAVITY * math.sin(ANGLE) * SECONDS**2 / (2 * share)


def stacked(file):
    data = moved(compiled(file, copies=2))
    fallen = 3 * RADIUS - data.xpos[2][2]
    return math.hypot(*data.xpos[2][:2]), fallen


def heights(file):
    """The least and the greatest height of the axis at which there is contact, turned about it, to 0.01 mm."""
    model = compiled(file)
    data = mujoco.MjData(model)
    found = []
    for turn in range(64):
        half = math.pi * turn / 64
        data.qpos[3:] = [math.cos(half), 0, math.sin(half), 0]
        low, high = RADIUS / 2, RADIUS * 1.5
        while high - low > 1e-5:
            data.qpos[2] = (low + high) / 2
            mujoco.mj_forward(model, data)
            touches = any(data.contact[k].dist <= 0 for k in range(data.ncon))
            low, high = (data.qpos[2], high) if touches else (low, data.qpos[2])
        found.append(low)
    return min(found), max(found)


def main(program):
    print(f"mujoco {mujoco.__version__}")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        run = lambda *words: subprocess.run([program, *map(str, words)], check=True, capture_output=True)
        for name, text in ROBOTS.items():
            source, urdd = folder / f"{name}.urdf", folder / name
            source.write_text(text)
            run("generate", source, "-o", urdd)
            for shapes in ["pieces", "source"]:
                file = folder / f"{name}_{shapes}.xml"
                run("export", "mjcf", urdd, "-o", file, "--shapes", shapes, "--floating-base")
                if name == "box":
                    aside, down = stacked(file)
                    print(f"{name} {shapes}: moved {aside * 1e3:.3f} mm aside, {down * 1e3:.3f} mm down")
                elif name == "foot":
                    low, high = heights(file)
                    print(f"{name} {shapes}: touches at {low:.5f} to {high:.5f} m, expected {RADIUS:.5f}")
                else:
                    far, expected = rolled(file)
                    print(f"{name} {shapes}: rolled {far:.3f} m, expected {expected:.3f}")


if __name__ == "__main__":
    main(sys.argv[1])
