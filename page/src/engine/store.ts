/** The files of one robot, and those that the module already has. */

import type { Urdd } from "./module";
import type { FileEntry } from "./protocol";
import type { RobotSource } from "./calls";

/** Number of files fetched at once. */
const AT_ONCE = 8;

const CLOSED = "another robot was opened";

const ABOUT = [
  "urdf",
  "chain",
  "dof",
  "bounds",
  "loops",
  "original_meshes",
  "plain_meshes",
  "convex_hull_meshes",
  "convex_decomposition_meshes",
];
const PAIRS = ["link_shapes_skips", "link_shapes_simple_skips", "link_shapes_distance_statistics"];

const MODULES = {
  about: ABOUT,
  shapes: ["link_shapes_approximations"],
  pairs: PAIRS,
  model: ["self_collision_model"],
  samples: ["kinematics_samples"],
};

export class Store {
  readonly name: string;
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
      this.name = listed.name;
      this.sizes = new Map(listed.files.map((file) => [file.path, file.size]));
      for (const path of this.sizes.keys()) this.given.add(path);
      return;
    }
    this.open = module.files(source.name, {});
    this.name = source.name;
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
          this.faults.set(path, error instanceof Error ? error.message : String(error));
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
