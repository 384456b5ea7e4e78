/** The page's side of the worker that validates and moves the open robot. */

import { Link } from "./link";
import type { Progress } from "./link";
import type { CallName, Calls, RobotSource } from "./calls";

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
