/** All robots of the site, with search; and where a folder or a zip is dropped. */

import type { App } from "../app";
import type { Entry } from "../model";
import { fill, h } from "../ui/dom";
import { count, name } from "../ui/format";

export function gallery(
  app: App,
  open: (entry: Entry) => void,
  choose: (files: FileList | null, folder: boolean) => void,
): HTMLElement {
  const search = h("input", { type: "search", placeholder: "Find a robot", "aria-label": "Find a robot" });
  const list = h("div", { class: "cards" });
  const picker = (folder: boolean, text: string): HTMLElement => {
    const input = h("input", {
      type: "file",
      hidden: true,
      accept: folder ? null : ".zip,.urdf",
      webkitdirectory: folder,
    });
    input.addEventListener("change", () => {
      choose(input.files, folder);
      input.value = "";
    });
    return h(
      "span",
      {},
      h(
        "button",
        {
          type: "button",
          click: () => {
            input.click();
          },
        },
        text,
      ),
      input,
    );
  };
  const panel = h(
    "section",
    { class: "gallery", "aria-label": "Robots" },
    h("h2", {}, "Robots"),
    search,
    list,
    h(
      "div",
      { class: "drop" },
      h("p", {}, "Drop the folder of a URDD here, or a .zip of it, to see and validate it."),
      h("div", { class: "actions" }, picker(true, "Choose a folder"), picker(false, "Choose a .zip")),
      h("p", { class: "hint" }, "It is read in this browser. Nothing is uploaded."),
    ),
  );
  const render = (): void => {
    const words = search.value.trim().toLowerCase();
    const { entries } = app.store.now;
    const found = entries.filter(
      (entry) => words === "" || entry.name.toLowerCase().includes(words) || entry.id.toLowerCase().includes(words),
    );
    search.hidden = entries.length < 2;
    fill(
      list,
      ...found.map((entry) => card(entry, open)),
      found.length === 0 && entries.length > 0 && h("p", { class: "empty" }, "No robot of this name."),
    );
  };
  search.addEventListener("input", render);
  app.store.on(["entries"], render);
  app.store.on(["robot", "loading", "failure"], ({ robot, loading, failure }) => {
    panel.hidden = robot !== null || loading !== null || failure !== null;
  });
  return panel;
}

function card(entry: Entry, open: (entry: Entry) => void): HTMLElement {
  const size = [
    entry.links === null ? null : count(entry.links, "link"),
    entry.dofs === null ? null : count(entry.dofs, "DOF"),
  ]
    .filter(Boolean)
    .join(" · ");
  return h(
    "button",
    {
      type: "button",
      class: "card",
      click: () => {
        open(entry);
      },
    },
    entry.picture
      ? h("img", { src: entry.picture, alt: "", loading: "lazy" })
      : h("span", { class: "no-picture" }, name(entry.name).slice(0, 2)),
    h("strong", {}, name(entry.name)),
    h("span", { class: "hint" }, size || name(entry.id)),
    entry.verdict && h("span", { class: `verdict ${entry.verdict}` }, entry.verdict),
  );
}
