/** How far the ends of a kinematic loop are apart, in words. */

import type { Loop, LoopErrors } from "./engine/protocol";
import { dofValue, length } from "./ui/format";

/** What rounding leaves, m and rad. */
const ROUNDING = 1e-8;

/** Null where the loop is closed. */
export function apart({ tolerances }: Loop, { position, rotation }: LoopErrors["gaps"][number]): string | null {
  const [far, turned] = [position > tolerances[0] + ROUNDING, rotation > tolerances[1] + ROUNDING];
  // The gap of a rotation is twice the sine of half its angle.
  const angle = 2 * Math.asin(Math.min(1, rotation / 2));
  const words = [far && length(position), turned && dofValue(angle, "rad")].filter((word) => word !== false);
  return words.length > 0 ? words.join(" and ") : null;
}
