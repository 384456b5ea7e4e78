/** The data in a page in one file: `<script type="text/plain" id="...">` in base64, deflated; the module by brotli. */

import { inflateSync } from "fflate";
import type { RobotSource } from "./engine/client";
import type { Explanation, Report } from "./engine/protocol";
import type { Entry } from "./model";
import type { Showing } from "./showing";

function text(name: string): string {
  const carried = document.getElementById(name)?.textContent;
  if (carried === undefined) throw new Error(`this page does not include ${name}`);
  return carried.trim();
}

function packed(name: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text(name)), (c) => c.charCodeAt(0));
}

function bytes(name: string): ArrayBuffer {
  return inflateSync(packed(name)).slice().buffer;
}

/** The module, compressed by brotli: the worker unpacks it. */
export function module(): ArrayBuffer {
  return packed("urdd.wasm").buffer;
}

/** The worker's code as an address. */
export function worker(): string {
  return URL.createObjectURL(new Blob([bytes("worker.js")], { type: "text/javascript" }));
}

function json(name: string): unknown {
  return JSON.parse(new TextDecoder().decode(bytes(name)));
}

export function robots(): Entry[] {
  return json("robots.json") as Entry[];
}

export function source(entry: Entry): RobotSource {
  return { kind: "zip", name: entry.name, bytes: bytes("robot.zip") };
}

/** What the program that wrote the page shows; null for the robot alone. */
export function showing(): Showing | null {
  return document.getElementById("showing.json") ? (json("showing.json") as Showing) : null;
}

export function report(): Report {
  return json("report.json") as Report;
}

/** The explanation of a rule of the report. */
export function explain(code: string): Explanation {
  const known = (json("rules.json") as Explanation[]).find((rule) => rule.code === code);
  if (!known) throw new Error("this page does not include explanations of rules");
  return known;
}
