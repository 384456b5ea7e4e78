/** A plot of each DOF of a trajectory, with its limits and the present value. */

import type { Dof } from "../engine/protocol";
import type { Trajectory } from "../trajectory";
import { fill, h } from "../ui/dom";
import { dofValue, name } from "../ui/format";
import { color } from "../ui/theme";

const SIZE = { width: 480, height: 44 };
/** Space above and below the curve, of the range of values. */
const MARGIN = 0.08;

interface Plot {
  dof: number;
  low: number;
  high: number;
  canvas: HTMLCanvasElement;
  value: HTMLElement;
}

export class Plots {
  readonly element = h("div", { class: "plots", hidden: true });
  private trajectory: Trajectory | null = null;
  private dofs: readonly Dof[] = [];
  private plots: Plot[] = [];

  show(trajectory: Trajectory | null, dofs: readonly Dof[]): void {
    this.trajectory = trajectory;
    this.dofs = dofs;
    this.plots = trajectory ? dofs.map((_, dof) => this.plot(trajectory, dof)) : [];
    fill(
      this.element,
      ...this.plots.map(({ dof, canvas, value }) =>
        h("div", {}, h("span", { class: "name" }, name(dofs[dof]?.name ?? "")), value, canvas),
      ),
    );
  }

  /** Draws all plots, with the values at a time. */
  at(time: number): void {
    const { trajectory } = this;
    if (this.element.hidden || !trajectory) return;
    const q = trajectory.at(time);
    for (const plot of this.plots) {
      const { unit = "rad", bounds = null } = this.dofs[plot.dof] ?? {};
      const value = q[plot.dof] ?? 0;
      plot.value.textContent = dofValue(value, unit);
      plot.value.classList.toggle("bad", bounds !== null && (value < bounds[0] - 1e-9 || value > bounds[1] + 1e-9));
      this.draw(plot, trajectory, bounds, time);
    }
  }

  private plot(trajectory: Trajectory, dof: number): Plot {
    const bounds = this.dofs[dof]?.bounds;
    let [low, high] = bounds ?? [Infinity, -Infinity];
    for (let row = 0; row < trajectory.times.length; row++) {
      const value = trajectory.value(row, dof);
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    const margin = MARGIN * (high - low) || 1;
    const label = `${name(this.dofs[dof]?.name ?? "")} over the time`;
    const canvas = h("canvas", { ...SIZE, role: "img", "aria-label": label });
    return { dof, low: low - margin, high: high + margin, canvas, value: h("output", {}) };
  }

  private draw(plot: Plot, trajectory: Trajectory, bounds: [number, number] | null, time: number): void {
    const context = plot.canvas.getContext("2d");
    if (!context) return;
    const { width, height } = SIZE;
    const y = (value: number): number => height - ((value - plot.low) / (plot.high - plot.low)) * height;
    const x = (seconds: number): number => (seconds / (trajectory.duration || 1)) * (width - 2) + 1;
    context.clearRect(0, 0, width, height);
    context.lineWidth = 1;
    context.strokeStyle = color("--error");
    for (const bound of bounds ?? []) {
      context.beginPath();
      context.moveTo(0, y(bound));
      context.lineTo(width, y(bound));
      context.stroke();
    }
    context.lineWidth = 2;
    context.strokeStyle = color("--accent");
    context.beginPath();
    // Where several rows are in one column, the largest and the smallest are drawn.
    let [column, low, high] = [-1, Infinity, -Infinity];
    const flush = (): void => {
      if (column < 0) return;
      context.lineTo(column, y(low));
      if (high > low) context.lineTo(column, y(high));
    };
    for (let row = 0; row < trajectory.times.length; row++) {
      const at = Math.round(x(trajectory.times[row] ?? 0));
      const value = trajectory.value(row, plot.dof);
      if (at !== column) {
        flush();
        [column, low, high] = [at, Infinity, -Infinity];
      }
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    flush();
    context.stroke();
    context.fillStyle = color("--text");
    context.fillRect(x(time) - 1, 0, 2, height);
  }
}
