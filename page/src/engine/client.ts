/** The page's side of the worker. */

import type { Answer, CallName, Calls, RobotSource } from "./protocol";

export interface Progress {
  done: number;
  of: number;
  what: string;
}

interface Waiting {
  resolve: (value: never) => void;
  reject: (error: Error) => void;
  onProgress: ((progress: Progress) => void) | undefined;
}

/** The module crashed: the worker is replaced, and the robot is reopened. */
export class Trapped extends Error {}

export class Engine {
  private worker: Worker | null = null;
  private readonly waiting = new Map<number, Waiting>();
  private next = 1;
  private ready: Promise<unknown> | null = null;
  private source: RobotSource | null = null;

  constructor(
    private readonly script: string,
    private readonly wasm: string | ArrayBuffer,
  ) {}

  async ask<K extends CallName>(
    call: K,
    question: Calls[K][0],
    onProgress?: (progress: Progress) => void,
  ): Promise<Calls[K][1]> {
    await this.start();
    if (call === "open") this.source = (question as Calls["open"][0]).source;
    return this.send(call, question, onProgress);
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

  end(): void {
    this.worker?.terminate();
    this.worker = null;
    this.ready = null;
    for (const waiting of this.waiting.values()) waiting.reject(new Error("stopped"));
    this.waiting.clear();
  }

  private start(): Promise<unknown> {
    if (!this.ready) {
      this.worker = new Worker(this.script);
      this.worker.addEventListener("message", (event: MessageEvent<Answer>) => this.answered(event.data));
      this.worker.addEventListener("error", (event) =>
        this.fail(new Error(event.message || "the worker cannot be started")),
      );
      this.ready = this.send("init", { wasm: this.wasm });
    }
    return this.ready;
  }

  private send<K extends CallName>(
    call: K,
    question: Calls[K][0],
    onProgress?: (progress: Progress) => void,
  ): Promise<Calls[K][1]> {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject, onProgress });
      this.worker?.postMessage({ id, call, question });
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
      this.fail(new Trapped("the engine stopped and was restarted"));
      const source = this.source;
      if (source) void this.ask("open", { source }).catch(() => undefined);
    } else waiting.reject(new Error(answer.error));
  }

  private fail(error: Error): void {
    this.worker?.terminate();
    this.worker = null;
    this.ready = null;
    for (const waiting of this.waiting.values()) waiting.reject(error);
    this.waiting.clear();
  }
}
