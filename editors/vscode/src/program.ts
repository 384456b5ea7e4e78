// The program `urdd`: where it is, and what it is started with. Nothing here needs VS Code.

import { accessSync, constants, statSync } from "node:fs";
import { delimiter, isAbsolute, join } from "node:path";

/** The settings that the language server asks for, as section `urdd`. */
export interface Settings {
  /** Expand .xacro files when they are saved. It runs code that they contain. */
  xacro: boolean;
  /** Folders with ROS packages. */
  packagePaths: string[];
  /** A file with findings that are not shown; none if it is empty. */
  baseline: string;
}

/**
 * The absolute path of a program; null if there is none.
 *
 * The system's own search also looks into the current folder on Windows, and wherever PATH has a relative folder: a
 * workspace could bring its own `urdd`. So only absolute folders of PATH count.
 */
export function find(program: string, environment: NodeJS.ProcessEnv): string | null {
  if (isAbsolute(program)) return isProgram(program) ? program : null;
  if (/[/\\]/.test(program)) return null;
  const isWindows = process.platform === "win32";
  const endings = isWindows ? [".exe", ""] : [""];
  // On Windows its name is often `Path`.
  const name = Object.keys(environment).find((key) => key === "PATH" || (isWindows && key.toUpperCase() === "PATH"));
  for (const folder of (name && environment[name]?.split(delimiter)) || []) {
    if (!isAbsolute(folder)) continue;
    const found = endings.map((ending) => join(folder, program + ending)).find(isProgram);
    if (found !== undefined) return found;
  }
  return null;
}

function isProgram(path: string): boolean {
  try {
    accessSync(path, constants.X_OK);
    return statSync(path).isFile();
  } catch {
    return false;
  }
}

/** What to tell somebody whose program was not found. */
export function notFound(program: string): string {
  return program === "urdd"
    ? "The program urdd is not on PATH. Install it (`pip install urdd`), or set `urdd.path` to where it is."
    : `urdd.path: \`${program}\` is not a program. Write an absolute path, or a name that is on PATH.`;
}

/** The environment of the program, with the folders of packages before those that ROS knows. */
export function withPackages(settings: Settings, environment: NodeJS.ProcessEnv): NodeJS.ProcessEnv {
  const paths = [...settings.packagePaths, environment["ROS_PACKAGE_PATH"] ?? ""].filter(Boolean);
  return paths.length > 0 ? { ...environment, ROS_PACKAGE_PATH: paths.join(delimiter) } : environment;
}

/** The answer to the server's question for a section; undefined if it is about another program. */
export function section(settings: Settings, name: string | undefined): unknown {
  if (name === "urdd") return settings;
  if (name === "urdd.xacro") return settings.xacro;
  if (name === "urdd.packagePaths") return settings.packagePaths;
  if (name === "urdd.baseline") return settings.baseline;
  return undefined;
}
