/** The ground: a grid with a round spacing, and the robot's shadow. */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  PlaneGeometry,
  ShadowMaterial,
  Vector3,
} from "three";
import type { Box3 } from "three";

/** Width of the part of the ground that has shadows, of the diagonal of the robot's box. */
const SHADED = 2;

/** The largest number of the form 1, 2 or 5 times a power of ten that is not larger. */
function roundStep(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  const share = length / power;
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

export class Ground {
  readonly group = new Group();
  /** Spacing of the grid, metres. */
  step = 0.1;
  private colors: [string, string] = ["#2a3140", "#39424f"];
  private box: Box3 | null = null;
  private readonly shadow = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ opacity: 0.28, depthWrite: false }));

  constructor() {
    this.shadow.receiveShadow = true;
  }

  color(fine: string, coarse: string): void {
    this.colors = [fine, coarse];
    if (this.box) this.under(this.box);
  }

  under(box: Box3): void {
    this.box = box.clone();
    this.clear();
    const size = Math.max(box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z, 1e-3);
    this.step = roundStep(size / 4);
    const lines = 12;
    const middle = [box.min.x + box.max.x, box.min.y + box.max.y].map(
      (sum) => Math.round(sum / 2 / this.step) * this.step,
    );
    const [x = 0, y = 0] = middle;
    const reach = lines * this.step;
    const groups: [string, number[]][] = [
      [this.colors[0], []],
      [this.colors[1], []],
    ];
    for (let k = -lines; k <= lines; k++) {
      const at = k * this.step;
      const points = groups[k % 5 === 0 ? 1 : 0]?.[1];
      points?.push(x - reach, y + at, 0, x + reach, y + at, 0, x + at, y - reach, 0, x + at, y + reach, 0);
    }
    for (const [color, points] of groups) {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
      this.group.add(new LineSegments(geometry, new LineBasicMaterial({ color: new Color(color) })));
    }
    // Every pixel of it costs time, so it is no larger than where shadows fall.
    const center = box.getCenter(new Vector3());
    this.shadow.position.set(center.x, center.y, 0);
    this.shadow.scale.setScalar(SHADED * box.getSize(new Vector3()).length());
    this.group.add(this.shadow);
    this.group.position.z = box.min.z;
  }

  private clear(): void {
    for (const child of this.group.children) {
      if (!(child instanceof LineSegments)) continue;
      const lines = child as LineSegments<BufferGeometry, LineBasicMaterial>;
      lines.geometry.dispose();
      lines.material.dispose();
    }
    this.group.clear();
  }
}
