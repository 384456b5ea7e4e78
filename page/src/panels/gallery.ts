/** All robots of the site, with pictures and search, and a place to drop a folder or a zip. */

import type { App } from "../app";
import type { Entry } from "../model";
import { button, fill, h } from "../ui/dom";
import { picker } from "../ui/files";
import { message, count, name } from "../ui/format";
import { generating } from "./status";

/** Number of parallel requests. */
const AT_ONCE = 2;

interface Card {
  entry: Entry;
  element: HTMLButtonElement;
  /** With the button that removes it. */
  whole: HTMLElement;
  show: (entry: Entry) => void;
}

export function gallery(
  app: App,
  open: (entry: Entry) => void,
  remove: (entry: Entry) => void,
  choose: (files: File[], folder: boolean) => void,
): HTMLElement {
  const search = h("input", { type: "search", placeholder: "Find a robot", "aria-label": "Find a robot" });
  const title = h("h2", {}, "Robots");
  const list = h("div", { class: "cards" });
  const empty = h("p", { class: "empty" }, "No robot matches.");
  const panel = h(
    "section",
    { class: "gallery", "aria-label": "Robots" },
    h("div", { class: "headline" }, title, h("span", { class: "spring" }), search),
    list,
    empty,
    dropHere(app.site.mode === "live", choose),
  );
  const cards = new Map<string, Card>();
  const asker = new Asker(app, (entry) => {
    cards.get(entry.id)?.show(entry);
    filter();
  });
  const filter = (): void => {
    const words = search.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const { element, whole, entry } of cards.values()) {
      const text = `${entry.id} ${element.textContent}`.toLowerCase();
      whole.hidden = !words.every((word) => text.includes(word));
      if (!whole.hidden) shown++;
    }
    empty.hidden = shown > 0 || cards.size === 0;
  };
  search.addEventListener("input", filter);
  app.store.on(["entries"], ({ entries }) => {
    for (const entry of entries) {
      const known = cards.get(entry.id);
      if (known) known.show({ ...known.entry, ...listed(entry) });
      else {
        const made = card(entry, open, remove);
        cards.set(entry.id, made);
        list.append(made.whole);
        asker.watch(made);
      }
    }
    const known = new Set(entries.map(({ id }) => id));
    for (const [id, { whole }] of cards) {
      if (known.has(id)) continue;
      whole.remove();
      cards.delete(id);
    }
    title.textContent = entries.length > 0 ? count(entries.length, "robot") : "See and validate a robot";
    search.hidden = entries.length < 2;
    filter();
  });
  app.store.on(["robot", "loading", "failure", "taking"], ({ robot, loading, failure, taking }) => {
    panel.hidden = robot !== null || loading !== null || failure !== null || taking !== null;
  });
  return panel;
}

/** An entry of `robots.json`, with what is known from elsewhere. */
function listed(entry: Entry): Partial<Entry> {
  return Object.fromEntries(
    Object.entries(entry).filter(([key, value]) => value !== null || key === "making" || key === "failure"),
  );
}

function dropHere(isLive: boolean, choose: (files: File[], folder: boolean) => void): HTMLElement {
  return h(
    "div",
    { class: "drop" },
    h(
      "p",
      {},
      "Drop a robot here: a URDF, MJCF, SDF or USD with its meshes, such as the folder of a ROS package, or a URDD; as files, as a folder, or as a .zip.",
    ),
    h("div", { class: "actions" }, picker("Choose a folder", true, choose), picker("Choose files", false, choose)),
    h(
      "p",
      { class: "hint" },
      isLive
        ? "It stays in this browser. xacro files, which are programs, go to `urdd view` on this machine, which runs them."
        : "It stays in this browser: nothing is uploaded.",
    ),
  );
}

function card(first: Entry, open: (entry: Entry) => void, remove: (entry: Entry) => void): Card {
  const picture = h("span", { class: "no-picture", "aria-hidden": "true" });
  const size = h("span", { class: "hint" });
  const verdict = h("span", { class: "verdict" });
  const heading = h("strong", { title: name(first.name) }, name(first.name));
  const element = button([picture, heading, size, verdict], { class: "card" }, () => open(made.entry));
  const away = { class: "tiny remove", title: "Remove it from this page", "aria-label": `Remove ${name(first.name)}` };
  const made: Card = {
    entry: first,
    element,
    whole: h("div", { class: "of-card" }, element, first.here && button("✕", away, () => remove(made.entry))),
    show(entry) {
      if (entry.picture !== null && entry.picture !== picture.dataset["of"]) {
        picture.dataset["of"] = entry.picture;
        fill(picture, h("img", { src: entry.picture, alt: "", loading: "lazy" }));
      }
      made.entry = entry;
      size.textContent = [
        entry.links === null ? null : count(entry.links, "link"),
        entry.dofs === null ? null : count(entry.dofs, "DOF"),
      ]
        .filter(Boolean)
        .join(" · ");
      verdict.className = `verdict ${entry.verdict ?? ""}`;
      verdict.textContent = words(entry);
    },
  };
  made.show(first);
  return made;
}

function words({ ready, making, failure, verdict, findings }: Entry): string {
  if (making) return generating(making);
  if (failure !== null) return "generation failed";
  if (!ready) return "generated when it is opened";
  if (verdict === null) return "";
  const [errors, warnings] = [findings?.error ?? 0, findings?.warning ?? 0];
  const passes = warnings > 0 ? `passes, ${count(warnings, "warning")}` : "passes";
  const fails = `fails: ${count(errors, "error")}`;
  return { pass: passes, part: `${passes} in part`, fail: fails, unreadable: "not examined" }[verdict] ?? verdict;
}

function isMade({ ready, making }: Entry): boolean {
  return ready && making === null;
}

/** Requests missing data of visible cards. */
class Asker {
  private readonly waiting: Card[] = [];
  private busy = 0;
  /** Visible cards of robots that are not generated. */
  private readonly undrawn = new Set<Card>();
  private isDrawing = false;
  private readonly seen: IntersectionObserver;
  private readonly cards = new Map<Element, Card>();

  constructor(
    private readonly app: App,
    private readonly answered: (entry: Entry) => void,
  ) {
    this.seen = new IntersectionObserver((changes) => {
      for (const { isIntersecting, target } of changes) {
        const card = this.cards.get(target);
        if (!card) continue;
        this.undrawn.delete(card);
        if (!isIntersecting) continue;
        if (isMade(card.entry)) {
          this.seen.unobserve(target);
          this.waiting.push(card);
        } else if (isUntouched(card.entry)) this.undrawn.add(card);
      }
      void this.work();
      void this.draw();
    });
    // Data of a robot can be requested once it is generated.
    app.store.on(["entries"], () => {
      // Once the cards have the new entries.
      queueMicrotask(() => {
        for (const [element, { entry }] of this.cards) {
          if (isMade(entry) && entry.verdict === null) {
            this.seen.unobserve(element);
            this.seen.observe(element);
          }
        }
      });
    });
  }

  watch(card: Card): void {
    // The server has nothing of a robot that was made in the page.
    if (this.app.site.mode !== "live" || card.entry.here) return;
    this.cards.set(card.element, card);
    this.seen.observe(card.element);
  }

  private async work(): Promise<void> {
    while (this.busy < AT_ONCE) {
      // An open robot has priority: the gallery is hidden then.
      const card = this.app.store.now.robot ? undefined : this.waiting.shift();
      if (!card) return;
      this.busy++;
      try {
        const picture = await this.app.site.picture(card.entry);
        this.answered({ ...card.entry, picture });
        const summary = await this.app.site.summary(card.entry);
        this.answered({ ...card.entry, ...listed(summary) });
      } catch (error) {
        console.info(message(error));
      }
      this.busy--;
    }
  }

  /** Asks for the pictures of robots that nobody has opened, one at a time: `urdd view` answers when one is drawn. */
  private async draw(): Promise<void> {
    if (this.isDrawing) return;
    this.isDrawing = true;
    for (const card of this.undrawn) {
      this.undrawn.delete(card);
      if (!isUntouched(card.entry)) continue;
      try {
        const picture = await this.app.site.picture(card.entry);
        if (picture !== null) this.answered({ ...card.entry, picture });
      } catch (error) {
        console.info(message(error));
      }
    }
    this.isDrawing = false;
  }
}

/** Whether there is no picture of a robot, and nobody has opened it. */
function isUntouched({ ready, making, failure, picture }: Entry): boolean {
  return !ready && making === null && failure === null && picture === null;
}
