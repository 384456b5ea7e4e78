/** The dark or light theme: that of the system, until the user chooses one. */

const KEY = "urdd-theme";

/** The last choice. A sandboxed frame, as in a notebook, has no storage: access throws. */
function remembered(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function remember(theme: string): void {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // It lasts until the page is closed.
  }
}

export function startTheme(): void {
  const chosen = remembered();
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
  remember(next);
  announce();
}

function announce(): void {
  dispatchEvent(new Event("urdd-theme"));
}

/** A colour of the style sheet. */
export function color(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
