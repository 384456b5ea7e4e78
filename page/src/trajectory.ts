/** Trajectories from files: CSV, or a JSON list or object on each line, as `urdd check-collisions` reads configurations. */

import type { Engine } from "./engine/client";
import type { Dof, Sample } from "./engine/protocol";
import { count, name, message } from "./ui/format";

/** Maximum number of rows and of bytes. */
const MAX_ROWS = 1_000_000;
const MAX_BYTES = 256 * 2 ** 20;
/** Rows a second, of a file without times. */
const RATE = 30;
/** Names of a column of times, unless a DOF has them. */
const TIME = ["time", "t", "time_from_start"];

export class Trajectory {
  constructor(
    readonly name: string,
    /** Seconds from the first row, ascending. */
    readonly times: Float64Array,
    private readonly values: Float64Array,
    private readonly dofs: number,
    /** Of samples: the largest errors of the poses of each row, m and rad. */
    readonly errors: readonly { position: number; angle: number }[] = [],
  ) {}

  get duration(): number {
    return this.times.at(-1) ?? 0;
  }

  row(at: number): number[] {
    return [...this.values.subarray(at * this.dofs, (at + 1) * this.dofs)];
  }

  value(row: number, dof: number): number {
    return this.values[row * this.dofs + dof] ?? 0;
  }

  /** The last row that is not later than a time. */
  before(time: number): number {
    let [low, high] = [0, this.times.length - 1];
    if ((this.times[high] ?? 0) <= time) return high;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if ((this.times[middle] ?? 0) <= time) low = middle;
      else high = middle;
    }
    return low;
  }

  /** The configuration at a time, on a straight line between the rows before and after it. */
  at(time: number): number[] {
    const low = this.before(time);
    const high = Math.min(low + 1, this.times.length - 1);
    const [from, to] = [this.times[low] ?? 0, this.times[high] ?? 0];
    const part = to > from ? Math.min(1, Math.max(0, (time - from) / (to - from))) : 1;
    const end = this.row(high);
    return this.row(low).map((value, dof) => value + part * ((end[dof] ?? value) - value));
  }
}

export async function trajectoryOf(file: File, dofs: readonly Dof[], zero: readonly number[]): Promise<Trajectory> {
  if (file.size > MAX_BYTES) throw new Error(`${name(file.name)} is larger than 256 MiB: show a part of it.`);
  const reader = new Reader(dofs, zero);
  const text = await file.text();
  let number = 0;
  for (let from = 0; from < text.length; number++) {
    const end = text.indexOf("\n", from);
    const line = text.slice(from, end < 0 ? undefined : end);
    try {
      reader.take(line);
    } catch (error) {
      const why = message(error);
      throw new Error(`${name(file.name)}, line ${number + 1}: ${why}`, { cause: error });
    }
    from += line.length + 1;
  }
  return reader.end(name(file.name));
}

class Reader {
  private readonly values: number[] = [];
  private readonly times: number[] = [];
  private rows = 0;
  private form: "json" | "csv" | null = null;
  /** For each column of CSV its DOF, or -1 for the time. */
  private columns: number[] | null = null;

  constructor(
    private readonly dofs: readonly Dof[],
    private readonly zero: readonly number[],
  ) {}

  take(line: string): void {
    const text = line.trim();
    if (text === "" || (this.form !== "json" && text.startsWith("#"))) return;
    this.form ??= /^[[{]/.test(text) ? "json" : "csv";
    if (this.form === "json") this.json(JSON.parse(text));
    else this.csv(text.split(",").map((field) => field.trim().replace(/^"(.*)"$/, "$1")));
  }

  end(file: string): Trajectory {
    if (this.rows === 0) throw new Error(`${file} has no configuration.`);
    const timed = this.times.length > 0;
    const first = this.times[0] ?? 0;
    const times = Float64Array.from({ length: this.rows }, (_, k) => (timed ? (this.times[k] ?? 0) - first : k / RATE));
    return new Trajectory(file, times, Float64Array.from(this.values), this.dofs.length);
  }

  private json(value: unknown): void {
    if (Array.isArray(value)) {
      this.row(value, null);
      return;
    }
    if (typeof value !== "object" || value === null) throw new Error("neither a list nor an object");
    const q = [...this.zero];
    let time: unknown = null;
    for (const [key, number] of Object.entries(value)) {
      const dof = this.dof(key);
      if (dof >= 0) q[dof] = number as number;
      else time = number;
    }
    this.row(q, time);
  }

  private csv(fields: string[]): void {
    if (this.columns === null) {
      const isHead = fields.every((field) => field === "" || Number.isNaN(Number(field)));
      if (isHead) {
        this.columns = fields.map((field) => this.dof(field));
        const missing = this.dofs.find((_, dof) => !this.columns?.includes(dof));
        if (missing) throw new Error(`the column for the DOF ${name(missing.name)} is missing`);
        if (new Set(this.columns).size < fields.length) throw new Error("two columns have one name");
        return;
      }
      const own = this.dofs.map((_, dof) => dof);
      this.columns = fields.length === own.length + 1 ? [-1, ...own] : own;
    }
    const { columns } = this;
    if (fields.length !== columns.length)
      throw new Error(`${count(fields.length, "value")}, where ${columns.length} are expected`);
    const q = [...this.zero];
    let time: unknown = null;
    for (const [column, dof] of columns.entries()) {
      const field = fields[column] ?? "";
      const value = field === "" ? NaN : Number(field);
      if (dof >= 0) q[dof] = value;
      else time = value;
    }
    this.row(q, time);
  }

  /** The DOF of a name, or -1 for the time. */
  private dof(key: string): number {
    const dof = this.dofs.findIndex((one) => one.name === key);
    if (dof >= 0 || TIME.includes(key.toLowerCase())) return dof;
    throw new Error(`this robot has no DOF ${name(key)}`);
  }

  private row(q: unknown[], time: unknown): void {
    if (q.length !== this.dofs.length)
      throw new Error(`${count(q.length, "value")}; this robot has ${count(this.dofs.length, "DOF")}`);
    for (const value of q) {
      if (typeof value !== "number" || !Number.isFinite(value)) throw new Error("a value is not a finite number");
      this.values.push(value);
    }
    if (time !== null) {
      if (typeof time !== "number" || !Number.isFinite(time)) throw new Error("a time is not a finite number");
      if (this.times.length !== this.rows) throw new Error("a time, where other rows have none");
      if (time < (this.times.at(-1) ?? -Infinity)) throw new Error("the time goes back");
      this.times.push(time);
    } else if (this.times.length > 0) throw new Error("no time, where other rows have one");
    if (++this.rows > MAX_ROWS) throw new Error("more than a million configurations: show a part of them");
  }
}

/** Seconds from a sample to the next one. */
const PER_SAMPLE = 0.7;

/** The stored kinematics samples as a trajectory, with the error of the poses at each. */
export async function samplesOf(engine: Engine, dofs: number): Promise<Trajectory> {
  const { samples } = await engine.ask("samples", {});
  if (samples.length === 0) throw new Error("the list is empty");
  const errors: { position: number; angle: number }[] = [];
  for (const sample of samples)
    errors.push(difference(await engine.ask("linkPoses", { q: sample.configuration }), sample));
  const times = Float64Array.from(samples, (_, k) => k * PER_SAMPLE);
  const values = Float64Array.from(samples.flatMap(({ configuration }) => configuration));
  return new Trajectory("Samples", times, values, dofs, errors);
}

/** The largest difference of positions (m) and of rotations (rad). */
function difference(poses: Float64Array, sample: Sample): { position: number; angle: number } {
  let [position, angle] = [0, 0];
  sample.link_poses.forEach((pose, link) => {
    const get = (k: number): number => poses[7 * link + k] ?? NaN;
    position = Math.max(position, Math.hypot(...pose.position.map((x, k) => x - get(k))));
    const q = pose.quaternion_wxyz;
    const signs = q.reduce((sum, x, k) => sum + x * get(3 + k), 0) < 0 ? -1 : 1;
    const apart = Math.hypot(...q.map((x, k) => x - signs * get(3 + k)));
    angle = Math.max(angle, 4 * Math.asin(Math.min(1, apart / 2)));
  });
  return { position, angle };
}
