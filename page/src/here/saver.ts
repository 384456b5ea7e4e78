/** Saves what the page made of a description, by workers of their own. */

import { offer } from "../ui/offer";
import { ofText } from "./draft";
import type { Draft } from "./draft";
import { ACTUATORS } from "./formats";
import type { Format } from "./formats";
import type { Kit } from "./kit";
import type { MadeRobot } from "./made";
import type { Given } from "./protocol";

export class Saver {
  constructor(
    private readonly kit: Kit,
    private readonly open: () => { robot: MadeRobot; draft: Draft | null },
    private readonly textSaved: () => void,
  ) {}

  /** The URDD as a .zip, with these files in place of its own. */
  async urdd(edited: readonly { path: string; text: string }[]): Promise<void> {
    const { robot } = this.open();
    const { name } = robot.entry;
    const texts = new Map(edited.map(({ path, text }) => [path, new Blob([text])]));
    const files = robot.files.map(({ path, file }) => ({ path: `${name}/${path}`, file: texts.get(path) ?? file }));
    offer(await this.pack(files), `${name}_urdd.zip`);
    robot.isSaved = true;
  }

  /** The text as it is now. */
  text(): Promise<void> {
    const draft = ofText(this.open().draft);
    if (draft) {
      offer(new Blob([draft.text], { type: "application/xml" }), draft.path.split("/").pop() ?? draft.path);
      this.textSaved();
    }
    return Promise.resolve();
  }

  /** The URDF, with meshes, that an MJCF, SDF or USD becomes. */
  async urdf(): Promise<void> {
    const { robot } = this.open();
    const maker = await robot.reader.worker();
    try {
      const { files } = await maker.ask("import", { path: robot.description.path });
      await this.offered(files, `${robot.entry.name}_urdf`);
    } finally {
      maker.end();
    }
  }

  /** Files for another program. Returns what is otherwise there. */
  async exported({ word, ending }: Format, kind: string): Promise<string[]> {
    const { robot } = this.open();
    const { name } = robot.entry;
    const output = (name.replace(/[^\p{L}\p{N}_-]+/gu, "_") || "robot") + ending;
    const actuators = ACTUATORS.find((one) => one === kind) ?? null;
    const ask = { urdd: robot.files, format: word, output, actuators };
    const made = await this.kit.once((maker) => maker.ask("export", ask));
    await this.offered(made.files, `${name}_${word}`);
    return made.notes;
  }

  /** One file as it is, several as a .zip. The names of two formats differ. */
  private async offered(files: Given[], name: string): Promise<void> {
    const [one, ...more] = files;
    if (one && more.length === 0) offer(one.file, name + (/\.[^./]+$/.exec(one.path)?.[0] ?? ""));
    else offer(await this.pack(files), `${name}.zip`);
  }

  private pack(files: Given[]): Promise<Blob> {
    return this.kit.once((maker) => maker.ask("zip", { files }));
  }
}
