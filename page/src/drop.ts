/** Folders and files that are dropped or selected: a URDD, descriptions with the files that they may name, or such files. */

import type { RobotSource } from "./engine/calls";
import { IS_XACRO, IS_ZIP, MAY_DESCRIBE, OF_ROBOT } from "./endings";
import { check, checkDescribed, MAX_BYTES, urddFolder } from "./given";
import { lost, sizeOf } from "./here/protocol";
import type { Given } from "./here/protocol";

/** Bytes that are looked at of a file whose name says nothing. */
const HEAD = 256;

/** A robot that can be opened; descriptions that robots are made of; or files without a description. */
export type Taken =
  RobotSource | { kind: "description"; files: Given[]; hasXacro: boolean } | { kind: "files"; files: Given[] };

/** What a drop needs: who unpacks a .zip, and whether it is still wanted. */
export interface Hands {
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
