/** What programs do with a URDF: a chip for each, or for a family whose versions do the same; a click says what it is. */

import type { App } from "../app";
import type { Deed, ProgramEffect, ProgramResult, UrddReport } from "../engine/protocol";
import type { Place } from "../findings";
import { button, fill, h, prose } from "../ui/dom";
import { count, name } from "../ui/format";
import { folded } from "../ui/opened";
import { placeList } from "./places";

/** The look of a chip, its sign, and the words behind its name. */
const LOOKS: Record<Deed | "loads", [look: string, sign: string, words: string]> = {
  loads: ["good", "✓", "loads it"],
  reads: ["warning", "≠", "loads it, and reads some of it otherwise"],
  drops: ["warning", "−", "loads it without some of it"],
  refuses: ["error", "✕", "refuses it"],
  crashes: ["error", "✕", "crashes on it"],
};
export const DEEDS: Record<Deed, string> = {
  reads: "reads it otherwise",
  drops: "leaves it out",
  refuses: "refuses the robot",
  crashes: "crashes",
};

/** Programs that do the same. */
interface Group {
  title: string;
  programs: [ProgramResult, ...ProgramResult[]];
}

/** Its element, and what shows another report, or none. */
export function programs(app: App): { element: HTMLElement; show: (urdd: UrddReport | undefined) => void } {
  const chips = h("div", { class: "actions", role: "group", "aria-label": "What programs do with this URDF" });
  const details = h("section", { id: "program", class: "program", hidden: true });
  const element = h("div", { class: "programs", hidden: true }, chips, details);
  let open: string | null = null;
  let urdd: UrddReport | undefined;
  const render = (): void => {
    const groups = grouped(urdd?.programs ?? []);
    const focused = document.activeElement?.getAttribute("data-program");
    element.hidden = groups.length === 0;
    const made = groups.map(({ title, programs: [program] }) => {
      const [look, sign, words] = LOOKS[program.does ?? "loads"];
      const click = (): void => {
        open = open === title ? null : title;
        render();
      };
      const attributes = {
        class: `chip ${look}`,
        title: `${title} ${words}`,
        "data-program": title,
        "aria-label": `${title} ${words}`,
        "aria-expanded": String(open === title),
        "aria-controls": details.id,
      };
      return button([h("span", { class: "sign" }, sign), ` ${title}`], attributes, click);
    });
    const chosen = made.filter((_, k) => groups[k]?.programs[0].is_chosen);
    const others = made.filter((_, k) => !groups[k]?.programs[0].is_chosen);
    const isSplit = chosen.length > 0 && others.length > 0;
    fill(chips, ...chosen, isSplit && h("span", { class: "hint" }, "others:"), ...others);
    made.find((chip) => chip.dataset["program"] === focused)?.focus();
    const shown = groups.find(({ title }) => title === open);
    details.hidden = shown === undefined;
    fill(details, ...(urdd && shown ? described(app, urdd, shown) : []));
  };
  const show = (next: UrddReport | undefined): void => {
    urdd = next;
    render();
  };
  return { element, show };
}

/** Programs of a family that do the same, in the order of the report. */
function grouped(all: readonly ProgramResult[]): Group[] {
  const groups = new Map<string, Group["programs"]>();
  for (const program of all) {
    const { family, is_chosen, does, effects } = program;
    const key = JSON.stringify([family, is_chosen, does, effects]);
    const group = groups.get(key);
    if (group) group.push(program);
    else groups.set(key, [program]);
  }
  return [...groups.values()].map((programs) => {
    const [{ family }] = programs;
    const isAll = all.filter((program) => program.family === family).length === programs.length;
    return { programs, title: isAll ? family : programs.map(({ name }) => name).join(", ") };
  });
}

function described(app: App, urdd: UrddReport, { title, programs }: Group): Node[] {
  const [{ does, effects, effects_cut: cut }] = programs;
  const usual = effects.filter(({ is_usual }) => is_usual);
  const versions = programs.map(({ name, version }) =>
    programs.length > 1 ? `${name} ${version}` : `version ${version}`,
  );
  return [
    h("h2", {}, `${title} ${LOOKS[does ?? "loads"][2]}`),
    h("p", { class: "hint" }, `As of ${versions.join(", ")}.`),
    ...kinds(
      app,
      title,
      urdd,
      effects.filter(({ is_usual }) => !is_usual),
    ),
    ...(usual.length > 0
      ? [
          folded(
            app.store.now.opened,
            `${title}\nusual`,
            { class: "usual" },
            `Usual, with any robot, or because of another fault: ${count(usual.length, "place")}`,
            ...kinds(app, title, urdd, usual),
          ),
        ]
      : []),
    ...(cut > 0
      ? [h("p", { class: "hint" }, `${count(cut, "effect")} more ${cut === 1 ? "is" : "are"} not in the report`)]
      : []),
    ...(effects.length === 0 ? [h("p", {}, "It reads all as it is written.")] : []),
  ];
}

/** Effects of one kind together, with their places. */
function kinds(app: App, title: string, urdd: UrddReport, effects: readonly ProgramEffect[]): Node[] {
  const found = new Map<string, ProgramEffect[]>();
  for (const effect of effects) {
    const key = JSON.stringify([effect.does, effect.reason, effect.makes]);
    found.set(key, [...(found.get(key) ?? []), effect]);
  }
  return [...found.values()].flatMap((alike) => {
    const [first] = alike;
    if (!first) return [];
    const { does, reason, makes } = first;
    const words = makes === null ? DEEDS[does] : `reads ${makes}`;
    return [
      h("p", {}, ...prose(name(`${words}: ${reason}`))),
      placeList(
        app,
        [title, words, reason].join("\n"),
        alike.map((effect) => place(urdd, effect)),
        alike.length,
      ),
    ];
  });
}

function place(urdd: UrddReport, { part, line, column }: ProgramEffect): Place {
  const rest = { pointer: null, expected: null, actual: null, message: null, related: [] };
  return { file: urdd.path, line, column, subject: part === null ? null : subject(part), ...rest };
}

/** A part by its name: `joint/elbow/limit` is "joint `elbow`: limit". */
function subject(part: string): string {
  const [, kind, of, what] = /^(link|joint|material)\/(.+?)(?:\/([a-z_]+|\?)(?:\/.*)?)?$/.exec(part) ?? [];
  if (kind === undefined || of === undefined) return part;
  const inside = what === undefined || what === "?" ? "" : `: ${what.replaceAll("_", " ")}`;
  return `${kind} \`${of}\`${inside}`;
}
