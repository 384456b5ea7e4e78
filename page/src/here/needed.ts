/** Which of many files a description may name: a folder of packages has those of other robots too. */

import { bytes } from "../ui/format";
import type { Given } from "./protocol";

/** Files that are read whatever they are, if all are together no larger. */
const MAX_ALL = 64 * 2 ** 20;
/** Maximum size of what is read for one robot: it is in memory more than once while it is made. */
const MAX_ROBOT = 512 * 2 ** 20;
/** Maximum size of a text that is searched for names. */
const MAX_TEXT = 64 * 2 ** 20;
const IS_TEXT = /\.(?:urdf|xacro|xml|sdf|mjcf|world|srdf|config|toml|ya?ml)$/i;
/** Files that a mesh names, which are not looked into. */
const IS_BESIDE = /\.(?:mtl|bin|png|jpe?g|tga|bmp|dds|gif|tiff?|webp|hdr|exr|ktx2|ppm|pgm)$/i;

function size(files: Given[]): number {
  return files.reduce((sum, { file }) => sum + file.size, 0);
}

function folder(path: string): string {
  return path.slice(0, path.lastIndexOf("/") + 1);
}

/** The files that are needed for a description, or to find all of them. */
export async function needed(all: Given[], path: string | null): Promise<Given[]> {
  const texts = all.filter(({ path, file }) => IS_TEXT.test(path) && file.size <= MAX_TEXT);
  if (path === null) return texts;
  if (size(all) <= MAX_ALL) return all;
  const top = path.split("/")[0] ?? "";
  const near = texts.filter((text) => text.path === path || text.path.startsWith(`${top}/`));
  const words: string[] = [];
  for (const { file } of near) words.push(await file.text());
  const said = words.join("\n");
  const base = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
  const meshes = all.filter(({ path }) => !IS_TEXT.test(path) && !IS_BESIDE.test(path) && said.includes(base(path)));
  const places = new Set(meshes.map(({ path }) => folder(folder(path).slice(0, -1))));
  const beside = all.filter(({ path }) => IS_BESIDE.test(path) && [...places].some((place) => path.startsWith(place)));
  const wanted = [...texts, ...meshes, ...beside];
  if (size(wanted) > MAX_ROBOT)
    throw new Error(
      `The files of this robot have ${bytes(size(wanted))}, more than ${bytes(MAX_ROBOT)}: too much for a browser. Use \`urdd view\` on this machine.`,
    );
  return wanted;
}
