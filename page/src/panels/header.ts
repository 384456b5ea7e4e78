/** The bar at the top: name, size, findings, layers, and actions on the whole page. */

import type { App } from "../app";
import { tally } from "../findings";
import type { Entry } from "../model";
import { LAYERS, LAYER_HINTS, LAYER_NAMES } from "../state";
import type { State } from "../state";
import { button, fill, h } from "../ui/dom";
import type { Child } from "../ui/dom";
import { count, name } from "../ui/format";
import { toggleTheme } from "../ui/theme";
import { absentChip } from "./absent";
import { collision, generating } from "./status";

/** The layers in the bar; the panel has all. */
const SHORT = LAYERS.slice(0, LAYERS.indexOf("spheres") + 1);

export function header(
  app: App,
  actions: {
    save: () => void;
    stop: () => void;
    goOn: () => void;
    share: () => void;
    picture: () => void;
    gallery: () => void;
  },
): HTMLElement {
  const title = h("div", { class: "title" });
  const chips = new Pills(app);
  const buttons = SHORT.map((layer) => {
    const hint = [LAYER_HINTS[layer], "Shift-click for several"].filter(Boolean).join(". ");
    const made = button(LAYER_NAMES[layer], { "aria-pressed": "false", title: hint }, (event) => {
      const { layers } = app.store.now;
      if (event.shiftKey) app.setLayer(layer, { on: !layers[layer].on });
      else app.showOnly(layer);
    });
    return [layer, made] as const;
  });
  const layers = h(
    "div",
    { class: "segments", role: "group", "aria-label": "Shown shapes; shift-click for several" },
    ...buttons.map(([, button]) => button),
  );
  const frames = button("Frames", { class: "quiet frames", "aria-pressed": "false" }, () => {
    const { overlays } = app.store.now;
    app.store.set({ overlays: { ...overlays, frames: !overlays.frames } });
  });
  const save = button(
    "Save…",
    { class: "main", title: "Save the generated URDD, or files for other programs" },
    actions.save,
  );
  const share = button("Share", { class: "quiet", title: "Copy a link to this view" }, actions.share);
  const picture = button("Picture", { class: "quiet", title: "Save the picture as PNG" }, actions.picture);
  const links = button("Links", { class: "quiet fold", "aria-expanded": "false", "aria-controls": "links" }, () =>
    app.store.set({ unfolded: app.store.now.unfolded === "links" ? null : "links" }),
  );
  app.store.on(["unfolded", "robot"], ({ unfolded, robot }) => {
    links.setAttribute("aria-expanded", String(unfolded === "links"));
    links.hidden = robot === null;
  });
  const bar = h(
    "header",
    { class: "bar" },
    links,
    title,
    chips.element,
    h("span", { class: "spring" }),
    layers,
    frames,
    save,
    share,
    picture,
    button("◐", { class: "quiet icon", "aria-label": "Dark or light", title: "Dark or light" }, toggleTheme),
    chips.rest,
  );
  const touching = button(
    "",
    {
      class: "chip",
      title: "See the nearest pairs",
    },
    () => app.store.set({ tab: "Proximity", unfolded: "panels" }),
  );
  app.store.on(["robot", "proximity", "contacts"], (state) => {
    const { brief, kind } = collision(state);
    touching.hidden = state.robot === null || state.contacts === null;
    touching.className = `chip ${kind === "bad" ? "error" : kind}`;
    if (touching.textContent !== brief) touching.textContent = brief;
    chips.fit();
  });
  const shown = ["robot", "entries", "report", "absent", "making", "draft", "wanted"] as const;
  app.store.on(shown, ({ robot, entries, report, absent, making, draft, wanted }) => {
    const several = entries.length > 1;
    const isOpen = robot !== null || draft !== null;
    fill(
      title,
      several && isOpen && button("☰", { class: "quiet back", "aria-label": "All robots" }, actions.gallery),
      h("h1", { title: robot ? name(robot.name) : "" }, robot ? name(robot.name) : "urdd"),
    );
    const found = report.report ? tally(report.report) : robot?.entry.findings;
    const chip = (severity: "error" | "warning"): Node | null => {
      const n = found?.[severity];
      if (!n || !isOpen) return null;
      return button(
        count(n, severity),
        {
          class: `chip ${severity}`,
        },
        () => app.store.set({ tab: "Findings", unfolded: "panels" }),
      );
    };
    // The most important first.
    chips.fill(
      touching,
      chip("error"),
      chip("warning"),
      absentChip(app, robot ? absent.length || wanted.length : 0),
      ...(robot ? running(making, robot.entry, actions) : []),
      robot?.entry.temporary && h("span", { class: "chip", title: kept(robot.entry) }, "not saved"),
      robot &&
        h(
          "span",
          { class: "chip" },
          [count(robot.links.length, "link"), robot.about.dofs ? count(robot.dofs.length, "DOF") : null]
            .filter(Boolean)
            .join(" · "),
          h("span", { class: "roomy" }, ` · ${version(robot.about.metadata, robot.about.profile)}`),
        ),
      robot &&
        robot.entry.notes.length > 0 &&
        button(
          count(robot.entry.notes.length, "assumption"),
          { class: "chip", title: "Assumptions during generation" },
          () => app.store.set({ tab: "Info", unfolded: "panels" }),
        ),
    );
    for (const element of [layers, frames, share, picture]) element.hidden = !robot;
    save.hidden = !robot?.entry.temporary;
  });
  app.store.on(["layers", "overlays"], ({ layers, overlays }) => {
    for (const [layer, button] of buttons) button.setAttribute("aria-pressed", String(layers[layer].on));
    frames.setAttribute("aria-pressed", String(overlays.frames));
  });
  return bar;
}

/** How far a robot is, and what can be done about it. */
function running(
  { making, failure }: State["making"],
  { here, ready }: Entry,
  actions: { stop: () => void; goOn: () => void },
): Node[] {
  if (making) {
    const chip = h("span", { class: "chip making" }, generating(making));
    const stop = button("Stop", { class: "chip", title: "Stop generating; what is there stays" }, actions.stop);
    return here ? [chip, stop] : [chip];
  }
  return here && ready && failure !== null
    ? [button("Generate the rest", { class: "chip warning", title: failure }, actions.goOn)]
    : [];
}

function kept({ here }: Entry): string {
  return here ? "It is in this page only, and gone when you close it" : "Deleted when `urdd view` ends";
}

function version(metadata: Record<string, unknown> | null, profile: string): string {
  const found = metadata?.["urdd_version"] ?? metadata?.["spec_version"];
  if (typeof found === "string") return `URDD ${name(found)}`;
  return profile === "legacy" ? "legacy URDD" : "URDD";
}

/** Pills in a row, the most important first. Those without room are behind a button that counts them. */
class Pills {
  readonly element = h("div", { class: "chips" });
  /** What the button unfolds, below the bar. */
  readonly rest = h("div", { class: "rest", id: "more-chips", role: "group", "aria-label": "More about this robot" });
  private readonly more: HTMLButtonElement;
  private pills: HTMLElement[] = [];

  constructor(app: App) {
    this.more = button("", { class: "chip more", "aria-controls": this.rest.id, "aria-expanded": "false" }, () =>
      app.store.set({ unfolded: app.store.now.unfolded === "pills" ? null : "pills" }),
    );
    app.store.on(["unfolded"], ({ unfolded }) => this.more.setAttribute("aria-expanded", String(unfolded === "pills")));
    let width = 0;
    new ResizeObserver(() => {
      if (this.element.clientWidth === width) return;
      width = this.element.clientWidth;
      this.fit();
    }).observe(this.element);
  }

  fill(...pills: Child[]): void {
    this.pills = pills.filter((pill) => pill instanceof HTMLElement);
    this.fit();
  }

  /** Folds what has no room. Call it when a pill has changed. */
  fit(): void {
    const { element, more, rest } = this;
    const shown = this.pills.filter((pill) => !pill.hidden);
    const { activeElement: focused } = document;
    const isNarrow = (): boolean => element.scrollWidth > element.clientWidth;
    fill(element, ...shown);
    const folded: HTMLElement[] = [];
    if (isNarrow()) element.append(more);
    while (isNarrow() && shown.length > folded.length) {
      const [last] = shown.slice(-1 - folded.length);
      if (!last) break;
      last.remove();
      folded.unshift(last);
      more.textContent = `+${folded.length}`;
      more.title = `${folded.length} more`;
    }
    fill(rest, ...folded);
    if (focused instanceof HTMLElement && focused !== document.activeElement) focused.focus();
  }
}
