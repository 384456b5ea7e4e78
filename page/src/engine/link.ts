/** A worker that answers queries, one after another: it is started when it is first asked, and again after it crashed. */

import type { Progress } from "../../../wasm/npm/index";

export type { Progress };

const STOPPED = "stopped";

/** Queries and answers, by name; `init` is the first of each worker. */
export type CallsOf<C> = { [K in keyof C]: [unknown, unknown] };

export interface Request {
  id: number;
  call: string;
  question: unknown;
}

export type Answer =
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
