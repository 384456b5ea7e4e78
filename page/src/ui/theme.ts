/** The dark or light theme: that of the system, until the user chooses one. */

import { keep, kept } from "./storage";

const KEY = "urdd-theme";

export function startTheme(): void {
  const chosen = kept(KEY);
  if (chosen === "dark" || chosen === "light") document.documentElement.dataset["theme"] = chosen;
  matchMedia("(prefers-color-scheme: light)").addEventListener("change", announce);
}

function isLight(): boolean {
  const chosen = document.documentElement.dataset["theme"];
  return chosen ? chosen === "light" : matchMedia("(prefers-color-scheme: light)").matches;
}

export function toggleTheme(): void {
  const next = isLight() ? "dark" : "light";
  document.documentElement.dataset["theme"] = next;
  keep(KEY, next);
  announce();
}

function announce(): void {
  dispatchEvent(new Event("urdd-theme"));
}

/** A colour of the style sheet. */
export function color(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
