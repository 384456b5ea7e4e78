/** The memory of a WebAssembly module of ours, and files in it: bytes in, JSON or bytes out. */

export interface Exports {
  memory: WebAssembly.Memory;
  urdd_alloc(length: number): number;
  urdd_free(pointer: number, length: number): void;
  urdd_free_answer(pointer: number): void;
  urdd_files_new(name: number, length: number): number;
  urdd_files_name(files: number, path: number, length: number, size: number): void;
  urdd_files_give(files: number, path: number, length: number, data: number, size: number): void;
  urdd_files_list(files: number): number;
  urdd_files_read(files: number, path: number, length: number): number;
  urdd_files_close(files: number): void;
}

export interface Listed {
  name: string;
  files: { path: string; size: number }[];
}

const NO_MEMORY = "not enough memory for this robot";
const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** A text as the module takes it. */
export function encoded(text: string): Uint8Array {
  return encoder.encode(text);
}

/** Compiles a module of this address, or of these bytes. */
export async function compiled(source: BufferSource | Promise<Response>): Promise<WebAssembly.Module> {
  if (!(source instanceof Promise)) return WebAssembly.compile(source);
  const response = await source;
  if (!response.ok) throw new Error(`the engine (${response.url}) cannot be loaded: status ${response.status}`);
  // Some file servers do not send `application/wasm`, which streaming requires.
  const streams = response.headers.get("content-type") === "application/wasm";
  return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

export class WasmModule<E extends Exports> {
  protected constructor(protected readonly exports: E) {}

  newFiles(name: string): number {
    return this.with([encoded(name)], ([at, length]) => this.exports.urdd_files_new(at, length));
  }

  nameFile(files: number, path: string, size: number): void {
    this.with([encoded(path)], ([at, length]) =>
      this.exports.urdd_files_name(files, at, length, Math.min(size, 0xffffffff)),
    );
  }

  giveFile(files: number, path: string, bytes: Uint8Array): void {
    this.with([encoded(path), bytes], ([at, length, data, size]) =>
      this.exports.urdd_files_give(files, at, length, data, size),
    );
  }

  list(files: number): Listed {
    return this.json(this.exports.urdd_files_list(files)) as Listed;
  }

  read(files: number, path: string): Uint8Array<ArrayBuffer> {
    return this.with([encoded(path)], ([at, length]) => this.bytes(this.exports.urdd_files_read(files, at, length)));
  }

  /** The content of files, which are closed. The browser keeps it outside of the page's memory. */
  contents(files: number): { path: string; file: Blob }[] {
    const found = this.list(files).files.map(({ path }) => ({ path, file: new Blob([this.read(files, path)]) }));
    this.closeFiles(files);
    return found;
  }

  closeFiles(files: number): void {
    if (files !== 0) this.exports.urdd_files_close(files);
  }

  /** The module's memory, bytes. */
  get memory(): number {
    return this.exports.memory.buffer.byteLength;
  }

  /** Calls with the addresses and lengths of inputs. */
  protected with<T>(inputs: Uint8Array[], call: (at: [number, number, number, number]) => T): T {
    const at: [number, number, number, number] = [0, 0, 0, 0];
    inputs.forEach((bytes, k) => {
      const place = this.exports.urdd_alloc(bytes.length) >>> 0;
      if (place === 0) throw new Error(NO_MEMORY);
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

  /** The text in the module's memory. */
  protected text(pointer: number, length: number): string {
    return decoder.decode(new Uint8Array(this.exports.memory.buffer, pointer >>> 0, length));
  }

  private answer(pointer: number): Uint8Array<ArrayBuffer> {
    const at = pointer >>> 0;
    if (at === 0) throw new Error(NO_MEMORY);
    const buffer = this.exports.memory.buffer;
    const length = new DataView(buffer).getUint32(at, true);
    const bytes = new Uint8Array(length);
    bytes.set(new Uint8Array(buffer, at + 4, length));
    this.exports.urdd_free_answer(at);
    return bytes;
  }

  protected json(pointer: number): unknown {
    const value: unknown = JSON.parse(decoder.decode(this.answer(pointer)));
    if (value !== null && typeof value === "object" && "error" in value && !("urdds" in value)) {
      throw new Error(String(value.error));
    }
    return value;
  }

  protected bytes(pointer: number): Uint8Array<ArrayBuffer> {
    const answer = this.answer(pointer);
    const rest = answer.slice(1);
    if (answer[0] === 1) return rest;
    throw new Error(decoder.decode(rest));
  }
}
