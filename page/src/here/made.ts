/** Robots that this page makes of descriptions: what their workers are asked, what is asked of the files of a drop, and the stages of a robot. */

import type { ExportOptions, Format, Generated, GenerateOptions } from "../../../wasm/npm/index";
import { lost, USD_TEXT } from "../drop";
import type { Given } from "../drop";
import type { RobotSource } from "../engine/client";
import { Link, compiled, Trapped } from "../engine/link";
import type { Progress } from "../engine/link";
import type { Description, Report } from "../engine/protocol";
import { unknown } from "../model";
import type { Entry } from "../model";
import { named } from "../site";
import { message } from "../ui/format";

type MakeOptions = Pick<GenerateOptions, "modules">;

export type Actuators = NonNullable<ExportOptions["actuators"]>;

/** The worker's queries and answers, by name. */
export interface MakerCalls {
  init: [{ module: WebAssembly.Module }, null];
  /** Takes files, each of which is read when it is needed. */
  take: [{ files: Given[] }, null];
  descriptions: [Record<string, never>, Description[]];
  /** Sets the content of a file that was taken. */
  put: [{ path: string; text: string }, null];
  lint: [{ path: string }, Report];
  /**
   * A URDD; what did not change is taken from the last that this worker made, or from the files of `donor` if it made none.
   * The answer has all its paths, and those `files` that are not as they were there.
   */
  generate: [
    { path: string; donor: Given[]; options: MakeOptions },
    Pick<Generated, "links" | "dofs" | "notes"> & { paths: string[]; files: Given[] },
  ];
  /** The files of the URDF that an MJCF, SDF or USD becomes. */
  import: [{ path: string }, Given[]];
  /** Files for another program, of a URDD. */
  export: [
    { urdd: Given[]; format: Format; output: string; actuators: Actuators | null },
    { notes: string[]; files: Given[] },
  ];
  /** A .zip of files. */
  zip: [{ files: Given[] }, Blob];
  /** The module's memory, bytes. */
  memory: [Record<string, never>, number];
}

type Maker = Link<MakerCalls>;

/** Workers that make robots. Their module is loaded when the first is started. */
export class Kit {
  private module: Promise<WebAssembly.Module> | null = null;

  /** A worker without files. */
  async worker(): Promise<Maker> {
    const address = new URL(named("make.wasm"), document.baseURI).href;
    this.module ??= compiled(fetch(address));
    try {
      const module = await this.module;
      return new Link<MakerCalls>(new URL(named("make.js"), document.baseURI).href, () => ({ module }));
    } catch (error) {
      // It may be there the next time.
      this.module = null;
      throw error;
    }
  }

  /** Does one job in a worker of its own. */
  async once<T>(job: (maker: Maker) => Promise<T>): Promise<T> {
    const maker = await this.worker();
    try {
      return await job(maker);
    } finally {
      maker.end();
    }
  }
}

/** What is asked of the files of a drop while robots are made: what is there, and what is wrong with it. */
export class Reader {
  /** Texts that a person changed, by path. */
  readonly changed = new Map<string, string>();
  private maker: Promise<Maker> | null = null;

  constructor(
    private readonly kit: Kit,
    public files: Given[],
  ) {}

  descriptions(): Promise<Description[]> {
    return this.ask((maker) => maker.ask("descriptions", {}));
  }

  lint(path: string): Promise<Report> {
    return this.ask((maker) => maker.ask("lint", { path }));
  }

  /** The text of a description; null of a USD that is none. */
  async text({ path, format }: Description): Promise<string | null> {
    const file = this.files.find((file) => file.path === path)?.file;
    if (format === "usd" && (await file?.slice(0, USD_TEXT.length).text()) !== USD_TEXT) return null;
    return this.changed.get(path) ?? (await file?.text()) ?? "";
  }

  /** Changes the text of a file. */
  change(path: string, text: string): void {
    this.changed.set(path, text);
    void this.maker?.then((maker) => maker.ask("put", { path, text })).catch(() => this.end());
  }

  /** Adds files, in place of those of the same path. They are found wherever they belong. */
  add(more: Given[]): void {
    const paths = new Set(more.map(({ path }) => path));
    this.files = [...this.files.filter(({ path }) => !paths.has(path)), ...more.map(lost)];
    this.end();
  }

  /** A worker that begins with these files. */
  async worker(): Promise<Maker> {
    const { files, changed } = this;
    const maker = await this.kit.worker();
    await maker.ask("take", { files });
    for (const [path, text] of changed) await maker.ask("put", { path, text });
    return maker;
  }

  end(): void {
    void this.maker?.then((maker) => maker.end()).catch(() => undefined);
    this.maker = null;
  }

  private async ask<T>(job: (maker: Maker) => Promise<T>): Promise<T> {
    this.maker ??= this.worker();
    const { maker } = this;
    try {
      return await job(await maker);
    } catch (error) {
      // The next one begins anew.
      if (error instanceof Trapped && this.maker === maker) this.maker = null;
      throw error;
    }
  }
}

/** What is made, one after another; each stage takes from the last what did not change. */
const STAGES: readonly MakeOptions[] = [
  { modules: ["plain_meshes"] },
  { modules: ["convex_hull_meshes", "convex_decomposition_meshes"] },
  {},
];
/** Minimum time between two reports of progress, ms. */
const PERIOD = 100;

/** A robot that is made of a description: at first what the picture needs, then its pieces, then all. */
export class MadeRobot {
  entry: Entry;
  /** The files of the URDD, as far as it is made. */
  files: Given[] = [];
  /** The last report; of the text as it was when it was asked for. */
  report: Promise<Report> | null = null;
  /** Whether all of it was made of the present text. */
  isWhole = false;
  /** Whether a person has it as files. */
  isSaved = false;
  private turn = 0;
  private maker: Maker | null = null;
  private toldAt = -Infinity;

  /** `changed` is called when the entry or the files changed. */
  constructor(
    id: string,
    readonly description: Description,
    readonly reader: Reader,
    private readonly changed: (robot: MadeRobot) => void,
  ) {
    this.entry = { ...unknown(description.name), id, temporary: true, ready: false, here: true };
    if (description.format === "xacro") this.entry.failure = xacro(description.path);
  }

  get source(): RobotSource {
    return { kind: "local", name: this.description.name, files: this.files };
  }

  lint(): Promise<Report> {
    this.report = this.reader.lint(this.description.path);
    return this.report;
  }

  /** Makes all of it, from the beginning. */
  async make(): Promise<void> {
    if (this.description.format === "xacro") return;
    this.stop(null);
    const turn = this.turn;
    this.isWhole = false;
    this.set({ making: { what: "files", done: 0, of: 0 }, failure: null, stopped: false });
    try {
      const maker = await this.reader.worker();
      if (turn !== this.turn) {
        maker.end();
        return;
      }
      this.maker = maker;
      const { path } = this.description;
      for (const [k, options] of STAGES.entries()) {
        const isLast = k === STAGES.length - 1;
        const tell = (progress: Progress): void => {
          if (turn === this.turn) this.tell(progress);
        };
        // Later stages find the files of the last in their worker.
        const donor = k === 0 ? this.files : [];
        const made = await maker.ask("generate", { path, donor, options }, tell);
        if (turn !== this.turn) return;
        this.files = together(this.files, made);
        this.isWhole = isLast;
        const { links, dofs, notes } = made;
        const making = isLast ? null : { what: "the rest", done: 0, of: 0 };
        this.set({ ready: true, making, failure: null, links, dofs, notes });
      }
      this.stop(null);
    } catch (error) {
      if (turn === this.turn) this.stop(message(error));
    }
  }

  /** Ends the run. `failure` says why. */
  stop(failure: string | null, stopped = false): void {
    this.turn++;
    this.maker?.end();
    this.maker = null;
    if (this.entry.making !== null || failure !== null) this.set({ making: null, failure, stopped });
  }

  /** Gives back the memory of what can be had again. */
  close(): void {
    this.stop(null);
    this.reader.end();
    this.report = null;
  }

  /** Takes the picture for its card; null gives back the last one. */
  draw(picture: Blob | null): void {
    if (this.entry.picture !== null) URL.revokeObjectURL(this.entry.picture);
    this.set({ picture: picture && URL.createObjectURL(picture) });
  }

  /** Gives back the memory of what takes seconds to make again, too. */
  forget(): void {
    this.close();
    this.files = [];
    this.isWhole = false;
    if (this.entry.ready) this.set({ ready: false });
  }

  private tell({ what, done, of }: Progress): void {
    const now = performance.now();
    if (now - this.toldAt < PERIOD) return;
    this.toldAt = now;
    this.set({ making: { what, done, of } });
  }

  private set(change: Partial<Entry>): void {
    this.entry = { ...this.entry, ...change };
    this.changed(this);
  }
}

/** The files of a URDD, of which those that are as they were are here. */
function together(before: readonly Given[], { paths, files }: { paths: string[]; files: Given[] }): Given[] {
  const known = new Map([...before, ...files].map((given) => [given.path, given]));
  return paths.flatMap((path) => known.get(path) ?? []);
}

function xacro(path: string): string {
  const file = path.split("/").pop() ?? path;
  const out = file.replace(/(?:\.urdf)?\.xacro$/i, ".urdf");
  return `${file} is a xacro file, a program, which a page does not run. Expand it with ROS's xacro and drop what comes out: \`xacro ${file} > ${out}\`. Or start \`urdd view --xacro ${file}\` on this machine.`;
}
