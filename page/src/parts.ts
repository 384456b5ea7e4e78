/** The robots that a robot was put together from, as `composition_module` has them. */

import type { Engine } from "./engine/client";
import type { FileEntry } from "./engine/protocol";

const MODULE = "composition_module/module.json";

export interface RobotPart {
  id: string;
  /** Name of the robot that it was. */
  name: string;
  links: number[];
}

/** None for a robot that was not put together, or where the module cannot be read. */
export async function partsOf(engine: Engine, files: FileEntry[]): Promise<RobotPart[]> {
  if (!files.some(({ path }) => path === MODULE)) return [];
  try {
    const bytes = await engine.ask("file", { path: MODULE });
    return parsed(JSON.parse(new TextDecoder().decode(bytes)));
  } catch {
    // Findings say what is wrong with it.
    return [];
  }
}

function parsed(module: unknown): RobotPart[] {
  const parts = field(module, "parts");
  if (!Array.isArray(parts)) return [];
  return parts.map((part: unknown) => {
    const links = field(part, "links");
    return {
      id: text(field(part, "id")),
      name: text(field(part, "name")),
      links: Array.isArray(links) ? links.map((link) => Number(field(link, "link_idx"))) : [],
    };
  });
}

function field(value: unknown, key: string): unknown {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>)[key] : undefined;
}

function text(value: unknown): string {
  return typeof value === "string" ? value : "";
}

/** A colour for a part, as CSS has it: neighbours in number differ. */
export function partColor(part: number): string {
  return `hsl(${Math.round((210 + 137.508 * part) % 360)}, 55%, 58%)`;
}
