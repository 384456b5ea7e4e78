/** The parts of a combined robot, from `composition_module`. */

import { documentOf, field, list, text } from "./document";
import type { Engine } from "./engine/client";
import type { FileEntry } from "./engine/protocol";

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
