/** The module that makes robots: descriptions in, URDDs and files of other programs out. It tells of progress. */

import { encoded, WasmModule } from "../engine/wasm";
import type { Exports } from "../engine/wasm";
import type { Progress } from "../engine/link";
import type { Report } from "../engine/protocol";
import type { Description, Exported, Imported, Made, MakeOptions } from "./protocol";

interface MakeExports extends Exports {
  urdd_files_put: (files: number, path: number, length: number, data: number, size: number) => void;
  urdd_files_lost: (files: number, path: number, length: number) => void;
  urdd_descriptions: (files: number) => number;
  urdd_lint: (files: number, question: number, length: number) => number;
  urdd_generate: (files: number, donor: number, question: number, length: number) => number;
  urdd_import: (files: number, question: number, length: number) => number;
  urdd_export: (files: number, question: number, length: number) => number;
}

export class MakeModule extends WasmModule<MakeExports> {
  /** `tell` is told of progress, and `content` gives the content of a file that was named. */
  static async of(
    module: WebAssembly.Module,
    tell: (progress: Progress) => void,
    content: (path: string) => Uint8Array,
  ): Promise<MakeModule> {
    const used: { made: MakeModule | null } = { made: null };
    const progress = (at: number, length: number): void => {
      if (used.made) tell(JSON.parse(used.made.text(at, length)) as Progress);
    };
    const read = (at: number, length: number): number =>
      used.made ? used.made.lent(content(used.made.text(at, length))) : 0;
    const instance = await WebAssembly.instantiate(module, { urdd: { progress, read } });
    used.made = new MakeModule(instance.exports as unknown as MakeExports);
    return used.made;
  }

  /** The address of an answer with these bytes; 0 if there is no memory for it. */
  private lent(bytes: Uint8Array): number {
    const at = this.exports.urdd_alloc(bytes.length + 5) >>> 0;
    if (at === 0) return 0;
    const { buffer } = this.exports.memory;
    new DataView(buffer).setUint32(at, bytes.length + 1, true);
    const answer = new Uint8Array(buffer, at + 4, bytes.length + 1);
    answer[0] = 1;
    answer.set(bytes, 1);
    return at;
  }

  /** States that nobody knows where a file belongs; that names may lead out of the files, without a path. */
  lose(files: number, path: string): void {
    this.with([encoded(path)], ([at, length]) => this.exports.urdd_files_lost(files, at, length));
  }

  /** Sets the content of a file, in place of any that it had. */
  put(files: number, path: string, bytes: Uint8Array): void {
    this.with([encoded(path), bytes], ([at, length, data, size]) =>
      this.exports.urdd_files_put(files, at, length, data, size),
    );
  }

  descriptions(files: number): Description[] {
    return this.json(this.exports.urdd_descriptions(files)) as Description[];
  }

  lint(files: number, urdf: string): Report {
    return this.asked(files, { urdf, with_text: true }, this.exports.urdd_lint) as Report;
  }

  generate(files: number, donor: number, question: { path: string } & MakeOptions): Made {
    const ask = (files: number, at: number, length: number): number =>
      this.exports.urdd_generate(files, donor, at, length);
    return this.asked(files, question, ask) as Made;
  }

  imported(files: number, path: string): Imported {
    return this.asked(files, { path }, this.exports.urdd_import) as Imported;
  }

  exported(files: number, question: { format: string; output: string; actuators: string | null }): Exported {
    return this.asked(files, question, this.exports.urdd_export) as Exported;
  }

  private asked(files: number, question: unknown, ask: (files: number, at: number, length: number) => number): unknown {
    return this.with([encoded(JSON.stringify(question))], ([at, length]) => this.json(ask(files, at, length)));
  }
}
