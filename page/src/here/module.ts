/** The module that makes robots: descriptions in, URDDs and files of other programs out. It tells of progress. */

import { encoded, WasmModule } from "../engine/wasm";
import type { Exports } from "../engine/wasm";
import type { Progress } from "../engine/link";
import type { Report } from "../engine/protocol";
import type { Description, Exported, Imported, Made, MakeOptions } from "./protocol";

interface MakeExports extends Exports {
  urdd_files_put: (files: number, path: number, length: number, data: number, size: number) => void;
  urdd_files_of_any_zip: (zip: number, length: number) => number;
  urdd_descriptions: (files: number) => number;
  urdd_lint: (files: number, question: number, length: number) => number;
  urdd_generate: (files: number, donor: number, question: number, length: number) => number;
  urdd_import: (files: number, question: number, length: number) => number;
  urdd_export: (files: number, question: number, length: number) => number;
}

export class MakeModule extends WasmModule<MakeExports> {
  static async of(module: WebAssembly.Module, tell: (progress: Progress) => void): Promise<MakeModule> {
    const told: { made: MakeModule | null } = { made: null };
    const progress = (at: number, length: number): void => {
      if (told.made) tell(JSON.parse(told.made.text(at, length)) as Progress);
    };
    const instance = await WebAssembly.instantiate(module, { urdd: { progress } });
    told.made = new MakeModule(instance.exports as unknown as MakeExports);
    return told.made;
  }

  /** Sets the content of a file, in place of any that it had. */
  put(files: number, path: string, bytes: Uint8Array): void {
    this.with([encoded(path), bytes], ([at, length, data, size]) =>
      this.exports.urdd_files_put(files, at, length, data, size),
    );
  }

  /** The files of any .zip. */
  unzipped(zip: Uint8Array): number {
    const made = this.with([zip], ([at, length]) => this.json(this.exports.urdd_files_of_any_zip(at, length)));
    return (made as { files: number }).files;
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

  exported(files: number, question: { format: string; output: string }): Exported {
    return this.asked(files, question, this.exports.urdd_export) as Exported;
  }

  private asked(files: number, question: unknown, ask: (files: number, at: number, length: number) => number): unknown {
    return this.with([encoded(JSON.stringify(question))], ([at, length]) => this.json(ask(files, at, length)));
  }
}
