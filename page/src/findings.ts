/** The links of findings. */

import type { Fix } from "./edits";
import type { Finding, Report, Severity } from "./engine/protocol";
import type { RobotModel } from "./model";
import type { State } from "./state";

const RANK: Record<Severity | "unverified", number> = { unverified: 0, info: 1, warning: 2, error: 3 };
type Worst = Severity | "unverified";

const LINK =
  /^\/(?:links|links_in_chain|link_meshes|link_hulls|link_pieces|(?:full|decomposition)_(?:obbs|bounding_spheres))\/(\d+)/;
const JOINT = /^\/(?:joints|joints_in_chain|joint_idx_to_[a-z_]+)\/(\d+)/;
const MESH = /\/meshes\/(?:stl|obj|glb)\/(\d+)_/;

/** The link of a place; null if there is none, or if it is unknown. */
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
    const moved = robot.joints.findIndex((joint) => subject.includes(`\`${joint.name}\``));
    // A joint may have the name of a link.
    const isJoint = moved >= 0 && (named < 0 || subject.startsWith("joint "));
    if (isJoint) return robot.joints[moved]?.child ?? null;
    if (named >= 0) return named;
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
  column: number | null;
  subject: string | null;
  expected: string | null;
  actual: string | null;
  message: string | null;
  /** For the expansion of a xacro file: where it is written. */
  written_at?: { file: string; line: number | null; column?: number | null; macro_name: string | null } | null;
  /** Changes that mend it, the best first. `urdd lint --fix` makes those that are safe. */
  fixes?: Fix[];
  /** Other places to look at; their message says what is there. */
  related: Place[];
}

export function places(finding: Finding): Place[] {
  return Array.isArray(finding["places"]) ? (finding["places"] as Place[]) : [];
}

/** The number of findings, as `urdd validate` counts them: each place counts. */
export function tally({ totals }: Report): Record<Severity, number> & { all: number } {
  const { error = 0, warning = 0, info = 0 } = totals;
  return { error, warning, info, all: error + warning + info };
}

/** Consequences of findings for users of the URDD, worst first, as in `urdd validate`. */
export const CONSEQUENCES = new Map([
  ["wrong-motion", "wrong motion"],
  ["wrong-place", "wrong place"],
  ["missing-geometry", "missing geometry"],
  ["collisions", "missed or false collisions"],
  ["format", "format"],
  ["appearance", "appearance"],
  ["looseness", "looseness"],
]);

/** Findings in the order in which to fix them. */
export function toMend(findings: readonly Finding[]): Finding[] {
  const order = [...CONSEQUENCES.keys()];
  const rank = ({ consequence }: Finding): number => order.indexOf(String(consequence));
  return findings.slice().sort((a, b) => RANK[b.severity] - RANK[a.severity] || rank(a) - rank(b) || b.count - a.count);
}

/** The links that a finding names. */
function linksOf(robot: RobotModel, finding: Finding): Set<number> {
  return new Set(places(finding).flatMap((place) => linkOf(robot, place) ?? []));
}

/** The worst severity of each link with findings, or that was not verified. */
export function worstOfLinks(robot: RobotModel, report: Report | null): Map<number, Worst> {
  return worstOf(robot, report, () => true);
}

function worstOf(robot: RobotModel, report: Report | null, counts: (finding: Finding) => boolean): Map<number, Worst> {
  const worst = new Map<number, Worst>();
  const add = (link: number | null, severity: Worst): void => {
    if (link === null) return;
    const before = worst.get(link);
    if (before === undefined || RANK[before] < RANK[severity]) worst.set(link, severity);
  };
  const urdd = report?.urdds[0];
  for (const { link } of urdd?.geometry_not_verified ?? []) add(known(robot, link), "unverified");
  for (const finding of urdd?.findings ?? []) {
    if (counts(finding)) for (const link of linksOf(robot, finding)) add(link, finding.severity);
  }
  return worst;
}

/** A rule with findings at links: how many links, and whether they are too many to stand out. */
interface NamedLinks {
  code: string;
  links: Set<number>;
  isSystematic: boolean;
}

/** Fraction of the links above which the links of a rule do not stand out. */
const SYSTEMATIC = 0.5;

export function namedLinks(robot: RobotModel, report: Report | null): NamedLinks[] {
  const found = new Map<string, Set<number>>();
  for (const finding of toMend(report?.urdds[0]?.findings ?? [])) {
    const links = found.get(finding.code) ?? new Set<number>();
    for (const link of linksOf(robot, finding)) links.add(link);
    if (links.size > 0) found.set(finding.code, links);
  }
  const most = Math.max(2, SYSTEMATIC * robot.links.length);
  return [...found].map(([code, links]) => ({ code, links, isSystematic: links.size > most }));
}

/** What links are painted by now: unless it was chosen, those of a URDF by their worst finding, beside the findings. */
export function paintNow({ painted, tab, robot }: Readonly<State>): "worst" | { code: string } | null {
  if (painted !== "auto") return painted;
  return tab === "Findings" && robot?.entry.temporary ? "worst" : null;
}

/** The colours of links: their worst finding that stands out, or the findings of one rule. */
export function paintOf(
  robot: RobotModel,
  report: Report | null,
  painted: "worst" | { code: string },
): Map<number, Worst> {
  if (painted !== "worst") return worstOf(robot, report, ({ code }) => code === painted.code);
  const left = new Set(namedLinks(robot, report).flatMap(({ code, isSystematic }) => (isSystematic ? [code] : [])));
  return worstOf(robot, report, ({ code }) => !left.has(code));
}
