/** A module of ours, as `module.mjs` has it: for `index.mjs` and the page. Files and robots are addresses in its memory. */
export declare class Urdd {
  tell: (progress: { what: string; done: number; of: number }) => void;
  content: (path: string) => Uint8Array | null;
  write: (question: unknown) => string;
  noMemory: string;
  static of(source: BufferSource | WebAssembly.Module): Promise<Urdd>;
  readonly memory: number;
  readonly validates: boolean;
  zip(name: string, zip: Uint8Array): number;
  unzipped(zip: Uint8Array): number;
  files(name: string, files: Record<string, Uint8Array | number>): number;
  name(files: number, path: string, size: number): void;
  give(files: number, path: string, content: Uint8Array): void;
  put(files: number, path: string, content: Uint8Array): void;
  lose(files: number, path: string): void;
  list(files: number): {
    name: string;
    files: { path: string; size: number }[];
  };
  changed(files: number, before: number): string[];
  read(files: number, path: string): Uint8Array<ArrayBuffer>;
  mesh(
    files: number,
    path: string,
  ): { positions: Float32Array; indices: Uint32Array };
  validate(files: number, name: string): unknown;
  lint(files: number, question: object): unknown;
  descriptions(files: number): unknown;
  generate(files: number, question: object, donor?: number): unknown;
  importRobot(files: number, question: object): unknown;
  export(files: number, question: object): unknown;
  explain(code: string): unknown;
  closeFiles(files: number): void;
  open(files: number): number;
  close(robot: number): void;
  linkPosesBatch(robot: number, values: ArrayLike<number>): Float64Array;
  ask(robot: number, question: object): unknown;
  sphereChecker(robot: number, question: object): unknown;
  spheresAround(checker: number, obstacles: object[]): unknown;
  spheresWithin(
    checker: number,
    values: ArrayLike<number>,
    margin: number,
    isOne: boolean,
  ): Uint8Array;
  spheresEdges(
    checker: number,
    starts: ArrayLike<number>,
    ends: ArrayLike<number>,
    settings: {
      margin: number;
      resolution: number;
      openLoops: boolean;
      isFirst: boolean;
      isOne: boolean;
    },
  ): Float64Array;
  closeSpheres(checker: number): void;
}
