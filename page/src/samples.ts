/** The stored kinematics samples as a trajectory, with the error of the poses at each. */

import type { Engine } from "./engine/client";
import type { Sample } from "./engine/protocol";
import { Trajectory } from "./trajectory";

/** Seconds from a sample to the next one. */
const PER_SAMPLE = 0.7;

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
