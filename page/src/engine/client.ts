/** The worker that validates and moves the open robot: its queries and answers, and the page's side. */

import { Link } from "./link";
import type { Progress } from "./link";
import type {
  About,
  ClosedLoops,
  Explanation,
  FileEntry,
  InverseQuestion,
  InverseSolution,
  LoopErrors,
  ProximityAnswer,
  Report,
  Sample,
  Shape,
  ShapeKind,
  SkipEdit,
  SkipsAnswer,
  SourceShape,
} from "./protocol";

/** The triangles of a mesh, or an error. */
export interface LinkMesh {
  link: number;
  piece: number;
  positions?: Float32Array;
  indices?: Uint32Array;
  error?: string;
}

/** The source of a robot's files. */
export type RobotSource =
  | { kind: "url"; name: string; base: string; token: string | null; files: FileEntry[]; revision: string | null }
  | { kind: "local"; name: string; files: { path: string; file: Blob }[] }
  | { kind: "zip"; name: string; bytes: ArrayBuffer };

/** The worker's queries and answers, by name. */
export interface Calls {
  /** The module: its address, or its bytes, compressed by brotli. */
  init: [{ wasm: string | ArrayBuffer }, null];
  open: [{ source: RobotSource }, { about: About; files: FileEntry[] }];
  linkPoses: [{ q: number[] }, Float64Array];
  random: [{ k: number }, number[]];
  file: [{ path: string }, ArrayBuffer];
  meshes: [{ kind: "plain" | "hulls" | "pieces" }, LinkMesh[]];
  /** The triangles of files: `link` is the index of the file in the query. */
  triangles: [{ paths: string[] }, LinkMesh[]];
  sources: [Record<string, never>, SourceShape[]];
  inverseKinematics: [InverseQuestion, InverseSolution];
  loopErrors: [{ q: number[] }, LoopErrors];
  /** The way from one configuration toward another with closed loops, as far as it goes: DOFs that follow give way. */
  followLoops: [{ from: number[]; to: number[] }, ClosedLoops];
  shapes: [{ kind: ShapeKind }, Shape[]];
  /** The `k` nearest pairs, or all contacts if there are more. */
  proximity: [{ q: number[]; kind: ShapeKind; k: number }, ProximityAnswer];
  skips: [{ kind: ShapeKind }, SkipsAnswer];
  editSkips: [{ kind: ShapeKind; edits: SkipEdit[] }, SkipsAnswer];
  samples: [Record<string, never>, { samples: Sample[] }];
  explain: [{ code: string }, Explanation];
  validate: [{ name: string }, Report];
  /** The files of any .zip; null if it is one of a URDD, which stays as it is. */
  unzip: [{ zip: Blob }, { path: string; file: Blob }[] | null];
  /** The module's memory, bytes. */
  memory: [Record<string, never>, number];
}

type CallName = keyof Calls;

/** The page's side of the worker. */
export class Engine {
  private readonly link: Link<Calls>;
  private source: RobotSource | null = null;

  constructor(
    private readonly script: string,
    private readonly wasm: string | ArrayBuffer,
  ) {
    this.link = new Link<Calls>(
      script,
      () => ({ wasm }),
      () => {
        const { source } = this;
        if (source) void this.ask("open", { source }).catch(() => undefined);
      },
    );
  }

  async ask<K extends CallName>(
    call: K,
    question: Calls[K][0],
    onProgress?: (progress: Progress) => void,
  ): Promise<Calls[K][1]> {
    if (call === "open") this.source = (question as Calls["open"][0]).source;
    return this.link.ask(call, question, onProgress);
  }

  /** A second worker, for another robot. */
  another(): Engine {
    return new Engine(this.script, this.wasm);
  }

  /** Runs a long query in a second worker, which then ends. */
  async aside<K extends CallName>(
    call: K,
    question: Calls[K][0],
    onProgress?: (progress: Progress) => void,
  ): Promise<Calls[K][1]> {
    const other = this.another();
    try {
      if (this.source) await other.ask("open", { source: this.source });
      return await other.ask(call, question, onProgress);
    } finally {
      other.end();
    }
  }

  /** Runs a query that needs no robot in a second worker, which then ends, or when it is aborted. */
  async apart<K extends CallName>(call: K, question: Calls[K][0], signal: AbortSignal): Promise<Calls[K][1]> {
    const other = this.another();
    const end = (): void => other.end();
    signal.addEventListener("abort", end);
    try {
      return await other.ask(call, question);
    } finally {
      signal.removeEventListener("abort", end);
      end();
    }
  }

  end(): void {
    this.source = null;
    this.link.end();
  }
}
