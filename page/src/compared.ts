/** Two robots compared link by link, by name, for a picture; `urdd diff` compares more. */

import type { Engine, LinkMesh } from "./engine/client";
import type { Dof, Joint, Link, Vector } from "./engine/protocol";
import type { RobotModel } from "./model";
import { dofValue, length, lengths, name, number } from "./ui/format";

/** What happened to a link: there before and not now, or now and not before; moved on its parent; otherwise changed. */
export type Change = "new" | "gone" | "moved" | "changed";

/** The colours of links, by what happened to them. */
export const CHANGE_COLORS: Record<Change, string> = {
  new: "--good",
  gone: "--error",
  moved: "--warning",
  changed: "--info",
};

export interface Compared {
  /** The other robot, which this one is taken to have been before. */
  model: RobotModel;
  engine: Engine;
  /** The present robot. */
  now: RobotModel;
  /** Poses of the other robot's links for the same values of the DOFs that both have. */
  poses: Float64Array | null;
  changes: readonly LinkChange[];
}

interface LinkChange {
  link: string;
  change: Change;
  /** What changed, in words. */
  what: string;
}

/** Maximum difference of two equal positions (m), rotations (rad) and other numbers (relative). */
const SAME = 1e-6;

/** The plain meshes of each link that has some, by its name. */
export type Shapes = ReadonlyMap<string, readonly LinkMesh[]>;

export function changesOf(old: RobotModel, now: RobotModel, oldShapes: Shapes, nowShapes: Shapes): LinkChange[] {
  const before = new Map(old.links.map((link) => [link.name, link]));
  const found: LinkChange[] = [];
  for (const link of now.links) {
    const was = before.get(link.name);
    before.delete(link.name);
    if (!was) found.push({ link: link.name, change: "new", what: "" });
    else {
      const moved = movedBy(old, was, now, link);
      const others = [...jointOf(old, was, now, link), ...massOf(was, link)];
      if (!areSame(oldShapes.get(link.name), nowShapes.get(link.name))) others.push("another shape");
      const what = [...moved, ...others].join("; ");
      if (what !== "") found.push({ link: link.name, change: moved.length > 0 ? "moved" : "changed", what });
    }
  }
  for (const link of before.values()) found.push({ link: link.name, change: "gone", what: "" });
  return found;
}

/** The values of a robot's DOFs where another robot has them too, and its zero elsewhere. */
export function sameValues(from: RobotModel, q: readonly number[], to: RobotModel): number[] {
  return to.dofs.map(({ name, bounds, unit }: Dof, k) => {
    const at = from.dofs.findIndex((dof) => dof.name === name && dof.unit === unit);
    const value = at < 0 ? (to.about.zero?.[k] ?? 0) : (q[at] ?? 0);
    const [low, high] = bounds ?? [-Infinity, Infinity];
    return Math.min(Math.max(value, low), high);
  });
}

function jointAbove(robot: RobotModel, link: Link): Joint | null {
  return link.parent_joint === null ? null : (robot.joints[link.parent_joint] ?? null);
}

function nameOf(robot: RobotModel, link: number | null): string {
  return link === null ? "" : robot.nameOf(link);
}

/** What moved a link on its parent. */
function movedBy(old: RobotModel, was: Link, now: RobotModel, is: Link): string[] {
  const [before, after] = [jointAbove(old, was), jointAbove(now, is)];
  const [parent, other] = [nameOf(old, before?.parent ?? null), nameOf(now, after?.parent ?? null)];
  if (parent !== other) return [`on ${other === "" ? "nothing" : name(other)} instead of ${name(parent) || "nothing"}`];
  const [from, to] = [before?.origin, after?.origin];
  if (!from || !to) return [];
  const words: string[] = [];
  const apart = distance(from.position, to.position);
  if (apart > SAME) words.push(`moved by ${length(apart)}`);
  const cosine = Math.abs(from.quaternion_wxyz.reduce((sum, x, k) => sum + x * (to.quaternion_wxyz[k] ?? 0), 0));
  const angle = 2 * Math.acos(Math.min(1, cosine));
  // The arc cosine of a rounded 1 is up to 3e-8.
  if (angle > SAME) words.push(`turned by ${dofValue(angle, "rad")}`);
  return words;
}

function jointOf(old: RobotModel, was: Link, now: RobotModel, is: Link): string[] {
  const [before, after] = [jointAbove(old, was), jointAbove(now, is)];
  if (!before || !after) return [];
  const words: string[] = [];
  if (before.name !== after.name) words.push(`joint ${name(before.name)} → ${name(after.name)}`);
  if (before.type !== after.type) words.push(`${before.type.toLowerCase()} → ${after.type.toLowerCase()}`);
  else if (before.axis && after.axis && before.type !== "Fixed" && distance(before.axis, after.axis) > SAME)
    words.push("another axis");
  const unit = after.type === "Prismatic" ? "m" : "rad";
  const limits = ({ limit }: Joint): string =>
    limit
      ? `${limit.lower === null ? "–" : dofValue(limit.lower, unit)} to ${limit.upper === null ? "–" : dofValue(limit.upper, unit)}`
      : "none";
  if (limits(before) !== limits(after)) words.push(`limits ${limits(before)} → ${limits(after)}`);
  const each: [string, (joint: Joint) => number | null | undefined][] = [
    ["velocity", ({ limit }) => limit?.velocity],
    ["effort", ({ limit }) => limit?.effort],
    ["mimic multiplier", ({ mimic }) => mimic?.multiplier],
    ["mimic offset", ({ mimic }) => mimic?.offset],
  ];
  for (const [what, of] of each) {
    const [a, b] = [of(before) ?? null, of(after) ?? null];
    if (!isNear(a, b)) words.push(`${what} ${shown(a)} → ${shown(b)}`);
  }
  return words;
}

function massOf({ inertial: was }: Link, { inertial: is }: Link): string[] {
  const words: string[] = [];
  const [a, b] = [was?.mass ?? null, is?.mass ?? null];
  if (!isNear(a, b)) words.push(`mass ${shown(a, b === null ? " kg" : "")} → ${shown(b, " kg")}`);
  if (!was || !is) return words;
  const apart = distance(was.position, is.position);
  if (apart > SAME) words.push(`centre of mass ${lengths(was.position)} → ${lengths(is.position)}`);
  const [i, j] = [was.inertia ?? [], is.inertia ?? []];
  if (i.length !== j.length || !i.every((value, k) => isNear(value, j[k] ?? null))) words.push("another inertia");
  return words;
}

function isNear(a: number | null, b: number | null): boolean {
  if (a === null || b === null) return a === b;
  return a === b || Math.abs(a - b) <= SAME * Math.max(Math.abs(a), Math.abs(b));
}

function shown(value: number | null, unit = ""): string {
  return value === null ? "none" : number(value, 4) + unit;
}

function distance(a: Vector, b: Vector): number {
  return Math.hypot(...a.map((x, k) => x - (b[k] ?? 0)));
}

function areSame(a: readonly LinkMesh[] = [], b: readonly LinkMesh[] = []): boolean {
  return (
    a.length === b.length &&
    a.every(({ positions, indices }, k) => areEqual(positions, b[k]?.positions) && areEqual(indices, b[k]?.indices))
  );
}

type Numbers = Float32Array | Uint32Array | undefined;

function areEqual(a: Numbers, b: Numbers): boolean {
  return a?.length === b?.length && (a?.every((value, k) => value === b?.[k]) ?? true);
}
