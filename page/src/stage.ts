/** The picture: what is in it follows the state; the pointer selects, moves joints and pulls links. */

import { Color, Vector3 } from "three";
import type { App } from "./app";
import { message } from "./app";
import { worstOfLinks } from "./findings";
import type { RobotModel } from "./model";
import { partColor } from "./parts";
import { pairOf, same as samePair } from "./panels/proximity";
import { Gizmo, GIZMOS } from "./scene/gizmo";
import { Ground } from "./scene/ground";
import { load } from "./scene/layers";
import { Overlays } from "./scene/overlays";
import { prepare } from "./scene/pick";
import { RobotScene } from "./scene/robot";
import type { Look } from "./scene/robot";
import { View } from "./scene/view";
import { Witness } from "./scene/witness";
import { Hand } from "./hand";
import { drawnLayers, LAYERS } from "./state";
import type { LayerKind, State } from "./state";
import { h } from "./ui/dom";
import { color } from "./ui/theme";

export const DIRECTIONS = {
  fit: null,
  front: new Vector3(1, 0, 0.12),
  side: new Vector3(0, -1, 0.12),
  top: new Vector3(0, -0.001, 1),
} as const;

const HANDLES = {
  translate: { text: "Move", title: "Move the chosen link by handles; the joints above it give way (G)" },
  rotate: { text: "Turn", title: "Turn the chosen link by handles; the joints above it give way (G)" },
};

const START = new Vector3(1, -0.75, 0.45);
/** What is not looked at. */
const FADED = 0.18;

export class Stage {
  readonly element: HTMLElement;
  readonly view: View;
  readonly gizmo: Gizmo;
  scene: RobotScene | null = null;
  private readonly ground = new Ground();
  private readonly overlays = new Overlays();
  private readonly witness: Witness;
  private readonly label = h("div", { class: "witness", hidden: true });
  private readonly progress = h("div", { class: "progress", role: "progressbar", hidden: true });
  private model: RobotModel | null = null;
  private size = 1;
  /** Milliseconds from the page's start to the first whole picture. */
  firstPicture: number | null = null;
  /** The robot that is drawn whole, and looked at. */
  settledOn: RobotModel | null = null;

  constructor(private readonly app: App) {
    const canvas = h("canvas", { id: "picture", tabindex: "0", "aria-label": "The robot" });
    const views = h("div", { class: "views" });
    for (const key of ["fit", "front", "side", "top"] as const) {
      const text = key.charAt(0).toUpperCase() + key.slice(1);
      views.append(
        h(
          "button",
          {
            type: "button",
            class: "quiet",
            click: () => {
              this.look(key);
            },
          },
          text,
        ),
      );
    }
    this.element = h("div", { class: "stage" }, canvas, this.label, views, this.progress);
    this.view = new View(canvas);
    this.witness = new Witness(this.view, this.label);
    this.gizmo = new Gizmo(app, this.view);
    const handles = GIZMOS.map((kind) => {
      const button = h(
        "button",
        { type: "button", "aria-pressed": "false", title: HANDLES[kind].title },
        HANDLES[kind].text,
      );
      button.addEventListener("click", () => {
        this.gizmo.use(this.gizmo.kind === kind ? null : kind);
        if (this.gizmo.kind && !app.store.now.selected) app.note("Choose a link to move it by handles.");
      });
      return [kind, button] as const;
    });
    this.gizmo.changed = () => {
      for (const [kind, button] of handles) button.setAttribute("aria-pressed", String(this.gizmo.kind === kind));
    };
    views.append(h("span", { class: "gap" }), ...handles.map(([, button]) => button));
    app.store.on(["robot"], ({ robot }) => {
      views.hidden = !robot;
      for (const [, button] of handles) button.hidden = !robot?.moves;
    });
    this.view.scene.add(this.ground.group, this.overlays.group, this.witness.group);
    new Hand(app, this);
    this.listen();
  }

  look(key: keyof typeof DIRECTIONS): void {
    const { selected } = this.app.store.now;
    const only = key === "fit" && selected?.kind === "link" ? new Set([selected.index]) : undefined;
    const box = this.scene?.bounds(only);
    if (box) this.view.fit(box, DIRECTIONS[key] ?? undefined);
  }

  private listen(): void {
    const { store } = this.app;
    const theme = (): void => {
      this.view.background(color("--stage"));
      this.ground.color(color("--grid"), color("--grid-strong"));
      this.dress(store.now);
    };
    addEventListener("urdd-theme", theme);
    theme();
    store.on(["robot"], ({ robot }) => {
      this.take(robot);
    });
    store.on(["poses"], ({ poses, robot }) => {
      if (!poses || !robot) return;
      this.scene?.pose(poses);
      this.overlays.pose(poses);
      this.view.invalidate();
    });
    store.on(["layers", "pair", "shapes"], () => {
      void this.fill();
    });
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
        "proximity",
      ],
      (state) => {
        this.dress(state);
      },
    );
    store.on(["overlays", "selected", "robot"], (state) => {
      this.over(state);
    });
    store.on(["proximity", "pair"], ({ proximity: { answer }, pair }) => {
      const found = answer?.nearest.find((at) => samePair(pair, pairOf(at))) ?? null;
      this.witness.show(found, this.size);
    });
    store.on(["loading"], ({ loading }) => {
      this.progress.hidden = !loading;
      this.progress.style.setProperty("--share", String(loading && loading.of > 0 ? loading.done / loading.of : 0));
    });
  }

  /** Another robot, or none. */
  private take(robot: RobotModel | null): void {
    const before = this.model;
    this.scene?.dispose();
    this.scene = null;
    this.overlays.clear();
    this.model = robot;
    this.view.invalidate();
    if (!robot) return;
    this.scene = new RobotScene(robot.links.length);
    this.busy = new Set();
    this.view.scene.add(this.scene.root);
    const { poses } = this.app.store.now;
    if (poses) this.scene.pose(poses);
    void this.fill(before?.entry.id !== robot.entry.id);
  }

  /** Loads the layers that are on. */
  private async fill(look = false): Promise<void> {
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
    if (look) this.settle(scene);
    this.settledOn = model;
  }

  /** The layers of the present scene that are being loaded. */
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

  /** The camera and the ground, once there is something to see. */
  private settle(scene: RobotScene): void {
    const box = scene.bounds();
    const side = box.getSize(new Vector3());
    this.size = Math.max(side.x, side.y, side.z, 1e-3);
    this.ground.under(box);
    this.over(this.app.store.now);
    this.view.fit(box, START);
    requestAnimationFrame(() => {
      this.firstPicture ??= performance.now();
      dispatchEvent(new Event("urdd-settled"));
    });
  }

  private over({ robot, overlays, selected, poses }: State): void {
    this.ground.group.visible = overlays.grid;
    if (robot && this.scene) {
      this.overlays.make(robot, overlays, this.size, selected?.kind === "link" ? selected.index : null);
      if (poses) this.overlays.pose(poses);
    }
    this.view.invalidate();
  }

  /** Colours and opacities. */
  private dress(state: State): void {
    const { robot, hidden, overlays, selected, hovered, pair, painted, byPart, report } = state;
    const layers = drawnLayers(state);
    if (!robot || !this.scene) return;
    const tints = new Map<number, Color>();
    const tint = (link: number | null | undefined, name: string): void => {
      if (link !== null && link !== undefined) tints.set(link, new Color(color(name)));
    };
    for (const [part, own, parent] of [
      [hovered, "--hover", "--parent"],
      [selected, "--accent", "--parent"],
    ] as const) {
      if (part?.kind === "link") tint(part.index, own);
      else if (part) {
        tint(robot.joints[part.index]?.parent, parent);
        tint(robot.joints[part.index]?.child, own === "--hover" ? "--child" : own);
      }
    }
    const worst = painted ? worstOfLinks(robot, report.report) : null;
    const parts = new Map<number, Color>();
    if (byPart)
      robot.parts.forEach(({ links }, part) => {
        for (const link of links) parts.set(link, new Color(partColor(part)));
      });
    const paint = (link: number): Color | null => {
      if (!worst) return parts.get(link) ?? null;
      const name = { error: "--error", warning: "--warning", info: "--info", unverified: "--open" }[
        worst.get(link) ?? "info"
      ];
      return new Color(color(worst.has(link) ? name : report.report ? "--good" : "--open"));
    };
    const touching =
      state.proximity.answer?.nearest.some((at) => at.distance <= 0 && samePair(pair, pairOf(at))) ?? false;
    this.scene.show(layers, hidden, overlays.wireframe, (link, piece, layer): Look => {
      let fade = 1;
      let own = tints.get(link) ?? null;
      if (pair) {
        const of = pair.find(([other]) => other === link);
        const isPiece = layer === "pieces" || layer.startsWith("piece-");
        const exact = layer === state.shapes && pair.some(([other, k]) => other === link && (k === piece || !isPiece));
        fade = exact ? 1 : of ? 0.3 : FADED;
        if (exact && touching) own = new Color(color("--error"));
      }
      return { tint: own, fade, paint: paint(link) };
    });
    this.view.invalidate();
  }
}
