/** The robot that the present one is compared with, drawn beside it. */

import { Box3, Color, Vector3 } from "three";
import type { App } from "./app";
import { CHANGE_COLORS } from "./compared";
import type { Compared } from "./compared";
import { load } from "./scene/layers";
import { RobotScene } from "./scene/robot";
import type { View } from "./scene/view";
import { LAYERS } from "./state";
import { message } from "./ui/format";
import { color } from "./ui/theme";

/** Space between the robots, of the larger one's size. */
const SPACE = 0.25;

export class Beside {
  scene: RobotScene | null = null;
  private compared: Compared | null = null;

  /** `own` is the box of the present robot, and `placed` is called when the picture has another robot, or none. */
  constructor(
    private readonly app: App,
    private readonly view: View,
    private readonly own: () => Box3 | null,
    private readonly placed: () => void,
  ) {
    app.store.on(["compared"], ({ compared }) => void this.take(compared));
    app.store.on(["layers", "selected", "overlays"], () => void this.fill());
    addEventListener("urdd-theme", () => {
      this.dress();
    });
  }

  bounds(): Box3 {
    return this.scene?.bounds() ?? new Box3();
  }

  private async take(compared: Compared | null): Promise<void> {
    const isKnown = compared?.model === this.compared?.model;
    this.compared = compared;
    if (compared?.poses) this.scene?.pose(compared.poses);
    if (isKnown) {
      this.view.castShadows();
      this.view.invalidate();
      // Without poses, there is nothing to place yet.
      if (this.scene && !this.scene.root.visible && compared?.poses) this.place();
      return;
    }
    this.scene?.dispose();
    this.scene = null;
    if (compared) {
      const scene = new RobotScene(compared.model.links.length);
      scene.root.visible = false;
      this.scene = scene;
      this.view.scene.add(scene.root);
      await this.fill();
      if (scene !== this.scene) return;
      if (this.compared?.poses) this.place();
    } else this.placed();
    this.view.castShadows();
    this.view.invalidate();
  }

  /** To the left of the present robot, as seen from the front. */
  private place(): void {
    const { scene } = this;
    const own = this.own();
    if (!scene || !own || !this.compared?.poses) return;
    scene.pose(this.compared.poses);
    scene.root.position.set(0, 0, 0);
    const box = scene.bounds();
    const [one, two] = [own.getSize(new Vector3()), box.getSize(new Vector3())];
    scene.root.position.y = own.min.y - box.max.y - SPACE * Math.max(...one.toArray(), ...two.toArray());
    scene.root.visible = true;
    this.placed();
  }

  /** Loads the layers that are drawn. */
  private async fill(): Promise<void> {
    const { scene, compared } = this;
    if (!scene || !compared) return;
    for (const layer of LAYERS) {
      if (!this.app.store.now.layers[layer].on || scene.has(layer)) continue;
      try {
        await load(layer, scene, compared.model, compared.engine, () => undefined);
      } catch (error) {
        this.app.note(message(error));
      }
      if (scene !== this.scene) {
        scene.dispose();
        return;
      }
    }
    this.dress();
  }

  private dress(): void {
    const { scene, compared } = this;
    if (!scene || !compared) return;
    const { layers, overlays, robot, selected } = this.app.store.now;
    const chosen = selected?.kind === "link" ? robot?.links[selected.index]?.name : undefined;
    const changes = new Map(compared.changes.map(({ link, change }) => [link, change]));
    const same = new Color(color("--open"));
    const tint = new Color(color("--accent"));
    scene.show(layers, new Set(), overlays.wireframe, (link) => {
      const name = compared.model.links[link]?.name ?? "";
      const change = changes.get(name);
      const paint = change ? new Color(color(CHANGE_COLORS[change])) : same;
      return { tint: name === chosen ? tint : null, fade: 1, paint };
    });
    this.view.castShadows();
    this.view.invalidate();
  }
}
