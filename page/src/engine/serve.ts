/** The worker's side of a [`Link`](link.ts). */

import type { Answer, CallsOf, Request } from "./link";

export type OnProgress = (done: number, of: number, what: string) => void;

export type Handlers<C extends CallsOf<C>> = {
  [K in keyof C]: (question: C[K][0], onProgress: OnProgress) => C[K][1] | Promise<C[K][1]>;
};

const scope = self as unknown as {
  postMessage(message: Answer, transfer: Transferable[]): void;
  addEventListener(type: "message", listener: (event: MessageEvent<Request>) => void): void;
};

/** Answers queries. Those that come while one of `first` is answered wait for it. */
export function serve<C extends CallsOf<C>>(handlers: Handlers<C>, first: (keyof C)[]): void {
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
      const message = error instanceof Error ? error.message : String(error);
      scope.postMessage({ id, error: message, trapped }, []);
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
