/** The page's actions: opens robots, moves them, runs queries. Panels show the state and call this. */

import { contactsOf } from "./contacts";
import { namedOf, partsOf, spheresOf } from "./document";
import type { Engine, RobotSource } from "./engine/client";
import { Trapped } from "./engine/link";
import type { Dof, InverseQuestion, InverseSolution, Report, ShapeKind } from "./engine/protocol";
import { Latest } from "./latest";
import { absentMeshes } from "./missing";
import { RobotModel } from "./model";
import type { Entry, Part } from "./model";
import type { Site } from "./site";
import { CHOOSES_PAIRS, LAYERS, NO_SKIPS, NOT_MADE, partial, PARTIAL, StateStore, unseen } from "./state";
import type { Layer, LayerKind, Pair, State } from "./state";
import { keepUnits, message } from "./ui/format";
import type { Units } from "./ui/format";

/** Number of requested nearest pairs: if they are listed, and if only contacts count. */
const LISTED = 128;
const FEW = 24;
/** Attempts to read files that change. */
const MAX_TRIES = 5;
/** Maximum number of undo steps, and the pause after which a move is a new step, ms. */
const MAX_STEPS = 200;
const REST = 300;

export class App {
  readonly store = new StateStore();
  private readonly poses: Latest<number[]>;
  private readonly reaching: Latest<number[]>;
  private readonly proximity: Latest<{ q: number[]; shapes: ShapeKind }>;
  /** The revision of the robot's files when they were read; null if unknown. */
  revision: string | null = null;
  private opening = 0;
  /** Whether the page itself changes the robot's files, or reads what it changed: that is no news. */
  isWriting = false;
  /** The robot whose first picture is complete. */
  private drawn: RobotModel | null = null;
  /** Called before a person moves the robot. */
  readonly byHand: (() => void)[] = [];
  private back: number[][] = [];
  private forth: number[][] = [];
  private movedAt = -Infinity;
  private noting: ReturnType<typeof setTimeout> | undefined;

  constructor(
    readonly engine: Engine,
    readonly site: Site,
  ) {
    this.poses = new Latest(async (q) => {
      const robot = this.store.now.robot;
      const closing = robot?.about.loops ? engine.ask("loopErrors", { q }) : null;
      const poses = await engine.ask("linkPoses", { q });
      const loops = await closing;
      if (this.store.now.robot === robot) this.store.set({ poses, loops });
    });
    this.reaching = new Latest(async (to) => {
      const { robot, q: from } = this.store.now;
      const found = await engine.ask("followLoops", { from, to });
      if (this.store.now.robot !== robot) return;
      this.move(found.configuration);
      if (!found.is_closed) this.note("The loops do not close from here.");
    });
    this.proximity = new Latest(async ({ q, shapes }) => {
      const { robot, tab } = this.store.now;
      const isOld = (): boolean => this.store.now.robot !== robot || this.store.now.shapes !== shapes;
      try {
        const answer = await engine.ask("proximity", { q, kind: shapes, k: tab === "Proximity" ? LISTED : FEW });
        if (isOld()) return;
        const contacts = contactsOf(answer, shapes, this.store.now.contacts);
        this.store.set({ proximity: { answer, error: null }, contacts });
      } catch (error) {
        if (!isOld()) this.store.set({ proximity: { answer: null, error: message(error) }, contacts: null });
      }
    });
    this.store.on(["tab"], ({ tab, robot }) => {
      if (!CHOOSES_PAIRS.has(tab)) this.store.set({ pair: null });
      // That panel lists more pairs.
      if (tab === "Proximity" && robot) this.measure();
    });
  }

  /** Opens a robot. `old` is its last version, whose view is preserved where possible. */
  async open(entry: Entry, source: RobotSource, old: RobotModel | null = null): Promise<RobotModel | null> {
    const turn = ++this.opening;
    const before = this.store.now;
    this.store.set({
      robot: null,
      failure: null,
      making: NOT_MADE,
      faults: new Map(),
      loading: { what: "modules", done: 0, of: 0 },
      ...(old ? {} : unseen()),
      proximity: { answer: null, error: null },
      contacts: null,
      absent: [],
      // Unsaved edits survive a reload of the same robot.
      skips: old && before.skips.dirty ? before.skips : NO_SKIPS,
      // That of a text that this page makes a robot of does not follow from how far the robot is.
      report: old?.entry.here ? before.report : { report: null, error: null, busy: null },
      sample: null,
    });
    try {
      const { about, files } = await this.engine.ask("open", { source }, ({ what, done, of }) => {
        if (turn === this.opening) this.store.set({ loading: { what, done, of } });
      });
      if (turn !== this.opening) return null;
      this.revision = source.kind === "url" ? source.revision : null;
      const parts = await partsOf(this.engine, files);
      const named = await namedOf(this.engine, files, about.dofs?.length ?? 0);
      const spheres = await spheresOf(this.engine, files);
      const robot = new RobotModel(entry, source, about, files, parts, named, spheres);
      if (robot.links.length === 0) throw new Error(why(robot));
      const view = old ? carried(old, robot, before) : null;
      const q = view?.q ?? robot.start ?? robot.dofs.map(() => 0);
      const poses = about.dofs ? await this.engine.ask("linkPoses", { q }) : null;
      const loops = about.loops ? await this.engine.ask("loopErrors", { q }) : null;
      if (turn !== this.opening) return null;
      this.back = [];
      this.forth = [];
      const { making, failure, stopped } = entry;
      this.store.set({ ...view, robot, q, poses, loops, loading: null, making: { making, failure, stopped } });
      void this.findAbsent(robot);
      return robot;
    } catch (error) {
      if (turn === this.opening) this.store.set({ loading: null, failure: message(error) });
      return null;
    }
  }

  /** Opens a robot of the server as it is now. Files that are replaced while they are read are read again. */
  async openNow(
    entry: Entry,
    old: RobotModel | null = null,
    isWanted: () => boolean = () => true,
  ): Promise<RobotModel | null> {
    let failed: string | null | undefined;
    for (let tries = 1; ; tries++) {
      const turn = this.opening + 1;
      const source = await this.site.source(entry);
      // Somebody opened another robot meanwhile.
      if (this.opening !== turn - 1 || !isWanted()) return null;
      // The same files fail again.
      const revision = source.kind === "url" ? source.revision : null;
      if (revision === failed) return null;
      const robot = await this.open(entry, source, old);
      if (robot || this.opening !== turn || tries === MAX_TRIES) return robot;
      failed = revision;
      await new Promise((resolve) => setTimeout(resolve, REST));
      if (this.opening !== turn) return null;
    }
  }

  /** Reloads the robot after its files changed, or it was saved. */
  async reopen(entry: Entry): Promise<void> {
    const { robot, skips } = this.store.now;
    if (robot?.source.kind !== "url" && !robot?.entry.here) return;
    await this.openNow(entry, robot);
    this.store.set({ skips: { ...this.store.now.skips, saved: skips.saved } });
    if (this.store.now.tab === "Findings") void this.loadReport();
  }

  /** Changes the files of the robot as they were read, then reads them: the entry that `change` returns, or the same. */
  async write(change: (robot: RobotModel, revision: string) => Promise<Entry | null>): Promise<void> {
    const { robot } = this.store.now;
    if (!robot) throw new Error("no robot is open");
    if (this.revision === null) throw new Error("the server does not answer");
    this.isWriting = true;
    try {
      const entry = await change(robot, this.revision);
      if (this.store.now.robot === robot) await this.reopen(entry ?? robot.entry);
    } finally {
      this.isWriting = false;
    }
  }

  close(): void {
    this.opening++;
    // What nobody waits for any more keeps no other robot waiting.
    if (this.store.now.robot === null && this.store.now.loading !== null) this.engine.end();
    this.store.set({
      robot: null,
      failure: null,
      loading: null,
      making: NOT_MADE,
      q: [],
      poses: null,
      loops: null,
      pair: null,
      contacts: null,
      absent: [],
      report: { report: null, error: null, busy: null },
    });
  }

  /** Moves the robot. Moves in quick succession, as in a drag, are one undo step. */
  move(q: number[]): void {
    if (!q.every(Number.isFinite)) return;
    for (const listener of this.byHand) listener();
    const now = performance.now();
    if (now - this.movedAt > REST) {
      this.back = [...this.back.slice(1 - MAX_STEPS), this.store.now.q];
      this.forth = [];
    }
    this.movedAt = now;
    this.place(q);
  }

  /** Undoes or redoes a move. */
  step(by: "back" | "forth"): void {
    const [from, to] = by === "back" ? [this.back, this.forth] : [this.forth, this.back];
    const q = from.pop();
    if (!q) {
      this.note(by === "back" ? "Nothing to undo." : "Nothing to redo.");
      return;
    }
    to.push(this.store.now.q);
    this.movedAt = -Infinity;
    this.place(q);
  }

  /** Shows a configuration of a trajectory or of a program, which no undo step takes back. */
  follow(q: number[]): void {
    if (q.every(Number.isFinite)) this.place(q);
  }

  private place(q: number[]): void {
    this.store.set({ q, sample: null });
    this.poses.ask(q);
    this.measure();
  }

  /** Moves the robot toward a configuration: with closed loops, as far as they go, unless they may open. */
  async reach(q: number[]): Promise<void> {
    const { robot, keepClosed } = this.store.now;
    if (!robot?.about.loops || !keepClosed) {
      this.move(q);
      return;
    }
    if (q.every(Number.isFinite)) await this.reaching.done(q);
  }

  /** Searches for a configuration in which a link is at a place, with closed loops unless they may open. */
  solve(question: InverseQuestion): Promise<InverseSolution> {
    return this.engine.ask("inverseKinematics", { ...question, open_loops: !this.store.now.keepClosed });
  }

  setDof(dof: number, value: number): Promise<void> {
    const q = this.store.now.q.slice();
    q[dof] = value;
    return this.reach(q);
  }

  /** Requests distances and collisions. The first picture has priority. */
  measure(): void {
    const { robot, q, shapes } = this.store.now;
    if (!robot?.moves || this.drawn !== robot) return;
    const error = partial(robot.entry);
    if (error !== null) this.store.set({ proximity: { answer: null, error }, contacts: null });
    else this.proximity.ask({ q, shapes });
  }

  /** Called when the first picture of the robot is complete, or cannot be drawn. */
  settled(): void {
    const { robot } = this.store.now;
    this.drawn = robot;
    this.measure();
    // What is wrong with a URDF is said without being asked for.
    if (robot?.entry.temporary) void this.loadReport();
  }

  useShapes(shapes: ShapeKind): void {
    this.store.set({ shapes, pair: null, proximity: { answer: null, error: null }, contacts: null });
    this.measure();
  }

  setUnits(units: Units): void {
    keepUnits(units);
    this.store.set({ units });
  }

  private async findAbsent(robot: RobotModel): Promise<void> {
    const absent = await absentMeshes(this.engine, robot);
    if (this.store.now.robot === robot) this.store.set({ absent });
  }

  select(selected: Part | null): void {
    this.store.set({ selected });
  }

  hover(hovered: Part | null): void {
    this.store.set({ hovered });
  }

  setLayer(kind: LayerKind, change: Partial<Layer>): void {
    const { layers } = this.store.now;
    this.store.set({ layers: { ...layers, [kind]: { ...layers[kind], ...change } } });
  }

  /** Shows only this layer. */
  showOnly(kind: LayerKind): void {
    const { layers } = this.store.now;
    const next = { ...layers };
    for (const layer of LAYERS)
      next[layer] = { on: layer === kind, opacity: layer === kind ? 1 : layers[layer].opacity };
    this.store.set({ layers: next });
  }

  hide(links: Iterable<number>, hide: boolean): void {
    const hidden = new Set(this.store.now.hidden);
    for (const link of links) {
      if (hide) hidden.add(link);
      else hidden.delete(link);
    }
    this.store.set({ hidden });
  }

  /** Loads the report again, after the URDF broke or was mended. */
  async renewReport(): Promise<void> {
    this.store.set({ report: { report: null, error: null, busy: null } });
    await this.loadReport();
  }

  /** Loads the report from the site, or validates here. */
  async loadReport(): Promise<void> {
    const { robot, report } = this.store.now;
    if (!robot || report.busy !== null || report.report) return;
    const { making, temporary } = robot.entry;
    // The findings of a URDF need no URDD.
    if (making && !temporary) {
      this.store.set({ report: { report: null, error: PARTIAL, busy: null } });
      return;
    }
    const begun = { report: null, error: null, busy: temporary ? "Examining the URDF" : "Validating" };
    this.store.set({ report: begun });
    let last: State["report"] = begun;
    const set = (report: Report | null, error: string | null): void => {
      // Another robot, or another run, may have taken its place.
      if (this.store.now.report === last) this.store.set({ report: { report, error, busy: null } });
    };
    try {
      const known = robot.entry.id !== "" ? await this.site.report(robot.entry) : null;
      const made =
        known ??
        (await this.engine.aside("validate", { name: robot.entry.name }, ({ done, of }) => {
          const busy = `Validating: ${done} of ${of} files`;
          if (this.store.now.report !== last) return;
          last = { report: null, error: null, busy };
          this.store.set({ report: last });
        }));
      set(made, null);
    } catch (error) {
      // A crash loses the validator's findings, and proves nothing.
      const incomplete = error instanceof Trapped ? "not fully examined: " : "";
      set(null, incomplete + message(error));
    }
  }

  note(text: string): void {
    clearTimeout(this.noting);
    this.store.set({ note: text });
    this.noting = setTimeout(() => this.store.set({ note: null }), 4000);
  }
}

/** The view of a robot for its next version: joints and links are known by their names. */
function carried(
  old: RobotModel,
  robot: RobotModel,
  { q, selected, hidden, pair }: State,
): Partial<State> & { q: number[] } {
  const link = (index: number): number => robot.link(old.nameOf(index));
  const zero = robot.about.zero ?? [];
  const place = ({ name, bounds }: Dof, k: number): number => {
    const value = q[old.dofs.findIndex((dof) => dof.name === name)];
    const [low, high] = bounds ?? [-Infinity, Infinity];
    return value === undefined ? (zero[k] ?? 0) : Math.min(Math.max(value, low), high);
  };
  const index =
    selected?.kind === "joint"
      ? robot.joints.findIndex(({ name }) => name === old.joints[selected.index]?.name)
      : link(selected?.index ?? -1);
  const pieces = pair?.map(([of, piece]) => [link(of), piece]) as Pair | undefined;
  return {
    q: robot.dofs.map(place),
    selected: selected && index >= 0 ? { ...selected, index } : null,
    hovered: null,
    hidden: new Set([...hidden].map(link).filter((found) => found >= 0)),
    pair: pieces?.every(([of]) => of >= 0) ? pieces : null,
  };
}

/** Why a robot has no links. */
function why(robot: RobotModel): string {
  const [fault] = robot.about.faults;
  if (fault) return `This URDD cannot be shown: ${fault.reason}`;
  return "This URDD has no readable urdf_module or chain_module, so there is nothing to show.";
}
