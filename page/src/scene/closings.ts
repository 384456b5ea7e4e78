/** The ends of kinematic loops, drawn over the robot: a point where a loop is closed, a red line with its length where not. */

import { Group, Vector3 } from "three";
import type { LoopErrors } from "../engine/protocol";
import type { RobotModel } from "../model";
import { h } from "../ui/dom";
import { apart } from "../ui/format";
import { matrixOf, poseOf } from "./robot";
import { Segment } from "./segment";
import type { View } from "./view";

/** Maximum number of loops that are drawn. */
const MAX_LOOPS = 200;

export class Closings {
  readonly group = new Group();
  readonly labels = h("div", { class: "loop-ends", "aria-hidden": "true" });
  private segments: Segment[] = [];
  private model: RobotModel | null = null;

  constructor(private readonly view: View) {}

  /** Draws the loops of a robot of this size, metres; `null` for none. */
  make(model: RobotModel | null, isOn: boolean): void {
    const count = isOn ? Math.min(MAX_LOOPS, model?.about.loops?.loops.length ?? 0) : 0;
    this.model = model;
    while (this.segments.length > count) {
      const gone = this.segments.pop();
      if (!gone) break;
      this.group.remove(gone.group);
      gone.remove();
    }
    while (this.segments.length < count) {
      const made = new Segment(this.view);
      this.segments.push(made);
      this.group.add(made.group);
      this.labels.append(made.label);
    }
  }

  /** Where they are, in the poses of a configuration. */
  pose(poses: Float64Array, errors: LoopErrors | null, size: number): void {
    const loops = this.model?.about.loops?.loops ?? [];
    this.segments.forEach((segment, k) => {
      const [one, gap] = [loops[k], errors?.gaps[k]];
      if (!one || !gap) {
        segment.show(null, size);
        return;
      }
      const end = (k: 0 | 1): Vector3 =>
        new Vector3().setFromMatrixPosition(poseOf(poses, one.links[k]).multiply(matrixOf(one.frames[k])));
      const text = apart(one, gap);
      segment.show({ points: [end(0), end(1)], text: text ?? "", alarming: text !== null }, size);
    });
  }
}
