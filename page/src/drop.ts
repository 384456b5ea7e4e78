/** Folders and archives that are dropped or selected. They are read in this browser, and never sent anywhere. */

import type { RobotSource } from "./engine/protocol";

/** Maximum number of files and bytes. */
const MAX_FILES = 50_000;
const MAX_BYTES = 1_000_000_000;

interface Dropped {
  path: string;
  file: File;
}

/** The files of a drop. Call it during the event: afterwards its entries are gone. */
export function dropped(transfer: DataTransfer): () => Promise<RobotSource> {
  const entries = [...transfer.items].flatMap((item) => item.webkitGetAsEntry() ?? []);
  const files = [...transfer.files];
  return async () => {
    const [first] = entries;
    if (entries.length === 1 && first?.isDirectory) return ofFolder(await walk(first));
    if (entries.length > 1 && entries.some((entry) => entry.isDirectory)) {
      const all: Dropped[] = [];
      for (const entry of entries) all.push(...(await walk(entry)));
      return ofFolder(all);
    }
    return ofFile(files);
  };
}

/** The files of a file dialog. */
export function chosen(files: File[], folder: boolean): Promise<RobotSource> {
  if (!folder) return ofFile(files);
  return Promise.resolve(ofFolder(files.map((file) => ({ path: file.webkitRelativePath || file.name, file }))));
}

async function walk(root: FileSystemEntry): Promise<Dropped[]> {
  const found: Dropped[] = [];
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

function check(found: Dropped[]): void {
  const size = found.reduce((sum, { file }) => sum + file.size, 0);
  if (found.length > MAX_FILES)
    throw new Error(`This folder has more than ${MAX_FILES.toLocaleString("en")} files. Drop the folder of one URDD.`);
  if (size > MAX_BYTES)
    throw new Error("This folder has more than 1 GB, too much for a browser. Use `urdd view` on this machine.");
}

const IS_URDD =
  /^(?:urdd\.json|(?:mesh_modules\/|link_shapes_modules\/|bevy_modules\/)?[a-z0-9_]+_module\/module\.json)$/;

function ofFolder(all: Dropped[]): RobotSource {
  check(all);
  // The root is the highest folder that looks like a URDD.
  const roots = new Map<string, Dropped[]>();
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
  if (root === undefined) throw new Error(notAUrdd(all));
  const prefix = root === "" ? "" : `${root}/`;
  const inside = all.filter(({ path }) => path.startsWith(prefix));
  const files = inside.map(({ path, file }) => ({ path: path.slice(prefix.length), file }));
  return { kind: "local", name: root.split("/").pop() ?? "robot", files };
}

function notAUrdd(all: Dropped[]): string {
  const urdf = all.find(({ path }) => /\.(?:urdf|xacro)$/i.test(path));
  return urdf
    ? `This is a URDF, not a URDD yet. Generate one on this machine: urdd generate ${urdf.path.split("/").pop() ?? "robot.urdf"} -o my_robot, or view it directly: urdd view ${urdf.path.split("/").pop() ?? "robot.urdf"}`
    : "This is not a URDD: it has no folder with urdd.json or a module such as urdf_module/module.json.";
}

async function ofFile(files: File[]): Promise<RobotSource> {
  const [file] = files;
  if (!file) throw new Error("Nothing was dropped. Drop the folder of a URDD, or a .zip of it.");
  if (!/\.zip$/i.test(file.name)) throw new Error(notAUrdd(files.map((file) => ({ path: file.name, file }))));
  if (file.size > MAX_BYTES)
    throw new Error("This archive has more than 1 GB, too much for a browser. Use `urdd view` on this machine.");
  return { kind: "zip", name: file.name.replace(/\.zip$/i, ""), bytes: await file.arrayBuffer() };
}
