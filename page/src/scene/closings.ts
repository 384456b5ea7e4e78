/** The ends of kinematic loops, drawn over the robot: a point where a loop is closed, a red line with its length where not. */

import { Group, Matrix4, Quaternion, Vector3 } from "three";
import type { LoopErrors, Pose } from "../engine/protocol";
import type { RobotModel } from "../model";
import { h } from "../ui/dom";
import { apart } from "../ui/format";
import { linkMatrix } from "./drag";
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
      const ends = [0, 1].map((end) => origin(poses, one.links[end] ?? 0, one.frames[end]));
      const [a, b] = ends;
      const text = apart(one, gap);
      segment.show(a && b ? { points: [a, b], text: text ?? "", alarming: text !== null } : null, size);
    });
  }
}

/** The origin of a frame of a link, in the root link's frame. */
function origin(poses: Float64Array, link: number, frame: Pose | undefined): Vector3 {
  const [w, x, y, z] = frame?.quaternion_wxyz ?? [1, 0, 0, 0];
  const own = new Matrix4().compose(
    new Vector3(...(frame?.position ?? [0, 0, 0])),
    new Quaternion(x, y, z, w),
    new Vector3(1, 1, 1),
  );
  return new Vector3().setFromMatrixPosition(linkMatrix(poses, link).multiply(own));
}
