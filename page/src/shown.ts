/** Shows what a program sends. */

import type { App } from "./app";
import type { RobotModel } from "./model";
import type { Showing } from "./showing";
import { Trajectory } from "./trajectory";
import { count } from "./ui/format";

/** Shows it. Returns the number of values of a configuration that is not one of this robot; null if all are. */
export function take(app: App, robot: RobotModel, { q, world, path }: Showing): number | null {
  const { length } = robot.dofs;
  const wrong = [...(q ? [q] : []), ...(path?.rows ?? [])].find((row) => row.length !== length);
  if (wrong) return wrong.length;
  if (world) app.store.set({ world });
  if (q) app.follow(q);
  if (path !== undefined) {
    const made =
      path && new Trajectory("path", Float64Array.from(path.times), Float64Array.from(path.rows.flat()), length);
    app.store.set({ path: made });
  }
  return null;
}

/** What is said of configurations of another robot. */
export function misfit(robot: RobotModel, values: number): string {
  return `A program sends ${count(values, "value")}; this robot has ${count(robot.dofs.length, "DOF")}.`;
}
