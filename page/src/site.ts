/** Where the page's robots come from: `urdd view`, a static site, or a file with a robot inside. */

import type { FileEntry, Report, RobotSource } from "./engine/protocol";
import * as inline from "./inline";
import { unknown } from "./model";
import type { Entry } from "./model";

export type Mode = "live" | "static" | "inline";

export class Site {
  constructor(
    readonly mode: Mode,
    private readonly token: string | null,
  ) {}

  async robots(): Promise<Entry[]> {
    const robots = this.mode === "inline" ? inline.robots() : ((await this.json("robots.json")) as Entry[]);
    return robots.map((entry) => ({ ...unknown(entry.name), ...entry }));
  }

  async source(entry: Entry): Promise<RobotSource> {
    if (this.mode === "inline") return inline.source(entry);
    const base = `robots/${encodeURIComponent(entry.id)}/`;
    const listed = (await this.json(`${base}files.json`)) as { name: string; files: FileEntry[]; revision?: string };
    const here = new URL(`${base}files/`, document.baseURI).href;
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
    if (this.mode === "inline") return inline.report();
    return (await this.json(`robots/${encodeURIComponent(entry.id)}/report.json`)) as Report;
  }

  /** What a gallery says of a robot. */
  async summary(entry: Entry): Promise<Entry> {
    return (await this.json(`robots/${encodeURIComponent(entry.id)}/summary.json`)) as Entry;
  }

  /** The address of a small picture of a robot; null where it has none. */
  async picture(entry: Entry): Promise<string | null> {
    const path = `robots/${encodeURIComponent(entry.id)}/picture.png`;
    const response = await fetch(path, { headers: this.headers() });
    return response.status === 200 ? URL.createObjectURL(await response.blob()) : null;
  }

  /** A word that changes when the robot's files do; `gone` where there are none any more. */
  async revision(entry: Entry): Promise<string> {
    const answer = (await this.json(`robots/${encodeURIComponent(entry.id)}/revision.json`)) as { revision: string };
    return answer.revision;
  }

  async post(path: string, body: unknown): Promise<unknown> {
    const response = await fetch(path, {
      method: "POST",
      headers: { ...this.headers(), "content-type": "application/json" },
      body: JSON.stringify(body),
    });
    const text = await response.text();
    if (!response.ok) throw new Error(text || `the server answered ${response.status}`);
    return JSON.parse(text) as unknown;
  }

  private headers(): Record<string, string> {
    return this.token ? { "x-urdd-token": this.token } : {};
  }

  private async json(path: string): Promise<unknown> {
    const response = await fetch(path, { headers: this.headers() });
    if (response.status === 403) {
      throw new Error("The server does not know this tab. Open the address that `urdd view` printed, with its token.");
    }
    if (!response.ok) throw new Error(`${path}: the server answered ${response.status}`);
    return (await response.json()) as unknown;
  }
}
