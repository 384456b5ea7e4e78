/** The distance between two points that were clicked. Each stays on its link. */

import type { Matrix4, Vector3 } from "three";
import type { App } from "../app";
import { length, lengths } from "../ui/format";
import type { Picked } from "./pick";
import { poseOf } from "./robot";
import { Segment } from "./segment";
import type { View } from "./view";

interface Point {
  link: number;
  /** In the frame of the link. */
  local: Vector3;
}

export class Measure {
  readonly segment: Segment;
  /** Called when it begins or ends. */
  changed: () => void = () => undefined;
  private on = false;
  private points: Point[] = [];

  constructor(
    private readonly app: App,
    view: View,
    private readonly size: () => number,
  ) {
    this.segment = new Segment(view);
    app.store.on(["robot"], () => this.use(false));
    app.store.on(["poses", "units"], () => this.show());
  }

  /** Whether clicks choose points. */
  get isOn(): boolean {
    return this.on;
  }

  /** Begins, or ends and removes the points. */
  use(on: boolean): void {
    this.on = on;
    this.points = [];
    this.show();
    this.changed();
    if (on) this.app.note("Click two points of the robot.");
  }

  /** Takes a point; a third one begins again. */
  take(picked: Picked): void {
    const { link } = picked.of;
    const pose = this.pose(link);
    if (!pose) return;
    if (this.points.length === 2) this.points = [];
    this.points.push({ link, local: picked.point.clone().applyMatrix4(pose.invert()) });
    this.show();
  }

  private show(): void {
    const [first, second = first] = this.points.flatMap(({ link, local }) => {
      const pose = this.pose(link);
      return pose ? [local.clone().applyMatrix4(pose)] : [];
    });
    if (!first || !second) {
      this.segment.show(null, 1);
      return;
    }
    const apart = second.clone().sub(first);
    const text =
      this.points.length < 2
        ? `at ${lengths(first.toArray())}`
        : `${length(apart.length(), 4)} (${lengths(apart.toArray())})`;
    this.segment.show({ points: [first, second], text }, this.size());
  }

  private pose(link: number): Matrix4 | null {
    const { poses } = this.app.store.now;
    return poses && poseOf(poses, link);
  }
}
