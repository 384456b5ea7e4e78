/** The configurations that a person named, from `named_configurations_module`. */

import { documentOf, field, list, text } from "./document";
import type { Engine } from "./engine/client";
import type { FileEntry } from "./engine/protocol";

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
