/** The WebAssembly modules, which the code of the npm package speaks to. */

import { Urdd } from "../../../wasm/npm/module.mjs";

export type { Urdd };

/** Compiles a module of this address, or of these bytes. */
export async function compiled(source: BufferSource | Promise<Response>): Promise<WebAssembly.Module> {
  if (!(source instanceof Promise)) return WebAssembly.compile(source);
  const response = await source;
  if (!response.ok) throw new Error(`the engine (${response.url}) cannot be loaded: status ${response.status}`);
  // Some file servers do not send `application/wasm`, which streaming requires.
  const streams = response.headers.get("content-type") === "application/wasm";
  return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

export async function started(module: WebAssembly.Module): Promise<Urdd> {
  const urdd = await Urdd.of(module);
  urdd.noMemory = "not enough memory for this robot";
  // A number that is not finite is the module's to refuse: here, a RangeError stands for a crash.
  urdd.write = JSON.stringify;
  return urdd;
}

/** The content of files, which are closed. The browser keeps it outside of the page's memory. */
export function contents(module: Urdd, files: number): { path: string; file: Blob }[] {
  const { changed } = changes(module, files, 0);
  module.closeFiles(files);
  return changed;
}

/** The paths of files, and the content of those that others of before do not have. */
export function changes(
  module: Urdd,
  files: number,
  before: number,
): { paths: string[]; changed: { path: string; file: Blob }[] } {
  const paths = module.list(files).files.map(({ path }) => path);
  const changed = before === 0 ? paths : module.changed(files, before);
  return { paths, changed: changed.map((path) => ({ path, file: new Blob([module.read(files, path)]) })) };
}
