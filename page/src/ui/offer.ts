/** Downloads a file. */

import { h } from "./dom";

export function offer(content: Blob, name: string): void {
  const url = URL.createObjectURL(content);
  h("a", { href: url, download: name.replace(/[^\p{L}\p{N}._-]+/gu, "_") }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
