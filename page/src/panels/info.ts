/** The robot's size, mass, modules and files, and all data of the selected link or joint. */

import { Euler, Quaternion, Vector3 } from "three";
import type { App } from "../app";
import type { Inertial, Loops } from "../engine/protocol";
import type { RobotModel } from "../model";
import { poseOf } from "../scene/robot";
import { button, fill, h } from "../ui/dom";
import { bytes, count, dofValue, lengths, name, number } from "../ui/format";

function line(term: string, ...value: (string | Node | null)[]): Node[] {
  return [h("dt", {}, term), h("dd", {}, ...value)];
}

function table(...lines: (Node[] | null | false)[]): HTMLElement {
  return h("dl", { class: "table" }, ...lines.flatMap((found) => found || []));
}

export function info(app: App): HTMLElement {
  const chosen = h("div", {});
  const whole = h("div", {});
  app.store.on(["robot", "selected", "q", "units", "tab"], ({ robot, selected, q, tab }) => {
    if (tab !== "Info") return;
    if (!robot || !selected) fill(chosen);
    else if (selected.kind === "link") fill(chosen, ...ofLink(app, robot, selected.index));
    else fill(chosen, ...ofJoint(app, robot, selected.index, q));
  });
  app.store.on(["robot"], ({ robot }) => fill(whole, ...(robot ? ofRobot(robot) : [])));
  return h("div", { class: "panel" }, chosen, placing(app), whole);
}

function linkButton(app: App, robot: RobotModel, link: number | null): Node {
  if (link === null) return h("span", {}, "none");
  return button(
    name(robot.nameOf(link)),
    {
      class: "place",
    },
    () => app.select({ kind: "link", index: link }),
  );
}

function jointButton(app: App, robot: RobotModel, joint: number | null): Node {
  if (joint === null) return h("span", {}, "none, it is the root");
  return button(
    name(robot.joints[joint]?.name ?? ""),
    {
      class: "place",
    },
    () => app.select({ kind: "joint", index: joint }),
  );
}

function ofLink(app: App, robot: RobotModel, index: number): Node[] {
  const link = robot.links[index];
  if (!link) return [];
  const pieces = robot.about.meshes.pieces?.[index]?.length ?? 0;
  return [
    h("h2", {}, `Link ${name(link.name)}`),
    table(
      line("Index", String(index)),
      line("Joint above", jointButton(app, robot, link.parent_joint)),
      line("Joints below", count(robot.below[index]?.length ?? 0, "joint")),
      line("Convex pieces", String(pieces)),
      ...mass(link.inertial),
    ),
  ];
}

function mass(inertial: Inertial | null): (Node[] | null)[] {
  if (!inertial) return [line("Mass", "not given")];
  return [
    line("Mass", inertial.mass === null ? "not given" : `${number(inertial.mass, 4)} kg`),
    line("Centre of mass", lengths(inertial.position)),
    inertial.inertia &&
      line(
        "Inertia",
        `xx ${number(inertial.inertia[0])}, yy ${number(inertial.inertia[3])}, zz ${number(inertial.inertia[5])} kg m²`,
      ),
    inertial.inertia &&
      line(
        "Products",
        `xy ${number(inertial.inertia[1])}, xz ${number(inertial.inertia[2])}, yz ${number(inertial.inertia[4])} kg m²`,
      ),
  ];
}

function ofJoint(app: App, robot: RobotModel, index: number, q: readonly number[]): Node[] {
  const joint = robot.joints[index];
  if (!joint) return [];
  const unit = joint.type === "Prismatic" ? "m" : "rad";
  const position = robot.position(index, q);
  const limit = joint.limit;
  const either = (value: number | null): string => (value === null ? "–" : dofValue(value, unit));
  return [
    h("h2", {}, `Joint ${name(joint.name)}`),
    table(
      line("Type", joint.type.toLowerCase()),
      line("Parent", linkButton(app, robot, joint.parent)),
      line("Child", linkButton(app, robot, joint.child)),
      joint.axis && line("Axis", joint.axis.map((x) => number(x)).join(", ")),
      joint.origin && line("Origin", lengths(joint.origin.position)),
      position !== null && joint.type !== "Fixed" && line("Position", dofValue(position, unit)),
      limit && line("Limits", `${either(limit.lower)} to ${either(limit.upper)}`),
      limit?.velocity != null && line("Speed limit", `${dofValue(limit.velocity, unit)}/s`),
      limit?.effort != null && line("Effort limit", `${number(limit.effort)} ${unit === "rad" ? "N m" : "N"}`),
      joint.mimic &&
        line(
          "Follows",
          `${number(joint.mimic.multiplier)} × ${name(robot.dofs[joint.mimic.dof ?? -1]?.name ?? "nothing")} + ${dofValue(joint.mimic.offset, unit)}`,
        ),
    ),
  ];
}

function ofLoops({ loops, couplings, independent }: Loops): string {
  const kinds = new Map<string, number>();
  for (const { kind } of loops) kinds.set(kind, (kinds.get(kind) ?? 0) + 1);
  const all = [...kinds].map(([kind, many]) => `${many} ${kind.toLowerCase()}`);
  if (couplings.length > 0) all.push(count(couplings.length, "coupling"));
  return `${all.join(", ")}; ${count(independent.length, "DOF")} ${independent.length === 1 ? "moves" : "move"} freely`;
}

function ofRobot(robot: RobotModel): Node[] {
  const { about } = robot;
  const total = robot.links.reduce((sum, link) => sum + (link.inertial?.mass ?? 0), 0);
  const size = robot.files.reduce((sum, file) => sum + file.size, 0);
  const pieces = about.meshes.pieces?.flat().length ?? 0;
  const modules = new Map<string, { size: number; files: number }>();
  for (const file of robot.files) {
    const folder = /^(?:[a-z_]+\/)?[a-z0-9_]+_module(?=\/)/.exec(file.path)?.[0];
    if (!folder) continue;
    const known = modules.get(folder) ?? { size: 0, files: 0 };
    modules.set(folder, { size: known.size + file.size, files: known.files + 1 });
  }
  return [
    h("h2", {}, `Robot ${name(robot.name)}`),
    table(
      line("Folder", name(about.folder)),
      line("Format", about.profile === "legacy" ? "legacy, from before version 1" : "version 1"),
      line("Links", String(robot.links.length)),
      line("Joints", `${robot.joints.length}, ${robot.joints.filter((joint) => joint.mimic).length} of them mimic`),
      line("DOFs", about.dofs ? String(robot.dofs.length) : "not known"),
      about.loops && line("Loops", ofLoops(about.loops)),
      line("Mass", total > 0 ? `${number(total, 4)} kg` : "not given"),
      pieces > 0 && line("Convex pieces", String(pieces)),
      line("Files", `${count(robot.files.length, "file")}, ${bytes(size)}`),
    ),
    ...(robot.entry.notes.length > 0
      ? [
          h("h2", {}, "Assumptions during generation"),
          h("ul", { class: "notes" }, ...robot.entry.notes.map((note) => h("li", {}, name(note)))),
        ]
      : []),
    ...(about.faults.length > 0
      ? [
          h("h2", {}, "Cannot be read"),
          h("ul", { class: "notes bad" }, ...about.faults.map((fault) => h("li", {}, name(fault.reason)))),
        ]
      : []),
    h("h2", {}, "Modules"),
    h(
      "dl",
      { class: "table modules" },
      ...[...modules]
        .sort(([a], [b]) => (a < b ? -1 : 1))
        .flatMap(([folder, { size, files }]) => [
          h("dt", { title: folder }, (folder.split("/").pop() ?? folder).replace(/_module$/, "")),
          h("dd", {}, `${count(files, "file")} · ${bytes(size)}`),
        ]),
    ),
  ];
}

const numbers = (values: readonly number[]): string => values.map((value) => number(value, 5)).join(", ");

/** The pose of the selected link in the frame of another one, in the forms that people copy into other programs. */
function placing(app: App): HTMLElement {
  const base = h("select", { id: "pose-base", change: () => show() });
  const table = h("dl", { class: "table" });
  const show = (): void => {
    const { robot, selected, poses } = app.store.now;
    element.hidden = !robot || !poses || selected?.kind !== "link";
    if (!poses || selected?.kind !== "link") return;
    const pose = poseOf(poses, Number(base.value)).invert().multiply(poseOf(poses, selected.index));
    const [position, turn, scale] = [new Vector3(), new Quaternion(), new Vector3()];
    pose.decompose(position, turn, scale);
    if (turn.w < 0) turn.set(-turn.x, -turn.y, -turn.z, -turn.w);
    // URDF's rpy are about fixed axes: x first, then y, then z.
    const { x, y, z } = new Euler().setFromQuaternion(turn, "ZYX");
    const lines: [string, string][] = [
      ["Position", lengths(position.toArray(), 5)],
      ["rpy", `${numbers([x, y, z])} rad`],
      ["Quaternion", `w ${number(turn.w, 5)}, xyz ${numbers([turn.x, turn.y, turn.z])}`],
    ];
    fill(table, ...lines.flatMap(([term, value]) => [h("dt", {}, term), h("dd", {}, value)]));
  };
  const element = h("div", { hidden: true }, h("label", { for: base.id }, "Pose in the frame of "), base, table);
  app.store.on(["robot"], ({ robot }) => {
    const root = robot?.links.findIndex(({ parent_joint: above }) => above === null) ?? 0;
    fill(
      base,
      ...(robot?.links ?? []).map((link, k) => h("option", { value: k, selected: k === root }, name(link.name))),
    );
    show();
  });
  app.store.on(["selected", "poses", "units", "tab"], ({ tab }) => {
    if (tab === "Info") show();
  });
  return element;
}
