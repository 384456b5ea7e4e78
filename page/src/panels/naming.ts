/** Saves the pose that is shown as a named configuration of the URDD. */

import type { App } from "../app";
import { message } from "../app";
import { h } from "../ui/dom";
import { name } from "../ui/format";

export function naming(app: App): HTMLElement {
  const entry = h("input", {
    type: "text",
    id: "pose-name",
    autocomplete: "off",
    spellcheck: "false",
    placeholder: "Name of this pose",
    "aria-label": "Name of this pose",
    required: true,
  });
  const submit = h(
    "button",
    { type: "submit", title: "Save this pose as a named configuration of the URDD" },
    "Save pose",
  );
  const form = h("form", { class: "actions", id: "naming" }, entry, submit);
  const known = (): boolean => app.store.now.robot?.named.some((other) => other.name === entry.value) ?? false;
  const relabel = (): void => {
    submit.textContent = known() ? "Replace pose" : "Save pose";
  };
  entry.addEventListener("input", relabel);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    void save(app, entry.value, known())
      .then((shown) => {
        entry.value = "";
        relabel();
        app.note(`Saved as \`${name(shown)}\`.`);
      })
      .catch((error: unknown) => app.note(`Nothing was saved: ${message(error)}`));
  });
  app.store.on(["robot"], ({ robot }) => {
    form.hidden = !robot?.moves || !robot.entry.writable || app.site.mode !== "live";
    relabel();
  });
  return form;
}

async function save(app: App, shown: string, replace: boolean): Promise<string> {
  const { robot, q, skips } = app.store.now;
  const { revision } = app;
  if (!robot || revision === null) throw new Error("the server does not answer");
  const path = `robots/${encodeURIComponent(robot.entry.id)}/configurations`;
  await app.site.post(path, { name: shown, configuration: q, replace, revision });
  // Saves of skips cannot be undone past this one.
  app.store.set({ skips: { ...skips, saved: 0 } });
  await app.reopen(robot.entry);
  return shown;
}
