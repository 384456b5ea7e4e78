/** Opens the robot that the present one is compared with, and moves it along. */

import type { App } from "./app";
import { changesOf, sameValues } from "./compared";
import type { Compared, Shapes } from "./compared";
import type { Engine, LinkMesh } from "./engine/client";
import { Latest } from "./latest";
import { RobotModel } from "./model";
import type { Entry } from "./model";
import { message, name } from "./ui/format";

/** Pause between polls, ms. */
const PERIOD = 300;

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
    found.set(model.links[link]?.name ?? "", await engine.ask("triangles", { paths }));
  }
  return found;
}
