/** Dragging in the picture: a joint follows the pointer, or a link is pulled and the joints above it follow. */

import { Plane, Vector3 } from "three";
import type { Ray } from "three";
import type { InverseSolution, InverseQuestion } from "../engine/protocol";
import type { RobotModel } from "../model";
import { matrixOf, poseOf } from "./robot";

/** The position and the axis of a joint, in the root link's frame. */
function jointFrame(model: RobotModel, poses: Float64Array, joint: number): { origin: Vector3; axis: Vector3 } {
  const found = model.joints[joint];
  const parent = poseOf(poses, found?.parent ?? 0);
  const frame = found?.origin ? parent.multiply(matrixOf(found.origin)) : parent;
  const axis = new Vector3(...(found?.axis ?? [0, 0, 1])).transformDirection(frame);
  return { origin: new Vector3().setFromMatrixPosition(frame), axis };
}

export interface Drag {
  /** Whether loops are closed in its configurations already. */
  isSolved: boolean;
  /** The configuration for a position of the pointer; null if there is none. */
  to(ray: Ray, q: number[]): Promise<number[] | null>;
}

function within(model: RobotModel, dof: number, value: number): number {
  const bounds = model.dofs[dof]?.bounds;
  return bounds ? Math.min(Math.max(value, bounds[0]), bounds[1]) : value;
}

/** A joint of one DOF, or one that follows another: exactly under the pointer. */
export function dragJoint(
  model: RobotModel,
  poses: Float64Array,
  joint: number,
  at: Vector3,
  eye: Vector3,
): Drag | null {
  const found = model.joints[joint];
  const [dof, ...more] = model.dofsOf(joint);
  if (!found || dof === undefined || more.length > 0) return null;
  const multiplier = found.mimic?.multiplier ?? 1;
  if (multiplier === 0) return null;
  const { origin, axis } = jointFrame(model, poses, joint);
  const slides = found.type === "Prismatic";
  const view = at.clone().sub(eye).normalize();
  // Seen from the side, the plane of rotation is a line: then the pointer's path along the rim counts.
  const edgeOn = Math.abs(view.dot(axis)) < 0.25;
  const start = at.clone().sub(origin);
  const arm = start.clone().projectOnPlane(axis);
  const rim = axis.clone().cross(arm);
  const facing = new Plane().setFromNormalAndCoplanarPoint(view, at);
  const across = new Plane().setFromNormalAndCoplanarPoint(axis, at);
  let turned = 0;
  let first: number | null = null;
  const moved = (ray: Ray): number | null => {
    if (slides || edgeOn) {
      const hit = ray.intersectPlane(facing, new Vector3());
      if (!hit) return null;
      const way = hit.sub(at);
      return slides ? way.dot(axis) : arm.lengthSq() > 0 ? way.dot(rim) / rim.lengthSq() : null;
    }
    const hit = ray.intersectPlane(across, new Vector3());
    if (!hit) return null;
    const now = hit.sub(origin).projectOnPlane(axis);
    const angle = Math.atan2(axis.dot(arm.clone().cross(now)), arm.dot(now));
    // Whole turns are counted.
    turned += Math.atan2(Math.sin(angle - turned), Math.cos(angle - turned));
    return turned;
  };
  return {
    isSolved: false,
    to(ray, q) {
      first ??= q[dof] ?? 0;
      const way = moved(ray);
      if (way === null || !Number.isFinite(way)) return Promise.resolve(null);
      const next = q.slice();
      next[dof] = within(model, dof, first + way / multiplier);
      return Promise.resolve(next);
    },
  };
}

/** Solves inverse kinematics. */
export type Solve = (question: InverseQuestion) => Promise<InverseSolution>;

/** Pulls a point of a link under the pointer by these DOFs, within their bounds. */
export function pull(
  poses: Float64Array,
  link: number,
  dofs: number[],
  at: Vector3,
  eye: Vector3,
  solve: Solve,
): Drag | null {
  if (dofs.length === 0) return null;
  const local = at.clone().applyMatrix4(poseOf(poses, link).invert());
  const facing = new Plane().setFromNormalAndCoplanarPoint(at.clone().sub(eye).normalize(), at);
  return {
    isSolved: true,
    async to(ray, q) {
      const target = ray.intersectPlane(facing, new Vector3());
      if (!target) return null;
      const question = { q, link, point: local.toArray(), position: target.toArray(), dofs };
      return (await solve(question)).configuration;
    },
  };
}
