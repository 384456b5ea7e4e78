/** A robot that this page makes of a description: at first what the picture needs, then its pieces, then all. */

import { message } from "../app";
import type { Report } from "../engine/protocol";
import type { RobotSource } from "../engine/calls";
import type { Progress } from "../engine/link";
import { unknown } from "../model";
import type { Entry } from "../model";
import type { Maker } from "./kit";
import type { Description, Given, MakeOptions } from "./protocol";
import type { Reader } from "./reader";

/** What is made, one after another; each stage takes from the last what did not change. */
const STAGES: readonly MakeOptions[] = [
  { modules: ["plain_meshes"] },
  { modules: ["convex_hull_meshes", "convex_decomposition_meshes"] },
  {},
];
/** Minimum time between two reports of progress, ms. */
const PERIOD = 100;

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

  /** Whether it is being made. */
  get isRunning(): boolean {
    return this.entry.making !== null;
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
    if (this.isRunning || failure !== null) this.set({ making: null, failure, stopped });
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
