/** The pointer in the picture. */

import type { App } from "./app";
import { Latest } from "./latest";
import { dragJoint, pull } from "./scene/drag";
import type { Drag, Solve } from "./scene/drag";
import { pick } from "./scene/pick";
import type { Stage } from "./stage";
import { name } from "./ui/format";

/** Maximum movement of the pointer during a click, pixels. */
const STILL = 4;

export class Hand {
  private drag: Drag | null = null;
  private down: { x: number; y: number; link: number | null; moved: boolean } | null = null;
  private readonly follow: Latest<{ x: number; y: number; drag: Drag }>;
  private readonly under: Latest<{ x: number; y: number }>;

  constructor(
    private readonly app: App,
    private readonly stage: Stage,
  ) {
    const { canvas } = stage.view;
    this.follow = new Latest(async ({ x, y, drag }) => {
      const q = await drag.to(stage.view.ray(x, y).ray, app.store.now.q);
      if (q && drag.isSolved) app.move(q);
      else if (q) await app.reach(q);
    });
    this.under = new Latest(({ x, y }) => {
      this.hover(x, y);
      return new Promise((resolve) => requestAnimationFrame(() => resolve()));
    });
    canvas.addEventListener("pointerdown", (event) => this.press(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.release(event));
    canvas.addEventListener("pointercancel", (event) => this.release(event));
    canvas.addEventListener("pointerleave", () => {
      if (!this.down) app.hover(null);
    });
    canvas.addEventListener("dblclick", () => stage.look("fit"));
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0 || this.stage.gizmo.isHeld) return;
    const { robot, poses } = this.app.store.now;
    const { scene, view } = this.stage;
    if (!robot || !scene) return;
    const picked = pick(view, scene, event.clientX, event.clientY);
    this.down = { x: event.clientX, y: event.clientY, link: picked?.of.link ?? null, moved: false };
    this.drag = null;
    if (picked && poses && robot.moves) {
      const { link } = picked.of;
      const eye = view.camera.position;
      const solve: Solve = (question) => this.app.solve(question);
      const joint = robot.moving(link);
      if (event.shiftKey) this.drag = pull(poses, link, robot.pulledBy(link), picked.point, eye, solve);
      else if (joint !== null) {
        this.drag =
          dragJoint(robot, poses, joint, picked.point, eye) ??
          pull(poses, link, robot.dofsOf(joint), picked.point, eye, solve);
      }
    }
    if (this.drag) {
      // The camera is fixed while a joint is dragged.
      view.controls.enabled = false;
      view.canvas.setPointerCapture(event.pointerId);
    }
  }

  private move(event: PointerEvent): void {
    const { down } = this;
    if (down && Math.hypot(event.clientX - down.x, event.clientY - down.y) > STILL) down.moved = true;
    if (down?.moved && this.drag) this.follow.ask({ x: event.clientX, y: event.clientY, drag: this.drag });
    else if (!down && event.buttons === 0) this.under.ask({ x: event.clientX, y: event.clientY });
  }

  private release(event: PointerEvent): void {
    const { down } = this;
    this.down = null;
    this.drag = null;
    this.stage.view.controls.enabled = true;
    if (this.stage.view.canvas.hasPointerCapture(event.pointerId)) {
      this.stage.view.canvas.releasePointerCapture(event.pointerId);
    }
    if (down && !down.moved && event.type === "pointerup") {
      const { measure, scene, view } = this.stage;
      const picked = measure.isOn && scene ? pick(view, scene, event.clientX, event.clientY) : null;
      if (picked) measure.take(picked);
      else this.app.select(down.link === null ? null : { kind: "link", index: down.link });
    }
  }

  private hover(x: number, y: number): void {
    const { scene, view } = this.stage;
    const { robot } = this.app.store.now;
    const picked = scene && robot ? pick(view, scene, x, y) : null;
    const link = picked?.of.link ?? null;
    const joint = link !== null && robot ? robot.moving(link) : null;
    this.app.hover(
      link === null ? null : joint === null ? { kind: "link", index: link } : { kind: "joint", index: joint },
    );
    view.canvas.style.cursor = joint === null ? "" : "grab";
    view.canvas.title = link === null || !robot ? "" : name(robot.nameOf(link));
  }
}
