// A robot with faults that have one right answer each, the first behind a character of two units.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { repository } from "./world.mjs";

export const SOUND = readFileSync(join(repository, "crates/urdd-lint/tests/cases/LNT060/near_miss.urdf"), "utf8");

export const FAULTY = [
  ['<robot name="arm">', '<!-- \u{1F916} --><robot name="arm" version="1">'],
  ['upper="2"', 'uper=" 2 "'],
  ["0 0 0.05", "0,0,0.05"],
  ['<mass value="4"/>', '<mass value="4"/><mass value="4"/>'],
  ["    <safety_controller", "    <dynamics/>\n    <safety_controller"],
  ['"revolute"', '"Revolute"'],
].reduce((text, [sound, faulty]) => {
  if (!text.includes(sound)) throw new Error(`the robot of LNT060 has no ${sound}`);
  return text.replace(sound, faulty);
}, SOUND);
