/** The robot that the present one is compared with: opened, moved along, and drawn beside it. */

import { Box3, Color, Vector3 } from "three";
import type { App } from "./app";
import { changesOf, sameValues, CHANGE_COLORS } from "./compared";
import type { Compared, Shapes } from "./compared";
import type { Engine, LinkMesh } from "./engine/client";
import { Latest } from "./latest";
import { RobotModel } from "./model";
import type { Entry } from "./model";
import { load } from "./scene/layers";
import { RobotScene } from "./scene/robot";
import type { View } from "./scene/view";
import { LAYERS } from "./state";
import { message, name } from "./ui/format";
import { color } from "./ui/theme";

/** Pause between polls, ms. */
const PERIOD = 300;

/** Opens the other robot, and moves it along. */
export function comparing(app: App): void {
  const { store } = app;
  let turn = 0;
  const poses = new Latest(async (q: readonly number[]) => {
    const { compared, robot } = store.now;
    if (!compared?.model.moves || !robot) return;
    const found = await compared.engine.ask("linkPoses", { q: sameValues(robot, q, compared.model) });
    const { compared: now } = store.now;
    if (now?.model === compared.model) store.set({ compared: { ...now, poses: found } });
  });
  store.on(["q"], ({ q, compared }) => {
    if (compared) poses.ask(q);
  });
  store.on(["robot", "compareWith"], () => void follow());

  async function follow(): Promise<void> {
    const { robot, compareWith, entries } = store.now;
    const { compared: before } = store.now;
    if (before?.model.entry.id === compareWith && before.now === robot) return;
    const own = ++turn;
    before?.engine.end();
    store.set({ compared: null });
    const entry = entries.find(({ id }) => id === compareWith);
    if (!robot || compareWith === null) return;
    const engine = app.engine.another();
    try {
      if (!entry) throw new Error("there is no such robot");
      const ready = await whenReady(app, entry, () => own === turn);
      const compared = ready && (await read(app, robot, ready, engine));
      if (own === turn) {
        store.set({ compared });
        poses.ask(store.now.q);
        return;
      }
    } catch (error) {
      if (own === turn) {
        store.set({ compareWith: null });
        app.note(`Cannot compare with ${name(entry?.name ?? compareWith)}: ${message(error)}`);
      }
    }
    engine.end();
  }
}

/** Polls until a robot of a URDF has something to show, which makes `urdd view` generate it. */
async function whenReady(app: App, first: Entry, isWanted: () => boolean): Promise<Entry | null> {
  for (let entry = first; ; await new Promise((resolve) => setTimeout(resolve, PERIOD))) {
    if (!isWanted()) return null;
    if (entry.ready) return entry;
    if (entry.failure !== null) throw new Error(entry.failure);
    ({ entry } = await app.site.revision(entry));
  }
}

async function read(app: App, now: RobotModel, entry: Entry, engine: Engine): Promise<Compared> {
  const source = await app.site.source(entry);
  const { about, files } = await engine.ask("open", { source });
  const model = new RobotModel(entry, source, about, files);
  const [before, after] = [await shapesOf(engine, model), await shapesOf(app.engine, now)];
  return { model, now, engine, poses: null, changes: changesOf(model, now, before, after) };
}

/** The plain meshes of each link. */
async function shapesOf(engine: Engine, model: RobotModel): Promise<Shapes> {
  const found = new Map<string, LinkMesh[]>();
  for (const [link, meshes] of (model.about.meshes.plain ?? []).entries()) {
    const paths = meshes.flatMap(({ read }) => read ?? []);
    found.set(model.nameOf(link), await engine.ask("triangles", { paths }));
  }
  return found;
}

/** Space between the robots, of the larger one's size. */
const SPACE = 0.25;

/** The other robot in the picture. */
export class Beside {
  scene: RobotScene | null = null;
  private compared: Compared | null = null;

  /** `own` is the box of the present robot, and `placed` is called when the picture has another robot, or none. */
  constructor(
    private readonly app: App,
    private readonly view: View,
    private readonly own: () => Box3 | null,
    private readonly placed: () => void,
  ) {
    app.store.on(["compared"], ({ compared }) => void this.take(compared));
    app.store.on(["layers", "selected", "overlays"], () => void this.fill());
    addEventListener("urdd-theme", () => {
      this.dress();
    });
  }

  bounds(): Box3 {
    return this.scene?.bounds() ?? new Box3();
  }

  private async take(compared: Compared | null): Promise<void> {
    const isKnown = compared?.model === this.compared?.model;
    this.compared = compared;
    if (compared?.poses) this.scene?.pose(compared.poses);
    if (isKnown) {
      this.view.castShadows();
      this.view.invalidate();
      // Without poses, there is nothing to place yet.
      if (this.scene && !this.scene.root.visible && compared?.poses) this.place();
      return;
    }
    this.scene?.dispose();
    this.scene = null;
    if (compared) {
      const scene = new RobotScene(compared.model.links.length);
      scene.root.visible = false;
      this.scene = scene;
      this.view.scene.add(scene.root);
      await this.fill();
      if (scene !== this.scene) return;
      if (this.compared?.poses) this.place();
    } else this.placed();
    this.view.castShadows();
    this.view.invalidate();
  }

  /** To the left of the present robot, as seen from the front. */
  private place(): void {
    const { scene } = this;
    const own = this.own();
    if (!scene || !own || !this.compared?.poses) return;
    scene.pose(this.compared.poses);
    scene.root.position.set(0, 0, 0);
    const box = scene.bounds();
    const [one, two] = [own.getSize(new Vector3()), box.getSize(new Vector3())];
    scene.root.position.y = own.min.y - box.max.y - SPACE * Math.max(...one.toArray(), ...two.toArray());
    scene.root.visible = true;
    this.placed();
  }

  /** Loads the layers that are drawn. */
  private async fill(): Promise<void> {
    const { scene, compared } = this;
    if (!scene || !compared) return;
    for (const layer of LAYERS) {
      if (!this.app.store.now.layers[layer].on || scene.has(layer)) continue;
      try {
        await load(layer, scene, compared.model, compared.engine, () => undefined);
      } catch (error) {
        this.app.note(message(error));
      }
      if (scene !== this.scene) {
        scene.dispose();
        return;
      }
    }
    this.dress();
  }

  private dress(): void {
    const { scene, compared } = this;
    if (!scene || !compared) return;
    const { layers, overlays, robot, selected } = this.app.store.now;
    const chosen = selected?.kind === "link" ? robot?.links[selected.index]?.name : undefined;
    const changes = new Map(compared.changes.map(({ link, change }) => [link, change]));
    const same = new Color(color("--open"));
    const tint = new Color(color("--accent"));
    scene.show(layers, new Set(), overlays.wireframe, (link) => {
      const name = compared.model.nameOf(link);
      const change = changes.get(name);
      const paint = change ? new Color(color(CHANGE_COLORS[change])) : same;
      return { tint: name === chosen ? tint : null, fade: 1, paint };
    });
    this.view.castShadows();
    this.view.invalidate();
  }
}
