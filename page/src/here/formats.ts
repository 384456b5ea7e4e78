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

export const FORMATS: readonly Format[] = [
  { word: "mjcf", title: "MuJoCo (MJCF)", ending: ".xml", hasActuators: true },
  { word: "usd", title: "Newton, Isaac, Omniverse (USD)", ending: ".usda", hasActuators: true },
  { word: "sdf", title: "Gazebo (SDF)", ending: ".sdf" },
  { word: "drake", title: "Drake (URDF)", ending: ".urdf" },
  { word: "moveit", title: "MoveIt (package)", ending: "" },
  { word: "srdf", title: "Pairs of links (SRDF)", ending: ".srdf" },
  { word: "urdf", title: "URDF with our collision shapes", ending: ".urdf" },
  { word: "urdf-plus", title: "URDF with loops (URDF+)", ending: ".urdf" },
  { word: "extended-urdf", title: "URDF with loops (Extended URDF)", ending: ".urdf" },
  { word: "curobo", title: "cuRobo (YAML)", ending: ".yml" },
  { word: "foam", title: "Foam (JSON of spheres)", ending: ".json" },
  { word: "spherized", title: "URDF with spheres", ending: ".urdf" },
];
