/** Folders and files that are dropped or selected: a URDD, descriptions with the files that they may name, or such files. */

import type { RobotSource } from "./engine/protocol";
import type { Given } from "./here/protocol";

/** Maximum number of files and bytes. */
const MAX_FILES = 50_000;
const MAX_BYTES = 1_000_000_000;

/** The files that a description or a mesh may name. */
const OF_ROBOT =
  /\.(?:urdf|xacro|xml|sdf|mjcf|world|srdf|config|toml|ya?ml|stl|dae|obj|mtl|ply|msh|glb|gltf|bin|png|jpe?g|tga|bmp|dds|gif|tiff?|webp|hdr|exr|ktx2|ppm|pgm)$/i;
/** Files that may be a description; whether one is, its content says. */
const MAY_DESCRIBE = /\.(?:urdf|xacro|xml|sdf|mjcf|world)$/i;
const IS_XACRO = /\.xacro$/i;
/** Maximum size of the list of files in a .zip that is looked at. */
const MAX_LIST = 8 * 2 ** 20;
/** Maximum length of the comment at the end of a .zip, with the record before it. */
const ZIP_END = 22 + 0xffff;

/** A robot that can be opened; descriptions that robots are made of; or files without a description. */
export type Taken =
  RobotSource | { kind: "description"; files: Given[] | File; hasXacro: boolean } | { kind: "files"; files: Given[] };

/** The files of a drop. Call it during the event: afterwards its entries are gone. */
export function dropped(transfer: DataTransfer): () => Promise<Taken> {
  const entries = [...transfer.items].flatMap((item) => item.webkitGetAsEntry() ?? []);
  const files = [...transfer.files];
  return async () => {
    const [first] = entries;
    if (entries.length === 1 && first?.isDirectory) return ofFolder(await walk(first));
    if (entries.length > 1 && entries.some((entry) => entry.isDirectory)) {
      const all: Given[] = [];
      for (const entry of entries) all.push(...(await walk(entry)));
      return ofFolder(all);
    }
    return ofFile(files);
  };
}

/** The files of a file dialog. */
export function chosen(files: File[], folder: boolean): Promise<Taken> {
  if (!folder) return ofFile(files);
  return Promise.resolve(ofFolder(files.map((file) => ({ path: file.webkitRelativePath || file.name, file }))));
}

/** A file beside the page. */
export async function beside(path: string): Promise<Taken> {
  const response = await fetch(path);
  if (!response.ok) throw new Error(`${path}: the site answered ${response.status}`);
  const name = path.split("/").pop() ?? path;
  return ofFile([new File([await response.blob()], name)]);
}

async function walk(root: FileSystemEntry): Promise<Given[]> {
  const found: Given[] = [];
  const waiting: { entry: FileSystemEntry; path: string }[] = [{ entry: root, path: root.name }];
  for (let next = waiting.pop(); next; next = waiting.pop()) {
    const { entry, path } = next;
    if (entry.isFile) {
      const file = await new Promise<File>((resolve, reject) => {
        (entry as FileSystemFileEntry).file(resolve, reject);
      });
      found.push({ path, file });
      check(found);
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

function check(found: Given[]): void {
  const size = found.reduce((sum, { file }) => sum + file.size, 0);
  if (found.length > MAX_FILES)
    throw new Error(`This folder has more than ${MAX_FILES.toLocaleString("en")} files. Drop the folder of one robot.`);
  if (size > MAX_BYTES)
    throw new Error("This folder has more than 1 GB, too much for a browser. Use `urdd view` on this machine.");
}

const IS_URDD =
  /^(?:urdd\.json|(?:mesh_modules\/|link_shapes_modules\/|bevy_modules\/)?[a-z0-9_]+_module\/module\.json)$/;

function ofFolder(all: Given[]): Taken {
  check(all);
  // The root is the highest folder that looks like a URDD.
  const roots = new Map<string, Given[]>();
  for (const item of all) {
    const parts = item.path.split("/");
    for (let depth = 0; depth < parts.length; depth++) {
      if (IS_URDD.test(parts.slice(depth).join("/"))) {
        roots.set(parts.slice(0, depth).join("/"), []);
        break;
      }
    }
  }
  const names = [...roots.keys()].sort((a, b) => a.length - b.length || (a < b ? -1 : 1));
  const [root] = names.filter((name) => !names.some((other) => other !== name && name.startsWith(`${other}/`)));
  if (root === undefined) return ofDescription(all);
  const prefix = root === "" ? "" : `${root}/`;
  const inside = all.filter(({ path }) => path.startsWith(prefix));
  const files = inside.map(({ path, file }) => ({ path: path.slice(prefix.length), file }));
  return { kind: "local", name: root.split("/").pop() ?? "robot", files };
}

function ofDescription(all: Given[]): Taken {
  const files = all.filter(({ path }) => OF_ROBOT.test(path) && !/(?:^|\/)\./.test(path));
  if (!files.some(({ path }) => MAY_DESCRIBE.test(path))) return { kind: "files", files };
  return { kind: "description", files, hasXacro: files.some(({ path }) => IS_XACRO.test(path)) };
}

async function ofFile(files: File[]): Promise<Taken> {
  const [file] = files;
  if (!file) throw new Error("Nothing was dropped. Drop a URDF, the folder of a URDD, or a .zip of it.");
  if (!/\.zip$/i.test(file.name)) return ofDescription(files.map((file) => ({ path: file.name, file })));
  if (file.size > MAX_BYTES)
    throw new Error("This archive has more than 1 GB, too much for a browser. Use `urdd view` on this machine.");
  const names = await namesOfZip(file);
  if (/\.(?:urdf|xacro|xml|sdf|mjcf)\b/i.test(names) && !/(?:urdd|module)\.json/.test(names))
    return { kind: "description", files: file, hasXacro: /\.xacro\b/i.test(names) };
  return { kind: "zip", name: file.name.replace(/\.zip$/i, ""), bytes: await file.arrayBuffer() };
}

/**
 * The list of files at the end of a .zip, as bytes in which names are found. Empty if there is none. Only what the archive
 * is, a URDD or a description with its meshes, follows from it.
 */
async function namesOfZip(file: File): Promise<string> {
  const text = async (part: Blob): Promise<string> => new TextDecoder("latin1").decode(await part.arrayBuffer());
  const from = Math.max(0, file.size - ZIP_END);
  const end = await text(file.slice(from));
  const at = end.lastIndexOf("PK\x05\x06");
  return at < 0 ? "" : text(file.slice(Math.max(0, from + at - MAX_LIST), from + at));
}
