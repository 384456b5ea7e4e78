/** What the open robot lacks, and whether a drop has it. */

import type { AbsentMesh } from "../absent";
import type { Taken } from "../drop";
import type { State } from "../state";
import type { Given } from "./protocol";

/** The packages of which meshes were not found. */
export function missingPackages(absent: readonly AbsentMesh[]): string[] {
  const named = absent.map(({ filename }) => /^(?:package|model):\/\/([^/]+)\//.exec(filename)?.[1]);
  return [...new Set(named.filter((name) => name !== undefined))].sort();
}

/** The files of a drop that the open robot lacks: the folder of a package, or files that are no robot by themselves. */
export function missingFrom({ robot, draft, absent }: Readonly<State>, taken: Taken): Given[] | null {
  if (!robot?.entry.here || !draft || absent.length === 0) return null;
  if (taken.kind === "files") return taken.files;
  if (taken.kind !== "description" || taken.files instanceof File) return null;
  const folders = new Set(taken.files.flatMap(({ path }) => path.split("/").slice(0, -1)));
  return missingPackages(absent).some((name) => folders.has(name)) ? taken.files : null;
}
