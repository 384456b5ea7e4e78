/** The picture. It follows the state. */

import { Vector3 } from "three";
import type { Box3 } from "three";
import type { App } from "./app";
import { Beside } from "./comparing";
import type { RobotModel } from "./model";
import { absent } from "./panels/absent";
import { chooseOther, comparison } from "./panels/comparison";
import { pairOf, same as samePair } from "./panels/proximity";
import { Closings } from "./scene/closings";
import { Gizmo, GIZMOS } from "./scene/gizmo";
import { Ground } from "./scene/ground";
import { load, rimColor } from "./scene/layers";
import { Measure } from "./scene/measure";
import { Names } from "./scene/names";
import { Obstacles } from "./scene/obstacles";
import { Overlays } from "./scene/overlays";
import { prepare } from "./scene/pick";
import { looks, Ghosts, RobotScene } from "./scene/robot";
import { Segment } from "./scene/segment";
import { View } from "./scene/view";
import { drawnLayers, ghosted, LAYERS } from "./state";
import type { LayerKind, State } from "./state";
import { button, h } from "./ui/dom";
import { message, length } from "./ui/format";
import { color } from "./ui/theme";

const DIRECTIONS = {
  fit: null,
  front: new Vector3(1, 0, 0.12),
  side: new Vector3(0, -1, 0.12),
  top: new Vector3(0, -0.001, 1),
} as const;

const HANDLES = {
  translate: { text: "Move", title: "Move the selected link by handles; the joints above it follow (G)" },
  rotate: { text: "Turn", title: "Turn the selected link by handles; the joints above it follow (G)" },
};

const START = new Vector3(1, -0.75, 0.45);

/** By how much a robot may grow or shrink before the camera is set anew. */
const MUCH = 3;

/** Whether the camera and the ground for one box are right for another one, as of a robot that was edited. */
function isAlike(box: Box3, other: Box3): boolean {
  const [size, before] = [box, other].map((one) => one.getSize(new Vector3()).length());
  const share = (size ?? 0) / (before ?? 0);
  return share < MUCH && share > 1 / MUCH && box.intersectsBox(other);
}

export class Stage {
  readonly element: HTMLElement;
  readonly view: View;
  readonly gizmo: Gizmo;
  scene: RobotScene | null = null;
  private readonly ground = new Ground();
  private readonly overlays = new Overlays();
  readonly obstacles = new Obstacles();
  private readonly names: Names;
  private readonly closings: Closings;
  private readonly witness: Segment;
  readonly measure: Measure;
  private readonly beside: Beside;
  private readonly ghosts = new Ghosts();
  private readonly scale = h("span", {});
  private readonly progress = h("div", { class: "progress", role: "progressbar", hidden: true });
  private model: RobotModel | null = null;
  /** Size of the robot, metres. */
  private size = 1;
  /** The camera for the next robot; null to fit all of it. */
  from: number[] | null = null;
  /** The robot that is shown, and the one that the camera was set for, with its box then. */
  private showing: string | null = null;
  private lookedAt: { id: string; box: Box3 } | null = null;
  /** Milliseconds from the page's start to the first complete picture. */
  firstPicture: number | null = null;
  /** The robot that is completely drawn, with the camera set. */
  settledOn: RobotModel | null = null;
  /** Called then. */
  settled: () => void = () => undefined;

  constructor(private readonly app: App) {
    const canvas = h("canvas", { id: "picture", tabindex: "0", "aria-label": "The robot" });
    const views = h("div", { class: "views" });
    for (const key of ["fit", "front", "side", "top"] as const) {
      const text = key.charAt(0).toUpperCase() + key.slice(1);
      views.append(button(text, { class: "quiet" }, () => this.look(key)));
    }
    this.view = new View(canvas);
    this.names = new Names(this.view);
    this.closings = new Closings(this.view);
    const howto = h(
      "p",
      { class: "howto" },
      this.scale,
      h("span", { class: "moving" }, "Drag a joint to move it · shift-drag a link to pull it · space: play samples"),
    );
    this.witness = new Segment(this.view);
    this.measure = new Measure(app, this.view, () => this.size);
    this.element = h(
      "div",
      { class: "stage" },
      canvas,
      this.names.element,
      this.closings.labels,
      this.witness.label,
      this.measure.segment.label,
      h("div", { class: "over" }, views, absent(app), comparison(app)),
      howto,
      this.progress,
    );
    this.view.follow(this.element);
    this.beside = new Beside(
      app,
      this.view,
      () => this.scene?.bounds() ?? null,
      () => {
        this.look("fit");
        const box = this.scene?.bounds().union(this.beside.bounds());
        if (box) this.ground.under(box);
      },
    );
    this.gizmo = new Gizmo(app, this.view);
    const handles = GIZMOS.map((kind) => {
      const made = button(HANDLES[kind].text, { "aria-pressed": "false", title: HANDLES[kind].title }, () => {
        this.gizmo.use(this.gizmo.kind === kind ? null : kind);
        if (this.gizmo.kind && !app.store.now.selected) app.note("Select a link to move it by handles.");
      });
      return [kind, made] as const;
    });
    this.gizmo.changed = () => {
      for (const [kind, button] of handles) button.setAttribute("aria-pressed", String(this.gizmo.kind === kind));
    };
    const measure = button(
      "Measure",
      { "aria-pressed": "false", title: "Click two points: how far apart they are" },
      () => this.measure.use(!this.measure.isOn),
    );
    this.measure.changed = () => measure.setAttribute("aria-pressed", String(this.measure.isOn));
    views.append(h("span", { class: "gap" }), ...handles.map(([, button]) => button), measure, chooseOther(app));
    app.store.on(["robot"], ({ robot }) => {
      // What is in front of an empty picture is not behind it for the Tab key.
      this.element.inert = robot === null;
      views.hidden = !robot;
      howto.hidden = !robot;
      howto.classList.toggle("still", !robot?.moves);
      for (const [, button] of handles) button.hidden = !robot?.moves;
    });
    this.view.scene.add(this.ground.group, this.overlays.group, this.closings.group, this.ghosts.group);
    this.view.scene.add(this.witness.group, this.measure.segment.group, this.obstacles.group);
    this.listen();
  }

  look(key: keyof typeof DIRECTIONS): void {
    const { selected } = this.app.store.now;
    const only = key === "fit" && selected?.kind === "link" ? new Set([selected.index]) : undefined;
    const box = this.scene?.bounds(only);
    if (box && !only) box.union(this.beside.bounds()).union(this.obstacles.bounds(box, this.size));
    if (box) this.view.fit(box, DIRECTIONS[key] ?? undefined);
    if (box && !only) this.view.lightUp(box);
  }

  private listen(): void {
    const { store } = this.app;
    const theme = (): void => {
      this.view.background(color("--stage"));
      this.ground.color(color("--grid"), color("--grid-strong"));
      this.obstacles.color(color("--obstacle"));
      rimColor(color("--rim"));
      this.dress(store.now);
    };
    addEventListener("urdd-theme", theme);
    theme();
    store.on(["robot"], ({ robot }) => this.take(robot));
    store.on(["poses"], ({ poses, robot, loops }) => {
      if (!poses || !robot) return;
      this.scene?.pose(poses);
      this.overlays.pose(poses);
      this.names.pose(poses);
      this.closings.pose(poses, loops, this.size);
      this.view.castShadows();
      this.view.invalidate();
    });
    store.on(["ghosts", "layers", "hidden", "faults"], ({ ghosts }) => {
      this.ghosts.show(this.scene, ghosts, [color("--accent"), color("--mark")]);
      this.view.invalidate();
    });
    store.on(["world"], ({ world }) => {
      this.obstacles.show(world);
      if (this.settledOn && world.length > 0) this.look("fit");
      this.view.castShadows();
      this.view.invalidate();
    });
    store.on(["layers", "pair", "shapes", "tab"], () => void this.fill());
    store.on(
      [
        "layers",
        "hidden",
        "overlays",
        "selected",
        "hovered",
        "pair",
        "report",
        "painted",
        "byPart",
        "faults",
        "contacts",
        "tab",
        "compared",
      ],
      (state) => this.dress(state),
    );
    // What a colour changes casts the same shadow.
    store.on(["layers", "hidden", "overlays", "pair", "tab", "faults"], () => this.view.castShadows());
    store.on(["overlays", "frameSize", "selected", "robot", "units"], (state) => this.over(state));
    store.on(["proximity", "pair", "tab", "units"], (state) => {
      const { answer } = state.proximity;
      const pair = ghosted(state);
      const found = answer?.nearest.find((at) => samePair(pair, pairOf(at))) ?? null;
      const [from, to] = found?.points ?? [];
      const touching = (found?.distance ?? 1) <= 0;
      const text = touching ? "in contact" : length(found?.distance ?? 0);
      const points = from && to && ([new Vector3(...from), new Vector3(...to)] as const);
      this.witness.show(points ? { points, text, alarming: touching } : null, this.size);
    });
    store.on(["loading"], ({ loading, robot }) => {
      if (!loading && !robot) this.retire();
      this.progress.hidden = !loading;
      this.progress.style.setProperty("--share", String(loading && loading.of > 0 ? loading.done / loading.of : 0));
    });
  }

  /** The last version of a robot that is reloaded: visible until the new one is. */
  private former: RobotScene | null = null;

  private retire(): void {
    this.former?.dispose();
    this.former = null;
  }

  /** Shows another robot, or none. */
  private take(robot: RobotModel | null): void {
    const isReload = robot === null ? this.app.store.now.loading !== null : robot.entry.id === this.showing;
    if (this.scene) {
      this.retire();
      this.former = this.scene;
    }
    if (!isReload) this.retire();
    this.scene = null;
    this.overlays.clear();
    this.model = robot;
    this.view.invalidate();
    if (!robot) {
      // The camera stays while the same robot is reloaded.
      if (!this.app.store.now.loading) this.showing = this.lookedAt = null;
      this.names.show([]);
      this.closings.make(null, false);
      return;
    }
    this.scene = new RobotScene(robot.links.length);
    this.busy = new Set();
    this.view.scene.add(this.scene.root);
    const { poses } = this.app.store.now;
    if (poses) this.scene.pose(poses);
    this.showing = robot.entry.id;
    // A robot that was dropped has no name to be known by.
    if (robot.entry.id === "") this.lookedAt = null;
    void this.fill();
  }

  /** Loads the visible layers. */
  private async fill(): Promise<void> {
    const { scene, model, busy } = this;
    const layers = drawnLayers(this.app.store.now);
    if (!scene || !model) return;
    for (const layer of LAYERS) {
      if (!layers[layer].on || scene.has(layer) || busy.has(layer)) continue;
      busy.add(layer);
      await this.one(layer, scene, model);
      busy.delete(layer);
      if (scene !== this.scene) return;
    }
    // Another call may still be loading: the last one ends it.
    if (busy.size > 0) return;
    this.retire();
    if (this.settledOn === model) return;
    this.settle(scene, model.entry.id);
    this.settledOn = model;
    this.app.settled();
    this.settled();
  }

  /** The layers of the present scene that are loading. */
  private busy = new Set<LayerKind>();

  private async one(layer: LayerKind, scene: RobotScene, model: RobotModel): Promise<void> {
    const { store, engine } = this.app;
    let faults: string[];
    try {
      faults = await load(layer, scene, model, engine, ({ what, done, of }) => {
        if (scene !== this.scene) return;
        store.set({ loading: { what, done, of } });
      });
    } catch (error) {
      faults = [message(error)];
    }
    if (scene !== this.scene) {
      scene.dispose();
      return;
    }
    store.set({ faults: new Map(store.now.faults).set(layer, faults), loading: null });
    this.view.invalidate();
    prepare(scene);
  }

  /** Sets the camera and the ground once the robot is visible, unless they are right for it. */
  private settle(scene: RobotScene, id: string): void {
    const box = scene.bounds();
    if (this.from === null && this.lookedAt?.id === id && isAlike(box, this.lookedAt.box)) return;
    this.lookedAt = { id, box };
    const side = box.getSize(new Vector3());
    this.size = Math.max(side.x, side.y, side.z, 1e-3);
    this.ground.under(box);
    this.view.lightUp(box);
    this.over(this.app.store.now);
    this.view.fit(box.clone().union(this.obstacles.bounds(box, this.size)), START);
    if (this.from) this.place(this.from);
    this.from = null;
    requestAnimationFrame(() => {
      this.firstPicture ??= performance.now();
    });
  }

  private over({ robot, overlays, frameSize, selected, poses, loops }: State): void {
    this.ground.group.visible = overlays.grid;
    this.scale.textContent = overlays.grid ? `A square of the ground: ${length(this.ground.step)}` : "";
    if (robot && this.scene) {
      const link = selected?.kind === "link" ? selected.index : null;
      this.overlays.make(robot, overlays, this.size, frameSize ?? this.frameSize, link);
      const named = overlays.frames && overlays.names ? robot.links.map(({ name }, index) => ({ name, index })) : [];
      // The selected link is always named.
      this.closings.make(robot, overlays.loops);
      this.names.show(named.sort((a, b) => Number(b.index === link) - Number(a.index === link)));
      if (poses) {
        this.overlays.pose(poses);
        this.names.pose(poses);
        this.closings.pose(poses, loops, this.size);
      }
    }
    this.view.invalidate();
  }

  /** The default length of frames' axes, metres. */
  get frameSize(): number {
    return this.size * 0.07;
  }

  /** Colours and opacities. */
  private dress(state: State): void {
    if (!state.robot || !this.scene) return;
    this.scene.show(drawnLayers(state), state.hidden, state.overlays.wireframe, looks(state));
    this.view.invalidate();
  }

  /** Sets the camera: its position and target. */
  place(camera: number[]): void {
    this.view.camera.position.fromArray(camera, 0);
    this.view.controls.target.fromArray(camera, 3);
    this.view.controls.update();
    this.view.invalidate();
  }
}
