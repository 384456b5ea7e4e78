/** Synchronises the address and the page: links open views, Back and Forward move between them. */

import type { App } from "./app";
import { beside, sizeOf } from "./drop";
import type { Taken, Taking, Given } from "./drop";
import * as fragment from "./fragment";
import type { Here } from "./here/here";
import { untilReady } from "./making";
import { missingFrom } from "./missing";
import { unknown } from "./model";
import type { Entry } from "./model";
import { keepToken } from "./site";
import type { Stage } from "./stage";
import { CHOOSES_PAIRS, initial, LAYERS, OVERLAYS } from "./state";
import type { State } from "./state";
import { message, bytes, count } from "./ui/format";

/** Delay between a change and the update of the address, ms. */
const QUIET = 400;

export class Address {
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** The fragment of the present view, and the robot of this page that it shows. */
  private shown = "";
  private own: string | null = null;
  /** Counts navigations, so that only the last one takes effect. */
  private turn = 0;
  /** The view that a site opens with: of `urdd view --compare --export`. */
  private first = document.querySelector<HTMLMetaElement>('meta[name="urdd-opens"]')?.content ?? "";
  /** Takes back the drop that is being read or sent. */
  private taking = new AbortController();

  constructor(
    private readonly app: App,
    private readonly stage: Stage | null,
    /** Who makes robots of what is dropped; null in a page in one file. */
    private readonly here: Here | null,
  ) {
    const later = (): void => {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => {
        const { robot, loading } = app.store.now;
        if (robot && !loading) this.put(this.current(), false, robot.entry.here ? robot.entry.id : null);
      }, QUIET);
    };
    app.store.on(
      ["robot", "q", "tab", "selected", "layers", "overlays", "frameSize", "hidden", "pair", "shapes", "compareWith"],
      later,
    );
    stage?.view.moved.push(later);
    const follow = (): void => {
      if (location.hash !== this.shown || ownOf(history.state) !== this.own) void this.follow();
    };
    addEventListener("popstate", follow);
    addEventListener("hashchange", follow);
    addEventListener("beforeunload", (event) => {
      if (here?.isUnsaved) event.preventDefault();
    });
  }

  /** Opens a robot of the list, as a new entry of the history. */
  async open(entry: Entry): Promise<void> {
    // Robots that this page makes have no address: another browser does not have them. This one's history has them.
    const words = entry.here ? "" : fragment.write({ ...fragment.read(""), robot: entry.id });
    this.put(words, true, entry.here ? entry.id : null);
    await this.read(entry);
  }

  /** Closes the robot, and removes it from the address. */
  leave(): void {
    this.stopTaking();
    this.close();
    this.put("", true);
  }

  private close(): void {
    this.turn++;
    this.app.store.set({ taking: null });
    this.here?.leave();
    this.app.close();
  }

  /** Ends what a person waits for. What was open before stays. */
  cancel(): void {
    if (this.app.store.now.taking === null) this.leave();
    else this.stopTaking();
  }

  private stopTaking(): void {
    this.taking.abort();
    this.app.store.set({ taking: null });
  }

  /** Removes robots that this page made. */
  remove(entry: Entry): void {
    this.here?.remove([entry]);
  }

  /**
   * Opens dropped or selected files, which have no address; or adds those that the open robot lacks. What is open stays
   * until there is another robot.
   */
  async openFiles(files: Taking): Promise<void> {
    const { app, here } = this;
    const { store } = app;
    this.stopTaking();
    this.taking = new AbortController();
    const { signal } = this.taking;
    const unzip = (zip: Blob): Promise<Given[] | null> => app.engine.apart("unzip", { zip }, signal);
    // During the event: afterwards its files are gone.
    const taking = files({ unzip, signal });
    store.set({ taking: "Reading the files", ...(here?.open ? {} : { failure: null }) });
    try {
      const source = await taking;
      signal.throwIfAborted();
      const missing = store.now.draft && missingFrom(store.now, source);
      if (missing) {
        here?.add(missing);
        app.note(`${count(missing.length, "file")} added.`);
      } else await this.showTaken(source, signal);
    } catch (error) {
      if (signal.aborted) return;
      if (store.now.robot || here?.open) app.note(message(error));
      else store.set({ loading: null, failure: message(error) });
    } finally {
      if (this.taking.signal === signal) store.set({ taking: null });
    }
  }

  private async showTaken(source: Taken, signal: AbortSignal): Promise<void> {
    const { app, here } = this;
    const { store, site } = app;
    if (source.kind === "files")
      throw new Error(
        "This is no robot: there is no URDF, MJCF, SDF or USD here, and no URDD (a folder with urdd.json or a module such as urdf_module/module.json).",
      );
    if (source.kind !== "description") {
      this.close();
      this.put("", true);
      await app.open({ ...unknown(source.name), id: "" }, source);
      return;
    }
    // xacro files are programs, which only `urdd view` runs.
    const isSent = site.mode === "live" && source.hasXacro;
    if (!isSent && !here)
      throw new Error(
        "This is a robot description, not a URDD, and this page in one file cannot generate one: run `urdd view` with it, or drop it on a page that `urdd view --export` made.",
      );
    const entries = isSent ? await this.send(source.files, signal) : await here?.take(source.files, signal);
    signal.throwIfAborted();
    if (!entries) return;
    const known = new Set(entries.map(({ id }) => id));
    this.close();
    store.set({ entries: [...store.now.entries.filter(({ id }) => !known.has(id)), ...entries] });
    const [one] = entries;
    if (one && entries.length === 1) await this.open(one);
    else this.put("", true);
  }

  /** Sends descriptions to `urdd view`, which makes robots of them. */
  private async send(files: Given[], signal: AbortSignal): Promise<Entry[]> {
    const { store, site } = this.app;
    store.set({ taking: `Sending ${count(files.length, "file")} (${bytes(sizeOf(files))})` });
    const sent = await site.drop(files, signal);
    return (await site.robots()).filter(({ id }) => sent.includes(id));
  }

  /** A link to the view, for other tabs and browsers too. */
  link(): string {
    const { site } = this.app;
    const words = [site.token === null ? "" : `token=${site.token}`, this.current()].filter(Boolean);
    return `${location.href.split("#")[0] ?? ""}#${words.join("&")}`;
  }

  /** Shows the view of the address. */
  async follow(): Promise<void> {
    clearTimeout(this.timer);
    const turn = ++this.turn;
    const { app } = this;
    const own = app.store.now.entries.find((entry) => entry.here && entry.id === ownOf(history.state));
    if (own) {
      this.put("", false, own.id);
      await this.read(own);
      return;
    }
    const shared = fragment.read(location.hash || this.first);
    this.first = "";
    const { robot } = app.store.now;
    if (shared.token === null && robot && robot.entry.id !== "" && robot.entry.id === shared.robot) {
      // Another state of the open robot: no request is needed.
      this.put(fragment.write(shared), false);
      this.apply(shared);
      return;
    }
    try {
      // The list is read with the link's token first: an unknown token must not replace a known one.
      const entries = await app.site.known(shared.token);
      if (turn !== this.turn) return;
      keepToken(app.site.token);
      app.store.set({ entries });
      this.put(fragment.write(shared), false);
      if (shared.from === null || !this.here) await this.show(shared, turn);
      else await this.openFiles(beside(shared.from));
    } catch (error) {
      if (turn !== this.turn) return;
      // The token is always removed from the address.
      this.put(fragment.write(shared), false);
      app.close();
      app.store.set({ failure: message(error) });
    }
  }

  private async show(shared: fragment.Shared, turn: number): Promise<void> {
    const { app } = this;
    const { entries, robot } = app.store.now;
    const asked = entries.find((entry) => entry.id === shared.robot);
    const one = asked ?? (entries.length === 1 ? entries.find((entry) => !entry.here) : undefined);
    if (shared.robot !== null && !asked) app.note(`Unknown robot ${shared.robot}.`);
    if (!one) {
      this.here?.leave();
      app.close();
    } else if (robot?.entry.id === one.id) this.apply(shared);
    else if (turn === this.turn) await this.read(one, shared);
  }

  /** Opens a robot, with the view of a link. */
  private async read(listed: Entry, shared: fragment.Shared | null = null): Promise<void> {
    const turn = ++this.turn;
    const { app, stage } = this;
    try {
      if (!listed.ready) app.close();
      // It goes on where it was left.
      if (listed.here) await app.site.revision(listed);
      else this.here?.leave();
      app.store.set({ failure: null, loading: { what: "the list of files", done: 0, of: 0 } });
      const entry = await untilReady(app, listed, () => turn === this.turn);
      if (!entry) return;
      // Layers and the camera are set before the first picture.
      if (shared) app.store.set(looks(shared));
      if (stage) stage.from = shared?.camera?.length === 6 ? shared.camera : null;
      const opened = await app.openNow(entry, null, () => turn === this.turn);
      if (opened && shared && turn === this.turn) this.apply(shared);
    } catch (error) {
      if (turn === this.turn) app.store.set({ loading: null, failure: message(error) });
    }
  }

  /** Shows the view of a link of the open robot, with defaults for what the link omits. */
  private apply(shared: fragment.Shared): void {
    const { app, stage } = this;
    const { robot } = app.store.now;
    if (!robot) return;
    const known = (link: number): boolean => link < robot.links.length;
    const link = shared.selected === null ? -1 : robot.link(shared.selected);
    const joint = shared.joint === null ? -1 : robot.joints.findIndex(({ name }) => name === shared.joint);
    const { tab } = looks(shared);
    const shapes = shared.shapes ?? initial().shapes;
    if (shapes !== app.store.now.shapes) app.useShapes(shapes);
    app.store.set({
      ...looks(shared),
      failure: null,
      compareWith: shared.compareWith,
      selected: link >= 0 ? { kind: "link", index: link } : joint >= 0 ? { kind: "joint", index: joint } : null,
      hidden: new Set((shared.hidden ?? []).filter(known)),
      pair: CHOOSES_PAIRS.has(tab) && shared.pair?.every(([link]) => known(link)) ? shared.pair : null,
    });
    const q = shared.q?.length === robot.dofs.length ? shared.q : robot.start;
    if (shared.q && q !== shared.q) app.note("The link is for another version of this robot, with other joints.");
    if (q) app.move(q);
    if (shared.camera?.length === 6) stage?.place(shared.camera);
    if (app.store.now.tab === "Findings") void app.loadReport();
  }

  /** The present view as a fragment. */
  private current(): string {
    const { robot, q, tab, selected, layers, overlays, hidden, pair, shapes, frameSize, compareWith } =
      this.app.store.now;
    // Dropped files have no address.
    if (!robot || robot.entry.id === "" || robot.entry.here) return "";
    const link = selected?.kind === "link" ? robot.links[selected.index] : undefined;
    const joint = selected?.kind === "joint" ? robot.joints[selected.index] : undefined;
    const isStart = robot.start?.every((value, dof) => value === q[dof]) ?? true;
    const onlyOriginal = LAYERS.every((layer) => layers[layer].on === (layer === "original"));
    const begin = initial();
    const over = OVERLAYS.filter((kind) => overlays[kind]);
    const camera = this.stage?.view.camera.position.toArray();
    return fragment.write({
      robot: robot.entry.id,
      q: isStart ? null : q,
      tab: tab === begin.tab ? null : tab,
      selected: link?.name ?? null,
      joint: joint?.name ?? null,
      hidden: hidden.size > 0 ? [...hidden] : null,
      pair,
      shapes: shapes === begin.shapes ? null : shapes,
      layers: onlyOriginal && layers.original.opacity === 1 ? null : layers,
      overlays: OVERLAYS.every((kind) => overlays[kind] === begin.overlays[kind]) ? null : over,
      frameSize,
      compareWith,
      camera: camera && this.stage ? [...camera, ...this.stage.view.controls.target.toArray()] : null,
      token: null,
      from: null,
    });
  }

  /** Writes the address, and the robot of this page: as a new entry of the history, or in place of the present one. */
  private put(words: string, step: boolean, own: string | null = null): void {
    clearTimeout(this.timer);
    const url = words === "" ? location.pathname + location.search : `#${words}`;
    const isOther = location.hash !== (words === "" ? "" : `#${words}`) || own !== this.own;
    try {
      if (step && isOther) history.pushState({ own }, "", url);
      else history.replaceState({ own }, "", url);
    } catch {
      // A frame without its own address, as in a notebook.
    }
    this.shown = location.hash;
    this.own = own;
  }
}

/** The robot of this page in an entry of the history. */
function ownOf(state: unknown): string | null {
  return (state as { own?: string } | null)?.own ?? null;
}

/** The state of the panels and the picture in a link. */
function looks(shared: fragment.Shared): Pick<State, "tab" | "layers" | "overlays" | "frameSize"> {
  const begin = initial();
  const layers = { ...begin.layers };
  if (shared.layers)
    for (const layer of LAYERS) layers[layer] = shared.layers[layer] ?? { ...layers[layer], on: false };
  const overlays = { ...begin.overlays };
  if (shared.overlays) for (const kind of OVERLAYS) overlays[kind] = shared.overlays.includes(kind);
  return { tab: shared.tab ?? begin.tab, layers, overlays, frameSize: shared.frameSize };
}
