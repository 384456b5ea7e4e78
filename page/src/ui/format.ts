/** Numbers for people: each with its unit. */

const MINUS = "−";

function signed(text: string): string {
  return text.startsWith("-") ? MINUS + text.slice(1) : text;
}

/** A number of so many significant digits at most, without an exponent where that is readable. */
export function number(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "not a number" : value > 0 ? "∞" : MINUS + "∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return signed(value.toExponential(Math.max(0, digits - 1)));
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const text = value.toFixed(Math.min(decimals, 8));
  const short = text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  return signed(short === "-0" ? "0" : short);
}

/** A length in metres, as mm or m. */
export function length(metres: number, digits = 3): string {
  if (metres === 0) return "0 mm";
  const size = Math.abs(metres);
  if (size < 1e-6) return "< 0.001 mm";
  return size < 1 ? `${number(metres * 1000, digits)} mm` : `${number(metres, digits)} m`;
}

export function degrees(radians: number): number {
  return (radians * 180) / Math.PI;
}

export function radians(degrees: number): number {
  return (degrees * Math.PI) / 180;
}

/** The value of a DOF: degrees or mm. */
export function dofValue(value: number, unit: Unit): string {
  return unit === "rad" ? `${number(round(degrees(value), 1), 4)}°` : `${number(round(value * 1000, 2), 5)} mm`;
}

export type Unit = "rad" | "m";

/** What a person types for a DOF, and its unit. */
export function shownUnit(unit: Unit): string {
  return unit === "rad" ? "°" : "mm";
}

export function toShown(value: number, unit: Unit): number {
  return unit === "rad" ? degrees(value) : value * 1000;
}

export function fromShown(value: number, unit: Unit): number {
  return unit === "rad" ? radians(value) : value / 1000;
}

export function round(value: number, decimals: number): number {
  const factor = 10 ** decimals;
  return Math.round(value * factor) / factor + 0;
}

export function percent(share: number): string {
  return `${number(share * 100, share < 10 ? 2 : 3)} %`;
}

export function count(n: number, one: string, many = `${one}s`): string {
  return `${n.toLocaleString("en")} ${n === 1 ? one : many}`;
}

export function bytes(n: number): string {
  if (n < 1000) return `${n} B`;
  const units = ["kB", "MB", "GB"];
  let value = n / 1000;
  let unit = 0;
  while (value >= 1000 && unit < units.length - 1) {
    value /= 1000;
    unit++;
  }
  return `${number(value)} ${units[unit] ?? ""}`;
}

/** A name from a file on one line: what cannot be seen, or turns the direction of text, is shown as its code. */
export function name(text: string): string {
  let shown = "";
  for (const char of text) {
    const code = char.codePointAt(0) ?? 0;
    const hidden =
      code < 0x20 ||
      (code >= 0x7f && code < 0xa0) ||
      code === 0xad ||
      (code >= 0x200b && code <= 0x200f) ||
      (code >= 0x2028 && code <= 0x202e) ||
      (code >= 0x2060 && code <= 0x206f) ||
      code === 0xfeff ||
      code === 0x61c;
    shown += hidden ? `\\u{${code.toString(16)}}` : char;
  }
  return shown;
}
