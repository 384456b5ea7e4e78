/** Two points, the line between them, and a label beside it. */

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
import { h } from "../ui/dom";
import type { View } from "./view";

const USUAL = new Color("#ffd166");
const ALARMING = new Color("#ff5d5d");

interface Shown {
  points: readonly [Vector3, Vector3];
  text: string;
  alarming?: boolean;
}

export class Segment {
  readonly group = new Group();
  readonly label = h("div", { class: "segment", hidden: true });
  private readonly line = new Line(
    new BufferGeometry(),
    new LineBasicMaterial({ depthTest: false, transparent: true }),
  );
  private readonly balls = [0, 1].map(
    () => new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial({ depthTest: false, transparent: true })),
  );
  private middle: Vector3 | null = null;

  constructor(private readonly view: View) {
    this.line.frustumCulled = false;
    this.group.add(this.line, ...this.balls);
    this.group.traverse((object) => (object.renderOrder = 10));
    this.show(null, 1);
    view.before.push(this.place);
  }

  /** Removes what it drew and its label. */
  remove(): void {
    this.label.remove();
    this.line.geometry.dispose();
    this.line.material.dispose();
    for (const ball of this.balls) {
      ball.geometry.dispose();
      ball.material.dispose();
    }
    this.view.before.splice(this.view.before.indexOf(this.place), 1);
  }

  /** Shows two points of a robot of this size, metres; or nothing. */
  show(shown: Shown | null, size: number): void {
    this.group.visible = shown !== null;
    this.label.hidden = !shown?.text;
    this.middle = null;
    if (shown) {
      const { points, text, alarming = false } = shown;
      const color = alarming ? ALARMING : USUAL;
      this.line.geometry.setFromPoints([...points]);
      this.line.material.color.copy(color);
      this.balls.forEach((ball, k) => {
        ball.material.color.copy(color);
        ball.position.copy(points[k] ?? points[0]);
        ball.scale.setScalar(size * 0.006);
      });
      // Without a text there is no label.
      this.middle = text === "" ? null : points[0].clone().add(points[1]).divideScalar(2);
      this.label.textContent = text;
      this.label.classList.toggle("alarming", alarming);
    }
    this.view.invalidate();
  }

  private readonly place = (): void => {
    const at = this.middle ? this.view.place(this.middle) : null;
    this.label.hidden = at === null;
    if (at)
      this.label.style.transform = `translate(${Math.round(at.x)}px, ${Math.round(at.y)}px) translate(-50%, -180%)`;
  };
}
