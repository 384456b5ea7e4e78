/** Follows `urdd view`: whether it answers, whether the files of the open robot changed, and what programs send to show. */

import type { App } from "./app";
import type { RobotModel } from "./model";
import type { Showing } from "./showing";
import { Gone, Refused } from "./site";
import type { State } from "./state";
import { Trajectory } from "./trajectory";
import { fill, h } from "./ui/dom";
import { lines, count } from "./ui/format";

/** Pauses between polls, ms. Whoever edits a URDF waits for the picture. */
const PERIOD = 1000;
const PERIOD_OF_URDF = 300;
const GONE = "gone";

/** Polls the server. */
export function follow(app: App): void {
  const states = new States(app);
  /** The last change that was reported to the user. */
  let told: string | null = null;
  const look = async (): Promise<void> => {
    const { robot, server, loading } = app.store.now;
    // A missing token is reported elsewhere.
    if (app.site.token === null) return;
    if (robot?.source.kind !== "url") {
      const entries = await app.site.robots();
      app.store.set({ server: "here" });
      // Others may have opened or dropped robots.
      if (!robot && !loading && !same(entries, app.store.now.entries)) app.store.set({ entries });
      return;
    }
    const { revision, entry } = await app.site.revision(robot.entry);
    app.store.set({ server: "here" });
    if (server !== "here") app.note("`urdd view` is back.");
    if (app.store.now.robot !== robot || app.revision === null || app.isWriting) return;
    if (entry.follows) states.follow(robot);
    const { making, failure } = entry;
    const { failure: before } = app.store.now.making;
    if (!same(app.store.now.making, { making, failure })) app.store.set({ making: { making, failure } });
    if (failure !== before) void app.renewReport();
    // The files may have been read with what was said of them before they were whole.
    const isStale = robot.entry.making !== null && making === null && failure === null;
    if (revision === app.revision && !isStale) return;
    if (revision === told && (!isStale || app.store.now.skips.dirty)) return;
    told = revision;
    const { temporary } = robot.entry;
    if (revision === GONE) {
      app.note("The files of this robot are gone. The page shows the last version.");
    } else if (app.store.now.skips.dirty) {
      app.note(
        temporary
          ? "The URDF changed. Your decisions on skips stay here: take them back to see the new robot."
          : "The files changed on disk. Your edits of skips stay here, but cannot be saved.",
      );
    } else {
      await app.reopen(entry);
      // The rest of a robot comes after its picture without a change.
      if (!temporary) app.note("The files changed: the robot was reloaded.");
      else if (making) app.note("The URDF or its meshes changed: this is the new robot.");
    }
  };
  const again = (): void => {
    look()
      .catch((error: unknown) => {
        const server: State["server"] = error instanceof Refused ? "another" : error instanceof Gone ? "gone" : "here";
        app.store.set({ server });
      })
      .finally(() => setTimeout(again, app.store.now.robot?.entry.temporary ? PERIOD_OF_URDF : PERIOD));
  };
  again();
}

function same(a: unknown, b: unknown): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

/** A line that says that the URDF cannot be generated any more, and why. */
export function brokenLine(app: App): HTMLElement {
  const line = h("div", { class: "broken", role: "alert" });
  app.store.on(["making", "robot", "server"], ({ making: { failure, stopped }, robot, server }) => {
    // Whoever stops it knows.
    line.hidden = failure === null || stopped === true || robot === null || server !== "here";
    const text = failure === null ? "" : `The page shows the last version that could be read. ${failure}`;
    const shown = lines(text);
    if (line.textContent !== shown) fill(line, shown);
  });
  return line;
}

/** A line that says that the server ended, and what to do. */
export function serverLine(app: App): HTMLElement {
  const line = h("div", { class: "server", role: "alert" });
  app.store.on(["server", "skips"], ({ server, skips, robot }) => {
    line.hidden = server === "here";
    const what =
      server === "gone"
        ? "`urdd view` has ended. The page stays, but cannot save, and does not see changes on disk. Start it again, and open the address that it prints."
        : "Another `urdd view` has replaced the one of this page. Open the address that it printed, or paste it into this tab.";
    const more = skips.dirty && robot ? " Decisions on skips are not saved: note them before you leave this page." : "";
    const text = server === "here" ? "" : what + more;
    if (line.textContent !== text) fill(line, text);
  });
  return line;
}

/** Pause before another attempt to connect, ms. */
const PAUSE = 1000;

/**
 * What a program sends of the open robot: `urdd view --follow`, Python, or any other. Follows it while its window is visible: browsers allow few connections to a server, in all windows
 * together.
 */
class States {
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

/** Shows what a program sends. Returns the number of values of a configuration that is not one of this robot; null if all are. */
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
