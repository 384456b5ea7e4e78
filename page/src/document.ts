/** Documents of modules that the page alone reads: named configurations, the parts of a combined robot, the spheres of links. */

import type { Engine } from "./engine/client";
import type { FileEntry, Vector } from "./engine/protocol";

/** The document of a module; null if there is none, or it cannot be read. */
async function documentOf(engine: Engine, files: FileEntry[], module: string): Promise<unknown> {
  const path = `${module}/module.json`;
  if (!files.some((file) => file.path === path)) return null;
  try {
    const bytes = await engine.ask("file", { path });
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    // Findings report the problem.
    return null;
  }
}

function field(value: unknown, key: string): unknown {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>)[key] : undefined;
}

function list(value: unknown, key: string): unknown[] {
  const found = field(value, key);
  return Array.isArray(found) ? found : [];
}

function text(value: unknown): string {
  return typeof value === "string" ? value : "";
}

/** A configuration that a person named, of `named_configurations_module`. */
export interface NamedConfiguration {
  name: string;
  /** One value for each DOF, rad or m. */
  q: number[];
}

/** Those with a value for each DOF. */
export async function namedOf(engine: Engine, files: FileEntry[], dofs: number): Promise<NamedConfiguration[]> {
  const module = await documentOf(engine, files, "named_configurations_module");
  const named = list(module, "configurations").map((one) => ({
    name: text(field(one, "name")),
    q: list(one, "configuration").map(Number),
  }));
  return named.filter(({ q }) => q.length === dofs && q.every(Number.isFinite));
}

/** A part of a combined robot, of `composition_module`. */
export interface RobotPart {
  id: string;
  /** The name of the part's robot. */
  name: string;
  links: number[];
}

/** Empty for a robot that was not combined, or if the module cannot be read. */
export async function partsOf(engine: Engine, files: FileEntry[]): Promise<RobotPart[]> {
  const module = await documentOf(engine, files, "composition_module");
  return list(module, "parts").map((part) => ({
    id: text(field(part, "id")),
    name: text(field(part, "name")),
    links: list(part, "links").map((link) => Number(field(link, "link_idx"))),
  }));
}

/** A CSS colour for a part: consecutive parts differ. */
export function partColor(part: number): string {
  return `hsl(${Math.round((210 + 137.508 * part) % 360)}, 55%, 58%)`;
}

/** A level of the spheres of links, of `link_shapes_spheres_module`: from coarse to fine. Lengths are in metres. */
export interface SphereLevel {
  /** Whether the spheres hold all pieces of the links. */
  covers: boolean;
  /** Whether a person gave them. */
  isGiven: boolean;
  /** In the frame of the link. */
  spheres: { link: number; centre: Vector; radius: number }[];
  /** How far the spheres are from the pieces at most. */
  standoff: number;
  /** How far a point of the pieces is outside of all spheres at most. */
  uncovered: number;
  /** Of how many collisions how many are missed, and of how many free configurations how many touch. */
  colliding: number;
  missed: number;
  free: number;
  wrong: number;
}

/** Empty for a URDD without the module, or if it cannot be read: that is a finding. */
export async function spheresOf(engine: Engine, files: FileEntry[]): Promise<SphereLevel[]> {
  const module = await documentOf(engine, files, "link_shapes_modules/link_shapes_spheres_module");
  return list(module, "levels").map((level) => {
    const fits = list(level, "fits").filter((fit) => fit !== null);
    const most = (key: string): number => Math.max(0, ...fits.map((fit) => number(fit, key)));
    const counts = field(level, "evaluation");
    return {
      covers: field(level, "covers") === true,
      isGiven: text(field(level, "origin")) === "Given",
      spheres: list(level, "spheres").flatMap(ofLink),
      standoff: most("max_standoff"),
      uncovered: most("max_uncovered"),
      colliding: number(counts, "num_colliding"),
      missed: number(counts, "num_missed"),
      free: number(counts, "num_free"),
      wrong: number(counts, "num_false_contacts"),
    };
  });
}

/** Those that can be drawn. */
function ofLink(own: unknown, link: number): SphereLevel["spheres"] {
  const all = (Array.isArray(own) ? own : []).map((one) => {
    const [x, y, z] = list(one, "offset_xyz").map(Number);
    const centre: Vector = [x ?? NaN, y ?? NaN, z ?? NaN];
    return { link, centre, radius: number(one, "radius") };
  });
  return all.filter(({ centre, radius }) => centre.every(Number.isFinite) && radius > 0 && Number.isFinite(radius));
}

function number(of: unknown, key: string): number {
  return Number(field(of, key));
}
