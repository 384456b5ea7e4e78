/** Follows the files on disk: asks each second whether they changed, and opens the robot again. */

import type { App } from "./app";

const PERIOD = 1000;

export function follow(app: App): void {
  let known: Record<string, string> = {};
  let lost = false;
  const look = async (): Promise<void> => {
    try {
      const revisions = await app.site.revisions();
      const { robot } = app.store.now;
      const id = robot?.source.kind === "url" ? robot.entry.id : null;
      if (id !== null && robot && known[id] !== undefined && known[id] !== revisions[id]) {
        if (revisions[id] === "gone") app.note("The files of this robot are gone. What is shown is what was there.");
        else {
          app.note("The files changed: the robot is read again.");
          const fresh = (await app.site.robots()).find((entry) => entry.id === id) ?? robot.entry;
          await app.open(fresh, await app.site.source(fresh), true);
        }
      }
      known = revisions;
      if (lost) app.note("The server is back.");
      lost = false;
    } catch {
      if (!lost) app.note("`urdd view` does not answer: what changes on disk is not seen.");
      lost = true;
    }
    setTimeout(() => void look(), PERIOD);
  };
  void look();
}
