/** Dark or light: as the system has it, until the person chooses. */

const KEY = "urdd-theme";

export function startTheme(): void {
  const chosen = localStorage.getItem(KEY);
  if (chosen === "dark" || chosen === "light") document.documentElement.dataset["theme"] = chosen;
  matchMedia("(prefers-color-scheme: light)").addEventListener("change", tell);
}

export function isLight(): boolean {
  const chosen = document.documentElement.dataset["theme"];
  return chosen ? chosen === "light" : matchMedia("(prefers-color-scheme: light)").matches;
}

export function toggleTheme(): void {
  const next = isLight() ? "dark" : "light";
  document.documentElement.dataset["theme"] = next;
  localStorage.setItem(KEY, next);
  tell();
}

function tell(): void {
  dispatchEvent(new Event("urdd-theme"));
}

/** A colour of the style sheet. */
export function color(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
