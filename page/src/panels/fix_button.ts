/** A button that makes a fix. */

import { button, prose } from "../ui/dom";
import { name } from "../ui/format";

export function fixButton({ message, is_safe }: { message: string; is_safe: boolean }, click: () => void): HTMLElement {
  const title = is_safe
    ? "Has one right answer: `urdd lint --fix` does it"
    : "One way to mend it: `urdd lint --fix` leaves it to you";
  return button([is_safe ? "Fix: " : "Possible fix: ", ...prose(name(message))], { class: "fix", title }, click);
}
