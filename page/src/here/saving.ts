/** A dialog that saves what this page made, by workers of their own: the URDD, the text, files for other programs. */

import type { Format } from "../../../wasm/npm/index";
import type { App } from "../app";
import type { Given } from "../drop";
import { fileName } from "../fixes";
import { saveDraft } from "../panels/text";
import { button, fill, h } from "../ui/dom";
import { offer } from "../ui/files";
import { message, name } from "../ui/format";
import type { Here } from "./here";
import type { Actuators, MadeRobot } from "./made";

/** Kinds of actuators, by MuJoCo's words. */
const ACTUATORS: readonly Actuators[] = ["position", "velocity", "motor"];

interface About {
  title: string;
  /** What the file's name ends with; a folder has none. */
  ending: string;
  /** Whether actuators can be chosen. */
  hasActuators?: boolean;
}

/** Each format of other programs, as on the command line, in the order of the menu. */
const FORMATS: Record<Format, About> = {
  mjcf: { title: "MuJoCo (MJCF)", ending: ".xml", hasActuators: true },
  usd: { title: "Newton, Isaac, Omniverse (USD)", ending: ".usda", hasActuators: true },
  sdf: { title: "Gazebo (SDF)", ending: ".sdf" },
  drake: { title: "Drake (URDF)", ending: ".urdf" },
  moveit: { title: "MoveIt (package)", ending: "" },
  srdf: { title: "Pairs of links (SRDF)", ending: ".srdf" },
  urdf: { title: "URDF with our collision shapes", ending: ".urdf" },
  "urdf-plus": { title: "URDF with loops (URDF+)", ending: ".urdf" },
  "extended-urdf": { title: "URDF with loops (Extended URDF)", ending: ".urdf" },
  curobo: { title: "cuRobo (YAML)", ending: ".yml" },
  foam: { title: "Foam (JSON of spheres)", ending: ".json" },
  spherized: { title: "URDF with spheres", ending: ".urdf" },
};

export function savingHere(app: App, here: Here): { element: HTMLDialogElement; open: () => void } {
  const wrong = h("p", { class: "bad", role: "alert" });
  const notes = h("ul", { class: "notes" });
  const verdict = h("p", { class: "hint", role: "status" });
  const hint = h("p", { class: "hint" });
  const formats = h(
    "select",
    { id: "save-format" },
    ...Object.entries(FORMATS).map(([word, { title }]) => h("option", { value: word }, title)),
  );
  const actuators = h(
    "select",
    { "aria-label": "Actuators" },
    h("option", { value: "" }, "without actuators"),
    ...ACTUATORS.map((kind) => h("option", { value: kind }, `with ${kind} actuators`)),
  );
  const choose = (): void => {
    actuators.hidden = !FORMATS[formats.value as Format].hasActuators;
  };
  formats.addEventListener("change", choose);
  choose();
  const urdd = button("Save the URDD", { class: "main" }, () => act(() => saveUrdd(app, here)));
  const text = button("", {}, () =>
    act(() => {
      saveDraft(app);
      return Promise.resolve();
    }),
  );
  const urdf = button("Save as URDF, with meshes", {}, () => act(() => saveUrdf(here)));
  const other = button("Save", {}, () =>
    act(async () => {
      const made = await saveExport(here, formats.value as Format, actuators.value);
      fill(notes, ...made.map((note) => h("li", {}, name(note))));
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
    text.textContent = `Save ${name(draft ? fileName(draft) : "")}`;
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

/** The robot that is open. */
function opened(here: Here): MadeRobot {
  if (!here.open) throw new Error("No robot is open.");
  return here.open;
}

/** The URDD as a .zip, with the decisions on skips that are not saved yet. */
async function saveUrdd(app: App, here: Here): Promise<void> {
  const { skips } = app.store.now;
  const robot = opened(here);
  const { name } = robot.entry;
  const edited = skips.dirty ? (skips.answer?.files ?? []) : [];
  const texts = new Map(edited.map(({ path, text }) => [path, new Blob([text])]));
  const files = robot.files.map(({ path, file }) => ({ path: `${name}/${path}`, file: texts.get(path) ?? file }));
  offer(await zipped(here, files), `${name}_urdd.zip`);
  robot.isSaved = true;
  app.store.set({ skips: { ...app.store.now.skips, dirty: false } });
}

/** The URDF, with meshes, that an MJCF, SDF or USD becomes. */
async function saveUrdf(here: Here): Promise<void> {
  const robot = opened(here);
  const maker = await robot.reader.worker();
  try {
    const files = await maker.ask("import", { path: robot.description.path });
    await offerAll(here, files, `${robot.entry.name}_urdf`);
  } finally {
    maker.end();
  }
}

/** Files for another program. Returns what is otherwise there. */
async function saveExport(here: Here, format: Format, kind: string): Promise<string[]> {
  const robot = opened(here);
  const { name } = robot.entry;
  const { ending, hasActuators = false } = FORMATS[format];
  const output = (name.replace(/[^\p{L}\p{N}_-]+/gu, "_") || "robot") + ending;
  const actuators = (hasActuators && ACTUATORS.find((one) => one === kind)) || null;
  const ask = { urdd: robot.files, format, output, actuators };
  const made = await here.kit.once((maker) => maker.ask("export", ask));
  await offerAll(here, made.files, `${name}_${format}`);
  return made.notes;
}

/** One file as it is, several as a .zip. The names of two formats differ. */
async function offerAll(here: Here, files: Given[], name: string): Promise<void> {
  const [one, ...more] = files;
  if (one && more.length === 0) offer(one.file, name + (/\.[^./]+$/.exec(one.path)?.[0] ?? ""));
  else offer(await zipped(here, files), `${name}.zip`);
}

function zipped(here: Here, files: Given[]): Promise<Blob> {
  return here.kit.once((maker) => maker.ask("zip", { files }));
}
