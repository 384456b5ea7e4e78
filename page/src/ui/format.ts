/** Readable numbers with units. */

import type { Unit, Loop, LoopErrors } from "../engine/protocol";
import { keep, kept } from "./storage";

const MINUS = "−";

function signed(text: string): string {
  return text.startsWith("-") ? MINUS + text.slice(1) : text;
}

/** A number with at most `digits` significant digits, without an exponent if that is readable. */
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

/** The units of all displayed lengths and angles. */
export interface Units {
  length: "mm" | "m";
  angle: "°" | "rad";
}

export const UNIT_NAMES = { mm: "millimetres", m: "metres", "°": "degrees", rad: "radians" } as const;

const KEY = "urdd-units";
const units: Units = { length: "mm", angle: "°" };

/** The last choice of units. */
export function keptUnits(): Units {
  const [length, angle] = (kept(KEY) ?? "").split(" ");
  if (length === "m") units.length = "m";
  if (angle === "rad") units.angle = "rad";
  return { ...units };
}

export function keepUnits({ length, angle }: Units): void {
  Object.assign(units, { length, angle });
  keep(KEY, `${length} ${angle}`);
}

/** A length in metres, in the displayed unit. */
export function length(metres: number, digits = 3): string {
  if (metres === 0) return `0 ${units.length}`;
  if (Math.abs(metres) < 1e-6) return units.length === "mm" ? "< 0.001 mm" : "< 0.000001 m";
  return units.length === "mm" ? `${plain(metres * 1000, digits)} mm` : `${plain(metres, digits)} m`;
}

/** As `number`, but millimetres of a large robot keep all their digits before the point. */
function plain(value: number, digits: number): string {
  return number(value, Math.max(digits, Math.floor(Math.log10(Math.abs(value))) + 1));
}

/** Several lengths in metres. */
export function lengths(values: readonly number[], digits = 4): string {
  return `${values.map((value) => number(toShown(value, "m"), digits)).join(", ")} ${units.length}`;
}

/** The value of a DOF. */
export function dofValue(value: number, unit: Unit): string {
  return `${entered(value, unit)}${shownUnit(unit) === "°" ? "°" : ` ${shownUnit(unit)}`}`;
}

/** The unit in which a DOF is displayed and entered. */
export function shownUnit(unit: Unit): keyof typeof UNIT_NAMES {
  return unit === "rad" ? units.angle : units.length;
}

/** The factor from the library's unit to the displayed one. */
function scale(unit: Unit): number {
  if (unit === "rad") return units.angle === "°" ? 180 / Math.PI : 1;
  return units.length === "mm" ? 1000 : 1;
}

function toShown(value: number, unit: Unit): number {
  return value * scale(unit);
}

export function fromShown(value: number, unit: Unit): number {
  return value / scale(unit);
}

/** Number of useful decimals: down to a hundredth of a degree or millimetre. */
const DECIMALS = { "°": 2, mm: 2, rad: 4, m: 5 } as const;

/** A value as a user would type it, without the unit. */
export function entry(value: number, unit: Unit): string {
  return String(round(toShown(value, unit), DECIMALS[shownUnit(unit)]));
}

function entered(value: number, unit: Unit): string {
  return signed(entry(value, unit));
}

/** The smallest step of a slider, in the library's unit: 0.1°, 0.1 mm, 0.001 rad. */
export function fineStep(unit: Unit): number {
  return unit === "m" ? 1e-4 : units.angle === "°" ? Math.PI / 1800 : 1e-3;
}

function round(value: number, decimals: number): number {
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

/** Maximum number of characters of a name that are shown; of longer ones, the beginning and the end. */
const MAX_SHOWN = 2000;

/** As `name`, for a text of several lines. */
export function lines(text: string): string {
  return text.split("\n").map(name).join("\n");
}

/** A name from a file on one line: invisible characters and marks of text direction are shown as their codes. */
export function name(text: string): string {
  if (text.length > MAX_SHOWN) {
    const half = MAX_SHOWN / 4;
    return `${name(text.slice(0, half))}… (${text.length.toLocaleString("en")} characters) …${name(text.slice(-half))}`;
  }
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

/** What rounding leaves, m and rad. */
const ROUNDING = 1e-8;

/** Null where the loop is closed. */
export function apart({ tolerances }: Loop, { position, rotation }: LoopErrors["gaps"][number]): string | null {
  const [far, turned] = [position > tolerances[0] + ROUNDING, rotation > tolerances[1] + ROUNDING];
  // The gap of a rotation is twice the sine of half its angle.
  const angle = 2 * Math.asin(Math.min(1, rotation / 2));
  const words = [far && length(position), turned && dofValue(angle, "rad")].filter((word) => word !== false);
  return words.length > 0 ? words.join(" and ") : null;
}

/** What an error says. */
export function message(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
