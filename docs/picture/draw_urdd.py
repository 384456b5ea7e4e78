#!/usr/bin/env python3
"""Draws the picture of docs/generate.md from the modules of a URDD: the plain mesh, the hulls, the convex
pieces and the spheres of one robot, side by side.

    urdd generate conformance/robots/welding_arm.urdf -o target/welding_arm
    python3 docs/picture/draw_urdd.py target/welding_arm docs/picture/welding_arm.png

Needs numpy. Nothing is derived from the URDF: `chain_module` and `dof_module` give the poses.
"""

import json
import struct
import sys
import zlib
from pathlib import Path

import numpy as np

POSE = [-0.55, 0.25, 0.75, 0.4, 0.5, 0.0]
WIDTH, HEIGHT, SAMPLES = 300, 420, 3
LIGHT = np.array([0.35, -0.55, 0.76])
BACKGROUND = np.array([250, 250, 248], float)
GREY = np.array([176, 184, 192], float)
PALETTE = np.array(
    [[86, 134, 190], [226, 142, 73], [98, 166, 110], [200, 92, 92], [146, 120, 180], [160, 120, 100], [90, 170, 180]],
    float,
)


def module(root, path):
    return json.loads((root / path / "module.json").read_text())


def rotation(quaternion):
    w, x, y, z = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def placed(turn, shift):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = turn, shift
    return pose


def link_poses(root, configuration):
    """Poses of all links (4 x 4, metres) for revolute and fixed joints."""
    chain, dofs = module(root, "chain_module"), module(root, "dof_module")
    poses = [np.eye(4) for _ in chain["links_in_chain"]]
    for level in chain["kinematic_hierarchy"]:
        for link in level:
            joint_idx = chain["links_in_chain"][link]["parent_joint_idx"]
            if joint_idx is None:
                continue
            joint = chain["joints_in_chain"][joint_idx]
            motion = np.eye(4)
            for dof in dofs["joint_idx_to_dof_idxs_mapping"][joint_idx]:
                half = configuration[dof] / 2
                motion = placed(rotation([np.cos(half), *(np.sin(half) * np.array(joint["axis"]))]), [0, 0, 0])
            origin = placed(rotation(joint["origin"]["quaternion_wxyz"]), joint["origin"]["position"])
            poses[link] = poses[joint["parent_link_idx"]] @ origin @ motion
    return poses


def triangles(path):
    """Corners (n, 3, 3) of a binary STL file."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    records = np.frombuffer(data, np.dtype("V12, (3,3)<f4, V2"), count, 84)
    return records["f1"].astype(float)


def ball(centre, radius, rings=16, around=32):
    polar, turn = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, around + 1), indexing="ij")
    grid = np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], -1)
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    faces = np.concatenate([np.stack([a, b, c], 2).reshape(-1, 3, 3), np.stack([a, c, d], 2).reshape(-1, 3, 3)])
    return faces * radius + np.array(centre)


def scenes(root):
    """What each picture shows: lists of (triangles in the world, colour)."""
    poses = link_poses(root, POSE)
    world = lambda link, faces: faces @ poses[link][:3, :3].T + poses[link][:3, 3]
    plain = module(root, "mesh_modules/plain_meshes_module")["link_meshes"]
    hulls = module(root, "mesh_modules/convex_hull_meshes_module")["link_hulls"]
    pieces = module(root, "mesh_modules/convex_decomposition_meshes_module")["link_pieces"]
    shapes = module(root, "link_shapes_modules/link_shapes_approximations_module")
    colour = lambda i: PALETTE[i % len(PALETTE)]
    yield [(world(i, triangles(root / m["files"]["stl"])), GREY) for i, m in enumerate(plain) if m]
    yield [(world(i, triangles(root / m["stl"])), colour(i)) for i, m in enumerate(hulls) if m]
    yield [(world(i, triangles(root / p["stl"])), colour(i + k)) for i, link in enumerate(pieces) for k, p in enumerate(link)]
    yield [
        (world(i, ball(s["offset_xyz"], s["radius"])), colour(i + k))
        for i, link in enumerate(shapes["decomposition_bounding_spheres"])
        for k, s in enumerate(link)
    ]


def draw(parts, camera, low, scale):
    """One picture (height, width, 3), with flat shading and a depth buffer."""
    height, width = HEIGHT * SAMPLES, WIDTH * SAMPLES
    image = np.tile(BACKGROUND, (height, width, 1))
    depth = np.full((height, width), -np.inf)
    for faces, colour in parts:
        normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
        size = np.linalg.norm(normals, axis=1)
        faces, normals = faces[size > 0], normals[size > 0] / size[size > 0, None]
        seen = (faces @ camera.T - low) * scale
        seen[..., 1] = height - seen[..., 1]
        shade = 0.45 + 0.55 * np.clip(normals @ LIGHT / np.linalg.norm(LIGHT), 0, 1)
        for corners, light in zip(seen, shade):
            x0, y0 = np.maximum(np.floor(corners[:, :2].min(0)).astype(int), 0)
            x1, y1 = np.minimum(np.ceil(corners[:, :2].max(0)).astype(int) + 1, [width, height])
            if x0 >= x1 or y0 >= y1:
                continue
            x, y = np.meshgrid(np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5)
            (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
            area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
            if abs(area) < 1e-12:
                continue
            u = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area
            v = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area
            z = az + u * (bz - az) + v * (cz - az)
            inside = (u >= 0) & (v >= 0) & (u + v <= 1) & (z > depth[y0:y1, x0:x1])
            depth[y0:y1, x0:x1][inside] = z[inside]
            image[y0:y1, x0:x1][inside] = colour * light
    return image.reshape(HEIGHT, SAMPLES, WIDTH, SAMPLES, 3).mean((1, 3))


def png(image, path):
    rows = b"".join(b"\0" + row.tobytes() for row in np.round(image).astype(np.uint8))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", image.shape[1], image.shape[0], 8, 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    )


def main():
    root, output = Path(sys.argv[1]), Path(sys.argv[2])
    pictures = list(scenes(root))
    turn, tilt = np.radians(-38), np.radians(14)
    right = np.array([np.cos(turn), np.sin(turn), 0])
    back = np.array([-np.sin(turn) * np.cos(tilt), np.cos(turn) * np.cos(tilt), -np.sin(tilt)])
    camera = np.stack([right, np.cross(right, back), -back])
    points = np.concatenate([faces.reshape(-1, 3) for faces, _ in pictures[3]]) @ camera.T
    low, high = points.min(0), points.max(0)
    scale = SAMPLES * min(WIDTH / (high - low)[0], HEIGHT / (high - low)[1]) * 0.92
    middle = (low + high) / 2
    low = middle - np.array([WIDTH, HEIGHT, 0]) * SAMPLES / scale / 2
    png(np.concatenate([draw(parts, camera, low, scale) for parts in pictures], axis=1), output)


if __name__ == "__main__":
    main()
