/** Transparent copies of what is drawn of the robot, in other configurations. */

import { Color, Group, Mesh, MeshBasicMaterial } from "three";
import { dataOf, poseOf } from "./robot";
import type { RobotScene } from "./robot";

const OPACITY = 0.22;

export class Ghosts {
  readonly group = new Group();

  /** A copy for each of these poses of all links, each in a colour. The meshes' data is shared. */
  show(scene: RobotScene | null, poses: readonly Float64Array[], colors: readonly string[]): void {
    for (const child of this.group.children) if (child instanceof Mesh) (child.material as MeshBasicMaterial).dispose();
    this.group.clear();
    if (!scene || poses.length === 0) return;
    const meshes = scene.meshes().flatMap((mesh) => {
      const of = dataOf(mesh);
      const link = of && scene.link(of.link);
      return link
        ? [{ mesh, link: of.link, within: link.matrixWorld.clone().invert().multiply(mesh.matrixWorld) }]
        : [];
    });
    poses.forEach((all, k) => {
      const color = new Color(colors[k] ?? "#fff");
      const material = new MeshBasicMaterial({ color, opacity: OPACITY, transparent: true, depthWrite: false });
      for (const { mesh, link, within } of meshes) {
        const ghost = new Mesh(mesh.geometry, material);
        ghost.matrixAutoUpdate = false;
        ghost.matrix.copy(poseOf(all, link)).multiply(within);
        this.group.add(ghost);
      }
    });
  }
}
