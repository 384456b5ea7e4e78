/** Shows the configurations, paths and obstacles that a program sends: `urdd view --follow`, Python, or any other. */

import type { App } from "./app";
import type { RobotModel } from "./model";
import { misfit, take } from "./shown";
import type { Showing } from "./showing";

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
          const wrong = take(app, robot, JSON.parse(line) as Showing);
          if (wrong !== null && wrong !== refused) {
            refused = wrong;
            app.note(misfit(robot, wrong));
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
