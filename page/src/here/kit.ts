/** Workers that make robots. Their module is loaded when the first is started. */

import { Link } from "../engine/link";
import { compiled } from "../engine/module";
import { named } from "../named";
import type { Given, MakerCalls } from "./protocol";

export type Maker = Link<MakerCalls>;

export class Kit {
  private module: Promise<WebAssembly.Module> | null = null;

  /** A worker without files. */
  async worker(): Promise<Maker> {
    const address = new URL(named("make.wasm"), document.baseURI).href;
    this.module ??= compiled(fetch(address));
    try {
      const module = await this.module;
      return new Link<MakerCalls>(new URL(named("make.js"), document.baseURI).href, () => ({ module }));
    } catch (error) {
      // It may be there the next time.
      this.module = null;
      throw error;
    }
  }

  /** A worker with files, of which some have another text by now. */
  async begun(files: Given[], changed: Map<string, string>): Promise<Maker> {
    const maker = await this.worker();
    await maker.ask("take", { files });
    for (const [path, text] of changed) await maker.ask("put", { path, text });
    return maker;
  }

  /** Does one job in a worker of its own. */
  async once<T>(job: (maker: Maker) => Promise<T>): Promise<T> {
    const maker = await this.worker();
    try {
      return await job(maker);
    } finally {
      maker.end();
    }
  }
}
