/** The user's edits of skips: made, undone, saved. */

import { strToU8, zipSync } from "fflate";
import type { App } from "./app";
import type { PairDistance, ShapeKind, SkipEdit, SkipsAnswer } from "./engine/protocol";
import { partial } from "./state";
import { offer } from "./ui/files";
import { message, count } from "./ui/format";

/** More pairs than any robot has. */
const ALL = 1e9;

export async function load(app: App, shapes: ShapeKind): Promise<void> {
  const { skips, robot } = app.store.now;
  const error = robot && partial(robot.entry);
  if (error !== null) {
    app.store.set({ skips: { ...skips, answer: null, error } });
    return;
  }
  const edits = skips.dirty ? skips.answer?.edits : null;
  try {
    const answer = edits
      ? await app.engine.ask("editSkips", { kind: shapes, edits })
      : await app.engine.ask("skips", { kind: shapes });
    app.store.set({ skips: { ...app.store.now.skips, answer, error: null } });
  } catch (error) {
    app.store.set({ skips: { ...app.store.now.skips, answer: null, error: message(error) } });
  }
}

/** Adds edits. */
export async function decide(app: App, more: SkipEdit[]): Promise<void> {
  if (!app.store.now.skips.answer) await load(app, "hulls");
  const { answer, error } = app.store.now.skips;
  const edits = answer?.edits;
  if (!edits) {
    app.note(error ?? "A legacy URDD has no edits: generate a new URDD to edit skips.");
    return;
  }
  // Only the last edit of a pair counts.
  const kept = edits.filter((edit) => !more.some(({ link_a, link_b }) => isOf(edit, [link_a, link_b])));
  await change(app, [...kept, ...more], [...app.store.now.skips.before, edits]);
  if (app.store.now.tab !== "Skips") {
    app.note(`${count(more.length, "pair")} of links edited. Save or undo in Skips.`);
  }
}

async function change(app: App, edits: SkipEdit[], before: SkipEdit[][]): Promise<void> {
  const { skips } = app.store.now;
  if (!skips.answer) return;
  try {
    const answer = await app.engine.ask("editSkips", { kind: skips.answer.kind, edits });
    app.store.set({ skips: { ...app.store.now.skips, answer, error: null, before, dirty: before.length > 0 } });
  } catch (error) {
    app.note(`The edit failed: ${message(error)}`);
  }
}

/** Undoes the last edit, or, after a save, the save. */
export async function undo(app: App): Promise<void> {
  const { skips } = app.store.now;
  const before = skips.before.slice();
  const last = before.pop();
  if (last) await change(app, last, before);
  else if (skips.saved > 0) await post(app, { undo: true }, "The last save is undone: the files are restored.");
}

export async function save(app: App): Promise<void> {
  const { answer } = app.store.now.skips;
  if (answer) await post(app, { edits: answer.edits ?? [] }, "Saved.");
}

async function post(app: App, wish: Record<string, unknown>, done: string): Promise<void> {
  try {
    await app.write(async ({ entry }, revision) => {
      const path = `robots/${encodeURIComponent(entry.id)}/skips`;
      const answer = (await app.site.post(path, { ...wish, revision })) as { revision: string; undo: number };
      app.store.set({ skips: { ...app.store.now.skips, before: [], dirty: false, saved: answer.undo } });
      return null;
    });
    app.note(done);
  } catch (error) {
    app.note(`Nothing was saved: ${message(error)}`);
  }
}

/** Downloads an archive of the changed files, for a page that cannot write them. */
export function download(app: App): void {
  const { skips, robot } = app.store.now;
  const files = skips.answer?.files;
  if (!files || !robot) return;
  const zip = zipSync(Object.fromEntries(files.map(({ path, text }) => [path, strToU8(text)])));
  offer(new Blob([zip], { type: "application/zip" }), `${robot.entry.name}-skips.zip`);
  app.note("Unpack the archive into the folder of the URDD: it has the three files that change.");
}

/** Skips all pairs of links that are nearer than this pair, by distance or relative to the mean. */
export async function nearer(
  app: App,
  links: [number, number],
  by: "distance" | "relative",
  reason: string,
): Promise<void> {
  const { robot, q, shapes } = app.store.now;
  if (!robot) return;
  const { nearest } = await app.engine.ask("proximity", { q, kind: shapes, k: ALL });
  const key = (pair: PairDistance): number => (by === "distance" ? pair.distance : (pair.relative ?? Infinity));
  const least = new Map<string, { links: [number, number]; value: number }>();
  for (const pair of nearest) {
    const [a, b] = [Math.min(...pair.link_idxs), Math.max(...pair.link_idxs)];
    const known = least.get(`${a} ${b}`);
    if (!known || key(pair) < known.value) least.set(`${a} ${b}`, { links: [a, b], value: key(pair) });
  }
  const own = least.get(`${Math.min(...links)} ${Math.max(...links)}`);
  if (!own || !Number.isFinite(own.value)) {
    app.note("This pair has no such distance: it is skipped, or has no mean.");
    return;
  }
  const found = [...least.values()].filter((pair) => pair.value < own.value);
  if (found.length === 0) app.note("No other pair is nearer.");
  else
    await decide(
      app,
      found.map(({ links: [a, b] }) => ({ link_a: robot.nameOf(a), link_b: robot.nameOf(b), skip: true, reason })),
    );
}

/** Whether an edit is of these two links, in any order. */
export function isOf({ link_a, link_b }: SkipEdit, [a, b]: readonly [string, string]): boolean {
  return (link_a === a && link_b === b) || (link_a === b && link_b === a);
}

export function isSkipped(answer: SkipsAnswer, i: number, j: number): boolean {
  // Legacy matrices are filled only above the diagonal.
  return answer.skipped[Math.min(i, j)]?.[Math.max(i, j)] === "1";
}

export function letterAt(answer: SkipsAnswer, i: number, j: number): string {
  return answer.reasons?.[i]?.[j] ?? (i === j ? "s" : "?");
}
