/** What the open robot lacks, what is drawn instead, and whether a drop has it. */

import { MAY_DESCRIBE, USD_TEXT } from "./drop";
import type { Taken, Given } from "./drop";
import type { Engine } from "./engine/client";
import type { SourceShape } from "./engine/protocol";
import type { RobotModel } from "./model";

/** A mesh that the URDF references and the URDD lacks. */
export interface AbsentMesh {
  link: number;
  geometry: "Visual" | "Collision";
  /** As written in the URDF. */
  filename: string;
  /** Number of visual elements of the link that exist. */
  others: number;
}

export async function absentMeshes(engine: Engine, robot: RobotModel): Promise<AbsentMesh[]> {
  // Unknown for a legacy URDD, or if the URDF cannot be read. Findings report that.
  const sources = await engine.ask("sources", {}).catch(() => []);
  const files = new Set([...robot.files.map(({ path }) => path), ...(robot.entry.left_out ?? [])]);
  const isAbsent = ({ shape, path }: SourceShape): boolean =>
    shape?.Mesh !== undefined && (path === null || !files.has(path));
  const there = sources.filter((shape) => shape.geometry === "Visual" && shape.shape !== null && !isAbsent(shape));
  return sources.filter(isAbsent).map(({ link, geometry, shape }) => ({
    link,
    geometry,
    filename: shape?.Mesh?.filename ?? "",
    others: there.filter((other) => other.link === link).length,
  }));
}

/** What is drawn instead of a mesh. */
export function drawnInstead(robot: RobotModel, { link, geometry, others }: AbsentMesh): string {
  if (geometry === "Collision") return "collision geometry";
  if ((robot.about.meshes.plain?.[link]?.length ?? 0) === 0) return "nothing is drawn";
  return others > 0 ? "the rest of the link is drawn" : "its collision geometry is drawn instead";
}

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
export function missingFrom(
  { absent, wanted }: { absent: readonly AbsentMesh[]; wanted: readonly string[] },
  taken: Taken,
): Given[] | null {
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
