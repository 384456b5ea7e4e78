/** Elements without HTML text: text from files stays text. */

export type Child = Node | string | number | null | undefined | false;

type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

function apply(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name, value as EventListener);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    element.append(child instanceof Node ? child : String(child));
  }
}

/** An HTML element. Attributes that are functions are event listeners. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  apply(element, attributes, children);
  return element;
}

/** A button: its label, its tooltip or attributes, and what a click does. */
export function button(
  label: Child | Child[],
  title: string | Attributes,
  click: (event: MouseEvent) => void,
): HTMLButtonElement {
  const attributes = typeof title === "string" ? { title } : title;
  return h("button", { type: "button", ...attributes, click }, ...(Array.isArray(label) ? label : [label]));
}

/** Text in which words between backticks are code, as nodes. */
export function prose(text: string): Node[] {
  return text
    .split("`")
    .map((part, k, all) => (k % 2 === 1 && k < all.length - 1 ? h("code", {}, part) : document.createTextNode(part)));
}

/** Number of characters at the end of a name that are always shown. */
const TAIL = 12;

/** A name that is truncated in its middle: names of one robot differ at their ends. */
export function cut(text: string): Node[] {
  const chars = Array.from(text);
  if (chars.length < 2 * TAIL) return [h("span", { class: "head" }, text)];
  return [
    h("span", { class: "head" }, chars.slice(0, -TAIL).join("")),
    h("span", { class: "tail" }, chars.slice(-TAIL).join("")),
  ];
}

/** Replaces the children of an element. */
export function fill(element: Element, ...children: Child[]): void {
  element.replaceChildren();
  apply(element, {}, children);
}

/** The element of this id in the page. */
export function byId(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no element ${id}`);
  return element;
}
