/** Polls the server: whether it answers, and whether the files of the open robot changed. */

import type { App } from "./app";
import { Gone, Refused } from "./site";
import type { State } from "./state";
import { fill, h } from "./ui/dom";

const PERIOD = 1000;
const GONE = "gone";

export function follow(app: App): void {
  /** The last change that was reported to the user. */
  let told: string | null = null;
  const look = async (): Promise<void> => {
    const { robot, server } = app.store.now;
    // A missing token is reported elsewhere.
    if (app.site.token === null) return;
    if (robot?.source.kind !== "url") {
      await app.site.answers();
      app.store.set({ server: "here" });
      return;
    }
    const revision = await app.site.revision(robot.entry);
    app.store.set({ server: "here" });
    if (server !== "here") app.note("`urdd view` is back.");
    if (app.store.now.robot !== robot || app.revision === null || revision === app.revision) return;
    if (revision === told) return;
    told = revision;
    if (revision === GONE) {
      app.note("The files of this robot are gone. The page shows the last version.");
    } else if (app.store.now.skips.dirty) {
      app.note("The files changed on disk. Your edits of skips stay here, but cannot be saved.");
    } else {
      await app.reopen();
      app.note("The files changed: the robot was reloaded.");
    }
  };
  const again = (): void => {
    look()
      .catch((error: unknown) => {
        const server: State["server"] = error instanceof Refused ? "another" : error instanceof Gone ? "gone" : "here";
        app.store.set({ server });
      })
      .finally(() => setTimeout(again, PERIOD));
  };
  again();
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
