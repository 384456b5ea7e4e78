/** Robots that `urdd view` generates while the page is open: their progress, and saving them. */

import type { App } from "./app";
import { message } from "./app";
import type { Entry } from "./model";
import { button, fill, h } from "./ui/dom";
import { name } from "./ui/format";

const PERIOD = 250;

/** Polls until all robots are generated. Returns the wanted one as soon as possible. */
export async function untilMade(app: App, id: string | null): Promise<Entry | null> {
  for (;;) {
    const { entries } = app.store.now;
    const wanted = entries.find((entry) => entry.id === id);
    if (wanted && !wanted.making) {
      app.store.set({ loading: null });
      if (wanted.failure === null) return wanted;
      app.store.set({ failure: `Generation of ${name(wanted.name)} failed: ${name(wanted.failure)}` });
      return null;
    }
    if (!entries.some(({ making }) => making)) return null;
    if (wanted?.making) {
      const { what, done, of } = wanted.making;
      app.store.set({ loading: { title: `Generating ${name(wanted.name)}:`, what: name(what), done, of } });
    }
    await new Promise((resolve) => setTimeout(resolve, PERIOD));
    app.store.set({ entries: await app.site.robots() });
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
        app.note(`Saved in ${name(where)}. Edits of skips are saved there from now on.`);
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
  const { robot } = app.store.now;
  if (!robot) throw new Error("No robot is open.");
  const path = `robots/${encodeURIComponent(robot.entry.id)}/keep`;
  const answer = (await app.site.post(path, { folder })) as { folder: string };
  const entries = await app.site.robots();
  app.store.set({ entries });
  const entry = entries.find(({ id }) => id === robot.entry.id);
  if (entry) await app.open(entry, await app.site.source(entry), true);
  return answer.folder;
}
