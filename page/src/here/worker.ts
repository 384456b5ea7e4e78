/** A worker that makes robots of descriptions. It reads the files that it was given, and nothing else. */

import { zipSync } from "fflate";
import type { Zippable } from "fflate";
import type { Exported, Generated, ImportedRobot } from "../../../wasm/npm/index";
import { hasPlace } from "../drop";
import type { Given } from "../drop";
import { changes, contents, started, serve } from "../engine/link";
import type { Urdd, OnProgress } from "../engine/link";
import type { Description, Report } from "../engine/protocol";
import { bytes, message } from "../ui/format";
import type { MakerCalls } from "./made";

/** Maximum size of what is read for one robot: it is in memory more than once while it is made. */
const MAX_ROBOT = 512 * 2 ** 20;
/** The time of files in a .zip, which cannot say an earlier one. */
const TIME = "1980-01-02T00:00:00";
/** How much a .zip is compressed, of 0 to 9: meshes gain little from more. */
const LEVEL = 3;

/** An answer of the module: of the package's, `files` is an address there. */
type Answer<T> = Omit<T, "files"> & { files: number };

/** As the libraries of TypeScript for pages do not have it. */
declare class FileReaderSync {
  readAsArrayBuffer(file: Blob): ArrayBuffer;
}

let module: Urdd | null = null;
/** What is told of the job that runs. */
let tell: OnProgress = () => undefined;
const taken = new Map<string, Blob>();
let files = 0;
/** The URDD that was made last. */
let last = 0;
const read = new Set<Blob>();
let size = 0;

function maker(): Urdd {
  if (!module) throw new Error("the module is not loaded");
  return module;
}

/** A job begins, which may read so much. */
function begin(): void {
  read.clear();
  size = 0;
}

/** The content of a file that was taken, when the module needs it. */
function content(path: string): Uint8Array {
  const file = taken.get(path);
  if (!file) throw new RangeError(`there is no file ${path}`);
  if (!read.has(file)) size += file.size;
  read.add(file);
  // A worker that threw within the module is replaced, as after a RangeError.
  if (size > MAX_ROBOT)
    throw new RangeError(
      `The files of this robot have more than ${bytes(MAX_ROBOT)}: too much for a browser. Use \`urdd view\` on this machine.`,
    );
  try {
    return new Uint8Array(new FileReaderSync().readAsArrayBuffer(file));
  } catch (error) {
    throw new RangeError(`${path} cannot be read: ${message(error)}`);
  }
}

async function opened(all: Given[]): Promise<number> {
  const address = maker().files("robot", {});
  for (const { path, file } of all) maker().give(address, path, new Uint8Array(await file.arrayBuffer()));
  return address;
}

serve<MakerCalls>(
  {
    async init({ module: compiled }) {
      module = await started(compiled);
      module.tell = ({ what, done, of }) => tell(done, of, what);
      module.content = content;
      return null;
    },

    take({ files: all }) {
      maker().closeFiles(files);
      maker().closeFiles(last);
      last = 0;
      files = maker().files("", {});
      taken.clear();
      // Names may lead out of the files, as of a URDF that was dropped alone.
      maker().lose(files, "");
      for (const { path, file, isLost } of all) {
        taken.set(path, file);
        maker().name(files, path, file.size);
        if (isLost && !hasPlace(path)) maker().lose(files, path);
      }
      return null;
    },

    descriptions() {
      begin();
      return maker().descriptions(files) as Description[];
    },

    put({ path, text }) {
      maker().put(files, path, new TextEncoder().encode(text));
      return null;
    },

    lint({ path }) {
      begin();
      return maker().lint(files, { urdf: path, with_text: true }) as Report;
    },

    async generate({ path, donor, options }, onProgress) {
      if (last === 0 && donor.length > 0) last = await opened(donor);
      tell = onProgress;
      begin();
      const made = maker().generate(files, { path, ...options }, last) as Answer<Generated>;
      const before = last;
      last = made.files;
      const { paths, changed } = changes(maker(), last, before);
      maker().closeFiles(before);
      const { links, dofs, notes } = made;
      return { links, dofs, notes, paths, files: changed };
    },

    import({ path }) {
      begin();
      const made = maker().importRobot(files, { path }) as Answer<ImportedRobot>;
      return contents(maker(), made.files);
    },

    async export({ urdd, format, output, actuators }) {
      const from = await opened(urdd);
      const made = maker().export(from, { format, output, actuators }) as Answer<Exported>;
      maker().closeFiles(from);
      return { notes: made.notes, files: contents(maker(), made.files) };
    },

    zip({ files: all }) {
      return packed(all);
    },

    memory() {
      return maker().memory;
    },
  },
  ["init", "take", "put"],
);

/** A .zip of files: the same bytes for the same files. */
async function packed(files: Given[]): Promise<Blob> {
  const all: Zippable = {};
  for (const { path, file } of files) all[path] = [new Uint8Array(await file.arrayBuffer()), { mtime: TIME }];
  return new Blob([zipSync(all, { level: LEVEL }).slice()], { type: "application/zip" });
}
