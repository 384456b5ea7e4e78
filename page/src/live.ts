/** Follows the files on disk: asks each second whether those of the open robot changed, and reads it again. */

import type { App } from "./app";

const PERIOD = 1000;
const GONE = "gone";

export function follow(app: App): void {
  /** The change that the person was told of. */
  let told: string | null = null;
  let lost = false;
  const look = async (): Promise<void> => {
    const { robot } = app.store.now;
    if (robot?.source.kind !== "url") return;
    const revision = await app.site.revision(robot.entry);
    if (lost) app.note("The server is back.");
    lost = false;
    if (app.store.now.robot !== robot || app.revision === null || revision === app.revision) return;
    if (revision === told) return;
    told = revision;
    if (revision === GONE) {
      app.note("The files of this robot are gone. What is shown is what was there.");
    } else if (app.store.now.skips.dirty) {
      app.note("The files changed on disk. Your decisions on skips stay here; saving them will be refused.");
    } else {
      await app.reopen();
      app.note("The files changed: the robot was read again.");
    }
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
