/** Puts the page together, and opens what the address asks for. */

import { App, message } from "./app";
import { dropped, chosen } from "./drop";
import { Engine } from "./engine/client";
import type { RobotSource } from "./engine/protocol";
import * as fragment from "./fragment";
import * as inline from "./inline";
import { keys } from "./keys";
import { follow } from "./live";
import { saveDialog, untilMade } from "./making";
import { unknown } from "./model";
import type { Entry } from "./model";
import { findings } from "./panels/findings";
import { gallery } from "./panels/gallery";
import { header } from "./panels/header";
import { info } from "./panels/info";
import { joints } from "./panels/joints";
import { proximity } from "./panels/proximity";
import { shapes } from "./panels/shapes";
import { skips } from "./panels/skips";
import { said, status } from "./panels/status";
import { tree } from "./panels/tree";
import { Site } from "./site";
import type { Mode } from "./site";
import { Stage } from "./stage";
import { initial, LAYERS, OVERLAYS } from "./state";
import { byId, fill, h } from "./ui/dom";
import { offer } from "./ui/offer";
import { startTheme } from "./ui/theme";
import { tabs } from "./ui/tabs";

const TOKEN = "urdd-token";

/** The token moves from the address to this tab's memory. */
function token(shared: fragment.Shared): string | null {
  try {
    if (shared.token !== null) {
      sessionStorage.setItem(TOKEN, shared.token);
      history.replaceState(null, "", `#${fragment.write(shared)}`);
    }
    return sessionStorage.getItem(TOKEN);
  } catch {
    // A frame that may keep nothing, as in a notebook: the token stays in the address.
    return shared.token;
  }
}

function start(): void {
  startTheme();
  const shared = fragment.read(location.hash);
  const mode = (document.querySelector<HTMLMetaElement>('meta[name="urdd-mode"]')?.content ?? "static") as Mode;
  const site = new Site(mode, token(shared));
  const base = document.baseURI;
  const engine =
    mode === "inline"
      ? new Engine(inline.worker(), inline.bytes("urdd.wasm"))
      : new Engine(new URL("worker.js", base).href, new URL("urdd.wasm", base).href);
  const app = new App(engine, site);

  let stage: Stage | null = null;
  let noPicture: string | null = null;
  try {
    stage = new Stage(app);
  } catch (error) {
    noPicture = message(error);
  }

  const openEntry = async (entry: Entry, from: fragment.Shared | null = null): Promise<void> => {
    try {
      await opened(app, stage, entry, await site.source(entry), from);
    } catch (error) {
      app.store.set({ failure: message(error) });
    }
  };
  const openFiles = async (files: () => Promise<RobotSource>): Promise<void> => {
    app.close();
    app.store.set({ loading: { what: "files", done: 0, of: 0 } });
    try {
      const source = await files();
      const entry = unknown(source.name);
      await opened(app, stage, entry, source, null);
    } catch (error) {
      app.store.set({ loading: null, failure: message(error) });
    }
  };

  const failure = h("div", { class: "failure", role: "alert" });
  app.store.on(["failure"], ({ failure: text }) => {
    failure.hidden = text === null;
    fill(
      failure,
      h("p", {}, text),
      h(
        "button",
        {
          type: "button",
          click: () => {
            app.close();
          },
        },
        "Back",
      ),
    );
  });
  const waiting = h("div", { class: "waiting", role: "status" });
  app.store.on(["robot", "loading"], ({ robot, loading }) => {
    waiting.hidden = robot !== null || loading === null;
    if (!loading) return;
    const progress = h("progress", { "aria-label": loading.what, max: Math.max(loading.of, 1) });
    if (loading.of > 0) progress.value = loading.done;
    fill(waiting, h("p", {}, said(loading)), progress);
  });
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
          `There is no picture: this browser gives no WebGL (${noPicture ?? ""}). The panels work all the same.`,
        ),
      ),
    gallery(
      app,
      (entry) => void openEntry(entry),
      (files, folder) => {
        if (files && files.length > 0) {
          const list = [...files];
          void openFiles(() => chosen(list, folder));
        }
      },
    ),
    waiting,
    failure,
  );
  const panels = {
    Joints: joints(app),
    Shapes: shapes(app),
    Proximity: proximity(app),
    Skips: skips(app),
    Findings: findings(app),
    Info: info(app),
  };
  const saving = saveDialog(app);
  const actions = {
    save: saving.open,
    share: () => void share(app),
    picture: () => void save(app, stage),
    gallery: () => {
      app.close();
    },
  };
  fill(
    byId("page"),
    header(app, actions),
    h("div", { class: "columns" }, tree(app), middle, tabs(app, panels)),
    status(app),
    saving.element,
  );
  keys(app, stage);
  app.store.on(["robot"], ({ robot }) => {
    document.title = robot ? `${robot.name} · urdd` : "urdd";
  });
  remember(app, stage);

  addEventListener("dragover", (event) => {
    event.preventDefault();
  });
  addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer) void openFiles(dropped(event.dataTransfer));
  });
  // For tests and benches: what a person sees is not enough to compare numbers.
  Object.assign(window, { urdd: { app, stage } });
  void begin(app, site, shared, openEntry);
}

async function begin(
  app: App,
  site: Site,
  shared: fragment.Shared,
  open: (entry: Entry, from: fragment.Shared) => Promise<void>,
): Promise<void> {
  try {
    const entries = await site.robots();
    app.store.set({ entries });
    const asked = entries.find((entry) => entry.id === shared.robot);
    const one = asked ?? (entries.length === 1 ? entries[0] : undefined);
    if (shared.robot !== null && !asked && !one) app.note(`There is no robot ${shared.robot} here.`);
    if (entries.some(({ making, failure }) => making !== null || failure !== null)) {
      const made = await untilMade(app, one?.id ?? null);
      if (made) await open(made, shared);
    } else if (one) await open(one, shared);
  } catch (error) {
    app.store.set({ failure: message(error) });
  }
  if (site.mode === "live") follow(app);
}

/** Opens a robot, and shows of it what a link asks for. */
async function opened(
  app: App,
  stage: Stage | null,
  entry: Entry,
  source: RobotSource,
  from: fragment.Shared | null,
): Promise<void> {
  if (from?.layers) {
    const layers = { ...app.store.now.layers };
    for (const layer of LAYERS) layers[layer] = from.layers[layer] ?? { ...layers[layer], on: false };
    app.store.set({ layers });
  }
  if (from?.overlays) {
    const overlays = { ...app.store.now.overlays };
    for (const kind of OVERLAYS) overlays[kind] = from.overlays.includes(kind);
    app.store.set({ overlays });
  }
  if (from?.tab) app.store.set({ tab: from.tab });
  if (from?.camera?.length === 6) {
    const camera = from.camera;
    addEventListener(
      "urdd-settled",
      () => {
        stage?.view.camera.position.fromArray(camera, 0);
        stage?.view.controls.target.fromArray(camera, 3);
        stage?.view.controls.update();
        stage?.view.invalidate();
      },
      { once: true },
    );
  }
  const robot = await app.open(entry, source);
  if (!robot) return;
  if (from?.q?.length === robot.dofs.length) app.move(from.q);
  const link = from?.selected ? robot.link(from.selected) : -1;
  const joint = from?.joint ? robot.joints.findIndex(({ name }) => name === from.joint) : -1;
  if (link >= 0) app.select({ kind: "link", index: link });
  else if (joint >= 0) app.select({ kind: "joint", index: joint });
  const known = (link: number): boolean => link < robot.links.length;
  if (from?.hidden) app.hide(from.hidden.filter(known), true);
  if (from?.shapes) app.store.set({ shapes: from.shapes });
  if (from?.pair?.every(([link]) => known(link))) app.store.set({ pair: from.pair });
  if (app.store.now.tab === "Proximity") app.measure(true);
  if (app.store.now.tab === "Findings") void app.loadReport();
}

function current(app: App, stage: Stage | null): string {
  const { robot, q, tab, selected, layers, overlays, hidden, pair, shapes } = app.store.now;
  const link = robot && selected?.kind === "link" ? robot.links[selected.index] : undefined;
  const joint = robot && selected?.kind === "joint" ? robot.joints[selected.index] : undefined;
  const zero = robot?.about.zero?.every((value, dof) => value === q[dof]) ?? true;
  const onlyOriginal = LAYERS.every((layer) => layers[layer].on === (layer === "original"));
  const over = OVERLAYS.filter((kind) => overlays[kind]);
  return fragment.write({
    robot: robot?.source.kind === "url" ? robot.entry.id : null,
    q: zero ? null : q,
    tab: tab === "Joints" ? null : tab,
    selected: link?.name ?? null,
    joint: joint?.name ?? null,
    hidden: hidden.size > 0 ? [...hidden] : null,
    pair,
    shapes: shapes === initial().shapes ? null : shapes,
    layers: onlyOriginal ? null : layers,
    overlays: over.join() === "grid" ? null : over,
    camera: stage && robot ? [...stage.view.camera.position.toArray(), ...stage.view.controls.target.toArray()] : null,
    token: null,
  });
}

/** Keeps the address up to date. */
function remember(app: App, stage: Stage | null): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const later = (): void => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const { robot, loading } = app.store.now;
      if (robot && !loading) history.replaceState(null, "", `#${current(app, stage)}`);
    }, 400);
  };
  app.store.on(["robot", "q", "tab", "selected", "layers", "overlays", "hidden", "pair", "shapes"], later);
  stage?.view.moved.push(later);
}

async function share(app: App): Promise<void> {
  try {
    await navigator.clipboard.writeText(location.href);
    app.note(
      app.site.mode === "live"
        ? "The link is copied. It works on this machine, while `urdd view` runs."
        : "The link is copied.",
    );
  } catch {
    app.note("The link cannot be copied: take it from the address bar.");
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
