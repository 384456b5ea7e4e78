/** The worker: it owns the module, reads a robot's files and answers queries, one after another. */

import { decompress } from "brotli/decompress";
import { check, isUrddArchive } from "../drop";
import type { RobotSource, Calls, LinkMesh } from "./client";
import { message } from "../ui/format";
import { follow } from "./follow";
import { compiled, contents, started, serve } from "./link";
import type { Urdd, Handlers, OnProgress } from "./link";
import type { FileEntry, About, Clearances, ClosedLoops, CollisionModel, MeshPaths, ShapeKind } from "./protocol";

/** Number of files fetched at once. */
const AT_ONCE = 8;

const CLOSED = "another robot was opened";

/** The modules that a query needs. */
const MODULES = {
  about: [
    "urdf",
    "chain",
    "dof",
    "bounds",
    "loops",
    "original_meshes",
    "plain_meshes",
    "convex_hull_meshes",
    "convex_decomposition_meshes",
  ],
  shapes: ["link_shapes_approximations"],
  pairs: ["link_shapes_skips", "link_shapes_simple_skips", "link_shapes_distance_statistics"],
  model: ["self_collision_model"],
  samples: ["kinematics_samples"],
};

/** The files of one robot, and those that the module already has. */
class Store {
  private open: number | null;
  private readonly given = new Set<string>();
  private readonly faults = new Map<string, string>();
  private readonly sizes: Map<string, number>;
  private readonly local = new Map<string, Blob>();
  /** The path of a file on a site, if it differs from its name. */
  private readonly places = new Map<string, string>();

  constructor(
    private readonly module: Urdd,
    private readonly source: RobotSource,
  ) {
    if (source.kind === "zip") {
      this.open = module.zip(source.name, new Uint8Array(source.bytes));
      const listed = module.list(this.handle);
      this.sizes = new Map(listed.files.map((file) => [file.path, file.size]));
      for (const path of this.sizes.keys()) this.given.add(path);
      return;
    }
    this.open = module.files(source.name, {});
    if (source.kind === "local") {
      for (const { path, file } of source.files) this.local.set(path, file);
      this.sizes = new Map(source.files.map(({ path, file }) => [path, file.size]));
    } else {
      this.sizes = new Map(source.files.map((file) => [file.path, file.size]));
      for (const { path, at } of source.files) if (at !== undefined) this.places.set(path, at);
    }
    for (const [path, size] of this.sizes) module.name(this.handle, path, size);
  }

  /** The files in the module. A query that waited for a file may come after they are closed. */
  get handle(): number {
    if (this.open === null) throw new Error(CLOSED);
    return this.open;
  }

  /** Closes a robot of these files, and the files. */
  close(robot: number): void {
    if (robot !== 0) this.module.close(robot);
    this.module.closeFiles(this.handle);
    this.open = null;
  }

  list(): FileEntry[] {
    return [...this.sizes].map(([path, size]) => ({ path, size }));
  }

  /** The files of the modules that a query needs. */
  needed(what: keyof typeof MODULES): string[] {
    const folders = MODULES[what].map((name) => `${name}_module`);
    return [...this.sizes.keys()].filter((path) => {
      if (path === "urdd.json") return true;
      const parts = path.split("/");
      const file = parts.pop() ?? "";
      return (file === "module.json" || file === "VERSION") && folders.includes(parts.pop() ?? "");
    });
  }

  /** Why a file cannot be loaded. */
  fault(path: string): string | undefined {
    return this.faults.get(path);
  }

  /** Passes files to the module. A file that cannot be loaded is missing there; the module reports it. */
  async ensure(paths: string[], onProgress?: (done: number, of: number) => void): Promise<void> {
    const wanted = paths.filter((path) => !this.given.has(path) && this.sizes.has(path));
    const missing = paths.filter((path) => !this.sizes.has(path));
    for (const path of missing) this.faults.set(path, "there is no such file");
    const waiting = wanted.slice();
    let done = 0;
    const work = async (): Promise<void> => {
      for (let path = waiting.shift(); path !== undefined && this.open !== null; path = waiting.shift()) {
        try {
          this.module.give(this.handle, path, await this.read(path));
          this.given.add(path);
          this.faults.delete(path);
        } catch (error) {
          if (error instanceof WebAssembly.RuntimeError) throw error;
          this.faults.set(path, message(error));
        }
        onProgress?.(++done, wanted.length);
      }
    };
    await Promise.all(Array.from({ length: Math.min(AT_ONCE, wanted.length) }, work));
    if (this.open === null) throw new Error(CLOSED);
  }

  /** The bytes of a file. */
  async read(path: string): Promise<Uint8Array<ArrayBuffer>> {
    if (this.source.kind === "zip") return this.module.read(this.handle, path);
    if (this.source.kind === "local") {
      const file = this.local.get(path);
      if (!file) throw new Error("there is no such file");
      return new Uint8Array(await file.arrayBuffer());
    }
    const { base, token } = this.source;
    const url = base + (this.places.get(path) ?? path.split("/").map(encodeURIComponent).join("/"));
    const response = await fetch(url, { headers: token ? { "x-urdd-token": token } : {} });
    if (response.status === 404) throw new Error("there is no such file");
    if (!response.ok) throw new Error(`it cannot be read: the server answered ${response.status}`);
    return new Uint8Array(await response.arrayBuffer());
  }
}

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
    return { about, files: store.list() };
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

  async editSkips({ kind, edits }) {
    const { store } = opened();
    await store.ensure([...store.needed("pairs"), ...store.needed("about")]);
    return engine().ask(open(), { ask: "edit_skips", kind, edits, skipped_reasons: null }) as Calls["editSkips"][1];
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
