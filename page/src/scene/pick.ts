/** The object under the pointer, by a bounding volume hierarchy of each mesh, built on first use. */

import { Mesh } from "three";
import type { BufferGeometry, Vector3 } from "three";
import { acceleratedRaycast, MeshBVH } from "three-mesh-bvh";
import type { View } from "./view";
import { dataOf } from "./robot";
import type { MeshData, RobotScene } from "./robot";

Mesh.prototype.raycast = acceleratedRaycast;

type WithTree = BufferGeometry & { boundsTree?: MeshBVH };

export interface Picked {
  of: MeshData;
  point: Vector3;
}

export function pick(view: View, scene: RobotScene, x: number, y: number): Picked | null {
  const meshes = scene.meshes();
  for (const mesh of meshes) {
    const geometry = mesh.geometry as WithTree;
    geometry.boundsTree ??= new MeshBVH(geometry);
  }
  const [hit] = view.ray(x, y).intersectObjects(meshes, false);
  const of = hit ? dataOf(hit.object) : null;
  return hit && of ? { of, point: hit.point } : null;
}

/** Builds the hierarchies while the browser is idle. */
export function prepare(scene: RobotScene): void {
  const waiting = scene.meshes();
  const idle = (work: () => void): void => {
    if ("requestIdleCallback" in window) window.requestIdleCallback(work);
    else setTimeout(work, 50);
  };
  const next = (): void => {
    const mesh = waiting.pop();
    if (!mesh) return;
    const geometry = mesh.geometry as WithTree;
    if (mesh.parent) geometry.boundsTree ??= new MeshBVH(geometry);
    idle(next);
  };
  idle(next);
}
