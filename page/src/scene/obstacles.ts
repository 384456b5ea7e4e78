/** Obstacles that a program shows, around the robot. */

import {
  BoxGeometry,
  Box3,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  Color,
  CylinderGeometry,
  DoubleSide,
  Group,
  IcosahedronGeometry,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import type { Object3D } from "three";
import { floats, indices } from "../showing";
import type { Obstacle, Shape } from "../showing";

/** Radius of points without one, metres. */
const DOT = 0.002;
const QUARTER = Math.PI / 2;
/** More points are drawn as smaller solids. */
const MANY = 5000;

export class Obstacles {
  readonly group = new Group();
  private readonly paint = new MeshLambertMaterial({ side: DoubleSide, transparent: true, opacity: 0.85 });

  show(world: readonly Obstacle[]): void {
    this.group.traverse((object) => {
      if (object instanceof Mesh) (object.geometry as BufferGeometry).dispose();
      if (object instanceof InstancedMesh) object.dispose();
    });
    this.group.clear();
    for (const { name, pose, shape } of world) {
      const object = this.drawn(shape);
      object.name = name;
      object.matrixAutoUpdate = false;
      object.matrix.fromArray(pose).transpose();
      object.traverse((part) => {
        part.castShadow = true;
      });
      this.group.add(object);
    }
    this.group.updateMatrixWorld(true);
  }

  color(color: string): void {
    this.paint.color = new Color(color);
  }

  /** The box around each. */
  boxes(): Box3[] {
    return this.group.children.map((object) => new Box3().setFromObject(object));
  }

  /** What is at most a length from a box, so that a floor does not make the robot small. */
  bounds(near: Box3, length: number): Box3 {
    return new Box3().setFromObject(this.group).intersect(near.clone().expandByScalar(length));
  }

  private drawn(shape: Shape): Object3D {
    if (shape.kind === "points") return this.copies(dots(floats(shape.points), shape.radius || DOT));
    if (shape.kind === "height_field") return this.copies(columns(shape));
    const object = new Group();
    object.add(new Mesh(solid(shape), this.paint));
    return object;
  }

  private copies({ of, places }: { of: BufferGeometry; places: Matrix4[] }): Object3D {
    const object = new InstancedMesh(of, this.paint, places.length);
    places.forEach((place, k) => {
      object.setMatrixAt(k, place);
    });
    return object;
  }
}

function solid(shape: Exclude<Shape, { kind: "points" | "height_field" }>): BufferGeometry {
  switch (shape.kind) {
    case "cuboid": {
      const [x = 0, y = 0, z = 0] = shape.half_extents;
      return new BoxGeometry(2 * x, 2 * y, 2 * z);
    }
    case "sphere":
      return new SphereGeometry(shape.radius, 48, 24);
    case "capsule":
      return new CapsuleGeometry(shape.radius, 2 * shape.half_length, 16, 48).rotateX(QUARTER);
    case "cylinder":
      return new CylinderGeometry(shape.radius, shape.radius, 2 * shape.half_length, 64).rotateX(QUARTER);
    case "hull": {
      const points = floats(shape.points);
      const corner = (k: number): Vector3 => new Vector3().fromArray(points, 3 * k);
      return new ConvexGeometry(Array.from({ length: points.length / 3 }, (_, k) => corner(k)));
    }
    case "mesh": {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(floats(shape.vertices), 3));
      geometry.setIndex(new BufferAttribute(indices(shape.faces), 1));
      const facets = geometry.toNonIndexed();
      facets.computeVertexNormals();
      return facets;
    }
  }
}

function dots(points: Float32Array, radius: number): { of: BufferGeometry; places: Matrix4[] } {
  const places: Matrix4[] = [];
  for (let k = 0; k + 2 < points.length; k += 3)
    places.push(new Matrix4().makeTranslation(points[k] ?? 0, points[k + 1] ?? 0, points[k + 2] ?? 0));
  return { of: new IcosahedronGeometry(radius, places.length > MANY ? 0 : 2), places };
}

/** A box for each cell, from its height down. */
function columns(field: Extract<Shape, { kind: "height_field" }>): { of: BufferGeometry; places: Matrix4[] } {
  const [x = 0, y = 0] = field.cell;
  const places = Array.from(floats(field.heights), (height, k) => {
    const [row, column] = [Math.floor(k / field.columns), k % field.columns];
    return new Matrix4().makeTranslation(column * x, row * y, height - field.thickness / 2);
  });
  return { of: new BoxGeometry(x, y, field.thickness), places };
}
