/** Fine sliders: arrow keys move by a step of the unit, and Shift makes the pointer ten times slower. */

/** Number of steps for a page key, or for an arrow key with Shift. */
const LARGE = 10;
/** How much slower the pointer is with Shift. */
const SLOW = 10;

/** Adds keys and a slow pointer to a slider without steps. `step` is called for each key. */
export function refine(slider: HTMLInputElement, step: () => number): void {
  const put = (value: number): void => {
    slider.value = String(Math.min(Number(slider.max), Math.max(Number(slider.min), value)));
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  };
  slider.addEventListener("keydown", (event) => {
    const steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: LARGE, PageDown: -LARGE }[
      event.key
    ];
    if (steps === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    put(Number(slider.value) + steps * (event.shiftKey ? LARGE : 1) * step());
  });
  let from: { x: number; value: number } | null = null;
  slider.addEventListener("pointerdown", (event) => {
    if (!event.shiftKey || event.button !== 0) return;
    event.preventDefault();
    slider.focus();
    slider.setPointerCapture(event.pointerId);
    from = { x: event.clientX, value: Number(slider.value) };
  });
  slider.addEventListener("pointermove", (event) => {
    if (!from) return;
    const range = Number(slider.max) - Number(slider.min);
    put(from.value + ((event.clientX - from.x) * range) / slider.clientWidth / SLOW);
  });
  for (const end of ["pointerup", "pointercancel"])
    slider.addEventListener(end, () => {
      from = null;
    });
}
