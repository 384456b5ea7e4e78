/** A dialog that saves what this page made: the URDD, the text, files for other programs. */

import type { App } from "../app";
import { message } from "../app";
import { button, fill, h } from "../ui/dom";
import { name } from "../ui/format";
import { ACTUATORS, FORMATS } from "./formats";
import type { Here } from "./here";

export function savingHere(app: App, here: Here): { element: HTMLDialogElement; open: () => void } {
  const wrong = h("p", { class: "bad", role: "alert" });
  const notes = h("ul", { class: "notes" });
  const verdict = h("p", { class: "hint", role: "status" });
  const hint = h("p", { class: "hint" });
  const formats = h(
    "select",
    { id: "save-format" },
    ...FORMATS.map(({ word, title }) => h("option", { value: word }, title)),
  );
  const actuators = h(
    "select",
    { "aria-label": "Actuators" },
    h("option", { value: "" }, "without actuators"),
    ...ACTUATORS.map((kind) => h("option", { value: kind }, `with ${kind} actuators`)),
  );
  const choose = (): void => {
    actuators.hidden = !(FORMATS.find(({ word }) => word === formats.value)?.hasActuators ?? false);
  };
  formats.addEventListener("change", choose);
  choose();
  const urdd = button("Save the URDD", { class: "main" }, () =>
    act(async () => {
      const { skips } = app.store.now;
      await here.saver.urdd(skips.dirty ? (skips.answer?.files ?? []) : []);
      app.store.set({ skips: { ...app.store.now.skips, dirty: false } });
    }),
  );
  const text = button("", {}, () => act(() => here.saver.text()));
  const urdf = button("Save as URDF, with meshes", {}, () => act(() => here.saver.urdf()));
  const other = button("Save", {}, () =>
    act(async () => {
      const format = FORMATS.find(({ word }) => word === formats.value);
      const made = format && (await here.saver.exported(format, format.hasActuators ? actuators.value : ""));
      fill(notes, ...(made ?? []).map((note) => h("li", {}, name(note))));
    }),
  );
  const element = h(
    "dialog",
    { class: "dialog", "aria-label": "Save" },
    h("h2", {}, "Save"),
    h("div", { class: "actions" }, urdd, text, urdf),
    verdict,
    hint,
    h("h3", {}, "For another program"),
    h(
      "div",
      { class: "actions" },
      h("label", { for: "save-format", class: "hint" }, "Format"),
      formats,
      actuators,
      other,
    ),
    notes,
    wrong,
    h(
      "div",
      { class: "actions" },
      button("Close", {}, () => element.close()),
    ),
  );
  const act = (job: () => Promise<void>): void => {
    wrong.textContent = "";
    for (const made of [urdd, text, urdf, other]) made.disabled = true;
    void job()
      .catch((error: unknown) => {
        wrong.textContent = message(error);
      })
      .finally(refresh);
  };
  const refresh = (): void => {
    const { open } = here;
    const { draft } = app.store.now;
    urdd.disabled = other.disabled = !open?.isWhole;
    text.hidden = !draft || draft.text === null;
    text.disabled = false;
    text.textContent = `Save ${name(draft?.path.split("/").pop() ?? "")}`;
    urdf.hidden = !draft || draft.format === "urdf";
    urdf.disabled = false;
    hint.textContent = open?.isWhole
      ? "A browser computes as the program does. Last digits may differ, within the tolerances of SPEC.md."
      : "The URDD, and files for other programs, can be saved when all of it is generated.";
  };
  const validate = async (): Promise<void> => {
    verdict.textContent = "";
    if (!here.open?.isWhole) return;
    verdict.textContent = "Validating the URDD…";
    const report = await app.engine.aside("validate", { name: here.open.entry.name });
    const errors = report.totals["error"] ?? 0;
    verdict.textContent =
      report.urdds[0]?.verdict === "pass" ? "The URDD passes." : `The URDD does not pass: ${errors} errors.`;
  };
  app.store.on(["making", "draft"], () => {
    if (element.open) refresh();
  });
  return {
    element,
    open: () => {
      wrong.textContent = "";
      fill(notes);
      refresh();
      element.showModal();
      void validate().catch((error: unknown) => {
        verdict.textContent = message(error);
      });
    },
  };
}
