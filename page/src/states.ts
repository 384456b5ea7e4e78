/** Shows the configurations that a program sends: `urdd view --follow`, `shown.set(q)` in Python, or any other. */

import type { App } from "./app";
import type { RobotModel } from "./model";
import { count } from "./ui/format";

/** Pause before another attempt to connect, ms. */
const PAUSE = 1000;

/**
 * Follows the open robot while its window is visible: browsers allow few connections to a server, in all windows
 * together.
 */
export class States {
  private robot: RobotModel | null = null;
  private stopping = new AbortController();

  constructor(private readonly app: App) {
    document.addEventListener("visibilitychange", () => {
      const { robot } = this;
      this.stop();
      if (robot) this.follow(robot);
    });
  }

  /** Follows a robot to which a program sends configurations. */
  follow(robot: RobotModel): void {
    if (this.robot === robot && !this.stopping.signal.aborted) return;
    this.stop();
    this.robot = robot;
    if (document.hidden) return;
    this.stopping = new AbortController();
    void this.listen(robot, this.stopping.signal);
  }

  private stop(): void {
    this.stopping.abort();
    this.robot = null;
  }

  private async listen(robot: RobotModel, signal: AbortSignal): Promise<void> {
    const { app } = this;
    let refused = -1;
    while (!signal.aborted && app.store.now.robot === robot) {
      try {
        for await (const line of app.site.states(robot.entry, signal)) {
          if (app.store.now.robot !== robot) break;
          const { q } = JSON.parse(line) as { q: number[] };
          if (q.length === robot.dofs.length) app.follow(q);
          else if (q.length !== refused) {
            refused = q.length;
            const has = count(robot.dofs.length, "DOF");
            app.note(`A program sends ${count(q.length, "value")}; this robot has ${has}.`);
          }
        }
      } catch {
        // The server ended, or the robot is another one: the poll tells.
      }
      await new Promise((resolve) => setTimeout(resolve, PAUSE));
    }
    if (this.robot === robot) this.stop();
  }
}
