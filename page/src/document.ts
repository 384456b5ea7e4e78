/** Documents of modules that the page alone reads. */

import type { Engine } from "./engine/client";
import type { FileEntry } from "./engine/protocol";

/** The document of a module; null if there is none, or it cannot be read. */
export async function documentOf(engine: Engine, files: FileEntry[], module: string): Promise<unknown> {
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

export function field(value: unknown, key: string): unknown {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>)[key] : undefined;
}

export function list(value: unknown, key: string): unknown[] {
  const found = field(value, key);
  return Array.isArray(found) ? found : [];
}

export function text(value: unknown): string {
  return typeof value === "string" ? value : "";
}
