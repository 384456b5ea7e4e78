// The exported site of robots on a plain file server.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { createServer } from "node:net";
import { join } from "node:path";
import { run } from "./world.mjs";

async function freePort() {
  const probe = createServer();
  await new Promise((resolve) => probe.listen(0, "127.0.0.1", resolve));
  const { port } = probe.address();
  await new Promise((resolve) => probe.close(resolve));
  return port;
}

/** The exported site on a plain file server. */
export async function exported(made) {
  const site = join(made.folder, "site");
  const done = run("view", made.robots, "--export", site);
  assert.equal(done.status, 0, done.stderr);
  const port = await freePort();
  const address = `http://127.0.0.1:${port}/`;
  const server = spawn("python3", ["-m", "http.server", "--bind", "127.0.0.1", "--directory", site, String(port)], {
    stdio: "ignore",
  });
  for (let tries = 0; ; tries++) {
    try {
      await fetch(address);
      break;
    } catch (error) {
      if (tries > 100) throw error;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
  }
  return { address, site, end: () => server.kill() };
}
