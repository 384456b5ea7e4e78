/** The list of missing meshes, and of what is drawn instead. */

import type { App } from "../app";
import { drawnInstead, packagesOf } from "../missing";
import { button, fill, h, prose } from "../ui/dom";
import { picker } from "../ui/files";
import { count, name } from "../ui/format";

/** Maximum number of meshes that are named. */
const MAX_NAMED = 40;

/** Asks for the files that the open robot lacks, or that a robot cannot be made without. */
export function missingFiles(app: App, isDrawn: boolean): HTMLElement {
  const add = (files: File[]): void =>
    app.site.here?.add(files.map((file) => ({ path: file.webkitRelativePath || file.name, file })));
  const text = h("p", {});
  app.store.on(["robot", "absent", "wanted"], ({ robot, absent, wanted }) => {
    const names = [...absent.map(({ filename }) => filename), ...wanted];
    fill(text, ...(isDrawn === (robot !== null) ? prose(words(names)) : []));
  });
  return h(
    "div",
    { class: "wanted" },
    text,
    h("div", { class: "actions" }, picker("Choose a folder", true, add), picker("Choose files", false, add)),
  );
}

export function absent(app: App): HTMLElement {
  const title = h("summary", {});
  const list = h("ul", {});
  const more = h("p", { class: "hint" });
  const ask = missingFiles(app, true);
  const away = button("✕", { class: "tiny", "aria-label": "Close the list of missing meshes" }, () => {
    element.hidden = true;
  });
  const details = h("details", {}, title, list, more);
  const element = h("div", { class: "absent", role: "status", hidden: true }, h("div", {}, details, ask), away);
  app.store.on(["robot", "absent", "wanted"], ({ robot, absent, wanted }) => {
    element.hidden = !robot || absent.length + wanted.length === 0;
    if (!robot || element.hidden) return;
    ask.hidden = !robot.entry.here;
    if (absent.length === 0) {
      fill(title, `${count(wanted.length, "file was", "files were")} not found`);
      fill(list, ...wanted.slice(0, MAX_NAMED).map((file) => h("li", {}, h("code", {}, name(file)))));
      fill(more, wanted.length > MAX_NAMED ? `and ${wanted.length - MAX_NAMED} more` : "");
      return;
    }
    const links = new Set(absent.map(({ link }) => link));
    fill(title, `${count(absent.length, "mesh was", "meshes were")} not found, of ${count(links.size, "link")}`);
    fill(
      list,
      ...absent.slice(0, MAX_NAMED).map((mesh) => {
        const link = button(name(robot.nameOf(mesh.link)), { class: "place" }, () =>
          app.select({ kind: "link", index: mesh.link }),
        );
        return h(
          "li",
          {},
          link,
          ": ",
          h("code", {}, name(mesh.filename)),
          h("span", {}, `; ${drawnInstead(robot, mesh)}`),
        );
      }),
    );
    more.textContent = absent.length > MAX_NAMED ? `and ${absent.length - MAX_NAMED} more` : "";
  });
  return element;
}

/** Maximum number of files that are named where they are asked for. */
const MAX_ASKED = 5;

function words(names: string[]): string {
  const packages = packagesOf(names);
  if (packages.length === 0) {
    const files = [...new Set(names.map((path) => path.split(/[\\/]/).pop() ?? path))];
    const shown = files.slice(0, MAX_ASKED).map((file) => `\`${name(file)}\``);
    const rest = files.length > shown.length ? ` and ${files.length - shown.length} more` : "";
    return `Drop the missing files here, or choose them: ${shown.join(", ")}${rest}.`;
  }
  const named = packages.map((one) => `\`${name(one)}\``).join(", ");
  return `Drop the folder of ${named} here, or choose it.`;
}

/** The short form in the header. */
export function absentChip(app: App, n: number): Node | null {
  if (n === 0) return null;
  const title = "Which meshes, and what is drawn instead";
  return button(`${count(n, "mesh", "meshes")} not found`, { class: "chip warning", title }, () => {
    for (const box of document.querySelectorAll<HTMLElement>(".absent")) {
      box.hidden = false;
      for (const details of box.querySelectorAll("details")) details.open = true;
    }
    app.showOnly("original");
  });
}
