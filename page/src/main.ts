/** Assembles the page, and opens the view of the address. */

import { Address } from "./address";
import { App } from "./app";
import { comparing } from "./comparing";
import { dropped, chosen } from "./drop";
import { Engine } from "./engine/client";
import { Hand } from "./hand";
import { Here } from "./here/here";
import { savingHere } from "./here/saving";
import * as inline from "./inline";
import { keys } from "./keys";
import { brokenLine, follow, serverLine, misfit, take } from "./live";
import { saveDialog } from "./making";
import { missingFiles } from "./panels/absent";
import { findings } from "./panels/findings";
import { gallery } from "./panels/gallery";
import { header } from "./panels/header";
import { info } from "./panels/info";
import { joints } from "./panels/joints";
import { proximity } from "./panels/proximity";
import { shapes } from "./panels/shapes";
import { skips } from "./panels/skips";
import { said, status } from "./panels/status";
import { text } from "./panels/text";
import { Timeline, trajectoryIn } from "./panels/timeline";
import { tree } from "./panels/tree";
import { named, Site } from "./site";
import type { Mode } from "./site";
import { Stage } from "./stage";
import { button, byId, fill, h } from "./ui/dom";
import { offer } from "./ui/files";
import { message } from "./ui/format";
import { Scrolled } from "./ui/scrolled";
import { tabs } from "./ui/tabs";
import { startTheme } from "./ui/theme";

/** Width of the pictures on cards, pixels. */
const CARD = 320;

function start(): void {
  startTheme();
  const mode = (document.querySelector<HTMLMetaElement>('meta[name="urdd-mode"]')?.content ?? "static") as Mode;
  const site = new Site(mode);
  const base = document.baseURI;
  const engine =
    mode === "inline"
      ? new Engine(inline.worker(), inline.module())
      : new Engine(new URL(named("worker.js"), base).href, new URL(named("urdd.wasm"), base).href);
  const app = new App(engine, site);

  let stage: Stage | null = null;
  let noPicture: string | null = null;
  try {
    stage = new Stage(app);
    new Hand(app, stage);
  } catch (error) {
    noPicture = message(error);
    app.store.on(["robot"], ({ robot }) => {
      if (robot) app.settled();
    });
  }
  comparing(app);
  const here = mode === "inline" ? null : new Here(app);
  site.here = here;
  if (here && stage) {
    const { view } = stage;
    stage.settled = () => void here.drawn(() => view.small(CARD));
  }
  const address = new Address(app, stage, here);

  const failure = h("div", { class: "failure", role: "alert" });
  const why = h("p", {});
  const what = h("p", { class: "hint" });
  // Buttons stay while the words change, so that a click is not lost.
  const ask = missingFiles(app, false);
  fill(
    failure,
    why,
    ask,
    what,
    button("Back", {}, () => address.leave()),
  );
  app.store.on(["failure", "draft", "wanted"], ({ failure: text, draft, wanted }) => {
    failure.hidden = text === null;
    fill(why, text);
    ask.hidden = wanted.length === 0;
    what.hidden = !draft;
    const first = wanted.length > 0 ? "Or" : "The findings say what is wrong. You can also";
    fill(what, `${first} mend the text: the robot is shown as soon as there is one.`);
  });
  const progress = h("div", { role: "status" });
  const waiting = h(
    "div",
    { class: "waiting" },
    progress,
    button("Cancel", {}, () => address.cancel()),
  );
  app.store.on(["robot", "loading", "taking", "failure"], ({ robot, loading, taking, failure }) => {
    const isBeside = robot !== null || failure !== null;
    waiting.hidden = taking === null && (isBeside || loading === null);
    waiting.classList.toggle("beside", isBeside);
    const { what = taking ?? "", done = 0, of = 0 } = (taking === null && loading) || {};
    const bar = h("progress", { "aria-label": what, max: Math.max(of, 1) });
    if (of > 0) bar.value = done;
    fill(progress, h("p", {}, taking ?? (loading && said(loading))), bar);
  });
  const choose = (files: File[], folder: boolean): void => void address.openFiles(chosen(files, folder));
  const timeline = new Timeline(app);
  const middle = h(
    "main",
    {},
    stage?.element ??
      h(
        "div",
        { class: "stage empty-stage" },
        h(
          "p",
          { role: "alert" },
          `Cannot draw the robot: this browser has no WebGL (${noPicture ?? ""}). The panels still work.`,
        ),
      ),
    gallery(
      app,
      (entry) => void address.open(entry),
      (entry) => address.remove(entry),
      choose,
    ),
    waiting,
    failure,
    timeline.element,
  );
  const scrolled = new Scrolled(app.store);
  const panels = {
    Joints: joints(app),
    Shapes: shapes(app),
    Proximity: proximity(app),
    Skips: skips(app),
    Findings: findings(app),
    Info: info(app),
    Text: text(app),
  };
  const saving = saveDialog(app);
  const savingMade = here && savingHere(app, here);
  const actions = {
    save: () => (app.store.now.robot?.entry.here ? savingMade?.open() : saving.open()),
    stop: () => here?.stop(),
    goOn: () => here?.goOn(),
    share: () => void share(app, address.link()),
    picture: () => void save(app, stage),
    gallery: () => address.leave(),
  };
  fill(
    byId("page"),
    header(app, actions),
    serverLine(app),
    brokenLine(app),
    h("div", { class: "columns" }, tree(app), middle, tabs(app, panels)),
    status(app),
    saving.element,
    ...(savingMade ? [savingMade.element] : []),
  );
  scrolled.keep(document.querySelectorAll(".body, .rows"));
  keys(app, stage);
  app.store.on(["robot"], ({ robot }) => {
    document.title = robot ? `${robot.name} · urdd` : "urdd";
  });

  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    if (!event.dataTransfer) return;
    const trajectory = app.store.now.robot?.moves ? trajectoryIn(event.dataTransfer) : null;
    if (trajectory) void timeline.load(trajectory);
    else void address.openFiles(dropped(event.dataTransfer));
  });
  // For tests and benches, which compare more digits than the page shows.
  Object.assign(window, { urdd: { app, stage } });
  void address.follow().finally(() => {
    if (mode === "live") follow(app);
    const { robot } = app.store.now;
    const showing = mode === "inline" ? inline.showing() : null;
    const wrong = robot && showing ? take(app, robot, showing) : null;
    if (robot && wrong !== null) app.note(misfit(robot, wrong));
  });
}

async function share(app: App, link: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(link);
    app.note(
      app.site.mode === "live"
        ? "Link copied. It opens this view in any browser on this machine while `urdd view` runs, and allows saving."
        : "Link copied.",
    );
  } catch {
    // The address of a live page has no token: it works only in this browser.
    app.note(`The link cannot be copied: ${app.site.mode === "live" ? link : "copy it from the address bar."}`);
  }
}

async function save(app: App, stage: Stage | null): Promise<void> {
  const picture = await stage?.view.picture();
  if (!picture) {
    app.note("There is no picture to save.");
    return;
  }
  offer(picture, `${app.store.now.robot?.entry.name ?? "urdd"}.png`);
}

start();
