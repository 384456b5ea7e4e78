/** The spheres of links, from `link_shapes_spheres_module`: levels from coarse to fine. */

import { documentOf, field, list, text } from "./document";
import type { Engine } from "./engine/client";
import type { FileEntry, Vector } from "./engine/protocol";

/** A level. Lengths are in metres. */
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
