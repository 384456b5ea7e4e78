/** To which links findings belong. */

import type { Finding, Report, Severity } from "./engine/protocol";
import type { RobotModel } from "./model";

const RANK: Record<Severity | "unverified", number> = { unverified: 0, info: 1, warning: 2, error: 3 };
export type Worst = Severity | "unverified";

const LINK =
  /^\/(?:links|links_in_chain|link_meshes|link_hulls|link_pieces|(?:full|decomposition)_(?:obbs|bounding_spheres))\/(\d+)/;
const JOINT = /^\/(?:joints|joints_in_chain|joint_idx_to_[a-z_]+)\/(\d+)/;
const MESH = /\/meshes\/(?:stl|obj|glb)\/(\d+)_/;

/** The link that a place is about; null where it is about none, or that cannot be told. */
export function linkOf(
  robot: RobotModel,
  place: { file?: unknown; pointer?: unknown; subject?: unknown },
): number | null {
  const file = typeof place.file === "string" ? place.file : "";
  const pointer = typeof place.pointer === "string" ? place.pointer : "";
  const mesh = MESH.exec(file);
  if (mesh) return known(robot, Number(mesh[1]));
  const link = LINK.exec(pointer);
  if (link) return known(robot, Number(link[1]));
  const joint = JOINT.exec(pointer);
  if (joint) return robot.joints[Number(joint[1])]?.child ?? null;
  if (typeof place.subject === "string") {
    const subject = place.subject;
    const named = robot.links.findIndex((link) => subject.includes(`\`${link.name}\``));
    if (named >= 0) return named;
    const moved = robot.joints.findIndex((joint) => subject.includes(`\`${joint.name}\``));
    if (moved >= 0) return robot.joints[moved]?.child ?? null;
  }
  return null;
}

function known(robot: RobotModel, link: number): number | null {
  return link < robot.links.length ? link : null;
}

export interface Place {
  file: string | null;
  pointer: string | null;
  line: number | null;
  subject: string | null;
  expected: string | null;
  actual: string | null;
  message: string | null;
}

export function places(finding: Finding): Place[] {
  return Array.isArray(finding["places"]) ? (finding["places"] as Place[]) : [];
}

/** The worst of each link that has findings, or that was not verified. */
export function worstOfLinks(robot: RobotModel, report: Report | null): Map<number, Worst> {
  const worst = new Map<number, Worst>();
  const add = (link: number | null, severity: Worst): void => {
    if (link === null) return;
    const before = worst.get(link);
    if (before === undefined || RANK[before] < RANK[severity]) worst.set(link, severity);
  };
  const urdd = report?.urdds[0];
  for (const { link } of urdd?.geometry_not_verified ?? []) add(known(robot, link), "unverified");
  for (const finding of urdd?.findings ?? []) {
    for (const place of places(finding)) add(linkOf(robot, place), finding.severity);
  }
  return worst;
}
