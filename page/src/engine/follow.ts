/** The way from one configuration toward another with closed loops. */

import type { ClosedLoops, Loops } from "./protocol";

/** How far a DOF moves in one step, rad or m. */
const STEP = 0.1;
const MAX_STEPS = 64;

/** The nearest closed configuration, where these DOFs keep their values. */
type Close = (q: number[], held: number[]) => ClosedLoops;

/**
 * Goes toward `to` in small steps, so that the robot stays on its branch of closed configurations. What does not follow goes
 * straight: the DOFs that differ, or of these only the independent ones if several differ. Where it cannot go on, the last
 * closed configuration is the answer, or the one with the smallest gaps if there is none.
 */
export function follow({ independent }: Loops, from: number[], to: number[], close: Close): ClosedLoops {
  const changed = to.flatMap((value, dof) => (value === from[dof] ? [] : [dof]));
  const free = changed.filter((dof) => independent.includes(dof));
  const held = changed.length === 1 || free.length === 0 ? changed : free;
  const way = held.map((dof) => (to[dof] ?? 0) - (from[dof] ?? 0));
  const farthest = Math.max(0, ...way.map(Math.abs));
  const steps = Math.min(MAX_STEPS, Math.max(1, Math.ceil(farthest / STEP)));
  let last: ClosedLoops | null = null;
  let at = from;
  // Of a step that is too long, half is tried.
  let done = 0;
  let step = 1 / steps;
  while (done < 1 && step > 1e-3 / steps) {
    const part = Math.min(1, done + step);
    const next = at.slice();
    held.forEach((dof, k) => (next[dof] = (from[dof] ?? 0) + part * (way[k] ?? 0)));
    const found = close(next, held);
    if (found.is_closed) {
      last = found;
      at = found.configuration;
      done = part;
    } else if (last) step /= 2;
    else return close(next, []);
  }
  return last ?? close(to, held);
}
