/** The parts of a combined robot, from `composition_module`. */

import type { Engine } from "./engine/client";
import type { FileEntry } from "./engine/protocol";

const MODULE = "composition_module/module.json";

export interface RobotPart {
  id: string;
  /** The name of the part's robot. */
  name: string;
  links: number[];
}

/** Empty for a robot that was not combined, or if the module cannot be read. */
export async function partsOf(engine: Engine, files: FileEntry[]): Promise<RobotPart[]> {
  if (!files.some(({ path }) => path === MODULE)) return [];
  try {
    const bytes = await engine.ask("file", { path: MODULE });
    return parsed(JSON.parse(new TextDecoder().decode(bytes)));
  } catch {
    // Findings report the problem.
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

/** A CSS colour for a part: consecutive parts differ. */
export function partColor(part: number): string {
  return `hsl(${Math.round((210 + 137.508 * part) % 360)}, 55%, 58%)`;
}
