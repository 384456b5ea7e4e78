/** The formats of other programs. */

import type { Format as Word } from "../../../wasm/npm/index";
import type { Actuators } from "./protocol";

export interface Format {
  /** As on the command line. */
  word: Word;
  title: string;
  /** What the file's name ends with; a folder has none. */
  ending: string;
  /** Whether actuators can be chosen. */
  hasActuators?: boolean;
}

/** Kinds of actuators, by MuJoCo's words. */
export const ACTUATORS: readonly Actuators[] = ["position", "velocity", "motor"];

/** Each format of the program, in the order of the menu. */
const OF_EACH = {
  mjcf: { title: "MuJoCo (MJCF)", ending: ".xml", hasActuators: true },
  usd: { title: "Newton, Isaac, Omniverse (USD)", ending: ".usda", hasActuators: true },
  sdf: { title: "Gazebo (SDF)", ending: ".sdf" },
  drake: { title: "Drake (URDF)", ending: ".urdf" },
  moveit: { title: "MoveIt (package)", ending: "" },
  srdf: { title: "Pairs of links (SRDF)", ending: ".srdf" },
  urdf: { title: "URDF with our collision shapes", ending: ".urdf" },
  "urdf-plus": { title: "URDF with loops (URDF+)", ending: ".urdf" },
  "extended-urdf": { title: "URDF with loops (Extended URDF)", ending: ".urdf" },
  curobo: { title: "cuRobo (YAML)", ending: ".yml" },
  foam: { title: "Foam (JSON of spheres)", ending: ".json" },
  spherized: { title: "URDF with spheres", ending: ".urdf" },
} satisfies Record<Word, Omit<Format, "word">>;

export const FORMATS: readonly Format[] = (Object.keys(OF_EACH) as Word[]).map((word) => ({ word, ...OF_EACH[word] }));
