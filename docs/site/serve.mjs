// A plain file server of a folder.

import { spawn } from "node:child_process";
import { createInterface } from "node:readline";

/** Its address, which ends in `/`, and how to end it. */
export async function serve(folder) {
  const words = ["-u", "-m", "http.server", "--bind", "127.0.0.1", "--directory", folder, "0"];
  const server = spawn("python3", words, { stdio: ["ignore", "pipe", "ignore"] });
  process.on("exit", () => server.kill());
  for await (const line of createInterface(server.stdout)) {
    const port = / port (\d+)/.exec(line)?.[1];
    if (port) return { address: `http://127.0.0.1:${port}/`, end: () => server.kill() };
  }
  throw new Error("python3 -m http.server ended");
}
