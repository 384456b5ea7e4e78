// The exported site of robots on a plain file server.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { join } from "node:path";
import { built, run } from "./world.mjs";

/** Puts the page as it was built last into a site, where URDD_DIST names its folder. */
function withBuilt(site) {
  if (!process.env.URDD_DIST) return;
  const page = join(site, "index.html");
  const text = readFileSync(page, "utf8");
  const words = /<meta name="urdd-files" content="([^"]*)"/.exec(text)[1].split(" ");
  for (let k = 0; k < words.length; k += 2)
    if (/\.(?:js|css|wasm)$/.test(words[k])) writeFileSync(join(site, words[k + 1]), built(words[k]));
  const policy = /<meta http-equiv="Content-Security-Policy"[^>]*>/;
  writeFileSync(page, text.replace(policy, policy.exec(built("index.html").toString())[0]));
}

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
  withBuilt(site);
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
