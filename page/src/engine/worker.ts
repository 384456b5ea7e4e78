/** The worker: it owns the module, reads files and answers queries, one after another. */

import { decompress } from "brotli/decompress";
import { check, isUrddArchive } from "../given";
import { follow } from "./follow";
import { compiled, contents, started } from "./module";
import type { Urdd } from "./module";
import { serve } from "./serve";
import type { Handlers, OnProgress } from "./serve";
import { Store } from "./store";
import type { About, Clearances, ClosedLoops, CollisionModel, MeshPaths, ShapeKind } from "./protocol";
import type { Calls, LinkMesh } from "./calls";

const NO_VALIDATOR = "This page has no validator: drop the robot on the page of `urdd view`.";

let module: Urdd | null = null;
let store: Store | null = null;
let robot = 0;
let about: About | null = null;

function engine(): Urdd {
  if (!module) throw new Error("the engine is not loaded");
  return module;
}

/** The module of a page in one file does not validate. */
function validator(): Urdd {
  if (!engine().validates) throw new Error(NO_VALIDATOR);
  return engine();
}

function opened(): { store: Store; about: About } {
  if (!store || !about) throw new Error("no robot is open");
  return { store, about };
}

function loops(about: object): unknown {
  return engine().ask(open(), { ask: "loops", about });
}

/** The robot's handle. */
function open(): number {
  if (robot === 0) throw new Error("no robot is open");
  return robot;
}

const handlers: Handlers<Calls> = {
  async init({ wasm }) {
    const source = typeof wasm === "string" ? fetch(wasm) : decompress(new Uint8Array(wasm)).slice();
    module = await started(await compiled(source));
    return null;
  },

  async open({ source }, onProgress) {
    const engineNow = engine();
    store?.close(robot);
    robot = 0;
    about = null;
    store = new Store(engineNow, source);
    await store.ensure(store.needed("about"), (done, of) => onProgress(done, of, "modules"));
    robot = engineNow.open(store.handle);
    about = engineNow.ask(robot, { ask: "about" }) as About;
    return { about, files: store.list(), folder: store.name };
  },

  linkPoses({ q }) {
    return engine().linkPosesBatch(open(), q);
  },

  random({ k }) {
    return engine().ask(open(), { ask: "random", k }) as number[];
  },

  async file({ path }) {
    return (await opened().store.read(path)).buffer;
  },

  async meshes({ kind }, onProgress) {
    const { store, about } = opened();
    const lists: MeshPaths[][] = about.meshes[kind] ?? [];
    const paths = lists.flat().flatMap((mesh) => mesh.read ?? []);
    await store.ensure(paths, (done, of) => onProgress(done, of, kind));
    return lists.flatMap((meshes, link) => meshes.map((mesh, piece) => triangles(store, link, piece, mesh.read)));
  },

  async triangles({ paths }, onProgress) {
    const { store } = opened();
    await store.ensure(paths, (done, of) => onProgress(done, of, "meshes"));
    return paths.map((path, k) => triangles(store, k, 0, path));
  },

  sources() {
    return engine().ask(open(), { ask: "sources" }) as Calls["sources"][1];
  },

  inverseKinematics(question) {
    return engine().ask(open(), { ask: "inverse_kinematics", ...question }) as Calls["inverseKinematics"][1];
  },

  loopErrors({ q }) {
    return loops({ errors: { q } }) as Calls["loopErrors"][1];
  },

  followLoops({ from, to }) {
    const known = opened().about.loops;
    if (!known) return { configuration: to, is_closed: true };
    return follow(known, from, to, (q, held) => loops({ close: { q, held } }) as ClosedLoops);
  },

  async shapes({ kind }) {
    await opened().store.ensure(opened().store.needed("shapes"));
    return engine().ask(open(), { ask: "shapes", kind }) as Calls["shapes"][1];
  },

  async proximity({ q, kind, k }, onProgress) {
    await ensureShapes(kind, onProgress);
    engine().ask(open(), { ask: "prepare", kind });
    const begin = performance.now();
    const nearest = (k: number): Calls["proximity"][1] =>
      engine().ask(open(), { ask: "proximity", q, kind, k }) as Calls["proximity"][1];
    let answer = nearest(k);
    // All contacts are reported, however many there are.
    for (let more = 4 * k; answer.nearest.length === more / 4 && (answer.nearest.at(-1)?.distance ?? 1) <= 0; more *= 4)
      answer = nearest(more);
    const ms = performance.now() - begin;
    return { ...answer, model: kind === "pieces" ? learned(q) : null, ms };
  },

  async skips({ kind }) {
    await opened().store.ensure(opened().store.needed("pairs"));
    return engine().ask(open(), { ask: "skips", kind }) as Calls["skips"][1];
  },

  async editSkips({ kind, edits, skipped_reasons }) {
    const { store } = opened();
    await store.ensure([...store.needed("pairs"), ...store.needed("about")]);
    return engine().ask(open(), { ask: "edit_skips", kind, edits, skipped_reasons }) as Calls["editSkips"][1];
  },

  async samples() {
    await opened().store.ensure(opened().store.needed("samples"));
    return engine().ask(open(), { ask: "samples" }) as Calls["samples"][1];
  },

  memory() {
    return engine().memory;
  },

  explain({ code }) {
    return validator().explain(code) as Calls["explain"][1];
  },

  async unzip({ zip }) {
    const files = engine().unzipped(new Uint8Array(await zip.arrayBuffer()));
    const { files: listed } = engine().list(files);
    if (isUrddArchive(listed.map(({ path }) => path))) return null;
    // Links in an archive may lead to one file many times.
    check(
      listed.length,
      listed.reduce((sum, { size }) => sum + size, 0),
    );
    return contents(engine(), files);
  },

  async validate({ name }, onProgress) {
    const { store } = opened();
    const all = store.list().map((file) => file.path);
    await store.ensure(all, (done, of) => onProgress(done, of, "files"));
    return validator().validate(store.handle, name) as Calls["validate"][1];
  },
};

/** Loads the data that distances of these shapes need. */
async function ensureShapes(kind: ShapeKind, onProgress: OnProgress): Promise<void> {
  const { store, about } = opened();
  await store.ensure(store.needed("pairs"));
  await store.ensure(store.needed("shapes"));
  if (kind === "pieces") await store.ensure(store.needed("model"));
  const lists = kind === "hulls" ? about.meshes.hulls : kind === "pieces" ? about.meshes.pieces : null;
  const paths = lists?.flat().flatMap((mesh) => mesh.read ?? []) ?? [];
  await store.ensure(paths, (done, of) => onProgress(done, of, kind));
}

/** The learned model's estimate; null without a model. */
function learned(q: number[]): Calls["proximity"][1]["model"] {
  try {
    const model = engine().ask(open(), { ask: "collision_model" }) as CollisionModel | null;
    return model && { ...model, ...(engine().ask(open(), { ask: "clearances", q }) as Clearances) };
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) throw error;
    return { error: (error as Error).message };
  }
}

function triangles(store: Store, link: number, piece: number, path: string | null): LinkMesh {
  if (path === null) return { link, piece, error: "it is outside of this URDD" };
  try {
    return { link, piece, ...engine().mesh(store.handle, path) };
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) throw error;
    return { link, piece, error: `${path}: ${store.fault(path) ?? (error as Error).message}` };
  }
}

// Loading of the module and opening of a robot: other queries wait for them.
serve(handlers, ["init", "open"]);
