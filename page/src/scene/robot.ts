/** The robot's links in the scene: poses, shapes, appearance. */

import { Box3, Color, Group, Matrix4, Mesh, MeshLambertMaterial, Quaternion, Vector3 } from "three";
import type { Object3D } from "three";
import { LAYERS } from "../state";
import type { Layer, LayerKind } from "../state";

/** Maximum opacity of what casts no shadow. */
const SHADOWLESS = 0.5;

/** The origin of a mesh in the scene. */
export interface MeshData {
  link: number;
  piece: number;
  layer: LayerKind;
  color: Color;
  opacity: number;
}

export function dataOf(object: Object3D): MeshData | null {
  return (object.userData as { of?: MeshData }).of ?? null;
}

/** The pose of a link, of those of all links: x, y, z and the quaternion w, x, y, z of each. */
export function poseOf(poses: Float64Array, link: number): Matrix4 {
  const [x = 0, y = 0, z = 0, w = 1, qx = 0, qy = 0, qz = 0] = poses.subarray(7 * link, 7 * link + 7);
  return new Matrix4().compose(new Vector3(x, y, z), new Quaternion(qx, qy, qz, w), new Vector3(1, 1, 1));
}

/** The appearance of a link in all layers: a tint, and a factor of its opacity. */
export interface Look {
  tint: Color | null;
  fade: number;
  paint: Color | null;
}

export class RobotScene {
  readonly root = new Group();
  private readonly links: Group[];
  private readonly layers = new Map<LayerKind, Group[]>();

  constructor(links: number) {
    this.links = Array.from({ length: links }, () => {
      const group = new Group();
      group.matrixAutoUpdate = false;
      this.root.add(group);
      return group;
    });
  }

  /** Sets the poses of all links. */
  pose(poses: Float64Array): void {
    this.links.forEach((group, link) => {
      group.matrix.copy(poseOf(poses, link));
      group.matrixWorldNeedsUpdate = true;
    });
    this.root.updateMatrixWorld(true);
  }

  link(index: number): Group | undefined {
    return this.links[index];
  }

  has(layer: LayerKind): boolean {
    return this.layers.has(layer);
  }

  /** Adds an empty layer. */
  begin(layer: LayerKind): void {
    this.drop(layer);
    this.layers.set(
      layer,
      this.links.map((link) => {
        const group = new Group();
        link.add(group);
        return group;
      }),
    );
  }

  add(layer: LayerKind, link: number, object: Object3D): void {
    this.layers.get(layer)?.[link]?.add(object);
    object.updateMatrixWorld(true);
  }

  drop(layer: LayerKind): void {
    for (const group of this.layers.get(layer) ?? []) {
      group.removeFromParent();
      group.traverse((object) => {
        if (!(object instanceof Mesh)) return;
        const mesh = object as Mesh<Mesh["geometry"], MeshLambertMaterial>;
        mesh.geometry.dispose();
        mesh.material.map?.dispose();
        mesh.material.dispose();
      });
    }
    this.layers.delete(layer);
  }

  dispose(): void {
    for (const layer of LAYERS) this.drop(layer);
    this.root.removeFromParent();
  }

  /** All visible meshes. */
  meshes(): Mesh[] {
    const found: Mesh[] = [];
    for (const groups of this.layers.values()) {
      for (const group of groups) {
        if (!group.visible) continue;
        group.traverse((object) => {
          if (object instanceof Mesh) found.push(object as Mesh);
        });
      }
    }
    return found;
  }

  /** Shows layers and links with these tints and opacities. */
  show(
    layers: Record<LayerKind, Layer>,
    hidden: ReadonlySet<number>,
    wireframe: boolean,
    look: (link: number, piece: number, layer: LayerKind) => Look,
  ): void {
    for (const [kind, groups] of this.layers) {
      const layer = layers[kind];
      groups.forEach((group, link) => {
        group.visible = layer.on && layer.opacity > 0 && !hidden.has(link);
        if (!group.visible) return;
        group.traverse((object) => {
          const data = dataOf(object);
          if (!data || !(object instanceof Mesh)) return;
          const material = object.material as MeshLambertMaterial;
          paint(material, data, look(link, data.piece, kind), layer.opacity, wireframe);
          object.castShadow = material.opacity > SHADOWLESS && !wireframe;
        });
      });
    }
  }

  /** The bounding box of everything, or of some links. */
  bounds(of?: ReadonlySet<number>): Box3 {
    this.root.updateMatrixWorld(true);
    const box = new Box3();
    this.links.forEach((group, link) => {
      if (!of || of.has(link)) box.expandByObject(group);
    });
    if (box.isEmpty()) {
      for (const group of this.links) box.expandByPoint(new Vector3().setFromMatrixPosition(group.matrix));
      if (!box.isEmpty()) box.expandByScalar(0.1);
    }
    return box;
  }
}

function paint(material: MeshLambertMaterial, data: MeshData, look: Look, opacity: number, wireframe: boolean): void {
  const visible = opacity * look.fade * data.opacity;
  const transparent = visible < 0.999;
  if (material.transparent !== transparent || material.wireframe !== wireframe) material.needsUpdate = true;
  material.transparent = transparent;
  material.depthWrite = !transparent;
  material.opacity = visible;
  material.wireframe = wireframe;
  material.color.copy(look.paint ?? data.color);
  if (look.tint) material.emissive.copy(look.tint).multiplyScalar(0.45);
  else material.emissive.setScalar(0);
}
