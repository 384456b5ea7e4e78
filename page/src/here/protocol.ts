/** Messages between the page and a worker that makes robots. */

import type * as Npm from "../../../wasm/npm/index";
import type { ExportOptions, Format, GenerateOptions } from "../../../wasm/npm/index";
import type { Description, Report } from "../engine/protocol";

export type { Description };

/** A file that was dropped, was in a .zip, or was made. */
export interface Given {
  path: string;
  file: Blob;
  /** Whether nobody knows the folder that it belongs into: it was dropped by itself, or later. */
  isLost?: boolean;
}

export function lost(given: Given): Given {
  return { ...given, isLost: true };
}

export function sizeOf(files: readonly Given[]): number {
  return files.reduce((sum, { file }) => sum + file.size, 0);
}

export type MakeOptions = Pick<GenerateOptions, "modules">;

export type Actuators = NonNullable<ExportOptions["actuators"]>;

/** What the module answers: of the package's answer, `files` is an address there. */
type Answer<T> = Omit<T, "files"> & { files: number };

export type Made = Answer<Omit<Npm.Generated, "name">> & { robot: string };
export type Imported = Answer<Npm.ImportedRobot>;
export type Exported = Answer<Npm.Exported>;

/** The worker's queries and answers, by name. */
export interface MakerCalls {
  init: [{ module: WebAssembly.Module }, null];
  /** Takes files, each of which is read when it is needed. */
  take: [{ files: Given[] }, null];
  descriptions: [Record<string, never>, Description[]];
  /** Sets the content of a file that was taken. */
  put: [{ path: string; text: string }, null];
  lint: [{ path: string }, Report];
  /**
   * A URDD; what did not change is taken from the last that this worker made, or from the files of `donor` if it made none.
   * The answer has all its paths, and those `files` that are not as they were there.
   */
  generate: [
    { path: string; donor: Given[]; options: MakeOptions },
    { robot: string; links: number; dofs: number; notes: string[]; paths: string[]; files: Given[] },
  ];
  /** The files of the URDF that an MJCF, SDF or USD becomes. */
  import: [{ path: string }, { main: string; files: Given[] }];
  /** Files for another program, of a URDD. */
  export: [
    { urdd: Given[]; format: Format; output: string; actuators: Actuators | null },
    { main: string; notes: string[]; files: Given[] },
  ];
  /** A .zip of files. */
  zip: [{ files: Given[] }, Blob];
  /** The module's memory, bytes. */
  memory: [Record<string, never>, number];
}
