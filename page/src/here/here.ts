/** The robots that this page makes of what was dropped, and the text of the one that is open. */

import type { App } from "../app";
import type { Given } from "../drop";
import type { RobotSource } from "../engine/client";
import type { Report } from "../engine/protocol";
import { Latest } from "../latest";
import { unmet } from "../missing";
import type { Entry } from "../model";
import type { Keeper } from "../site";
import { ofText } from "../state";
import type { Draft } from "../state";
import { message } from "../ui/format";
import { Kit, MadeRobot, Reader } from "./made";

/** Pauses after a change of the text, before it is examined and before the robot is made again, ms. */
const SOON = 150;
const LATER = 500;

export class Here implements Keeper {
  readonly kit = new Kit();
  private robots: MadeRobot[] = [];
  private count = 0;
  /** The robot that is open, or waited for. */
  private current: MadeRobot | null = null;
  /** The one that was open before. */
  private last: MadeRobot | null = null;
  private timers: ReturnType<typeof setTimeout>[] = [];
  private readonly lints: Latest<MadeRobot>;

  constructor(private readonly app: App) {
    this.lints = new Latest(async (robot) => {
      const report = await robot.lint().then(
        (report) => ({ report, error: null, busy: null }),
        (error: unknown) => ({ report: null, error: message(error), busy: null }),
      );
      if (this.current === robot) app.store.set({ ...this.decoded(report.report), report });
    });
    // The robot got further while the page read it, or decisions on skips kept the page from showing it anew.
    app.store.on(["robot", "skips"], ({ robot, skips }) => {
      if (robot?.entry.here && !skips.dirty) this.show();
    });
  }

  /** The descriptions among these files as robots. */
  async take(files: Given[], signal: AbortSignal): Promise<Entry[]> {
    const reader = new Reader(this.kit, files);
    const stop = (): void => reader.end();
    signal.addEventListener("abort", stop);
    const found = await reader.descriptions().finally(() => {
      signal.removeEventListener("abort", stop);
      reader.end();
    });
    signal.throwIfAborted();
    if (found.length === 0) {
      throw new Error(
        "There is no robot description here: no file that is a URDF, an MJCF or an SDF by its content, and no USD with bodies.",
      );
    }
    const robots = found.map(
      (description) => new MadeRobot(`here.${++this.count}`, description, reader, (robot) => this.changed(robot)),
    );
    this.robots.push(...robots);
    return robots.map(({ entry }) => entry);
  }

  /** Removes robots, with all that is theirs. */
  remove(entries: Entry[]): void {
    const gone = new Set(entries.map(({ id }) => id));
    for (const robot of this.robots) if (gone.has(robot.entry.id)) robot.draw(null);
    if (this.current && gone.has(this.current.entry.id)) this.leave();
    this.robots = this.robots.filter(({ entry }) => !gone.has(entry.id));
    if (this.last && gone.has(this.last.entry.id)) this.last = null;
    const { store } = this.app;
    store.set({ entries: store.now.entries.filter(({ id }) => !gone.has(id)) });
  }

  /** Whether closing the page loses a robot that was not saved. */
  get isUnsaved(): boolean {
    return this.robots.some(({ isSaved }) => !isSaved);
  }

  entries(): Entry[] {
    return this.robots.map(({ entry }) => entry);
  }

  source(entry: Entry): RobotSource {
    return this.found(entry).source;
  }

  report(entry: Entry): Promise<Report> {
    const robot = this.found(entry);
    return robot.report ?? robot.lint();
  }

  state(entry: Entry): Entry {
    const robot = this.found(entry);
    if (this.current !== robot) void this.begin(robot);
    return robot.entry;
  }

  /** The robot that is open is drawn: a small picture of it is for its card. */
  async drawn(picture: () => Promise<Blob | null>): Promise<void> {
    const { current } = this;
    if (!current || this.app.store.now.robot?.entry.id !== current.entry.id) return;
    const blob = await picture();
    if (blob && this.robots.includes(current)) current.draw(blob);
  }

  /** The robot that is open. */
  get open(): MadeRobot | null {
    return this.current;
  }

  /** Makes the robot that is open whole, after it was stopped. */
  goOn(): void {
    void this.current?.make();
  }

  /** Ends the making of the robot that is open. What is there stays. */
  stop(): void {
    this.current?.stop("Stopped: the rest of this robot was not made.", true);
  }

  /** The page shows something else: nothing of ours, or `next`. */
  leave(next: MadeRobot | null = null): void {
    this.timers.forEach(clearTimeout);
    const { current } = this;
    this.current = null;
    this.app.store.set({ draft: null, wanted: [] });
    if (!current) return;
    current.close();
    // Whoever goes back finds the last robot as it was. Those before it are made again.
    if (this.last !== current && this.last !== next) this.last?.forget();
    this.last = current;
  }

  /** Adds files that were missing, and makes the robot again. */
  add(more: Given[]): void {
    const { current } = this;
    if (!current || !this.app.store.now.draft) return;
    current.reader.add(more);
    this.lints.ask(current);
    void current.make();
    this.want();
  }

  /** Says which files the description names that are not there. Those of a URDF are known once it is made. */
  private want(): void {
    const { current } = this;
    const draft = ofText(this.app.store.now.draft);
    const wanted = !current || !draft || draft.format === "urdf" ? [] : unmet(draft.text, current.reader.files);
    this.app.store.set({ wanted });
  }

  edit(text: string): void {
    const { current } = this;
    const { draft } = this.app.store.now;
    if (!current || !draft || draft.text === text) return;
    this.app.store.set({ draft: { ...draft, text, isChanged: true } });
    this.timers.forEach(clearTimeout);
    const examine = (): void => {
      current.reader.change(draft.path, text);
      current.isSaved = false;
      current.stop(null);
      this.lints.ask(current);
      this.want();
    };
    this.timers = [setTimeout(examine, SOON), setTimeout(() => void current.make(), LATER)];
  }

  saved(): void {
    const { draft } = this.app.store.now;
    if (this.current) this.current.isSaved = true;
    if (draft) this.app.store.set({ draft: { ...draft, isChanged: false } });
  }

  /** The text as the module decoded it: a file may be in another encoding than the page supposed. */
  private decoded(report: Report | null): { draft?: Draft } {
    const { draft } = this.app.store.now;
    const text = report?.text;
    return draft?.format === "urdf" && !draft.isChanged && typeof text === "string" && text !== draft.text
      ? { draft: { ...draft, text } }
      : {};
  }

  private found(entry: Entry): MadeRobot {
    const found = this.robots.find((robot) => robot.entry.id === entry.id);
    if (!found) throw new Error("this robot is gone: drop it again");
    return found;
  }

  private async begin(robot: MadeRobot): Promise<void> {
    this.leave(robot);
    this.current = robot;
    const { path, format } = robot.description;
    const text = await robot.reader.text(robot.description);
    if (this.current !== robot) return;
    if (format !== "xacro") {
      const draft: Draft = { path, format, text, isChanged: robot.reader.changed.has(path) };
      this.app.store.set({ draft, tab: "Findings" });
      this.lints.ask(robot);
      this.want();
    }
    if (!robot.isWhole) await robot.make();
  }

  /** A robot got further. */
  private changed(robot: MadeRobot): void {
    const { store } = this.app;
    const { entry } = robot;
    store.set({ entries: store.now.entries.map((known) => (known.id === entry.id ? entry : known)) });
    if (store.now.robot?.entry.id !== entry.id) return;
    this.show();
  }

  /** Shows the files of the open robot as they are now, if the page has others. */
  private show(): void {
    const { robot, skips } = this.app.store.now;
    const { current } = this;
    if (!robot || !current || robot.entry.id !== current.entry.id) return;
    if (robot.source.kind !== "local") return;
    const { making, failure, stopped } = current.entry;
    this.app.store.set({ making: { making, failure, stopped } });
    // What is not made by now will not be: panels say so.
    const ended = making === null && failure !== null && robot.entry.making !== null;
    if (robot.source.files === current.files && !ended) return;
    if (skips.dirty) {
      this.app.note("The robot is made anew. Your decisions on skips stay here: take them back to see it.");
      return;
    }
    void this.app.reopen(current.entry);
  }
}
