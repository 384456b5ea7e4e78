/** A button that asks for files, or for a folder. */

import { button, h } from "./dom";

export function picker(text: string, folder: boolean, choose: (files: File[], folder: boolean) => void): HTMLElement {
  const input = h("input", { type: "file", hidden: true, webkitdirectory: folder, multiple: true });
  input.addEventListener("change", () => {
    const files = [...(input.files ?? [])];
    input.value = "";
    if (files.length > 0) choose(files, folder);
  });
  return h(
    "span",
    {},
    button(text, {}, () => input.click()),
    input,
  );
}
