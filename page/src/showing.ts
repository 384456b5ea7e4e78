/** What programs show of a robot: a configuration, a path, obstacles. `show` and `frame` of the Python package write it. */

/** A body that the robot must not touch, in the root link's frame. Lengths are in metres. */
export interface Obstacle {
  name: string;
  /** A homogeneous matrix, 4 x 4, in rows. */
  pose: number[];
  shape: Shape;
}

/** Arrays are bytes in base64: 32 bits a number, little-endian. */
export type Shape =
  | { kind: "cuboid"; half_extents: number[] }
  | { kind: "sphere"; radius: number }
  | { kind: "capsule" | "cylinder"; radius: number; half_length: number }
  | { kind: "hull"; points: string }
  | { kind: "mesh"; vertices: string; faces: string }
  | { kind: "points"; points: string; radius: number }
  | { kind: "height_field"; heights: string; columns: number; cell: number[]; thickness: number };

export interface Showing {
  /** A value for each DOF. */
  q?: number[];
  /** In place of the obstacles that are shown. */
  world?: Obstacle[];
  /** Configurations at times, seconds from the first, ascending; null for none. */
  path?: { times: number[]; rows: number[][] } | null;
}

function bytes(text: string): ArrayBuffer {
  return Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
}

/** Rows of three, or single values. */
export function floats(text: string): Float32Array {
  return new Float32Array(bytes(text));
}

export function indices(text: string): Uint32Array {
  return new Uint32Array(bytes(text));
}
