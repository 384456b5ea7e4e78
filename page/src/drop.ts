/** Folders and files that are dropped or selected: a URDD, descriptions with the files that they may name, or such files. */

import type { RobotSource } from "./engine/client";

/** A file that was dropped, was in a .zip, or was made. */
export interface Given {
  path: string;
  file: Blob;
  /** Whether nobody knows the folder that it belongs into: it was dropped by itself, or later. */
  isLost?: boolean;
}

export function lost(given: Given): Given {
  return { ...given, isLost: true };
}

export function sizeOf(files: readonly Given[]): number {
  return files.reduce((sum, { file }) => sum + file.size, 0);
}

// Files by the endings of their names: `tests/program/file_types.rs` compares the lists with the program's. The worker's bundle
// has none of these expressions, since they are pure.

/** Files that may be a description; whether one is, its content says. */
const DESCRIBING = ["urdf", "xacro", "xml", "sdf", "mjcf", "world", "usd", "usda", "usdc", "usdz"];
/** Meshes, and what they reference. */
const OF_MESHES = [
  "stl",
  "dae",
  "obj",
  "gltf",
  "glb",
  "ply",
  "msh",
  "mtl",
  "bin",
  "png",
  "jpg",
  "jpeg",
  "tga",
  "bmp",
  "dds",
  "gif",
  "tif",
  "tiff",
  "webp",
  "hdr",
  "exr",
  "ktx2",
  "ppm",
  "pgm",
];
/** What says more of a robot, or of a folder. */
const BESIDE = ["srdf", "yaml", "yml", "toml", "config"];
/** Files that say what their folder is. */
const MANIFESTS = ["package.xml", "model.config"];

function ending(...endings: readonly string[][]): RegExp {
  return new RegExp(`\\.(?:${endings.flat().join("|")})$`, "i");
}

export const MAY_DESCRIBE = /* @__PURE__ */ ending(DESCRIBING);
/** A description, and the files that it or a mesh may name. */
const OF_ROBOT = /* @__PURE__ */ ending(DESCRIBING, OF_MESHES, BESIDE);
const IS_XACRO = /* @__PURE__ */ ending(["xacro"]);
export const IS_ZIP = /* @__PURE__ */ ending(["zip"]);

const SAYS_WHAT = /* @__PURE__ */ ending(["urdf", "xacro"], BESIDE);

/** Whether a file says what its folder is, or what a robot is: its place is known. */
export function hasPlace(path: string): boolean {
  return SAYS_WHAT.test(path) || MANIFESTS.includes(path.split("/").pop() ?? path);
}

/** Maximum number of files and bytes: at most those of the program (`tests/program/file_types.rs`). */
const MAX_FILES = 50_000;
const MAX_BYTES = 1_000_000_000;
/** Maximum number of files around descriptions: that of the program. */
const MAX_DESCRIBED = 20_000;

/** Throws if there are too many files or bytes. */
export function check(files: number, bytes: number): void {
  if (files > MAX_FILES)
    throw new Error(`These are more than ${MAX_FILES.toLocaleString("en")} files. Drop the folder of one robot.`);
  if (bytes > MAX_BYTES)
    throw new Error("These files have more than 1 GB, too much for a browser. Use `urdd view` on this machine.");
}

/** Throws if descriptions have too many files around them. */
function checkDescribed(files: number): void {
  if (files > MAX_DESCRIBED)
    throw new Error(
      `These are more than ${MAX_DESCRIBED.toLocaleString("en")} files of robots. Drop the folder of one robot.`,
    );
}

const IS_URDD =
  /^(?:urdd\.json|(?:mesh_modules\/|link_shapes_modules\/|bevy_modules\/)?[a-z0-9_]+_module\/module\.json)$/;

/** The highest folder that looks like a URDD. */
function urddFolder(paths: readonly string[]): string | undefined {
  const roots = new Set<string>();
  for (const path of paths) {
    const parts = path.split("/");
    const depth = parts.findIndex((_, depth) => IS_URDD.test(parts.slice(depth).join("/")));
    if (depth >= 0) roots.add(parts.slice(0, depth).join("/"));
  }
  const names = [...roots].sort((a, b) => a.length - b.length || (a < b ? -1 : 1));
  return names.find((name) => !names.some((other) => other !== name && name.startsWith(`${other}/`)));
}

/** Whether an archive is one of a URDD, which is in its root or in a top-level folder. */
export function isUrddArchive(paths: readonly string[]): boolean {
  const folder = urddFolder(paths);
  return folder !== undefined && !folder.includes("/");
}

/** How a USD begins that is a text. */
export const USD_TEXT = "#usda";
/** Bytes that are looked at of a file whose name says nothing. */
const HEAD = 256;

/** A robot that can be opened; descriptions that robots are made of; or files without a description. */
export type Taken =
  RobotSource | { kind: "description"; files: Given[]; hasXacro: boolean } | { kind: "files"; files: Given[] };

/** What a drop needs: who unpacks a .zip, and whether it is still wanted. */
interface Hands {
  unzip: (zip: Blob) => Promise<Given[] | null>;
  signal: AbortSignal;
}

export type Taking = (hands: Hands) => Promise<Taken>;

/** The files of a drop. Call it during the event: afterwards its entries are gone. */
export function dropped(transfer: DataTransfer): Taking {
  const entries = [...transfer.items].flatMap((item) => item.webkitGetAsEntry() ?? []);
  const files = [...transfer.files];
  return async (hands) => {
    if (!entries.some((entry) => entry.isDirectory)) return ofFiles(files, hands);
    const all: Given[] = [];
    for (const entry of entries) {
      const found = await walk(entry, hands.signal);
      all.push(...(entry.isFile ? found.map(lost) : found));
    }
    return ofFolder(all);
  };
}

/** The files of a file dialog. */
export function chosen(files: File[], folder: boolean): Taking {
  if (!folder) return (hands) => ofFiles(files, hands);
  return () => Promise.resolve(ofFolder(files.map((file) => ({ path: file.webkitRelativePath || file.name, file }))));
}

/** A file beside the page. */
export function beside(path: string): Taking {
  return async (hands) => {
    const response = await fetch(path, { signal: hands.signal });
    if (!response.ok) throw new Error(`${path}: the site answered ${response.status}`);
    const name = path.split("/").pop() ?? path;
    return ofFiles([new File([await response.blob()], name)], hands);
  };
}

async function walk(root: FileSystemEntry, signal: AbortSignal): Promise<Given[]> {
  const found: Given[] = [];
  let bytes = 0;
  const waiting: { entry: FileSystemEntry; path: string }[] = [{ entry: root, path: root.name }];
  for (let next = waiting.pop(); next; next = waiting.pop()) {
    const { entry, path } = next;
    signal.throwIfAborted();
    if (entry.isFile) {
      const file = await new Promise<File>((resolve, reject) => {
        (entry as FileSystemFileEntry).file(resolve, reject);
      });
      found.push({ path, file });
      bytes += file.size;
      check(found.length, bytes);
    } else {
      const reader = (entry as FileSystemDirectoryEntry).createReader();
      for (;;) {
        const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
        if (some.length === 0) break;
        for (const child of some) waiting.push({ entry: child, path: `${path}/${child.name}` });
      }
    }
  }
  return found;
}

/** `begun` are files that begin as a description does, whatever their names. */
function ofFolder(all: Given[], begun: readonly Given[] = []): Taken {
  check(all.length, sizeOf(all));
  const root = urddFolder(all.flatMap(({ path, isLost }) => (isLost ? [] : path)));
  if (root === undefined) return ofDescription(all, begun);
  const prefix = root === "" ? "" : `${root}/`;
  const inside = all.filter(({ path }) => path.startsWith(prefix));
  const files = inside.map(({ path, file }) => ({ path: path.slice(prefix.length), file }));
  return { kind: "local", name: root.split("/").pop() ?? "robot", files };
}

function ofDescription(all: Given[], begun: readonly Given[]): Taken {
  const named = all.filter(({ path }) => OF_ROBOT.test(path) && !/(?:^|\/)\./.test(path));
  const files = [...named, ...begun];
  checkDescribed(files.length);
  if (begun.length === 0 && !files.some(({ path }) => MAY_DESCRIBE.test(path))) return { kind: "files", files };
  return { kind: "description", files, hasXacro: files.some(({ path }) => IS_XACRO.test(path)) };
}

async function ofFiles(files: File[], { unzip }: Hands): Promise<Taken> {
  const [first] = files;
  if (!first) throw new Error("Nothing was dropped. Drop a URDF, the folder of a URDD, or a .zip of it.");
  const all: Given[] = [];
  const begun: Given[] = [];
  for (const file of files) {
    const given = lost({ path: file.name, file });
    if (!OF_ROBOT.test(file.name) && (await beginsAsDescription(file))) {
      begun.push(given);
      continue;
    }
    if (!IS_ZIP.test(file.name)) {
      all.push(given);
      continue;
    }
    if (file.size > MAX_BYTES)
      throw new Error("This archive has more than 1 GB, too much for a browser. Use `urdd view` on this machine.");
    const inside = await unzip(file);
    if (!inside) return { kind: "zip", name: file.name.replace(IS_ZIP, ""), bytes: await file.arrayBuffer() };
    all.push(...inside);
  }
  return ofFolder(all, begun);
}

/** Whether a file begins as XML or USD do: what it is, the module finds. */
async function beginsAsDescription(file: Blob): Promise<boolean> {
  return /^\s*(?:<|#usda |PXR-USDC)/.test(await file.slice(0, HEAD).text());
}
