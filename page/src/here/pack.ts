/** A .zip of files: the same bytes for the same files. */

import { zipSync } from "fflate";
import type { Zippable } from "fflate";
import type { Given } from "./protocol";

/** A .zip cannot say an earlier time. */
const TIME = "1980-01-02T00:00:00";
/** Of 0 to 9: meshes gain little from more. */
const LEVEL = 3;

export async function packed(files: Given[]): Promise<Blob> {
  const all: Zippable = {};
  for (const { path, file } of files) all[path] = [new Uint8Array(await file.arrayBuffer()), { mtime: TIME }];
  return new Blob([zipSync(all, { level: LEVEL }).slice()], { type: "application/zip" });
}
