/** Handles that move or turn the selected link. The joints above it follow within their bounds. */

import { Object3D, Quaternion, Vector3 } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { App } from "../app";
import { Latest } from "../latest";
import { length } from "../ui/format";
import { poseOf } from "./robot";
import type { View } from "./view";

export const GIZMOS = ["translate", "rotate"] as const;
type GizmoKind = (typeof GIZMOS)[number];

/** Position error above which a target counts as out of reach, metres. */
const REACHED = 1e-4;

export class Gizmo {
  kind: GizmoKind | null = null;
  /** Called when it is switched on or off. */
  changed: () => void = () => undefined;
  private readonly target = new Object3D();
  private readonly controls: TransformControls;
  private readonly follow: Latest<{ position: Vector3; quaternion: Quaternion }>;
  private link: number | null = null;

  constructor(
    private readonly app: App,
    private readonly view: View,
  ) {
    this.controls = new TransformControls(view.camera, view.canvas);
    this.controls.size = 0.8;
    this.controls.space = "local";
    const helper = this.controls.getHelper();
    helper.visible = false;
    view.scene.add(this.target, helper);
    this.follow = new Latest(async ({ position, quaternion }) => {
      const { link } = this;
      if (link === null) return;
      const { x, y, z, w } = quaternion;
      const found = await app.solve({
        q: app.store.now.q,
        link,
        position: position.toArray(),
        quaternion_wxyz: [w, x, y, z],
      });
      app.move(found.configuration);
      if (found.position_error > REACHED) app.note(`Out of reach by ${length(found.position_error)}.`);
    });
    this.controls.addEventListener("dragging-changed", ({ value }) => {
      view.controls.enabled = value !== true;
      if (value !== true) this.place();
    });
    this.controls.addEventListener("change", () => view.invalidate());
    this.controls.addEventListener("objectChange", () =>
      this.follow.ask({ position: this.target.position.clone(), quaternion: this.target.quaternion.clone() }),
    );
    app.store.on(["selected", "robot"], ({ robot, selected }) => {
      this.link = robot?.moves ? robot.linkOf(selected) : null;
      this.place();
    });
    app.store.on(["poses"], () => {
      if (!this.controls.dragging) this.place();
    });
  }

  use(kind: GizmoKind | null): void {
    this.kind = kind;
    if (kind) this.controls.setMode(kind);
    this.place();
    this.changed();
  }

  /** Off, moving, turning, off. */
  next(): void {
    this.use([null, ...GIZMOS, null][[null, ...GIZMOS].indexOf(this.kind) + 1] ?? null);
    if (this.kind && this.link === null) this.app.note("Select a link to move it by handles.");
  }

  /** Whether the pointer is on a handle. */
  get isHeld(): boolean {
    return this.kind !== null && this.link !== null && this.controls.axis !== null;
  }

  private place(): void {
    const { poses } = this.app.store.now;
    const shown = this.kind !== null && this.link !== null && poses !== null;
    if (shown && this.link !== null) {
      poseOf(poses, this.link).decompose(this.target.position, this.target.quaternion, this.target.scale);
      this.target.updateMatrixWorld();
      this.controls.attach(this.target);
    } else {
      this.controls.detach();
    }
    this.controls.getHelper().visible = shown;
    this.view.invalidate();
  }
}
