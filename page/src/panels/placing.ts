/** The pose of the selected link in the frame of another one, in the forms that people copy into other programs. */

import { Euler, Quaternion, Vector3 } from "three";
import type { App } from "../app";
import { linkMatrix } from "../scene/drag";
import { fill, h } from "../ui/dom";
import { lengths, name, number } from "../ui/format";

const numbers = (values: readonly number[]): string => values.map((value) => number(value, 5)).join(", ");

export function placing(app: App): HTMLElement {
  const base = h("select", { id: "pose-base", change: () => show() });
  const table = h("dl", { class: "table" });
  const show = (): void => {
    const { robot, selected, poses } = app.store.now;
    element.hidden = !robot || !poses || selected?.kind !== "link";
    if (!poses || selected?.kind !== "link") return;
    const pose = linkMatrix(poses, Number(base.value)).invert().multiply(linkMatrix(poses, selected.index));
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
