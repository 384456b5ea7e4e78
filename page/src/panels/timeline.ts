/** A trajectory below the picture: play, speed, loop, plots, where it collides and how near it comes, a video of it. */

import type { App } from "../app";
import type { RobotModel } from "../model";
import { samplesOf, trajectoryOf } from "../trajectory";
import type { Trajectory } from "../trajectory";
import { button, fill, h } from "../ui/dom";
import { offer } from "../ui/files";
import { message, length } from "../ui/format";
import { color } from "../ui/theme";
import { Plots } from "./plots";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
/** Configurations whose distances are asked, at most. */
const ASKED = 240;
/** And a second of few rows, at least. */
const ASKED_A_SECOND = 30;
const STRIP = { width: 480, height: 28 };

/** A trajectory among the files of a drop, if it is the only one. */
export function trajectoryIn(transfer: DataTransfer): File | null {
  const [file] = transfer.files;
  return file && transfer.files.length === 1 && /\.(?:csv|jsonl|ndjson)$/i.test(file.name) ? file : null;
}

export class Timeline {
  readonly element: HTMLElement;
  private trajectory: Trajectory | null = null;
  private time = 0;
  private playing = false;
  /** Counts what is loaded or played, so that only the last one takes effect. */
  private turn = 0;
  private found: ({ distance: number; collides: boolean; unseen: boolean } | null)[] = [];
  private readonly input = h("input", { type: "file", accept: ".csv,.jsonl,.ndjson", hidden: true });
  private readonly title = h("strong", {});
  private readonly play = button("Play", { id: "timeline-play" }, () => {
    this.toggle();
  });
  private readonly slider = h("input", { type: "range", min: 0, step: "any", "aria-label": "Time" });
  private readonly clock = h("output", {});
  private readonly speed = h(
    "select",
    { "aria-label": "Speed" },
    ...SPEEDS.map((speed) => h("option", { value: speed, selected: speed === 1 }, `${speed} ×`)),
  );
  private readonly loop = h("input", { type: "checkbox", id: "timeline-loop" });
  private readonly ghosts = h("input", { type: "checkbox", id: "timeline-ghosts", checked: true });
  private readonly plots = new Plots();
  private readonly strip = h("canvas", { ...STRIP, role: "img" });
  private readonly said = h("span", { class: "along", "aria-live": "polite" });

  constructor(private readonly app: App) {
    const record = button("Record", "Play it once, and save the picture as a WebM video", () => void this.record());
    record.hidden = typeof MediaRecorder === "undefined";
    const plotted = h("input", { type: "checkbox", id: "timeline-plots" });
    plotted.addEventListener("change", () => {
      this.plots.element.hidden = !plotted.checked;
      this.plots.at(this.time);
    });
    this.ghosts.addEventListener("change", () => void this.haunt());
    this.element = h(
      "div",
      { class: "timeline", hidden: true, role: "group", "aria-label": "Trajectory" },
      h("div", { class: "actions" }, this.title, this.said, h("span", { class: "spring" }), this.clock),
      this.plots.element,
      this.strip,
      this.slider,
      h(
        "div",
        { class: "actions" },
        this.play,
        this.speed,
        h("label", {}, this.loop, " Loop"),
        h("label", { title: "Where it begins, in blue, and ends, in yellow" }, this.ghosts, " Start and end"),
        h("label", { title: "Each joint over the time, with its limits in red" }, plotted, " Plots"),
        record,
        h("span", { class: "spring" }),
        button("Close", {}, () => {
          this.close();
        }),
      ),
      this.input,
    );
    this.slider.addEventListener("input", () => {
      this.stop();
      this.show(Number(this.slider.value));
    });
    this.input.addEventListener("change", () => {
      const [file] = this.input.files ?? [];
      if (file) void this.load(file);
      this.input.value = "";
    });
    addEventListener("urdd-trajectory", () => {
      this.input.click();
    });
    addEventListener("urdd-samples", () => void this.playSamples());
    addEventListener("urdd-play", () => {
      if (this.trajectory) this.toggle();
      else void this.playSamples();
    });
    app.byHand.push(() => {
      this.stop();
    });
    addEventListener("urdd-theme", () => {
      this.draw();
    });
    app.store.on(["robot"], () => {
      this.close();
    });
    app.store.on(["path"], ({ path }) => {
      if (path) void this.open(() => Promise.resolve(path));
      else this.close();
    });
    app.store.on(["shapes"], () => {
      if (this.trajectory) void this.ask();
    });
  }

  async load(file: File): Promise<void> {
    await this.open((robot) => trajectoryOf(file, robot.dofs, robot.about.zero ?? robot.dofs.map(() => 0)));
  }

  /** Plays the stored samples, round and round. */
  private async playSamples(): Promise<void> {
    this.loop.checked = true;
    const { engine } = this.app;
    const made = await this.open(({ dofs }) => samplesOf(engine, dofs.length), "There are no samples to play: ");
    if (made && made === this.trajectory) void this.run(made);
  }

  /** Shows a trajectory of the robot, and returns it before its distances are known; null if it cannot be read. */
  private async open(read: (robot: RobotModel) => Promise<Trajectory>, failing = ""): Promise<Trajectory | null> {
    const { robot } = this.app.store.now;
    if (!robot?.moves) return null;
    this.close();
    const turn = ++this.turn;
    let trajectory: Trajectory;
    try {
      trajectory = await read(robot);
    } catch (error) {
      this.app.note(failing + message(error));
      return null;
    }
    if (turn !== this.turn) return null;
    this.trajectory = trajectory;
    fill(this.title, trajectory.name);
    this.slider.max = String(trajectory.duration);
    this.plots.show(trajectory, robot.dofs);
    this.element.hidden = false;
    this.show(0);
    void this.haunt();
    void this.ask();
    return trajectory;
  }

  private close(): void {
    this.stop();
    this.turn++;
    this.trajectory = null;
    this.element.hidden = true;
    this.plots.show(null, []);
    this.app.store.set({ ghosts: [] });
  }

  /** Shows where the trajectory begins and ends, if that is asked for. */
  private async haunt(): Promise<void> {
    const { trajectory, app } = this;
    const isWanted = (): boolean => this.trajectory === trajectory && this.ghosts.checked;
    if (!trajectory || !isWanted()) {
      app.store.set({ ghosts: [] });
      return;
    }
    const poses: Float64Array[] = [];
    for (const row of [0, trajectory.times.length - 1])
      poses.push(await app.engine.ask("linkPoses", { q: trajectory.row(row) }));
    if (isWanted()) app.store.set({ ghosts: poses });
  }

  private stop(): void {
    this.playing = false;
    this.play.textContent = "Play";
  }

  private show(time: number): void {
    const { trajectory } = this;
    if (!trajectory) return;
    this.time = time;
    this.slider.value = String(time);
    this.clock.textContent = `${time.toFixed(2)} of ${trajectory.duration.toFixed(2)} s`;
    this.app.follow(trajectory.at(time));
    const at = trajectory.before(time);
    const error = trajectory.errors[at];
    if (error) this.app.store.set({ sample: { at, of: trajectory.errors.length, ...error } });
    this.plots.at(time);
    this.draw();
  }

  private toggle(): void {
    const { trajectory } = this;
    if (!trajectory) return;
    if (this.playing) {
      this.stop();
      return;
    }
    if (this.time >= trajectory.duration) this.time = 0;
    void this.run(trajectory);
  }

  /** Plays to the end, or until it is stopped. */
  private run(trajectory: Trajectory): Promise<void> {
    this.playing = true;
    this.play.textContent = "Pause";
    let before: number | null = null;
    return new Promise((resolve) => {
      const step = (now: number): void => {
        if (!this.playing || this.trajectory !== trajectory) {
          resolve();
          return;
        }
        const passed = ((now - (before ?? now)) / 1000) * Number(this.speed.value);
        before = now;
        let time = this.time + passed;
        if (time >= trajectory.duration && this.loop.checked && trajectory.duration > 0) time %= trajectory.duration;
        this.show(Math.min(time, trajectory.duration));
        if (time >= trajectory.duration) this.stop();
        requestAnimationFrame(step);
      };
      requestAnimationFrame(step);
    });
  }

  /** Asks for distances along the trajectory, as long as it is the one that is shown. */
  private async ask(): Promise<void> {
    const { trajectory, app } = this;
    if (!trajectory) return;
    const turn = ++this.turn;
    const kind = app.store.now.shapes;
    const { duration, times } = trajectory;
    const number = Math.min(ASKED, Math.max(2, times.length, Math.ceil(duration * ASKED_A_SECOND)));
    this.found = Array.from({ length: number }, () => null);
    this.said.textContent = "";
    let pairs = 0;
    try {
      for (let k = 0; k < number; k++) {
        const q = trajectory.at((duration * k) / (number - 1));
        const answer = await app.engine.ask("proximity", { q, kind, k: 1 });
        if (turn !== this.turn) return;
        const [pair] = answer.nearest;
        this.found[k] = {
          distance: pair?.distance ?? Infinity,
          collides: answer.in_collision,
          unseen: answer.skipped_touching.length > 0,
        };
        pairs = answer.pairs;
        this.draw();
      }
    } catch {
      // A robot that is still being generated has no distances yet.
      return;
    }
    const all = this.found.flatMap((one) => one ?? []);
    const hits = all.filter((one) => one.collides).length;
    const least = Math.min(...all.map((one) => one.distance));
    const near = Number.isFinite(least) ? `, least distance ${length(least)}` : "";
    const share = (hits: number): string => `${Math.ceil((100 * hits) / number)} % of the time`;
    const unseen = all.filter((one) => one.unseen && !one.collides).length;
    const free = pairs === 0 ? "no pair to check for collisions" : `no self-collision${near}`;
    const skipped = unseen > 0 ? `; links that are skipped touch for ${share(unseen)}` : "";
    this.said.textContent = (hits > 0 ? `self-collision for ${share(hits)}` : free) + skipped;
    this.strip.setAttribute("aria-label", this.said.textContent);
  }

  /** The distances, red where it collides, and the present time. */
  private draw(): void {
    const context = this.strip.getContext("2d");
    if (!context || !this.trajectory) return;
    const { width, height } = STRIP;
    context.clearRect(0, 0, width, height);
    const finite = this.found.flatMap((one) => (one && Number.isFinite(one.distance) ? [one.distance] : []));
    const most = Math.max(1e-9, ...finite);
    const wide = width / this.found.length;
    for (const [k, one] of this.found.entries()) {
      if (!one) continue;
      context.fillStyle = color(one.collides ? "--error" : "--accent");
      const tall = one.collides ? height : Math.max(1, (Math.min(one.distance, most) / most) * height);
      context.fillRect(k * wide, height - tall, wide + 0.5, tall);
    }
    context.fillStyle = color("--text");
    context.fillRect((this.time / (this.trajectory.duration || 1)) * (width - 2), 0, 2, height);
  }

  /** Plays once, and saves the picture as a video. */
  private async record(): Promise<void> {
    const { trajectory } = this;
    const picture = document.getElementById("picture");
    if (!trajectory || !(picture instanceof HTMLCanvasElement)) return;
    this.stop();
    const recorder = new MediaRecorder(picture.captureStream(60), { mimeType: "video/webm" });
    const parts: Blob[] = [];
    recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
    const ended = new Promise((resolve) => {
      recorder.addEventListener("stop", resolve);
    });
    recorder.start();
    const loop = this.loop.checked;
    this.loop.checked = false;
    this.show(0);
    await this.run(trajectory);
    this.loop.checked = loop;
    recorder.stop();
    await ended;
    offer(new Blob(parts, { type: "video/webm" }), `${trajectory.name.replace(/\.[^.]*$/, "")}.webm`);
  }
}
