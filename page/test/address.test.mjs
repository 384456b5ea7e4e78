// Addresses that are true: shared links, typed addresses, Back and Forward, and who may open them.

import assert from "node:assert/strict";
import { test } from "node:test";
import { drawn, inPage, open, setting, soon, state, tab, view } from "./world.mjs";

const set = setting(["welding_arm", "gripper"]);

/** What a person would call the view. */
function seen(page) {
  return page.evaluate(() => {
    const { robot, q, tab, selected, overlays } = globalThis.urdd.app.store.now;
    return { robot: robot?.entry.id ?? null, q, tab, selected, ground: overlays.grid };
  });
}

/** Makes a view, and gives the link that Share copies. */
async function shared(page) {
  await open(page, "welding_arm");
  await page.getByRole("button", { name: "Random", exact: true }).click();
  await state(page, "q", (q) => q.some((value) => value !== 0));
  await page.locator(".row", { hasText: "torch" }).first().click();
  await page.click("#tab-Shapes");
  await page.uncheck("#overlay-grid");
  await page.getByRole("button", { name: "Share" }).click();
  await page.getByText("Link copied").waitFor();
  return { link: await page.evaluate(() => globalThis.navigator.clipboard.readText()), view: await seen(page) };
}

async function same(page, expected) {
  await drawn(page, "welding_arm");
  await soon(async () => {
    const { q, ...rest } = await seen(page);
    const { q: wanted, ...others } = expected;
    assert.deepEqual(rest, others);
    q.forEach((value, dof) => assert.ok(Math.abs(value - wanted[dof]) < 1e-6, `${q} ${wanted}`));
  });
}

inPage(set, "a shared link opens in a new tab, in another browser, and in a tab that is open", async (page) => {
  const { link, view: expected } = await shared(page);
  assert.match(link, /#token=.*r=welding_arm/);
  const second = await page.context().newPage();
  await second.goto(link);
  await same(second, expected);
  assert.ok(!second.url().includes("token"), second.url());
  await second.close();
  const other = await tab(set.chrome, link);
  await same(other.page, expected);
  await other.close();
  // Pasted where the gallery is open, and where another robot is: the page is not loaded again.
  const third = await page.context().newPage();
  await third.goto(set.server.address);
  await third.waitForSelector(".card");
  await third.evaluate(() => (globalThis.kept = true));
  await third.goto(link);
  await same(third, expected);
  await open(third, "gripper");
  await third.goto(link);
  await same(third, expected);
  // The same robot with another state.
  await third.goto(link.replace(/&q=[^&]*/, "").replace("t=Shapes", "t=Info"));
  await state(third, "tab", (tab) => tab === "Info");
  await state(third, "q", (q) => q.every((value) => value === 0));
  assert.equal(await third.evaluate(() => globalThis.kept), true);
  await third.close();
});

inPage(set, "the address bar's own address opens in a new tab of the same browser", async (page) => {
  await open(page, "gripper");
  const address = await soon(() => {
    assert.match(page.url(), /r=gripper.*c=/);
    return page.url();
  });
  const second = await page.context().newPage();
  await second.goto(address);
  await drawn(second, "gripper");
  await second.close();
});

inPage(set, "Back and Forward change the page, and the gallery has no robot's address", async (page) => {
  await open(page, "welding_arm");
  await page.getByRole("button", { name: "Middle" }).click();
  const middle = await state(page, "q", (q) => q.some((value) => value !== 0));
  await soon(() => assert.match(page.url(), /r=welding_arm.*q=/));
  await page.getByRole("button", { name: "All robots" }).click();
  await page.waitForSelector(".card");
  assert.ok(!page.url().includes("r="), page.url());
  await page.reload();
  await page.waitForSelector(".card:visible");
  await open(page, "gripper");
  await page.goBack();
  await page.waitForSelector(".card:visible");
  assert.equal((await seen(page)).robot, null);
  await page.goBack();
  await drawn(page, "welding_arm");
  await soon(async () => {
    const { q } = await seen(page);
    q.forEach((value, dof) => assert.ok(Math.abs(value - middle[dof]) < 1e-6));
  });
  await page.goForward();
  await page.waitForSelector(".card:visible");
  await page.goForward();
  await drawn(page, "gripper");
});

test(
  "a tab that the server does not know: the printed address helps, without loading the page again",
  { timeout: 300_000 },
  async () => {
    const { origin } = new URL(set.server.address);
    const { page, close } = await tab(set.chrome, `${origin}/#r=gripper`);
    await page.getByText("Paste the address that `urdd view` printed").waitFor();
    await page.evaluate(() => (globalThis.kept = true));
    await page.goto(set.server.address);
    await page.waitForSelector(".card:visible");
    // A token that nobody knows, as in a link of yesterday or of somebody else, does not shut the page out.
    await page.goto(`${origin}/#token=0123&r=gripper`);
    await drawn(page, "gripper");
    assert.equal(await page.evaluate(() => globalThis.kept), true);
    await page.reload();
    await drawn(page, "gripper");
    await close();
  },
);

test("a link on a page of others opens the page, which that page cannot read", { timeout: 300_000 }, async () => {
  const { page, close } = await tab(set.chrome, set.server.address);
  await page.waitForSelector(".card");
  const link = `${new URL(set.server.address).origin}/#r=gripper`;
  const other = await page.context().newPage();
  await other.route("http://others.example/", (route) =>
    route.fulfill({
      contentType: "text/html",
      body: `<a href="${link}">robot</a><script>const name = "others";</script>`,
    }),
  );
  await other.goto("http://others.example/");
  const read = await other.evaluate(async (link) => {
    const asked = async (path, init) =>
      fetch(new URL(path, link), init).then(
        (answer) => `${answer.type} ${answer.status}`,
        () => "refused",
      );
    const robots = await asked("/robots.json");
    const blind = await asked("/robots.json", { mode: "no-cors" });
    const post = await asked("/robots/gripper/skips", { method: "POST", mode: "no-cors", body: "{}" });
    const framed = globalThis.document.createElement("iframe");
    framed.src = link;
    await new Promise((resolve) => {
      framed.onload = resolve;
      globalThis.document.body.append(framed);
    });
    let inside = "hidden";
    try {
      inside = framed.contentDocument ? "seen" : "hidden";
    } catch {
      // As it should be.
    }
    return { robots, blind, post, inside };
  }, link);
  assert.deepEqual([read.robots, read.inside], ["refused", "hidden"]);
  assert.ok(
    ["refused", "opaque 0"].includes(read.blind) && ["refused", "opaque 0"].includes(read.post),
    JSON.stringify(read),
  );
  await other.click("a");
  await drawn(other, "gripper");
  await close();
});

test(
  "a server that ended is told of, with what to do, and so is another one in its place",
  { timeout: 300_000 },
  async () => {
    const server = await view(set.made.robots);
    const { page, close } = await tab(set.chrome, server.address);
    await open(page, "gripper");
    assert.equal(await page.locator(".server").isVisible(), false);
    server.end();
    const begun = Date.now();
    await page.getByText(/`urdd view` has ended.*Start it again/).waitFor({ timeout: 60_000 });
    assert.ok(Date.now() - begun < 30_000);
    // What is shown works on.
    await page.getByRole("button", { name: "Middle" }).click();
    await state(page, "q", (q) => q.some((value) => value !== 0));
    await server.status;
    const port = new URL(server.address).port;
    const next = await view(set.made.robots, "--port", port);
    await page.getByText("Another `urdd view` has replaced").waitFor();
    await page.goto(next.address);
    await page.waitForSelector(".card:visible");
    await page.locator(".server").waitFor({ state: "hidden" });
    next.end();
    await close();
  },
);
