/** The source of the page's robots: `urdd view`, a static site, or a file with a robot inside. */

import type { Given } from "./drop";
import type { RobotSource } from "./engine/client";
import type { Explanation, FileEntry, Report } from "./engine/protocol";
import * as inline from "./inline";
import { unknown } from "./model";
import { keep, kept } from "./ui/storage";
import type { Entry } from "./model";

export type Mode = "live" | "static" | "inline";

/** Time after which a server without an answer counts as gone, ms. */
const PATIENCE = 8000;

/** The server does not accept the token. */
export class Refused extends Error {
  constructor() {
    super(
      "`urdd view` does not accept this link's token: it was restarted, or the link is incomplete. Paste the address that " +
        "`urdd view` printed into this tab, or a link that Share copied.",
    );
  }
}

/** The server does not answer. */
export class Gone extends Error {}

export class Site {
  /** The token that the server requires; null if it requires none. */
  token: string | null = null;
  /** The robots that the page makes itself; null where it cannot. */
  here: Keeper | null = null;

  constructor(readonly mode: Mode) {}

  /** The robots, requested with a link's token, or with the one that this browser remembers. */
  async known(token: string | null): Promise<Entry[]> {
    if (this.mode !== "live") return this.robots();
    const tokens = new Set([token, this.token, kept(KEY)].filter((known) => known !== null));
    for (const known of tokens) {
      this.token = known;
      try {
        return await this.robots();
      } catch (error) {
        if (!(error instanceof Refused)) throw error;
      }
    }
    this.token = null;
    throw new Refused();
  }

  async robots(): Promise<Entry[]> {
    const robots =
      this.mode === "inline" ? inline.robots() : ((await this.json(named("robots.json"), PATIENCE)) as Entry[]);
    return [...robots.map((entry) => ({ ...unknown(entry.name), ...entry })), ...(this.here?.entries() ?? [])];
  }

  async source(entry: Entry): Promise<RobotSource> {
    if (entry.here && this.here) return this.here.source(entry);
    if (this.mode === "inline") return inline.source(entry);
    const base = `robots/${encodeURIComponent(entry.id)}/`;
    const listed = (await this.json(entry.files ?? `${base}files.json`)) as {
      name: string;
      files: FileEntry[];
      revision?: string;
    };
    const here = new URL(entry.files ? "." : `${base}files/`, document.baseURI).href;
    return {
      kind: "url",
      name: listed.name,
      base: here,
      token: this.token,
      files: listed.files,
      revision: listed.revision ?? null,
    };
  }

  async report(entry: Entry): Promise<Report> {
    if (entry.here && this.here) return this.here.report(entry);
    if (this.mode === "inline") return inline.report();
    const path = entry.report ?? `robots/${encodeURIComponent(entry.id)}/report.json`;
    const report = (await this.json(path)) as Report | { error: string };
    if ("error" in report) throw new Error(report.error);
    return report;
  }

  /** The explanation of a rule, if the page includes it. */
  explanation(code: string): Explanation | null {
    return this.mode === "inline" ? inline.explain(code) : null;
  }

  /** The data of a robot's card in the gallery. */
  async summary(entry: Entry): Promise<Entry> {
    return (await this.json(`robots/${encodeURIComponent(entry.id)}/summary.json`)) as Entry;
  }

  /** The address of a robot's thumbnail; null if it has none. */
  async picture(entry: Entry): Promise<string | null> {
    const path = `robots/${encodeURIComponent(entry.id)}/picture.png`;
    const response = await this.fetch(path);
    return response.status === 200 ? URL.createObjectURL(await response.blob()) : null;
  }

  /**
   * A word that changes with the robot's files: `gone` if they no longer exist, null if there are none yet. Asking tells
   * `urdd view` that this page shows the robot, or waits for it.
   */
  async revision(entry: Entry): Promise<{ revision: string | null; entry: Entry }> {
    if (entry.here && this.here) return { revision: null, entry: this.here.state(entry) };
    const path = `robots/${encodeURIComponent(entry.id)}/revision.json`;
    return (await this.json(path, PATIENCE)) as { revision: string | null; entry: Entry };
  }

  /** Sends URDFs and their meshes to `urdd view`. Returns the ids of their robots. An abort takes the drop back. */
  async drop(files: { path: string; file: Blob }[], signal: AbortSignal): Promise<string[]> {
    const list = JSON.stringify(files.map(({ path, file }) => ({ path, size: file.size })));
    const body = new Blob([list, "\n", ...files.map(({ file }) => file)]);
    return ((await this.send("drops", body, signal)) as { robots: string[] }).robots;
  }

  /** The configurations that a program sends, as lines of JSON, from the last one on. */
  async *states(entry: Entry, signal: AbortSignal): AsyncGenerator<string> {
    const response = await this.fetch(`robots/${encodeURIComponent(entry.id)}/states`, { signal });
    if (!response.ok || !response.body) throw new Error(`the server answered ${response.status}`);
    const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
    try {
      for (let rest = ""; ;) {
        const { value, done } = await reader.read();
        if (done) return;
        const lines = (rest + value).split("\n");
        rest = lines.pop() ?? "";
        // What waited is of the past: the last one counts.
        const last = lines.filter(Boolean).at(-1);
        if (last !== undefined) yield last;
      }
    } finally {
      void reader.cancel();
    }
  }

  async post(path: string, body: unknown): Promise<unknown> {
    return this.send(path, JSON.stringify(body));
  }

  private async send(path: string, body: string | Blob, signal: AbortSignal | null = null): Promise<unknown> {
    const response = await this.fetch(path, { method: "POST", body, signal });
    const text = await response.text();
    if (!response.ok) throw new Error(text || `the server answered ${response.status}`);
    return JSON.parse(text) as unknown;
  }

  private async fetch(path: string, init: RequestInit = {}): Promise<Response> {
    const headers: Record<string, string> = this.token === null ? {} : { "x-urdd-token": this.token };
    if (typeof init.body === "string") headers["content-type"] = "application/json";
    try {
      return await fetch(path, { ...init, headers });
    } catch {
      const who = this.mode === "live" ? "`urdd view`" : "The site";
      throw new Gone(
        `${who} does not answer. ${this.mode === "live" ? "Start it again, and open the address that it prints." : "Try again later."}`,
      );
    }
  }

  private async json(path: string, patience?: number): Promise<unknown> {
    const response = await this.fetch(path, { signal: patience === undefined ? null : AbortSignal.timeout(patience) });
    if (response.status === 403) throw new Refused();
    if (!response.ok) throw new Error(`${path}: the server answered ${response.status}`);
    return (await response.json()) as unknown;
  }
}

/** Who has the robots that this page makes: the site asks it as it asks a server, and a person changes their texts. */
export interface Keeper {
  /** The robots. */
  entries(): Entry[];
  source(entry: Entry): RobotSource;
  report(entry: Entry): Promise<Report>;
  /** How far it is. Asking begins to make it. */
  state(entry: Entry): Entry;
  /** Takes a text of the one that is open: the findings follow at once, the picture after a pause. */
  edit(text: string): void;
  /** The text was saved as a file. */
  saved(): void;
  /** Takes files that were missing. */
  add(files: Given[]): void;
}

/** The path of a file of the page. A site names files by their hash, listed in `<meta name="urdd-files">`. */
export function named(name: string): string {
  const words = document.querySelector<HTMLMetaElement>('meta[name="urdd-files"]')?.content.split(" ") ?? [];
  const place = words.findIndex((word, k) => k % 2 === 0 && word === name);
  return (place >= 0 && words[place + 1]) || name;
}

/**
 * All tabs of this browser share the token. Storage is separate for each address and port, so no other page or server of this
 * machine can read it.
 */
const KEY = "urdd-token";

export function keepToken(token: string | null): void {
  if (token !== null) keep(KEY, token);
}
