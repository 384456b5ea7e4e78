/** Meshes that the URDF references and the URDD lacks, and what is drawn instead. */

import type { Engine } from "./engine/client";
import type { SourceShape } from "./engine/protocol";
import type { RobotModel } from "./model";

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
