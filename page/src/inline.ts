/** What a page that is one file carries in itself: `<script type="text/plain" id="...">` with base64. */

import type { Report, RobotSource } from "./engine/protocol";
import type { Entry } from "./model";

function text(name: string): string {
  const carried = document.getElementById(name)?.textContent;
  if (carried === undefined) throw new Error(`this page does not carry ${name}`);
  return carried.trim();
}

export function bytes(name: string): ArrayBuffer {
  const raw = atob(text(name));
  const found = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; k++) found[k] = raw.charCodeAt(k);
  return found.buffer;
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

export function report(): Report {
  return json("report.json") as Report;
}
