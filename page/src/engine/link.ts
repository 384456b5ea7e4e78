/** A worker that owns a module and answers queries, one after another: how the page starts and asks it, how it answers, and its module. */

import type { Progress } from "../../../wasm/npm/index";
import { Urdd } from "../../../wasm/npm/module.mjs";
import { message } from "../ui/format";

export type { Progress };

const STOPPED = "stopped";

/** Queries and answers, by name; `init` is the first of each worker. */
type CallsOf<C> = { [K in keyof C]: [unknown, unknown] };

interface Request {
  id: number;
  call: string;
  question: unknown;
}

type Answer =
  { id: number; value: unknown } | { id: number; error: string; trapped: boolean } | { id: number; progress: Progress };

interface Waiting {
  resolve: (value: never) => void;
  reject: (error: Error) => void;
  onProgress: ((progress: Progress) => void) | undefined;
}

/** The addresses of scripts as blobs. A worker of a blob has the policy of its page; one of an address of a site has none. */
const blobs = new Map<string, Promise<string>>();

function underPolicy(script: string): Promise<string> {
  if (script.startsWith("blob:")) return Promise.resolve(script);
  const fetched = async (): Promise<string> => {
    const response = await fetch(script);
    if (!response.ok) throw new Error(`the worker (${script}) cannot be loaded: status ${response.status}`);
    return URL.createObjectURL(new Blob([await response.text()], { type: "text/javascript" }));
  };
  const made = blobs.get(script) ?? fetched();
  blobs.set(script, made);
  // It may be there the next time.
  made.catch(() => blobs.delete(script));
  return made;
}

/** The module crashed: the worker is replaced. */
export class Trapped extends Error {}

/** The page's side: starts the worker when it is first asked, and again after it crashed. */
export class Link<C extends CallsOf<C> & { init: [unknown, unknown] }> {
  private worker: Worker | null = null;
  private readonly waiting = new Map<number, Waiting>();
  private next = 1;
  private ready: Promise<unknown> | null = null;
  /** Counts starts and ends, so that a start that was overtaken comes to nothing. */
  private turn = 0;

  /** `begin` gives the question of `init`; `revived` is called after a crash. */
  constructor(
    private readonly script: string,
    private readonly begin: () => C["init"][0],
    private readonly revived: () => void = () => undefined,
  ) {}

  async ask<K extends keyof C & string>(
    call: K,
    question: C[K][0],
    onProgress?: (progress: Progress) => void,
  ): Promise<C[K][1]> {
    await this.start();
    return this.send(call, question, onProgress);
  }

  end(): void {
    this.stop(new Error(STOPPED));
  }

  private start(): Promise<unknown> {
    if (this.ready) return this.ready;
    const ready = this.begun();
    this.ready = ready;
    // It may begin the next time.
    ready.catch((error: unknown) => {
      if (this.ready === ready) this.stop(error as Error);
    });
    return ready;
  }

  private async begun(): Promise<unknown> {
    const turn = ++this.turn;
    const script = await underPolicy(this.script);
    if (turn !== this.turn) throw new Error(STOPPED);
    this.worker = new Worker(script);
    this.worker.addEventListener("message", (event: MessageEvent<Answer>) => this.answered(event.data));
    this.worker.addEventListener("error", (event) =>
      this.stop(new Error(event.message || "the worker cannot be started")),
    );
    return this.send("init", this.begin());
  }

  private send<K extends keyof C & string>(
    call: K,
    question: C[K][0],
    onProgress?: (progress: Progress) => void,
  ): Promise<C[K][1]> {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject, onProgress });
      this.worker?.postMessage({ id, call, question } satisfies Request);
    });
  }

  private answered(answer: Answer): void {
    const waiting = this.waiting.get(answer.id);
    if (!waiting) return;
    if ("progress" in answer) {
      waiting.onProgress?.(answer.progress);
      return;
    }
    this.waiting.delete(answer.id);
    if (!("error" in answer)) waiting.resolve(answer.value as never);
    else if (answer.trapped) {
      waiting.reject(new Trapped(`the engine stopped: ${answer.error}`));
      this.stop(new Trapped("the engine stopped and was restarted"));
      this.revived();
    } else waiting.reject(new Error(answer.error));
  }

  private stop(error: Error): void {
    this.turn++;
    this.worker?.terminate();
    this.worker = null;
    this.ready = null;
    for (const waiting of this.waiting.values()) waiting.reject(error);
    this.waiting.clear();
  }
}

export type OnProgress = (done: number, of: number, what: string) => void;

export type Handlers<C extends CallsOf<C>> = {
  [K in keyof C]: (question: C[K][0], onProgress: OnProgress) => C[K][1] | Promise<C[K][1]>;
};

/** The worker's side: answers queries. Those that come while one of `first` is answered wait for it. */
export function serve<C extends CallsOf<C>>(handlers: Handlers<C>, first: (keyof C)[]): void {
  const scope = self as unknown as {
    postMessage(message: Answer, transfer: Transferable[]): void;
    addEventListener(type: "message", listener: (event: MessageEvent<Request>) => void): void;
  };
  let opening: Promise<unknown> = Promise.resolve();
  const answer = async ({ id, call, question }: Request): Promise<void> => {
    try {
      const handler = handlers[call as keyof C];
      const onProgress: OnProgress = (done, of, what) => scope.postMessage({ id, progress: { done, of, what } }, []);
      const answered = opening.then(() => handler(question as C[keyof C][0], onProgress));
      if (first.includes(call as keyof C)) opening = answered.catch(() => undefined);
      const value = await answered;
      scope.postMessage({ id, value }, buffers(value));
    } catch (error) {
      const trapped = error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
      scope.postMessage({ id, error: message(error), trapped }, []);
    }
  };
  scope.addEventListener("message", (event) => void answer(event.data));
}

/** The buffers of an answer, which go to the page without a copy. */
function buffers(value: unknown): Transferable[] {
  if (value instanceof ArrayBuffer) return [value];
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  if (Array.isArray(value)) return value.flatMap(buffers);
  const positions = (value as { positions?: Float32Array } | null)?.positions;
  return positions ? buffers(positions) : [];
}

/** The module, which the code of the npm package speaks to. */
export type { Urdd };

/** Compiles a module of this address, or of these bytes. */
export async function compiled(source: BufferSource | Promise<Response>): Promise<WebAssembly.Module> {
  if (!(source instanceof Promise)) return WebAssembly.compile(source);
  const response = await source;
  if (!response.ok) throw new Error(`the engine (${response.url}) cannot be loaded: status ${response.status}`);
  // Some file servers do not send `application/wasm`, which streaming requires.
  const streams = response.headers.get("content-type") === "application/wasm";
  return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

export async function started(module: WebAssembly.Module): Promise<Urdd> {
  const urdd = await Urdd.of(module);
  urdd.noMemory = "not enough memory for this robot";
  // A number that is not finite is the module's to refuse: here, a RangeError stands for a crash.
  urdd.write = JSON.stringify;
  return urdd;
}

/** The content of files, which are closed. The browser keeps it outside of the page's memory. */
export function contents(module: Urdd, files: number): { path: string; file: Blob }[] {
  const { changed } = changes(module, files, 0);
  module.closeFiles(files);
  return changed;
}

/** The paths of files, and the content of those that others of before do not have. */
export function changes(
  module: Urdd,
  files: number,
  before: number,
): { paths: string[]; changed: { path: string; file: Blob }[] } {
  const paths = module.list(files).files.map(({ path }) => path);
  const changed = before === 0 ? paths : module.changed(files, before);
  return { paths, changed: changed.map((path) => ({ path, file: new Blob([module.read(files, path)]) })) };
}
