/** Each movable joint with a slider, a number and limits; and actions on the whole configuration, such as saving it with a name. */

import type { App } from "../app";
import type { NamedConfiguration } from "../document";
import type { RobotModel } from "../model";
import { Sweep } from "../sweep";
import { button, cut, fill, h } from "../ui/dom";
import {
  message,
  count,
  dofValue,
  entry as typed,
  fineStep,
  fromShown,
  name,
  number,
  shownUnit,
  UNIT_NAMES,
} from "../ui/format";
import { loops } from "./loops";

interface Control {
  dof: number;
  slider: HTMLInputElement;
  entry: HTMLInputElement;
  row: HTMLElement;
}

/** Bounds of a slider whose DOF has none. */
const OPEN = { rad: Math.PI, m: 1 };

export function joints(app: App): HTMLElement {
  const sweeps = new Sweep(app);
  const list = h("div", { class: "joints" });
  const sample = h("p", { class: "sample", "aria-live": "polite" });
  let controls: Control[] = [];
  let drawn = 0;

  const at = (key: "zero" | "middle") => () => {
    const q = app.store.now.robot?.about[key];
    if (q) app.move(q);
  };
  const play = button("Play samples", "Show the stored samples in turn (space)", () =>
    dispatchEvent(new Event("urdd-samples")),
  );
  const step = (by: "back" | "forth", text: string, title: string): HTMLButtonElement => {
    const made = button(text, title, () => {
      app.step(by);
    });
    made.setAttribute("aria-label", title);
    return made;
  };
  const undo = step("back", "↶", "Undo the last move (Ctrl-Z)");
  const redo = step("forth", "↷", "Redo the move (Ctrl-Shift-Z)");
  const actions = h(
    "div",
    { class: "actions" },
    button("Zero", "Every DOF at 0, or at the bound nearest to 0", at("zero")),
    button("Middle", "Every DOF half-way between its bounds", at("middle")),
    button("Random", "A random configuration within the bounds (R)", () => void random(app, drawn++)),
    button("Copy", "Copy the configuration as a list of numbers, rad and m", () => void copy(app)),
    button("Paste", "Paste a list of numbers, rad and m", () => void paste(app)),
    play,
    button("Trajectory…", "Play configurations from a file: CSV, or JSON lines; or drop it on the picture", () =>
      dispatchEvent(new Event("urdd-trajectory")),
    ),
    h("span", { class: "spring" }),
    undo,
    redo,
  );
  const named = h("div", {
    class: "actions",
    id: "named-configurations",
    role: "group",
    "aria-label": "Named configurations",
  });
  const empty = h("p", { class: "empty" });
  const panel = h("div", { class: "panel" }, actions, named, naming(app), loops(app), sample, list, empty);

  const group = (robot: RobotModel, joint: number): HTMLElement => {
    const found = robot.joints[joint];
    const dofs = found?.dofs ?? [];
    const followers = robot.joints.flatMap((other) =>
      other.mimic && dofs.includes(other.mimic.dof ?? -1) ? [other] : [],
    );
    const [first] = dofs;
    const follows = (dof: number): boolean => robot.follows(dof);
    const sweep =
      dofs.length === 1
        ? button(
            "↔",
            {
              class: "tiny",
              title: "Sweep this joint through its limits",
              "aria-label": `Sweep ${name(found?.name ?? "")}`,
            },
            () => {
              if (first !== undefined) sweeps.toggle(first);
            },
          )
        : null;
    const heading = h(
      "div",
      { class: "heading" },
      h("span", { class: "name cut", title: name(found?.name ?? "") }, ...cut(name(found?.name ?? ""))),
      h(
        "span",
        { class: "kind" },
        (found?.type ?? "").toLowerCase() + (dofs.every(follows) && first !== undefined ? " · follows" : ""),
      ),
      sweep,
    );
    heading.addEventListener("click", () => app.select({ kind: "joint", index: joint }));
    const block = h(
      "div",
      { class: "joint", id: `joint-${joint}` },
      heading,
      ...dofs.map((dof) => control(robot, dof, dofs.length > 1)),
    );
    for (const other of followers) {
      block.append(
        h(
          "div",
          { class: "mimic" },
          `⇄ ${name(other.name)} = ${number(other.mimic?.multiplier ?? 1)} × this${other.mimic?.offset ? ` + ${dofValue(other.mimic.offset, other.type === "Prismatic" ? "m" : "rad")}` : ""}`,
        ),
      );
    }
    block.addEventListener("pointerenter", () => app.hover({ kind: "joint", index: joint }));
    block.addEventListener("pointerleave", () => app.hover(null));
    return block;
  };

  const control = (robot: RobotModel, dof: number, named: boolean): HTMLElement => {
    const found = robot.dofs[dof];
    const unit = found?.unit ?? "rad";
    const [lower, upper] = found?.bounds ?? [-OPEN[unit], OPEN[unit]];
    const label = name(found?.name ?? "");
    const slider = h("input", {
      type: "range",
      min: lower,
      max: upper,
      step: "any",
      "aria-label": label,
      title: "Arrow keys: fine steps. Shift-drag: ten times finer",
      value: 0,
    });
    refine(slider, () => fineStep(unit));
    const entry = h("input", {
      type: "number",
      step: "any",
      "aria-label": `${label}, ${UNIT_NAMES[shownUnit(unit)]}`,
    });
    const row = h(
      "div",
      { class: "dof" },
      named && h("span", { class: "axis" }, label.split("/").pop() ?? ""),
      slider,
      h("label", { class: "number" }, entry, h("span", {}, shownUnit(unit))),
      h("span", { class: "limit low" }, dofValue(lower, unit)),
      h("span", { class: "limit high" }, dofValue(upper, unit)),
    );
    slider.addEventListener("input", () => {
      void app.setDof(dof, Number(slider.value));
    });
    slider.addEventListener("dblclick", () => void app.setDof(dof, robot.start?.[dof] ?? 0));
    entry.addEventListener("change", () => {
      const value = fromShown(Number(entry.value), unit);
      if (entry.value !== "" && Number.isFinite(value)) void app.setDof(dof, value);
    });
    controls.push({ dof, slider, entry, row });
    return row;
  };

  app.store.on(["robot", "units"], ({ robot }) => {
    controls = [];
    const moving = robot?.joints.flatMap((joint, index) => ((joint.dofs?.length ?? 0) > 0 ? [index] : [])) ?? [];
    fill(list, ...(robot ? moving.map((joint) => group(robot, joint)) : []));
    actions.hidden = !robot?.moves;
    named.hidden = !robot?.moves || robot.named.length === 0;
    const preset = ({ name: shown, q }: NamedConfiguration): HTMLButtonElement =>
      button(name(shown), "A named configuration of this URDD", () => {
        app.move(q);
      });
    fill(named, ...(robot?.named ?? []).map(preset));
    play.hidden = !robot?.files.some(({ path }) => path === "kinematics_samples_module/module.json");
    empty.hidden = moving.length > 0;
    empty.textContent = !robot
      ? ""
      : robot.moves
        ? "This robot has no movable joints."
        : `The joints cannot be moved: ${robot.about.faults[0]?.reason ?? "chain_module or dof_module is missing"}.`;
  });
  app.store.on(["robot", "q", "units"], ({ robot, q }) => {
    for (const { dof, slider, entry, row } of controls) {
      const value = q[dof] ?? 0;
      const unit = robot?.dofs[dof]?.unit ?? "rad";
      const bounds = robot?.dofs[dof]?.is_limited === false ? null : robot?.dofs[dof]?.bounds;
      if (Number(slider.value) !== value) slider.value = String(value);
      const text = typed(value, unit);
      if (document.activeElement !== entry && entry.value !== text) entry.value = text;
      row.classList.toggle("beyond", bounds ? value < bounds[0] - 1e-9 || value > bounds[1] + 1e-9 : false);
    }
  });
  app.store.on(["selected"], ({ robot, selected }) => {
    const joint = selected?.kind === "joint" ? selected.index : selected && robot ? robot.moving(selected.index) : null;
    for (const block of list.querySelectorAll(".joint")) {
      const is = joint !== null && block.id === `joint-${joint}`;
      block.classList.toggle("selected", is);
      if (is) block.scrollIntoView({ block: "nearest" });
    }
  });
  app.store.on(["sample"], ({ sample: shown }) => {
    sample.hidden = !shown;
    if (shown) {
      const error = (value: number, unit: string): string =>
        `${value === 0 ? "0" : value.toExponential(1).replace("-", "−")} ${unit}`;
      sample.textContent = `Sample ${shown.at + 1} of ${shown.of}: poses differ by at most ${error(shown.position, "m")} and ${error(shown.angle, "rad")}`;
      sample.classList.toggle("bad", shown.position > 1e-6 || shown.angle > 1e-6);
    }
  });
  addEventListener("urdd-random", () => void random(app, drawn++));
  return panel;
}

async function random(app: App, k: number): Promise<void> {
  if (!app.store.now.robot?.moves) return;
  try {
    await app.reach(await app.engine.ask("random", { k }));
  } catch (error) {
    app.note(message(error));
  }
}

async function copy(app: App): Promise<void> {
  try {
    await navigator.clipboard.writeText(JSON.stringify(app.store.now.q));
    app.note(`Copied ${count(app.store.now.q.length, "value")}, rad and m`);
  } catch (error) {
    app.note(`The configuration cannot be copied: ${message(error)}`);
  }
}

async function paste(app: App): Promise<void> {
  try {
    const text = await navigator.clipboard.readText();
    const values = text
      .replace(/[[\]]/g, " ")
      .split(/[\s,;]+/)
      .filter(Boolean)
      .map(Number);
    const wanted = app.store.now.robot?.dofs.length ?? 0;
    if (values.length !== wanted || !values.every(Number.isFinite)) {
      throw new Error(`expected ${count(wanted, "number")} in the clipboard`);
    }
    app.move(values);
  } catch (error) {
    app.note(`Nothing was pasted: ${message(error)}`);
  }
}

/** Saves the pose that is shown as a named configuration of the URDD. */
function naming(app: App): HTMLElement {
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
  await app.write(async ({ entry }, revision) => {
    const { q, skips } = app.store.now;
    const path = `robots/${encodeURIComponent(entry.id)}/configurations`;
    await app.site.post(path, { name: shown, configuration: q, replace, revision });
    // Saves of skips cannot be undone past this one.
    app.store.set({ skips: { ...skips, saved: 0 } });
    return null;
  });
  return shown;
}

/** Number of steps for a page key, or for an arrow key with Shift. */
const LARGE = 10;
/** How much slower the pointer is with Shift. */
const SLOW = 10;

/** Adds keys and a slow pointer to a slider without steps. `step` is called for each key. */
function refine(slider: HTMLInputElement, step: () => number): void {
  const put = (value: number): void => {
    slider.value = String(Math.min(Number(slider.max), Math.max(Number(slider.min), value)));
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  };
  slider.addEventListener("keydown", (event) => {
    const steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: LARGE, PageDown: -LARGE }[
      event.key
    ];
    if (steps === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    put(Number(slider.value) + steps * (event.shiftKey ? LARGE : 1) * step());
  });
  let from: { x: number; value: number } | null = null;
  slider.addEventListener("pointerdown", (event) => {
    if (!event.shiftKey || event.button !== 0) return;
    event.preventDefault();
    slider.focus();
    slider.setPointerCapture(event.pointerId);
    from = { x: event.clientX, value: Number(slider.value) };
  });
  slider.addEventListener("pointermove", (event) => {
    if (!from) return;
    const range = Number(slider.max) - Number(slider.min);
    put(from.value + ((event.clientX - from.x) * range) / slider.clientWidth / SLOW);
  });
  for (const end of ["pointerup", "pointercancel"])
    slider.addEventListener(end, () => {
      from = null;
    });
}
