/** Files that the page offers for download, and files that it asks for. */

import { h, button } from "./dom";

/** Downloads a file. */
export function offer(content: Blob, name: string): void {
  const url = URL.createObjectURL(content);
  h("a", { href: url, download: name.replace(/[^\p{L}\p{N}._-]+/gu, "_") }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** A button that asks for files, or for a folder. */
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
