/** Robots that `urdd view` generates: their progress, and saving them. */

import type { App } from "./app";
import type { Entry } from "./model";
import { button, fill, h } from "./ui/dom";
import { message, lines, name } from "./ui/format";

/** Pauses between polls while a robot is generated, and after that failed, ms. */
const SOON = 50;
const PERIOD = 500;

/**
 * Polls until a robot has something to show, which makes `urdd view` generate it. After a failure too: the URDF may be
 * mended. Null if the page shows something else by then.
 */
export async function untilReady(app: App, first: Entry, isWanted: () => boolean): Promise<Entry | null> {
  for (let entry = first; ;) {
    if (entry.ready) return entry;
    ({ entry } = await app.site.revision(entry));
    if (!isWanted()) return null;
    const { making, failure } = entry;
    const words = { title: `Generating ${name(entry.name)}:`, what: name(making?.what ?? "the URDF") };
    app.store.set({
      entries: app.store.now.entries.map((known) => (known.id === entry.id ? entry : known)),
      failure: failure === null ? null : `Generation of ${name(entry.name)} failed: ${lines(failure)}`,
      loading: failure === null ? { ...words, done: making?.done ?? 0, of: making?.of ?? 0 } : null,
    });
    if (!entry.ready) await new Promise((resolve) => setTimeout(resolve, failure === null ? SOON : PERIOD));
    if (!isWanted()) return null;
  }
}

/** A dialog that asks for a folder, and saves the generated URDD there. */
export function saveDialog(app: App): { element: HTMLElement; open: () => void } {
  const folder = h("input", {
    type: "text",
    id: "save-folder",
    autocomplete: "off",
    spellcheck: "false",
    required: true,
  });
  const wrong = h("p", { class: "bad", role: "alert" });
  const assumed = h("div", { class: "assumed" });
  const cancel = button("Cancel", {}, () => element.close());
  const form = h(
    "form",
    {},
    h("h2", {}, "Save the generated URDD"),
    h("label", { for: folder.id }, "Folder"),
    folder,
    h("p", { class: "hint" }, "A new or empty folder. A relative path begins in the folder where `urdd view` runs."),
    assumed,
    wrong,
    h("div", { class: "actions" }, h("button", { type: "submit", class: "main" }, "Save"), cancel),
  );
  const element = h("dialog", { class: "dialog", "aria-label": "Save the generated URDD" }, form);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    void save(app, folder.value)
      .then((where) => {
        element.close();
        app.note(`Saved in ${name(where)}. The page shows that folder now, and no longer follows the URDF.`);
      })
      .catch((error: unknown) => {
        wrong.textContent = message(error);
      });
  });
  return {
    element,
    open: () => {
      const entry = app.store.now.robot?.entry;
      if (!entry) return;
      wrong.textContent = "";
      folder.value = entry.name;
      fill(
        assumed,
        ...(entry.notes.length === 0
          ? []
          : [
              h("h3", {}, "Assumptions during generation"),
              h("ul", { class: "notes" }, ...entry.notes.map((note) => h("li", {}, name(note)))),
            ]),
      );
      element.showModal();
      folder.select();
    },
  };
}

async function save(app: App, folder: string): Promise<string> {
  let kept = folder;
  await app.write(async ({ entry: { id } }) => {
    const path = `robots/${encodeURIComponent(id)}/keep`;
    kept = ((await app.site.post(path, { folder })) as { folder: string }).folder;
    const entries = await app.site.robots();
    app.store.set({ entries });
    return entries.find((entry) => entry.id === id) ?? null;
  });
  return kept;
}
