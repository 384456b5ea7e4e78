/** What the open robot lacks, and whether a drop has it. */

import type { State } from "../state";
import { MAY_DESCRIBE } from "../endings";
import type { Taken } from "../drop";
import { USD_TEXT } from "./reader";
import type { Given } from "./protocol";

/** Maximum number of characters of a text that is searched for names, and of names. */
const MAX_TEXT = 4e6;
const MAX_NAMES = 1000;
/** Elements of SDF whose text is the name of a file; those of scripts are of Gazebo itself. */
const NAMES_FILE = /^(?:uri|[a-z_]+_map)$/;

/** The packages that these names of files are in. */
export function packagesOf(names: readonly string[]): string[] {
  const named = names.map((name) => /^(?:package|model):\/\/([^/]+)/.exec(name)?.[1]);
  return [...new Set(named.filter((name) => name !== undefined))].sort();
}

/** The files that an MJCF, SDF or USD names, of whose last name there is none among these. */
export function unmet(text: string, files: readonly Given[]): string[] {
  if (text.length > MAX_TEXT) return [];
  const known = new Set(files.flatMap(({ path }) => path.split("/")));
  const found = new Set<string>();
  const look = (name: string | null): void => {
    const last = name?.trim().split(/[\\/]/).pop();
    if (name && last && !known.has(last) && !/^https?:/.test(name)) found.add(name.trim());
  };
  if (text.startsWith(USD_TEXT)) {
    for (const [, name] of text.matchAll(/@([^@\n]+)@/g)) if (found.size < MAX_NAMES) look(name ?? null);
    return [...found];
  }
  for (const element of new DOMParser().parseFromString(text, "application/xml").getElementsByTagName("*")) {
    if (found.size >= MAX_NAMES) break;
    if (NAMES_FILE.test(element.tagName) && element.parentElement?.tagName !== "script") look(element.textContent);
    if (element.tagName !== "plugin")
      for (const { name, value } of element.attributes) if (name.startsWith("file")) look(value);
  }
  return [...found];
}

/**
 * The files of a drop that are for the open robot: what is no robot by itself, the folder of a package that it lacks, or a
 * description that it includes.
 */
export function missingFrom({ draft, absent, wanted }: Readonly<State>, taken: Taken): Given[] | null {
  if (!draft) return null;
  if (taken.kind === "files") return taken.files.length > 0 ? taken.files : null;
  if (taken.kind !== "description") return null;
  const parts = taken.files.map(({ path }) => path.split("/"));
  const folders = new Set(parts.flatMap((parts) => parts.slice(0, -1)));
  const names = new Set(parts.map((parts) => parts.pop()));
  const packages = packagesOf([...absent.map(({ filename }) => filename), ...wanted]);
  const included = wanted.filter((name) => MAY_DESCRIBE.test(name)).map((name) => name.split(/[\\/]/).pop());
  const isFor = packages.some((name) => folders.has(name)) || included.some((name) => names.has(name));
  return isFor ? taken.files : null;
}
