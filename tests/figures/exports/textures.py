"""Textures of exports in the programs that show them: `textures.py URDD_PROGRAM`.

Four boxes with an image each, as OBJ, COLLADA, glTF and GLB, are written, generated and exported. What is compared with
the images and with the texture coordinates of each corner that this script wrote:

- MuJoCo (MJCF): `tex_data` and the texture coordinates of each face of the compiled model.
- Drake (its URDF, and SDF): parsed without a warning.
- libsdformat (SDF), where SDF_LOAD names the program of `sdf.cpp`: loads without an error.
- yourdfpy (URDF, through trimesh): image and texture coordinates.

With folders of robots' URDDs after the program, each is exported too, and what MuJoCo and Drake say of it is printed.
"""

import json
import logging
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy as np

HALF = np.array([0.5, 1.0, 1.5])


def faces():
    """For each side its corners, counter-clockwise from outside: positions, and places in the image from below."""
    found = []
    for face in range(6):
        axis, side = face // 2, (1.0, -1.0)[face % 2]
        corners = []
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            position = np.zeros(3)
            position[axis], position[(axis + 1) % 3], position[(axis + 2) % 3] = side, a, b
            corners.append((position * HALF, ((face + (a > 0)) / 8, 0.75 if b > 0 else 0.125)))
        found.append(corners if side > 0 else corners[::-1])
    return found


CORNERS = [corner for face in faces() for corner in face]


def png(seed):
    """8 by 4 pixels, of one colour in each column: a side of the box is a column."""
    pixels = np.random.default_rng(seed).integers(0, 256, (1, 8, 3), dtype=np.uint8).repeat(4, 0)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", 8, 4, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    parts = [struct.pack(">I", len(d)) + k + d + struct.pack(">I", zlib.crc32(k + d)) for k, d in chunks]
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts), pixels


def obj(folder, image):
    lines = ["mtllib a.mtl", "usemtl paint"]
    lines += ["v %r %r %r" % tuple(map(float, p)) for p, _ in CORNERS]
    lines += ["vt %r %r" % uv for _, uv in CORNERS]
    lines += ["f " + " ".join(f"{4 * k + i}/{4 * k + i}" for i in (1, 2, 3, 4)) for k in range(6)]
    (folder / "a.obj").write_text("\n".join(lines) + "\n")
    (folder / "a.mtl").write_text(f"newmtl paint\nKd 0.2 0.4 0.6\nmap_Kd {image}\n")


def collada(folder, image):
    def source(name, rows, axes):
        numbers = " ".join(repr(float(x)) for row in rows for x in row)
        params = "".join(f'<param name="{axis}" type="float"/>' for axis in axes)
        return (
            f'<source id="{name}"><float_array id="{name}-array" count="{len(rows) * len(axes)}">{numbers}</float_array>'
            f'<technique_common><accessor source="#{name}-array" count="{len(rows)}" stride="{len(axes)}">{params}'
            "</accessor></technique_common></source>"
        )

    p = " ".join(f"{i} {i}" for i in range(24))
    (folder / "b.dae").write_text(
        '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
        '<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>'
        f'<library_images><image id="i"><init_from>{image}</init_from></image></library_images>'
        '<library_effects><effect id="e"><profile_COMMON>'
        '<newparam sid="u"><surface type="2D"><init_from>i</init_from></surface></newparam>'
        '<newparam sid="s"><sampler2D><source>u</source></sampler2D></newparam>'
        '<technique sid="t"><lambert><diffuse><texture texture="s" texcoord="UV"/></diffuse></lambert></technique>'
        "</profile_COMMON></effect></library_effects>"
        '<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>'
        '<library_geometries><geometry id="g"><mesh>'
        + source("x", [p for p, _ in CORNERS], "XYZ")
        + source("uv", [uv for _, uv in CORNERS], "ST")
        + '<vertices id="v"><input semantic="POSITION" source="#x"/></vertices>'
        '<polylist count="6" material="m"><input semantic="VERTEX" source="#v" offset="0"/>'
        f'<input semantic="TEXCOORD" source="#uv" offset="1"/><vcount>4 4 4 4 4 4</vcount><p>{p}</p></polylist>'
        "</mesh></geometry></library_geometries>"
        '<library_visual_scenes><visual_scene id="w"><node><instance_geometry url="#g"><bind_material><technique_common>'
        '<instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry></node>'
        "</visual_scene></library_visual_scenes>"
        '<scene><instance_visual_scene url="#w"/></scene></COLLADA>'
    )


def gltf(folder, name, image):
    positions = np.array([[p[0], p[2], -p[1]] for p, _ in CORNERS], dtype="<f4")
    uvs = np.array([[u, 1 - v] for _, (u, v) in CORNERS], dtype="<f4")
    triangles = np.array([4 * k + i for k in range(6) for i in (0, 1, 2, 0, 2, 3)], dtype="<u2")
    data = positions.tobytes() + uvs.tobytes() + triangles.tobytes()
    views = [{"buffer": 0, "byteLength": 288}, {"buffer": 0, "byteOffset": 288, "byteLength": 192}]
    views += [{"buffer": 0, "byteOffset": 480, "byteLength": 72}]
    is_file = isinstance(image, str)
    if not is_file:
        views.append({"buffer": 0, "byteOffset": 552, "byteLength": len(image)})
        data += image
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": image} if is_file else {"bufferView": 3, "mimeType": "image/png"}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 24, "type": "VEC3"}
            | {"min": positions.min(0).tolist(), "max": positions.max(0).tolist()},
            {"bufferView": 1, "componentType": 5126, "count": 24, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": len(data)} | ({"uri": f"{name}.bin"} if is_file else {})],
    }
    text = json.dumps(document).encode()
    if is_file:
        (folder / f"{name}.bin").write_bytes(data)
        (folder / f"{name}.gltf").write_bytes(text)
        return
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    (folder / f"{name}.glb").write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def boxes(folder):
    images = [png(seed) for seed in range(4)]
    for name, (image, _) in zip("abcd", images):
        (folder / f"{name}.png").write_bytes(image)
    obj(folder, "a.png")
    collada(folder, "b.png")
    gltf(folder, "c", "c.png")
    gltf(folder, "d", images[3][0])
    links = [
        f'<link name="l{k}"><visual><geometry><mesh filename="{name}"/></geometry></visual></link>'
        for k, name in enumerate(("a.obj", "b.dae", "c.gltf", "d.glb"))
    ]
    joints = [
        f'<joint name="j{k}" type="fixed"><origin xyz="0 {5 * k} 0"/><parent link="l0"/><child link="l{k}"/></joint>'
        for k in (1, 2, 3)
    ]
    (folder / "boxes.urdf").write_text('<robot name="boxes">' + "".join(links + joints) + "</robot>")
    return [pixels for _, pixels in images]


def of_side(normal_axis, position, uv):
    return normal_axis, tuple(np.round(position, 6)), tuple(np.round(uv, 6))


def wanted():
    return {of_side(k // 2, p, uv) for k, face in enumerate(faces()) for p, uv in face}


def found(triangles, uvs):
    """Positions and texture coordinates of triangles, n x 3 x 3 and n x 3 x 2."""
    corners = set()
    for triangle, uv in zip(triangles, uvs):
        axis = int(np.argmin(np.ptp(triangle, axis=0)))
        corners |= {of_side(axis, p, q) for p, q in zip(triangle, uv)}
    return corners


def mujoco_model(path):
    import mujoco

    return mujoco.MjModel.from_xml_path(str(path))


def check_mujoco(path, images):
    import mujoco

    model = mujoco_model(path)
    assert model.ntex == 4, model.ntex
    for link in range(4):
        body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, f"l{link}")
        geoms = [g for g in range(model.ngeom) if model.geom_bodyid[g] == body and model.geom_group[g] == 2]
        assert len(geoms) == 1
        geom = geoms[0]
        texture = int(model.mat_texid[model.geom_matid[geom]][mujoco.mjtTextureRole.mjTEXROLE_RGB])
        start, height, width, depth = (
            int(values[texture]) for values in (model.tex_adr, model.tex_height, model.tex_width, model.tex_nchannel)
        )
        data = model.tex_data[start : start + height * width * depth].reshape(height, width, depth)
        # MuJoCo keeps rows from above.
        assert (data == images[link]).all(), link
        mesh = model.geom_dataid[geom]
        faces_at = model.mesh_faceadr[mesh] + np.arange(model.mesh_facenum[mesh])
        vertices = model.mesh_vert[model.mesh_vertadr[mesh] :][model.mesh_face[faces_at]]
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, model.mesh_quat[mesh])
        placed = vertices @ rotation.reshape(3, 3).T + model.mesh_pos[mesh]
        uvs = model.mesh_texcoord[model.mesh_texcoordadr[mesh] :][model.mesh_facetexcoord[faces_at]]
        # MuJoCo counts from above.
        ours = found(placed, uvs * [1, -1] + [0, 1])
        assert ours == wanted(), (link, sorted(ours ^ wanted())[:6])


class Warnings(logging.Handler):
    def __init__(self):
        super().__init__(logging.WARNING)
        self.texts = []

    def emit(self, record):
        self.texts.append(record.getMessage())


def drake_warnings(path):
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
    from pydrake.systems.framework import DiagramBuilder

    warnings = Warnings()
    logging.getLogger("drake").addHandler(warnings)
    plant, _ = AddMultibodyPlantSceneGraph(DiagramBuilder(), 0.001)
    Parser(plant).AddModels(str(path))
    logging.getLogger("drake").removeHandler(warnings)
    return warnings.texts


def check_drake(path):
    warnings = drake_warnings(path)
    assert not warnings, warnings


def check_sdf(path):
    program = os.environ.get("SDF_LOAD")
    if program:
        done = subprocess.run([program, str(path)], capture_output=True, text=True)
        assert done.returncode == 0 and not done.stderr, done.stderr


def check_yourdfpy(path, images):
    import yourdfpy

    robot = yourdfpy.URDF.load(str(path), build_collision_scene_graph=False)
    for link in range(4):
        name = robot.robot.links[link].visuals[0].geometry.mesh.filename
        import trimesh

        mesh = trimesh.load(path.parent / name, process=False, force="mesh")
        data = np.asarray(mesh.visual.material.image.convert("RGB"))
        assert (data == images[link]).all()
        ours = found(mesh.vertices[mesh.faces], mesh.visual.uv[mesh.faces])
        assert ours == wanted(), (link, sorted(ours ^ wanted())[:6])


def export(program, urdd, folder, kind, name, *more):
    path = folder / name
    done = subprocess.run(
        [program, "export", kind, str(urdd), "-o", str(path), *more], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return path, done.stderr


def main():
    program, robots = sys.argv[1], sys.argv[2:]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        images = boxes(folder)
        urdd = folder / "boxes"
        subprocess.run([program, "generate", str(folder / "boxes.urdf"), "-o", str(urdd)], check=True, capture_output=True)
        for more in ((), ("--visuals", "40")):
            out = folder / f"out{len(more)}"
            out.mkdir()
            check_mujoco(export(program, urdd, out, "mjcf", "m.xml", *more)[0], images)
            check_drake(export(program, urdd, out, "drake", "d.urdf", *more)[0])
            sdf = export(program, urdd, out, "sdf", "s.sdf", *more)[0]
            check_drake(sdf)
            check_sdf(sdf)
            check_yourdfpy(export(program, urdd, out, "urdf", "u.urdf", *more)[0], images)
        print("boxes: images and texture coordinates are those of the source in MuJoCo and yourdfpy; Drake does not warn")
        for robot in robots:
            out = folder / pathlib.Path(robot).name
            out.mkdir()
            path, notes = export(program, robot, out, "mjcf", "m.xml")
            model = mujoco_model(path)
            textured = int((model.geom_matid >= 0).sum())
            drake = [export(program, robot, out, *args)[0] for args in (("drake", "d.urdf"), ("sdf", "s.sdf"))]
            said = [text for path in drake for text in drake_warnings(path)]
            check_sdf(drake[1])
            report = export(program, robot, out, "urdf", "u.urdf", "--report", str(out / "r.json"))
            entries = json.loads((out / "r.json").read_text())
            counts = {
                key: entry["count"]
                for key in ("carried", "otherwise", "lost")
                for entry in entries[key]
                if entry["what"] == "textures of meshes"
            }
            print(f"{out.name}: {model.ntex} textures, {textured} geoms with one; Drake warns {len(said)} times; URDF {counts}")
            for text in sorted(set(said))[:3]:
                print("   ", text[:300])


main()
