/** The findings of a report that have a line of the draft. */

import type { Deed, Report } from "../engine/protocol";
import type { Found } from "../editor/marks";
import { places } from "../findings";
import { fixesOf, isDraft } from "../fixes";
import type { Draft } from "../here/draft";
import { DEEDS } from "./programs";

export function foundIn(report: Report, draft: Draft): Found[] {
  const urdd = report.urdds[0];
  if (!urdd) return [];
  const names = new Map(urdd.programs.map(({ program, name }) => [program, name]));
  return urdd.findings.flatMap((finding) => {
    const { code, severity, message } = finding;
    const deeds = new Map<Deed, string[]>();
    for (const { program, does } of finding.programs)
      deeds.set(does, [...(deeds.get(does) ?? []), names.get(program) ?? program]);
    const programs = [...deeds].map(([deed, names]) => `${DEEDS[deed]}: ${names.join(", ")}`).join(" · ");
    return places(finding).flatMap((place) => {
      if (place.line === null || !isDraft(draft, place.file)) return [];
      const { line, column, message: here } = place;
      return [{ code, severity, message: here ?? message, programs, line, column, fixes: fixesOf(draft, place) }];
    });
  });
}
