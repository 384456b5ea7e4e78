/** Sets of files that are given to the page: how many there may be, and whether they are a URDD. */

/** Maximum number of files and bytes: at most those of the program (`tests/program/file_types.rs`). */
const MAX_FILES = 50_000;
export const MAX_BYTES = 1_000_000_000;
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
export function checkDescribed(files: number): void {
  if (files > MAX_DESCRIBED)
    throw new Error(
      `These are more than ${MAX_DESCRIBED.toLocaleString("en")} files of robots. Drop the folder of one robot.`,
    );
}

const IS_URDD =
  /^(?:urdd\.json|(?:mesh_modules\/|link_shapes_modules\/|bevy_modules\/)?[a-z0-9_]+_module\/module\.json)$/;

/** The highest folder that looks like a URDD. */
export function urddFolder(paths: readonly string[]): string | undefined {
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
