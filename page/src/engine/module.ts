/** The WebAssembly module that validates and moves robots. It imports nothing. */

import { compiled, encoded, WasmModule } from "./wasm";
import type { Exports } from "./wasm";

interface EngineExports extends Exports {
  urdd_files_of_zip(name: number, nameLength: number, zip: number, length: number): number;
  urdd_zip_fault(zip: number, length: number): number;
  urdd_files_of_any_zip(zip: number, length: number): number;
  urdd_mesh(files: number, path: number, length: number): number;
  /** Missing in the module of a page in one file. */
  urdd_validate?: (files: number, name: number, length: number) => number;
  urdd_explain?: (code: number, length: number) => number;
  urdd_robot_open(files: number): number;
  urdd_robot_close(robot: number): void;
  urdd_robot_link_poses_batch(robot: number, values: number, count: number): number;
  urdd_robot_ask(robot: number, question: number, length: number): number;
}

const NO_VALIDATOR = "This page has no validator: drop the robot on the page of `urdd view`.";

export class UrddModule extends WasmModule<EngineExports> {
  static async of(source: BufferSource | Promise<Response>): Promise<UrddModule> {
    const instance = await WebAssembly.instantiate(await compiled(source), {});
    return new UrddModule(instance.exports as unknown as EngineExports);
  }

  filesOfZip(name: string, zip: Uint8Array): number {
    const files = this.with([encoded(name), zip], ([at, length, data, size]) =>
      this.exports.urdd_files_of_zip(at, length, data, size),
    );
    if (files === 0) {
      this.with([zip], ([at, length]) => this.json(this.exports.urdd_zip_fault(at, length)));
      throw new Error("this zip archive has no URDD");
    }
    return files;
  }

  /** The files of any .zip. */
  unzipped(zip: Uint8Array): number {
    const made = this.with([zip], ([at, length]) => this.json(this.exports.urdd_files_of_any_zip(at, length)));
    return (made as { files: number }).files;
  }

  mesh(files: number, path: string): Uint8Array<ArrayBuffer> {
    return this.with([encoded(path)], ([at, length]) => this.bytes(this.exports.urdd_mesh(files, at, length)));
  }

  validate(files: number, name: string): unknown {
    const { urdd_validate: run } = this.exports;
    if (!run) throw new Error(NO_VALIDATOR);
    return this.with([encoded(name)], ([at, length]) => this.json(run(files, at, length)));
  }

  explain(code: string): unknown {
    const { urdd_explain: run } = this.exports;
    if (!run) throw new Error(NO_VALIDATOR);
    return this.with([encoded(code)], ([at, length]) => this.json(run(at, length)));
  }

  openRobot(files: number): number {
    return this.exports.urdd_robot_open(files);
  }

  close(files: number, robot: number): void {
    if (robot !== 0) this.exports.urdd_robot_close(robot);
    this.closeFiles(files);
  }

  /** x, y, z and the quaternion w, x, y, z of each link. */
  linkPoses(robot: number, q: number[]): Float64Array {
    const values = new Uint8Array(new Float64Array(q).buffer);
    const bytes = this.with([values], ([at]) =>
      this.bytes(this.exports.urdd_robot_link_poses_batch(robot, at, q.length)),
    );
    return new Float64Array(bytes.buffer);
  }

  ask(robot: number, question: unknown): unknown {
    return this.with([encoded(JSON.stringify(question))], ([at, length]) =>
      this.json(this.exports.urdd_robot_ask(robot, at, length)),
    );
  }
}
