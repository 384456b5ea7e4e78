/** The WebAssembly module: bytes in, JSON or bytes out. It imports nothing. */

interface Exports {
  memory: WebAssembly.Memory;
  urdd_alloc(length: number): number;
  urdd_free(pointer: number, length: number): void;
  urdd_free_answer(pointer: number): void;
  urdd_files_new(name: number, length: number): number;
  urdd_files_name(files: number, path: number, length: number, size: number): void;
  urdd_files_give(files: number, path: number, length: number, data: number, size: number): void;
  urdd_files_of_zip(name: number, nameLength: number, zip: number, length: number): number;
  urdd_zip_fault(zip: number, length: number): number;
  urdd_files_list(files: number): number;
  urdd_files_read(files: number, path: number, length: number): number;
  urdd_files_close(files: number): void;
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

const encoder = new TextEncoder();
const decoder = new TextDecoder();

export class UrddModule {
  private readonly exports: Exports;

  private constructor(instance: WebAssembly.Instance) {
    this.exports = instance.exports as unknown as Exports;
  }

  static async of(bytes: BufferSource | Promise<Response>): Promise<UrddModule> {
    if (bytes instanceof Promise) {
      const response = await bytes;
      if (!response.ok) throw new Error(`the engine (urdd.wasm) cannot be loaded: status ${response.status}`);
      // Some file servers do not send `application/wasm`, which streaming requires.
      const streams = response.headers.get("content-type") === "application/wasm";
      const { instance } = streams
        ? await WebAssembly.instantiateStreaming(response, {})
        : await WebAssembly.instantiate(await response.arrayBuffer(), {});
      return new UrddModule(instance);
    }
    const { instance } = await WebAssembly.instantiate(bytes, {});
    return new UrddModule(instance);
  }

  newFiles(name: string): number {
    return this.with([encoder.encode(name)], ([at, length]) => this.exports.urdd_files_new(at, length));
  }

  nameFile(files: number, path: string, size: number): void {
    this.with([encoder.encode(path)], ([at, length]) =>
      this.exports.urdd_files_name(files, at, length, Math.min(size, 0xffffffff)),
    );
  }

  giveFile(files: number, path: string, bytes: Uint8Array): void {
    this.with([encoder.encode(path), bytes], ([at, length, data, size]) =>
      this.exports.urdd_files_give(files, at, length, data, size),
    );
  }

  filesOfZip(name: string, zip: Uint8Array): number {
    const files = this.with([encoder.encode(name), zip], ([at, length, data, size]) =>
      this.exports.urdd_files_of_zip(at, length, data, size),
    );
    if (files === 0) {
      this.with([zip], ([at, length]) => this.json(this.exports.urdd_zip_fault(at, length)));
      throw new Error("this zip archive has no URDD");
    }
    return files;
  }

  list(files: number): { name: string; files: { path: string; size: number }[] } {
    return this.json(this.exports.urdd_files_list(files)) as ReturnType<UrddModule["list"]>;
  }

  read(files: number, path: string): Uint8Array<ArrayBuffer> {
    return this.with([encoder.encode(path)], ([at, length]) =>
      this.bytes(this.exports.urdd_files_read(files, at, length)),
    );
  }

  mesh(files: number, path: string): Uint8Array<ArrayBuffer> {
    return this.with([encoder.encode(path)], ([at, length]) => this.bytes(this.exports.urdd_mesh(files, at, length)));
  }

  validate(files: number, name: string): unknown {
    const { urdd_validate: run } = this.exports;
    if (!run) throw new Error(NO_VALIDATOR);
    return this.with([encoder.encode(name)], ([at, length]) => this.json(run(files, at, length)));
  }

  explain(code: string): unknown {
    const { urdd_explain: run } = this.exports;
    if (!run) throw new Error(NO_VALIDATOR);
    return this.with([encoder.encode(code)], ([at, length]) => this.json(run(at, length)));
  }

  openRobot(files: number): number {
    return this.exports.urdd_robot_open(files);
  }

  close(files: number, robot: number): void {
    if (robot !== 0) this.exports.urdd_robot_close(robot);
    if (files !== 0) this.exports.urdd_files_close(files);
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
    return this.with([encoder.encode(JSON.stringify(question))], ([at, length]) =>
      this.json(this.exports.urdd_robot_ask(robot, at, length)),
    );
  }

  /** The module's memory, bytes. */
  get memory(): number {
    return this.exports.memory.buffer.byteLength;
  }

  /** Calls with the addresses and lengths of inputs. */
  private with<T>(inputs: Uint8Array[], call: (at: [number, number, number, number]) => T): T {
    const at: [number, number, number, number] = [0, 0, 0, 0];
    inputs.forEach((bytes, k) => {
      const place = this.exports.urdd_alloc(bytes.length) >>> 0;
      if (place === 0) throw new Error("not enough memory for this robot");
      new Uint8Array(this.exports.memory.buffer, place, bytes.length).set(bytes);
      at[2 * k] = place;
      at[2 * k + 1] = bytes.length;
    });
    try {
      return call(at);
    } finally {
      inputs.forEach((bytes, k) => this.exports.urdd_free(at[2 * k] ?? 0, bytes.length));
    }
  }

  private answer(pointer: number): Uint8Array<ArrayBuffer> {
    const at = pointer >>> 0;
    if (at === 0) throw new Error("not enough memory for this robot");
    const buffer = this.exports.memory.buffer;
    const length = new DataView(buffer).getUint32(at, true);
    const bytes = new Uint8Array(length);
    bytes.set(new Uint8Array(buffer, at + 4, length));
    this.exports.urdd_free_answer(at);
    return bytes;
  }

  private json(pointer: number): unknown {
    const value: unknown = JSON.parse(decoder.decode(this.answer(pointer)));
    if (value !== null && typeof value === "object" && "error" in value && !("urdds" in value)) {
      throw new Error(String(value.error));
    }
    return value;
  }

  private bytes(pointer: number): Uint8Array<ArrayBuffer> {
    const answer = this.answer(pointer);
    const rest = answer.slice(1);
    if (answer[0] === 1) return rest;
    throw new Error(decoder.decode(rest));
  }
}
