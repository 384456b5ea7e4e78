// The learned self-collision model beside the exact answer: what the panel says, against the network worked out here.

import assert from "node:assert/strict";
import { cpSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { inPage, open, read, repository, run, setting, state, view } from "./world.mjs";

const MODULE = "link_shapes_modules/self_collision_model_module/module.json";

/** The same robot with another text of the model. */
function changed(made, name, change) {
  cpSync(join(made.robots, "arm"), join(made.robots, name), { recursive: true });
  const file = join(made.robots, name, MODULE);
  writeFileSync(file, change(readFileSync(file, "utf8")));
}

/** With so much added to every margin, metres. */
function withMargins(more) {
  return (text) => {
    const model = JSON.parse(text);
    for (const pair of model.pairs) pair.margin += more;
    return JSON.stringify(model);
  };
}

const set = setting(["gripper"], (made) => {
  const urdf = join(repository, "conformance/robots/six_axis_arm.urdf");
  const modules = ["--modules", "all,self_collision_model"];
  const done = run("generate", urdf, "-o", join(made.robots, "arm"), ...modules);
  assert.equal(done.status, 0, done.stderr);
  changed(made, "wary", withMargins(10));
  changed(made, "blind", withMargins(-10));
  changed(made, "broken", (text) => text.slice(0, -20));
  return view(made.robots);
});

/** Random configurations, and whether the program finds them in collision. */
function configurations() {
  const words = ["--random", "40", "--shapes", "pieces", "--format", "json"];
  const lines = run("check-collisions", join(set.made.robots, "arm"), ...words).stdout.trim();
  return lines.split("\n").map((line) => JSON.parse(line));
}

/** The clearances of SPEC 8.8.3 and 8.8.4, of a robot whose DOFs are all angles. */
function clearances({ inputs, layers, pairs }, q) {
  let values = inputs.flatMap(({ Angle: { dof_idx: dof } }) => [
    Math.sin(q[dof]),
    Math.cos(q[dof]),
    Math.sin(2 * q[dof]),
    Math.cos(2 * q[dof]),
  ]);
  layers.forEach(({ weights, biases }, k) => {
    if (k > 0) values = values.map(Math.tanh);
    values = weights.map((row, i) => row.reduce((sum, weight, j) => sum + weight * values[j], biases[i]));
  });
  return values.map((value, k) => value - pairs[k].margin);
}

/** The rates of SPEC 8.8.11, in the words of the page. */
function rates({ num_missed, num_colliding, num_near_contact_missed, num_near_contact }) {
  const rate = (x, n) => {
    const [p, z] = [x / n, 1.959963984540054];
    const half = z * Math.sqrt((p * (1 - p)) / n + (z * z) / (4 * n * n));
    const ends = [-half, half].map((by) => (p + (z * z) / (2 * n) + by) / (1 + (z * z) / n));
    const [share, lower, upper] = [p, ...ends].map((of) => (100 * Math.max(0, of)).toFixed(2));
    return `${share} % (${lower} to ${upper} %)`;
  };
  return `${rate(num_missed, num_colliding)} of collisions, ${rate(num_near_contact_missed, num_near_contact)} near contact`;
}

/** Moves the robot, and waits until the panel is of that configuration. */
async function moved(page, q) {
  const before = (await state(page, "proximity")).answer;
  await page.evaluate((q) => globalThis.urdd.app.move(q), q);
  await page.waitForFunction((before) => {
    const { answer } = globalThis.urdd.app.store.now.proximity;
    return answer && JSON.stringify(answer) !== before;
  }, JSON.stringify(before));
  return page.locator(".learned").textContent();
}

/** Moves, and waits for this line: an answer to the pose before may come in between. */
async function says(page, q, pattern) {
  await moved(page, q);
  const isThere = (source) => new RegExp(source).test(document.querySelector(".learned").textContent);
  await page.waitForFunction(isThere, pattern.source, { timeout: 10000 }).catch(() => {});
  assert.match(await page.locator(".learned").textContent(), pattern);
}

async function proximity(page, name) {
  await open(page, name);
  await page.click("#tab-Proximity");
  return (await state(page, "proximity", ({ answer }) => answer !== null)).answer;
}

inPage(set, "the line says what the network gives, free and in collision", async (page) => {
  await proximity(page, "arm");
  const model = read(join(set.made.robots, "arm", MODULE));
  const { links } = await page.evaluate(() => globalThis.urdd.app.store.now.robot.about);
  const seen = new Set();
  for (const { values, in_collision } of configurations()) {
    const expected = clearances(model, values);
    const least = Math.min(...expected);
    const pair = model.pairs[expected.indexOf(least)];
    const text = await moved(page, values);
    const verdict =
      least > 0
        ? in_collision
          ? "predicted clear, but is in collision: missed"
          : "clear"
        : in_collision
          ? "may be in contact"
          : "predicted in contact, but is free";
    seen.add(verdict);
    const found = /^Model: (.*) \(minimum clearance (−?[\d.]+) mm, (.*) – (.*)\)misses (.*)$/.exec(text);
    assert.ok(found, text);
    assert.equal(found[1], verdict);
    const shown = Number(found[2].replace("−", "-")) / 1000;
    assert.ok(Math.abs(shown - least) <= 0.006 * Math.abs(least), `${text}: ${least}`);
    assert.deepEqual([found[3], found[4]], [links[pair.link_a_idx].name, links[pair.link_b_idx].name]);
    assert.equal(found[5], rates(model.evaluation));
    const exact = await page.locator(".collision").textContent();
    assert.match(exact, in_collision ? /^Self-collision: \d+ pairs? of links$/ : /^No self-collision/);
  }
  assert.ok(seen.has("clear") && seen.has("may be in contact"), [...seen].join(", "));
  // It stands for pieces, and for no other shapes.
  assert.ok(await page.locator(".learned").isVisible());
  await page.getByLabel("Kind of shapes").selectOption("hulls");
  await state(page, "proximity", ({ answer }) => answer !== null);
  assert.equal(await page.locator(".learned").isVisible(), false);
  await page.getByLabel("Kind of shapes").selectOption("pieces");
  await state(page, "proximity", ({ answer }) => answer !== null);
  assert.ok(await page.locator(".learned").isVisible());
});

inPage(set, "a model that is wrong is said to be, and one that cannot be read, and none is none", async (page) => {
  const all = configurations();
  const free = all.find(({ in_collision }) => !in_collision).values;
  const colliding = all.find(({ in_collision }) => in_collision).values;
  await proximity(page, "wary");
  await says(page, colliding, /^Model: may be in contact \(minimum clearance −/);
  await says(page, free, /^Model: predicted in contact, but is free \(minimum clearance −/);
  await proximity(page, "blind");
  await says(page, free, /^Model: clear \(/);
  await says(page, colliding, /^Model: predicted clear, but is in collision: missed \(/);

  const answer = await proximity(page, "broken");
  assert.ok(answer.nearest.length > 0);
  const text = await page.locator(".learned").textContent();
  assert.match(text, /^Model: cannot be used: self_collision_model_module: /);
  await proximity(page, "gripper");
  assert.equal(await page.locator(".learned").isVisible(), false);
});
