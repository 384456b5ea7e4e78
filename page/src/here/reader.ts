/** What is asked of the files of a drop while robots are made: what is there, and what is wrong with it. */

import { Trapped } from "../engine/link";
import type { Report } from "../engine/protocol";
import type { Kit, Maker } from "./kit";
import { lost } from "./protocol";
import type { Description, Given } from "./protocol";

/** How a USD begins that is a text. */
export const USD_TEXT = "#usda";

export class Reader {
  /** Texts that a person changed, by path. */
  readonly changed = new Map<string, string>();
  private maker: Promise<Maker> | null = null;

  constructor(
    private readonly kit: Kit,
    public files: Given[],
  ) {}

  descriptions(): Promise<Description[]> {
    return this.ask((maker) => maker.ask("descriptions", {}));
  }

  lint(path: string): Promise<Report> {
    return this.ask((maker) => maker.ask("lint", { path }));
  }

  /** The text of a description; null of a USD that is none. */
  async text({ path, format }: Description): Promise<string | null> {
    const file = this.files.find((file) => file.path === path)?.file;
    if (format === "usd" && (await file?.slice(0, USD_TEXT.length).text()) !== USD_TEXT) return null;
    return this.changed.get(path) ?? (await file?.text()) ?? "";
  }

  /** Changes the text of a file. */
  change(path: string, text: string): void {
    this.changed.set(path, text);
    void this.maker?.then((maker) => maker.ask("put", { path, text })).catch(() => this.end());
  }

  /** Adds files, in place of those of the same path. They are found wherever they belong. */
  add(more: Given[]): void {
    const paths = new Set(more.map(({ path }) => path));
    this.files = [...this.files.filter(({ path }) => !paths.has(path)), ...more.map(lost)];
    this.end();
  }

  /** A worker that begins with these files. */
  worker(): Promise<Maker> {
    return this.kit.begun(this.files, this.changed);
  }

  end(): void {
    void this.maker?.then((maker) => maker.end()).catch(() => undefined);
    this.maker = null;
  }

  private async ask<T>(job: (maker: Maker) => Promise<T>): Promise<T> {
    this.maker ??= this.worker();
    const { maker } = this;
    try {
      return await job(await maker);
    } catch (error) {
      // The next one begins anew.
      if (error instanceof Trapped && this.maker === maker) this.maker = null;
      throw error;
    }
  }
}
