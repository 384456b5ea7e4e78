/** A worker that makes robots of descriptions. It reads the files that it was given, and nothing else. */

import { serve } from "../engine/serve";
import type { OnProgress } from "../engine/serve";
import { MakeModule } from "./module";
import { needed } from "./needed";
import { packed } from "./pack";
import type { Given, MakerCalls } from "./protocol";

let module: MakeModule | null = null;
/** What is told of the job that runs. */
let tell: OnProgress = () => undefined;
let taken: Given[] = [];
let files = 0;
const read = new Set<string>();

function maker(): MakeModule {
  if (!module) throw new Error("the module is not loaded");
  return module;
}

/** Passes the files that a description needs to the module, or all texts without one. */
async function ensure(path: string | null, onProgress: OnProgress): Promise<void> {
  const wanted = (await needed(taken, path)).filter((file) => !read.has(file.path));
  let done = 0;
  for (const { path, file } of wanted) {
    onProgress(done++, wanted.length, "files");
    maker().giveFile(files, path, new Uint8Array(await file.arrayBuffer()));
    read.add(path);
  }
}

/** The content of files of the module, which are closed. The browser keeps it outside of the page's memory. */
function content(address: number): Given[] {
  const all = maker().list(address).files;
  const found = all.map(({ path }) => ({ path, file: new Blob([maker().read(address, path)]) }));
  maker().closeFiles(address);
  return found;
}

async function opened(all: Given[]): Promise<number> {
  const address = maker().newFiles("robot");
  for (const { path, file } of all) maker().giveFile(address, path, new Uint8Array(await file.arrayBuffer()));
  return address;
}

serve<MakerCalls>(
  {
    async init({ module: compiled }) {
      module = await MakeModule.of(compiled, ({ what, done, of }) => tell(done, of, what));
      return null;
    },

    async unzip({ zip }) {
      return { files: content(maker().unzipped(new Uint8Array(await zip.arrayBuffer()))) };
    },

    take({ files: all }) {
      maker().closeFiles(files);
      files = maker().newFiles("");
      read.clear();
      taken = all;
      return null;
    },

    async descriptions(_, onProgress) {
      await ensure(null, onProgress);
      return maker().descriptions(files);
    },

    put({ path, text }) {
      maker().put(files, path, new TextEncoder().encode(text));
      read.add(path);
      return null;
    },

    async lint({ path }, onProgress) {
      await ensure(path, onProgress);
      return maker().lint(files, path);
    },

    async generate({ path, donor, options }, onProgress) {
      await ensure(path, onProgress);
      const from = donor.length > 0 ? await opened(donor) : 0;
      tell = onProgress;
      const made = maker().generate(files, from, { path, ...options });
      maker().closeFiles(from);
      return { ...made, files: content(made.files) };
    },

    async import({ path }, onProgress) {
      await ensure(path, onProgress);
      const made = maker().imported(files, path);
      return { main: made.urdf, files: content(made.files) };
    },

    async export({ urdd, format, output }) {
      const from = await opened(urdd);
      const made = maker().exported(from, { format, output });
      maker().closeFiles(from);
      return { main: made.main, notes: made.notes, files: content(made.files) };
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
