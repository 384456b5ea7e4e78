/** Layers with their opacity, overlays, and the visible links. */

import type { App } from "../app";
import { partColor } from "../document";
import type { RobotPart, SphereLevel } from "../document";
import type { AbsentMesh } from "../missing";
import type { RobotModel } from "../model";
import { LAYERS, LAYER_HINTS, LAYER_NAMES, OVERLAYS, OVERLAY_NAMES, sphereLevel } from "../state";
import type { LayerKind } from "../state";
import { button, cut, fill, h } from "../ui/dom";
import { count, length, name } from "../ui/format";

/** Maximum number of links that a message names. */
const NAMED = 6;

export function shapes(app: App): HTMLElement {
  const layers = LAYERS.map((layer) => {
    const box = h("input", { type: "checkbox", id: `layer-${layer}` });
    const opacity = h("input", {
      type: "range",
      min: 0,
      max: 1,
      step: 0.01,
      "aria-label": `Opacity of ${LAYER_NAMES[layer]}`,
    });
    const faults = h("span", { class: "fault" });
    box.addEventListener("change", () => app.setLayer(layer, { on: box.checked }));
    opacity.addEventListener("input", () => app.setLayer(layer, { opacity: Number(opacity.value), on: true }));
    const label = h("label", { for: box.id, title: LAYER_HINTS[layer] }, LAYER_NAMES[layer]);
    const row = h("div", { class: "layer" }, box, label, opacity, faults);
    return { layer, box, label, opacity, faults, row };
  });
  const ofShapes = layers.filter(({ layer }) => sphereLevel(layer) === null);
  const ofSpheres = layers
    .filter(({ layer }) => sphereLevel(layer) !== null)
    .map(({ row, label }) => ({ row, label, about: h("p", { class: "hint level" }) }));
  const spheres = h(
    "div",
    { hidden: true },
    h("h2", {}, "Spheres of links"),
    h("p", { class: "hint" }, "Levels of link_shapes_spheres_module, from coarse to fine."),
    ...ofSpheres.flatMap(({ row, about }) => [row, about]),
  );
  app.store.on(["robot"], ({ robot }) => {
    const levels = robot?.spheres ?? [];
    spheres.hidden = levels.length === 0;
    ofSpheres.forEach(({ row, label, about }, number) => {
      const level = levels[number];
      row.hidden = about.hidden = !level;
      if (!level) return;
      label.textContent = `Level ${number}: ${level.spheres.length}`;
      label.title = rates(level);
      about.textContent = fit(level);
    });
  });
  const overlays = OVERLAYS.map((kind) => {
    const box = h("input", { type: "checkbox", id: `overlay-${kind}` });
    box.addEventListener("change", () =>
      app.store.set({ overlays: { ...app.store.now.overlays, [kind]: box.checked } }),
    );
    return { kind, box, row: h("div", { class: "check" }, box, h("label", { for: box.id }, OVERLAY_NAMES[kind])) };
  });
  app.store.on(["robot"], ({ robot }) => {
    for (const { kind, row } of overlays) row.hidden = kind === "loops" && !robot?.about.loops;
  });
  // A tenth of a millimetre to ten metres.
  const size = h("input", { type: "range", id: "frame-size", min: -4, max: 1, step: 0.01 });
  const sizeText = h("span", { class: "kind" });
  size.addEventListener("input", () => {
    const { overlays } = app.store.now;
    app.store.set({ frameSize: 10 ** Number(size.value), overlays: { ...overlays, frames: true } });
  });
  app.store.on(["frameSize", "units"], ({ frameSize }) => {
    size.value = String(Math.log10(frameSize ?? 0.1));
    sizeText.textContent = frameSize === null ? "by the robot's size" : length(frameSize);
  });
  const byPart = h("input", { type: "checkbox", id: "by-part" });
  byPart.addEventListener("change", () => app.store.set({ byPart: byPart.checked }));
  const partList = h("div", { class: "links" });
  const parts = h(
    "div",
    { hidden: true },
    h("h2", {}, "Parts"),
    h("div", { class: "check" }, byPart, h("label", { for: "by-part" }, "Colour links by part")),
    partList,
  );
  const links = h("div", { class: "links" });
  const all = (hide: boolean): void => app.hide(app.store.now.robot?.links.keys() ?? [], hide);
  const panel = h(
    "div",
    { class: "panel" },
    h("h2", {}, "Shapes"),
    h("p", { class: "hint" }, "Several at once, each with its opacity."),
    ...ofShapes.map(({ row }) => row),
    spheres,
    parts,
    h("h2", {}, "Overlays"),
    h("div", { class: "checks" }, ...overlays.map(({ row }) => row)),
    h("div", { class: "check size" }, h("label", { for: size.id }, "Size of frames"), size, sizeText),
    h(
      "div",
      { class: "headline" },
      h("h2", {}, "Links"),
      h("span", { class: "spring" }),
      button("All", { class: "tiny" }, () => all(false)),
      button("None", { class: "tiny" }, () => all(true)),
      button("Selected", { class: "tiny", title: "Only the selected link" }, () => {
        const { selected } = app.store.now;
        all(true);
        if (selected?.kind === "link") app.hide([selected.index], false);
      }),
    ),
    links,
  );
  let boxes: HTMLInputElement[] = [];
  app.store.on(["byPart"], ({ byPart: on }) => {
    byPart.checked = on;
  });
  app.store.on(["robot"], ({ robot }) => {
    boxes = [];
    parts.hidden = (robot?.parts.length ?? 0) === 0;
    fill(partList, ...(robot?.parts ?? []).map(partRow));
    fill(
      links,
      ...(robot?.links ?? []).map((link, index) => {
        const box = h("input", { type: "checkbox", id: `link-${index}` });
        box.addEventListener("change", () => app.hide([index], !box.checked));
        boxes.push(box);
        const has = robot?.about.meshes.plain?.[index]?.length ?? 0;
        const pieces = robot?.about.meshes.pieces?.[index]?.length ?? 0;
        const what = has === 0 && pieces === 0 ? "no geometry" : count(pieces, "piece");
        return h(
          "div",
          { class: "check wide" },
          box,
          h("label", { for: box.id, title: name(link.name), class: "cut" }, ...cut(name(link.name))),
          h("span", { class: "kind" }, what),
        );
      }),
    );
  });
  app.store.on(
    ["layers", "overlays", "hidden", "robot", "faults", "absent"],
    ({ layers: now, overlays: over, hidden, robot, faults, absent }) => {
      for (const { layer, box, opacity, faults: line, row } of layers) {
        box.checked = now[layer].on;
        row.classList.toggle("off", !now[layer].on);
        opacity.value = String(now[layer].opacity);
        const found = faults.get(layer) ?? [];
        line.textContent =
          found.length > 0
            ? found.length === 1
              ? name(found[0] ?? "")
              : `${found.length} meshes cannot be shown: ${name(found[0] ?? "")}`
            : "";
        const gone = robot ? notFound(robot, layer, absent) : "";
        if (gone !== "")
          line.textContent = [gone, layer === "original" ? line.textContent : ""].filter(Boolean).join(". ");
        line.hidden = line.textContent === "";
      }
      for (const { kind, box } of overlays) box.checked = over[kind];
      boxes.forEach((box, link) => {
        box.checked = !hidden.has(link);
      });
    },
  );
  return panel;
}

/** How the spheres of a level fit the links. */
function fit(level: SphereLevel): string {
  const far = length(level.standoff);
  if (level.covers) return `They cover the links, at most ${far} off.`;
  const from = level.isGiven ? "Given" : "Fitted";
  return `${from}: at most ${far} off, and links are at most ${length(level.uncovered)} outside.`;
}

/** How often a check by a level is right. */
function rates({ missed, colliding, wrong, free }: SphereLevel): string {
  return `Missed: ${missed} of ${colliding} collisions. Contacts that are none: in ${wrong} of ${free} free configurations.`;
}

/** The missing meshes of a layer. */
function notFound(robot: RobotModel, layer: LayerKind, absent: readonly AbsentMesh[]): string {
  const of = absent.filter(({ geometry }) =>
    geometry === "Visual" ? layer === "original" || layer === "plain" : layer === "collision",
  );
  if (of.length === 0) return "";
  const links = [...new Set(of.map(({ link }) => name(robot.nameOf(link))))];
  const rest = links.length > NAMED ? ` and ${links.length - NAMED} more` : "";
  return `${count(of.length, "mesh was", "meshes were")} not found: ${links.slice(0, NAMED).join(", ")}${rest}`;
}

function partRow(part: RobotPart, index: number): HTMLElement {
  const swatch = h("span", { class: "swatch" });
  swatch.style.background = partColor(index);
  return h(
    "div",
    { class: "check wide part" },
    swatch,
    h("span", { class: "cut", title: name(part.name) }, ...cut(name(part.id))),
    h("span", { class: "kind" }, count(part.links.length, "link")),
  );
}
