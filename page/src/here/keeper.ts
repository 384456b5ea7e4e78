/** Who has the robots that this page makes: the site asks it as it asks a server. */

import type { Report } from "../engine/protocol";
import type { RobotSource } from "../engine/calls";
import type { Entry } from "../model";

export interface Keeper {
  /** The robots. */
  entries(): Entry[];
  source(entry: Entry): RobotSource;
  report(entry: Entry): Promise<Report>;
  /** How far it is. Asking begins to make it. */
  state(entry: Entry): Entry;
}
