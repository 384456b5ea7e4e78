/** Fixes of findings, made in the draft. */

import type { App } from "./app";
import { Lines, apply, changesOf } from "./edits";
import type { Fix } from "./edits";
import type { Place } from "./findings";
import { ofText } from "./state";
import type { Draft } from "./state";

/** The name of the draft's file. */
export function fileName({ path }: Draft): string {
  return path.slice(path.lastIndexOf("/") + 1);
}

/** Whether the report means the draft by this file: it names files relative to the draft's folder. */
export function isDraft(draft: Draft, file: string | null): boolean {
  return file !== null && (file === draft.path || file === fileName(draft));
}

/** Whether fixes of the report are for the draft: those of MJCF, SDF and USD are for the URDF that an import makes. */
export function hasFixes({ format }: Draft): boolean {
  return format === "urdf";
}

/** The fixes of a place that change the draft alone, the safe ones first. */
export function fixesOf(draft: Draft | null, { fixes = [] }: Place): Fix[] {
  if (!draft || !hasFixes(draft)) return [];
  const here = fixes.filter(({ edits }) => edits.length > 0 && edits.every(({ file }) => isDraft(draft, file)));
  return here.sort((a, b) => Number(b.is_safe) - Number(a.is_safe));
}

/** Makes a fix of the report in the draft. */
export function mend(app: App, fix: Fix): void {
  const { report } = app.store.now;
  const draft = ofText(app.store.now.draft);
  if (!draft) return;
  const isOld = report.report?.text !== draft.text;
  const changes = isOld ? null : changesOf(fix, new Lines(draft.text), (file) => isDraft(draft, file));
  if (changes) app.site.here?.edit(apply(draft.text, changes));
  else app.note("The text has changed: wait for its findings.");
}
