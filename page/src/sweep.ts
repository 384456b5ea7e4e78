/** Moves a joint through its limits and back. */

import type { App } from "./app";

/** Maximum speeds, rad/s and m/s, unless the joint's limit is lower; and the minimum duration, s. */
const SPEED = { rad: Math.PI / 4, m: 0.1 };
const SHORTEST = 4;

export class Sweep {
  /** The DOF that is moving. */
  private moving: number | null = null;
  private turn = 0;

  constructor(private readonly app: App) {}

  /** Begins, until something else moves the robot. A second call for the same DOF stops it. */
  toggle(dof: number): void {
    const turn = ++this.turn;
    if (this.moving === dof) {
      this.moving = null;
      return;
    }
    const { robot, q } = this.app.store.now;
    const found = robot?.dofs[dof];
    const [lower, upper] = found?.bounds ?? [-Math.PI, Math.PI];
    this.moving = dof;
    const start = performance.now();
    const first = q[dof] ?? 0;
    const middle = (lower + upper) / 2;
    const half = (upper - lower) / 2 || 1;
    const phase = Math.asin(Math.max(-1, Math.min(1, (first - middle) / half)));
    const own = robot?.joints[found?.joint ?? -1]?.limit?.velocity ?? Infinity;
    const speed = Math.min(SPEED[found?.unit ?? "rad"], own > 0 ? own : Infinity);
    const time = 1000 * Math.max(SHORTEST, (2 * Math.PI * half) / speed);
    let last = q;
    const step = async (now: number): Promise<void> => {
      if (turn !== this.turn) return;
      const share = Math.min(1, Math.max(0, now - start) / time);
      if (this.app.store.now.q === last) {
        await this.app.setDof(dof, share < 1 ? middle + half * Math.sin(phase + 2 * Math.PI * share) : first);
        if (turn !== this.turn) return;
        last = this.app.store.now.q;
        if (share < 1) {
          requestAnimationFrame((now) => void step(now));
          return;
        }
      }
      this.moving = null;
    };
    requestAnimationFrame((now) => void step(now));
  }
}
