/** Plays the stored samples with the error of the poses, and sweeps joints. */

import type { App } from "./app";
import { message } from "./app";
import type { Sample } from "./engine/protocol";

const PER_SAMPLE = 700;
/** Maximum speeds of a sweep, rad/s and m/s, unless the joint's limit is lower; and its minimum duration, s. */
const SPEED = { rad: Math.PI / 4, m: 0.1 };
const SHORTEST = 4;

export class Player {
  changed: (playing: boolean) => void = () => undefined;
  private turn = 0;
  private playing = false;
  private sweeping: number | null = null;

  constructor(private readonly app: App) {}

  stop(): void {
    if (!this.playing) return;
    this.turn++;
    this.playing = false;
    this.sweeping = null;
    this.changed(false);
  }

  async toggle(): Promise<void> {
    if (this.playing) {
      this.stop();
      return;
    }
    const { robot } = this.app.store.now;
    if (!robot?.moves) return;
    const turn = this.begin();
    try {
      const { samples } = await this.app.engine.ask("samples", {});
      for (let at = 0; turn === this.turn && samples.length > 0; at = (at + 1) % samples.length) {
        const sample = samples[at];
        if (sample) await this.show(sample, at, samples.length);
        await new Promise((resolve) => setTimeout(resolve, PER_SAMPLE));
      }
    } catch (error) {
      this.app.note(`There are no samples to play: ${message(error)}`);
    }
    if (turn === this.turn) this.stop();
  }

  /** Shows a sample, and the error of its poses against the stored ones. */
  private async show(sample: Sample, at: number, of: number): Promise<void> {
    const poses = await this.app.engine.ask("linkPoses", { q: sample.configuration });
    this.app.move(sample.configuration);
    const [position, angle] = difference(poses, sample);
    this.app.store.set({ sample: { at, of, position, angle } });
  }

  /** Moves a joint through its limits and back. A second call stops it. */
  sweep(dof: number): void {
    if (this.sweeping === dof) {
      this.stop();
      return;
    }
    const { robot, q } = this.app.store.now;
    const found = robot?.dofs[dof];
    const bounds = found?.bounds;
    const [lower, upper] = bounds ?? [-Math.PI, Math.PI];
    const turn = this.begin();
    this.sweeping = dof;
    const start = performance.now();
    const first = q[dof] ?? 0;
    const middle = (lower + upper) / 2;
    const half = (upper - lower) / 2 || 1;
    const phase = Math.asin(Math.max(-1, Math.min(1, (first - middle) / half)));
    const own = robot?.joints[found?.joint ?? -1]?.limit?.velocity ?? Infinity;
    const speed = Math.min(SPEED[found?.unit ?? "rad"], own > 0 ? own : Infinity);
    const time = 1000 * Math.max(SHORTEST, (2 * Math.PI * half) / speed);
    const step = (now: number): void => {
      if (turn !== this.turn) return;
      const share = Math.min(1, Math.max(0, now - start) / time);
      this.app.setDof(dof, share < 1 ? middle + half * Math.sin(phase + 2 * Math.PI * share) : first);
      if (share < 1) requestAnimationFrame(step);
      else this.stop();
    };
    requestAnimationFrame(step);
  }

  private begin(): number {
    this.stop();
    this.playing = true;
    this.changed(true);
    return ++this.turn;
  }
}

/** The largest difference of positions (m) and of rotations (rad). */
export function difference(poses: Float64Array, sample: Sample): [number, number] {
  let [position, angle] = [0, 0];
  sample.link_poses.forEach((pose, link) => {
    const get = (k: number): number => poses[7 * link + k] ?? NaN;
    position = Math.max(position, Math.hypot(...pose.position.map((x, k) => x - get(k))));
    const q = pose.quaternion_wxyz;
    const signs = q.reduce((sum, x, k) => sum + x * get(3 + k), 0) < 0 ? -1 : 1;
    const apart = Math.hypot(...q.map((x, k) => x - signs * get(3 + k)));
    angle = Math.max(angle, 4 * Math.asin(Math.min(1, apart / 2)));
  });
  return [position, angle];
}
