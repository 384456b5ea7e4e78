// Processes of `urdd view`, one for each robot, or comparison, that is shown. Nothing here needs VS Code.

import { spawn, type ChildProcess } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";

/** What `urdd view` shows for a file of the editor: the file, or the URDD that it is the root of. */
export function target(file: string): string | null {
  if (basename(file) === "urdd.json") return dirname(file);
  return /\.(urdf|xacro)$/i.test(file) ? file : null;
}

/** A robot, or two that are compared: before and after a change. */
export type Robots = readonly [string] | readonly [string, string];

/** The two robots that are compared of files that were selected: the older first. Null if they are not two. */
export function compared(files: readonly string[], changed: (file: string) => number): Robots | null {
  const [first, second, ...others] = [...new Set(files)];
  if (first === undefined || second === undefined || others.length > 0) return null;
  const [before, after] = changed(second) < changed(first) ? [second, first] : [first, second];
  const [one, other] = [target(before), target(after)];
  return one === null || other === null ? null : [one, other];
}

/** The arguments of `urdd` that serve the page of these robots and print its address. */
export function viewArguments(robots: Robots): string[] {
  return ["view", ...(robots.length === 2 ? ["--compare"] : []), ...robots, "--no-open"];
}

/** The page's address in what the program has printed so far: on this machine alone, and up to the end of its line. */
export function address(printed: string): string | null {
  return /(?:^|\s)(http:\/\/127\.0\.0\.1:\d{1,5}\/\S*)\r?\n/.exec(printed)?.[1] ?? null;
}

/**
 * A page that leads to an address, in a folder that only this user can enter: everybody on the machine can read the
 * arguments that a browser is started with, and the address has a token.
 */
export function pageTo(address: string): string {
  const page = join(mkdtempSync(join(tmpdir(), "urdd-open-")), "open.html");
  const link = address.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;");
  const text = `<!doctype html>\n<meta http-equiv="refresh" content="0; url=${link}">\n<a href="${link}">The robot</a>\n`;
  writeFileSync(page, text, { mode: 0o600, flag: "wx" });
  return page;
}

/** How long the program may take to print the address, in milliseconds. */
const STARTS_WITHIN = 30_000;

/** The servers of pages that run. */
export class Viewers {
  readonly #running = new Map<string, { child: ChildProcess; address: Promise<string> }>();
  readonly #pages = new Map<string, string>();

  /** A page of this machine that leads to an address, until all of them end. */
  page(address: string): string {
    const page = this.#pages.get(address) ?? pageTo(address);
    this.#pages.set(address, page);
    return page;
  }

  /** The address of the page with these robots, from a server that runs or is started. */
  address(program: string, robots: Robots, env: NodeJS.ProcessEnv): Promise<string> {
    const key = robots.join("\0");
    const running = this.#running.get(key);
    if (running) return running.address;
    const child = spawn(program, viewArguments(robots), {
      cwd: dirname(robots[0]),
      env,
      stdio: ["ignore", "pipe", "pipe"],
      windowsHide: true,
    });
    const forget = () => {
      if (this.#running.get(key)?.child === child) this.#running.delete(key);
    };
    const found = new Promise<string>((resolve, reject) => {
      let printed = "";
      let errors = "";
      const late = setTimeout(() => {
        child.kill();
        reject(new Error(`urdd view printed no address within ${STARTS_WITHIN / 1000} s`));
      }, STARTS_WITHIN);
      child.stdout.setEncoding("utf8").on("data", (text: string) => {
        printed = (printed + text).slice(-10_000);
        const one = address(printed);
        if (one !== null) {
          clearTimeout(late);
          resolve(one);
        }
      });
      child.stderr.setEncoding("utf8").on("data", (text: string) => (errors = (errors + text).slice(-2_000)));
      const ended = (reason: string) => {
        clearTimeout(late);
        forget();
        reject(new Error(errors.trim() || reason));
      };
      child.on("error", (error) => ended(error.message));
      child.on("close", (status) => ended(`urdd view ended with status ${status ?? "none"}`));
    });
    this.#running.set(key, { child, address: found });
    return found;
  }

  /** Ends all of them. */
  stop(): void {
    for (const { child } of this.#running.values()) child.kill();
    this.#running.clear();
    for (const page of this.#pages.values()) rmSync(dirname(page), { recursive: true, force: true });
    this.#pages.clear();
  }
}
