/** Follows the files on disk: asks each second whether those of the open robot changed, and reads it again. */

import type { App } from "./app";

const PERIOD = 1000;
const GONE = "gone";

export function follow(app: App): void {
  let known: { id: string; revision: string } | null = null;
  let lost = false;
  const look = async (): Promise<void> => {
    const { robot } = app.store.now;
    if (robot?.source.kind !== "url") return;
    const { entry } = robot;
    const revision = await app.site.revision(entry);
    const before = known;
    known = { id: entry.id, revision };
    app.revision = known;
    if (lost) app.note("The server is back.");
    lost = false;
    if (before?.id !== entry.id || before.revision === revision || app.store.now.robot !== robot) return;
    if (revision === GONE) {
      app.note("The files of this robot are gone. What is shown is what was there.");
      return;
    }
    app.note("The files changed: the robot is read again.");
    await app.open(entry, await app.site.source(entry), true);
    if (app.store.now.tab === "Findings") void app.loadReport();
  };
  const again = (): void => {
    look()
      .catch(() => {
        if (!lost) app.note("`urdd view` does not answer: changes on disk are not seen.");
        lost = true;
      })
      .finally(() => {
        setTimeout(again, PERIOD);
      });
  };
  again();
}
