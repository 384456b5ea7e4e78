/** An open robot: the engine's data, and what the page derives from it. */

import type { NamedConfiguration, RobotPart, SphereLevel } from "./document";
import type { RobotSource } from "./engine/client";
import type { About, Dof, FileEntry, Joint, Link } from "./engine/protocol";

/** An entry of `robots.json`. */
export interface Entry {
  id: string;
  name: string;
  /** Whether skips can be saved: a folder on disk, of version 1. */
  writable: boolean;
  /** Whether it is deleted when `urdd view` ends, unless it is saved. */
  temporary: boolean;
  /** Whether there is something to show: a robot of a URDF has nothing before somebody opens it. */
  ready: boolean;
  /** The progress of its generation; null otherwise. A robot that is ready then has only what the picture needs. */
  making: { what: string; done: number; of: number } | null;
  /** Why its generation failed, or ended. */
  failure: string | null;
  /** Whether a person ended it. */
  stopped?: boolean;
  links: number | null;
  dofs: number | null;
  verdict: string | null;
  findings: { error: number; warning: number; info: number } | null;
  /** Assumptions during generation for this view. */
  notes: string[];
  picture: string | null;
  /** Whether a program sends configurations to show. */
  follows?: boolean;
  /** Whether this page makes it. */
  here?: boolean;
  /** Original meshes that a page in one file leaves out, since it draws the plain ones. */
  left_out?: string[];
  /** The paths of its list of files and its report on a site. */
  files?: string;
  report?: string;
}

/** An entry without data. */
export function unknown(name: string): Entry {
  return {
    id: name,
    name,
    writable: false,
    temporary: false,
    ready: true,
    making: null,
    failure: null,
    links: null,
    dofs: null,
    verdict: null,
    findings: null,
    notes: [],
    picture: null,
  };
}

export type Part = { kind: "link"; index: number } | { kind: "joint"; index: number };

export function same(a: Part | null, b: Part | null): boolean {
  return a?.kind === b?.kind && a?.index === b?.index;
}

export class RobotModel {
  readonly links: Link[];
  readonly joints: Joint[];
  readonly dofs: Dof[];
  /** The child joints of each link. */
  readonly below: number[][];
  readonly roots: number[];

  constructor(
    readonly entry: Entry,
    readonly source: RobotSource,
    readonly about: About,
    readonly files: FileEntry[],
    /** The parts that it was combined from. */
    readonly parts: RobotPart[] = [],
    /** The configurations that a person named. */
    readonly named: NamedConfiguration[] = [],
    /** The levels of its spheres. */
    readonly spheres: SphereLevel[] = [],
  ) {
    this.links = about.links;
    this.joints = about.joints;
    this.dofs = about.dofs ?? [];
    this.below = this.links.map(() => []);
    this.joints.forEach((joint, index) => {
      if (joint.parent !== null) this.below[joint.parent]?.push(index);
    });
    const isRoot = (link: Link): boolean => link.parent_joint === null;
    this.roots = this.links.flatMap((link, index) => (isRoot(link) ? [index] : []));
    if (this.roots.length === 0 && this.links.length > 0) this.roots.push(0);
  }

  get name(): string {
    return this.about.name ?? this.entry.name;
  }

  /** Whether poses can be computed. */
  get moves(): boolean {
    return this.about.dofs !== null && this.about.zero !== null;
  }

  /** The configuration that it is first shown in: a closed one, or zero; null if it cannot be moved. */
  get start(): number[] | null {
    return this.about.loops?.reference ?? this.about.zero;
  }

  link(name: string): number {
    return this.links.findIndex((link) => link.name === name);
  }

  nameOf(link: number): string {
    return this.links[link]?.name ?? "";
  }

  /** The link that a part is, or that it moves. */
  linkOf(part: Part | null): number | null {
    return part?.kind === "joint" ? (this.joints[part.index]?.child ?? null) : (part?.index ?? null);
  }

  /** The joints from a link to the root, the link's own first. */
  path(link: number): number[] {
    const joints: number[] = [];
    const seen = new Set<number>();
    for (let at: number | null = link; at !== null && !seen.has(at);) {
      seen.add(at);
      const joint: number | null = this.links[at]?.parent_joint ?? null;
      if (joint === null) break;
      joints.push(joint);
      at = this.joints[joint]?.parent ?? null;
    }
    return joints;
  }

  /** The DOFs that move a joint: its own, or the one that it follows. */
  dofsOf(joint: number): number[] {
    const found = this.joints[joint];
    if (!found) return [];
    if (found.mimic) return found.mimic.dof === null ? [] : [found.mimic.dof];
    return found.dofs ?? [];
  }

  /** The DOFs above a link, and those that loops tie to others: what may move where it is pulled. */
  pulledBy(link: number): number[] {
    const loops = this.about.loops;
    const dofs = (link: number): number[] => this.path(link).flatMap((joint) => this.dofsOf(joint));
    const tied = loops?.loops.flatMap(({ links: [a, b] }) => {
      const [ofA, ofB] = [new Set(dofs(a)), new Set(dofs(b))];
      return [...[...ofA].filter((dof) => !ofB.has(dof)), ...[...ofB].filter((dof) => !ofA.has(dof))];
    });
    return [...new Set([...dofs(link), ...(tied ?? []), ...(loops?.couplings.flatMap(({ dofs }) => dofs) ?? [])])];
  }

  /** The first movable joint above a link. */
  moving(link: number): number | null {
    return this.path(link).find((joint) => this.dofsOf(joint).length > 0) ?? null;
  }

  /** Whether the DOF follows others, by loops. */
  follows(dof: number): boolean {
    const { loops } = this.about;
    return loops !== null && !loops.independent.includes(dof);
  }

  /** The position of a joint with one DOF; null for others. */
  position(joint: number, q: readonly number[]): number | null {
    const found = this.joints[joint];
    if (!found) return null;
    if (found.mimic) {
      const driver = found.mimic.dof === null ? 0 : (q[found.mimic.dof] ?? 0);
      return found.mimic.multiplier * driver + found.mimic.offset;
    }
    const [dof, ...more] = found.dofs ?? [];
    return dof === undefined || more.length > 0 ? null : (q[dof] ?? 0);
  }
}
