/** The closest points of two shapes, the line between them, and the distance beside it. */

import {
  BufferGeometry,
  Color,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import type { PairDistance } from "../engine/protocol";
import { length } from "../ui/format";
import type { View } from "./view";

const NEAR = new Color("#ffd166");
const TOUCHING = new Color("#ff5d5d");

export class Witness {
  readonly group = new Group();
  private readonly line = new Line(
    new BufferGeometry(),
    new LineBasicMaterial({ depthTest: false, transparent: true }),
  );
  private readonly balls = [0, 1].map(
    () => new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial({ depthTest: false, transparent: true })),
  );
  private middle: Vector3 | null = null;

  constructor(
    private readonly view: View,
    private readonly label: HTMLElement,
  ) {
    this.line.frustumCulled = false;
    this.group.add(this.line, ...this.balls);
    this.group.renderOrder = 10;
    this.group.traverse((object) => (object.renderOrder = 10));
    this.show(null, 1);
    view.before.push(() => this.follow());
  }

  show(pair: PairDistance | null, size: number): void {
    this.group.visible = pair !== null;
    this.label.hidden = pair === null;
    this.middle = null;
    if (pair) {
      const points = pair.points.map((point) => new Vector3(...point));
      const touching = pair.distance <= 0;
      const color = touching ? TOUCHING : NEAR;
      this.line.geometry.setFromPoints(points);
      this.line.material.color.copy(color);
      this.balls.forEach((ball, k) => {
        ball.material.color.copy(color);
        ball.position.copy(points[k] ?? new Vector3());
        ball.scale.setScalar(size * 0.006);
      });
      this.middle = new Vector3()
        .add(points[0] ?? new Vector3())
        .add(points[1] ?? new Vector3())
        .divideScalar(2);
      this.label.textContent = touching ? "in contact" : length(pair.distance);
      this.label.classList.toggle("touching", touching);
    }
    this.view.invalidate();
  }

  private follow(): void {
    const at = this.middle ? this.view.place(this.middle) : null;
    this.label.hidden = at === null;
    if (at)
      this.label.style.transform = `translate(${Math.round(at.x)}px, ${Math.round(at.y)}px) translate(-50%, -180%)`;
  }
}
