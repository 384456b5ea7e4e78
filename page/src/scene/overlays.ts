/** Frames, joint axes, mass and paths, drawn over the robot. */

import {
  AxesHelper,
  BoxGeometry,
  BufferGeometry,
  Color,
  EdgesGeometry,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  Matrix3,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import type { Material, Object3D } from "three";
import type { Inertial } from "../engine/protocol";
import type { RobotModel } from "../model";
import type { OverlayKind } from "../state";
import { poseOf } from "./robot";

type Drawn = Mesh | LineSegments | Line;

export class Overlays {
  readonly group = new Group();
  private readonly frames: Group[] = [];

  /** Creates the selected overlays. `size` is the robot's, `frame` the length of a frame's axes, metres. */
  make(
    model: RobotModel,
    on: Record<OverlayKind, boolean>,
    size: number,
    frame: number,
    selected: number | null,
  ): void {
    this.clear();
    this.frames.length = 0;
    for (const link of model.links) {
      const group = new Group();
      group.matrixAutoUpdate = false;
      this.group.add(group);
      this.frames.push(group);
      if (on.frames) group.add(above(new AxesHelper(frame)));
      const joint = link.parent_joint === null ? null : model.joints[link.parent_joint];
      if (on.axes && joint?.axis && joint.type !== "Fixed") group.add(axis(joint.axis, size));
      if (link.inertial) {
        if (on.com && (link.inertial.mass ?? 0) > 0) group.add(centre(link.inertial, size));
        if (on.inertia) {
          const box = inertia(link.inertial);
          if (box) group.add(box);
        }
      }
    }
    if (on.path && selected !== null) this.group.add(path(model, selected));
  }

  /** Sets their poses from the links'. */
  pose(poses: Float64Array): void {
    this.frames.forEach((group, link) => {
      group.matrix.copy(poseOf(poses, link));
      group.matrixWorldNeedsUpdate = true;
    });
    for (const child of this.group.children) {
      const links = (child.userData as { links?: number[] }).links;
      if (!links) continue;
      const points = links.map(
        (link) => new Vector3(poses[7 * link] ?? 0, poses[7 * link + 1] ?? 0, poses[7 * link + 2] ?? 0),
      );
      if (child instanceof Line) (child.geometry as BufferGeometry).setFromPoints(points);
    }
  }

  clear(): void {
    this.group.traverse((object: Object3D) => {
      const drawn = object as Partial<Drawn>;
      drawn.geometry?.dispose();
      (drawn.material as Material | undefined)?.dispose();
    });
    this.group.clear();
  }
}

/** Visible through other objects. */
function above<T extends Object3D>(object: T): T {
  object.renderOrder = 5;
  const material = (object as unknown as { material?: Material }).material;
  if (material) {
    material.depthTest = false;
    material.transparent = true;
  }
  return object;
}

function axis(along: [number, number, number], size: number): Object3D {
  const half = new Vector3(...along).normalize().multiplyScalar(size * 0.09);
  const geometry = new BufferGeometry().setFromPoints([half.clone().negate(), half]);
  return above(new LineSegments(geometry, new LineBasicMaterial({ color: new Color("#d977ff") })));
}

function centre(inertial: Inertial, size: number): Object3D {
  const ball = new Mesh(
    new SphereGeometry(size * 0.01, 12, 8),
    new MeshBasicMaterial({ color: new Color("#ffd166"), opacity: 0.9 }),
  );
  ball.position.set(...inertial.position);
  return above(ball);
}

/** The box of uniform density with this mass and inertia. */
function inertia(inertial: Inertial): Object3D | null {
  const mass = inertial.mass ?? 0;
  if (mass <= 0 || !inertial.inertia) return null;
  const { moments, axes } = principal(inertial.inertia);
  const [a, b, c] = moments;
  const side = (x: number, y: number, z: number): number => Math.sqrt(Math.max(0, (6 * (y + z - x)) / mass));
  const sides = [side(a, b, c), side(b, a, c), side(c, a, b)] as const;
  if (sides.some((length) => !Number.isFinite(length))) return null;
  const edges = new EdgesGeometry(new BoxGeometry(...sides));
  const box = above(new LineSegments(edges, new LineBasicMaterial({ color: new Color("#ffd166") })));
  const [w, x, y, z] = inertial.quaternion_wxyz;
  const turn = new Matrix4().makeRotationFromQuaternion(new Quaternion(x, y, z, w));
  const own = new Matrix4().setFromMatrix3(new Matrix3().fromArray(axes.flat()));
  box.quaternion.setFromRotationMatrix(turn.multiply(own));
  box.position.set(...inertial.position);
  return box;
}

/** A line through the origins from a link to the root. */
function path(model: RobotModel, link: number): Object3D {
  const links = [link, ...model.path(link).flatMap((joint) => model.joints[joint]?.parent ?? [])];
  const line = new Line(new BufferGeometry(), new LineBasicMaterial({ color: new Color("#5aa9ff") }));
  line.frustumCulled = false;
  line.userData = { links };
  return above(line);
}

type Row = [number, number, number];

/** Moments and their axes: unit vectors that form a right-handed frame. By Jacobi rotations. */
function principal([xx, xy, xz, yy, yz, zz]: readonly [number, number, number, number, number, number]): {
  moments: Row;
  axes: [Row, Row, Row];
} {
  const m: [Row, Row, Row] = [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
  // Columns are the axes.
  const v: [Row, Row, Row] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  const pairs = [
    [0, 1],
    [0, 2],
    [1, 2],
  ] as const;
  for (let sweep = 0; sweep < 30; sweep++) {
    for (const [p, q] of pairs) {
      if (Math.abs(m[p][q]) < 1e-300) continue;
      const theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
      const t = Math.sign(theta || 1) / (Math.abs(theta) + Math.hypot(theta, 1));
      const c = 1 / Math.hypot(t, 1);
      const s = t * c;
      for (const row of [m[0], m[1], m[2]]) {
        [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
      }
      for (let k: 0 | 1 | 2 = 0; k < 3; k++) {
        const [a, b] = [m[p][k as 0 | 1 | 2], m[q][k as 0 | 1 | 2]];
        m[p][k as 0 | 1 | 2] = c * a - s * b;
        m[q][k as 0 | 1 | 2] = s * a + c * b;
      }
      for (const row of v) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
    }
  }
  const column = (k: 0 | 1 | 2): Row => [v[0][k], v[1][k], v[2][k]];
  const [x, y] = [column(0), column(1)];
  const z: Row = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
  return { moments: [m[0][0], m[1][1], m[2][2]], axes: [x, y, z] };
}
