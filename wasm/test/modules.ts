// Checked by `npm --prefix page run check`: the types of documents accept what the schemas accept, and refuse the rest.

import type {
  BoundsModule,
  Documents,
  Geometry,
  JointInChain,
  Pose,
} from "../npm/modules.js";

const bounds: BoundsModule = {
  bounds: [[-1.5, 2]],
  dof_lower_bounds: [-1.5],
  dof_upper_bounds: [2],
  dof_limited: [true],
  dof_velocity_limits: [null],
  dof_effort_limits: [87],
  x_acme_note: "keys of one's own",
};
export const documents: Partial<Documents> = { bounds_module: bounds };

export const box: Geometry = { Box: { size: [1, 2, 3] } };

export function axis(joint: JointInChain): [number, number, number] | null {
  return joint.joint_type === "Fixed" ? null : joint.axis;
}

// @ts-expect-error two numbers are no position
export const short: Pose["position"] = [0, 0];

// @ts-expect-error a key that is missing
export const without: Pose = { position: [0, 0, 0] };

// @ts-expect-error no such type of joint
export const word: JointInChain["joint_type"] = "Hinge";

// @ts-expect-error null is not a list
export const none: BoundsModule["dof_limited"] = null;

export const unknown: Pose = {
  position: [0, 0, 0],
  quaternion_wxyz: [1, 0, 0, 0],
  // @ts-expect-error a key that no schema has
  origin: 7,
};
