/** A report on an imported description, with its places in the original, as whoever writes that sees them. */

import { places } from "../findings";
import type { Place } from "../findings";
import type { Report } from "../engine/protocol";

/** `text` is that of the original. */
export function inOriginal(report: Report, text: string): Report {
  const urdds = report.urdds.map((urdd) => ({
    ...urdd,
    findings: urdd.findings.map((finding) => ({ ...finding, places: places(finding).map(moved) })),
  }));
  return { ...report, urdds, text };
}

/** Fixes are for the URDF that the import makes. */
function moved(place: Place): Place {
  const { written_at: written, related } = place;
  const where = written && { file: written.file, line: written.line, column: written.column ?? null, written_at: null };
  return { ...place, line: null, column: null, ...where, fixes: [], related: related.map(moved) };
}
