/** The robot's links in the scene: poses, shapes, how each link looks, and transparent copies in other configurations. */

import { Box3, Color, Group, Matrix4, Mesh, MeshLambertMaterial, Quaternion, Vector3, MeshBasicMaterial } from "three";
import type { Object3D } from "three";
import { CHANGE_COLORS } from "../compared";
import { placeKey } from "../contacts";
import { partColor } from "../document";
import { paintNow, paintOf } from "../findings";
import type { Pose } from "../engine/protocol";
import { LAYERS, ghosted } from "../state";
import type { Layer, LayerKind, State } from "../state";
import { color } from "../ui/theme";

/** Maximum opacity of what casts no shadow. */
const SHADOWLESS = 0.5;

/** The origin of a mesh in the scene. */
export interface MeshData {
  link: number;
  piece: number;
  layer: LayerKind;
  color: Color;
  opacity: number;
}

export function dataOf(object: Object3D): MeshData | null {
  return (object.userData as { of?: MeshData }).of ?? null;
}

/** The pose of a link, of those of all links: x, y, z and the quaternion w, x, y, z of each. */
export function poseOf(poses: Float64Array, link: number): Matrix4 {
  const [x = 0, y = 0, z = 0, w = 1, qx = 0, qy = 0, qz = 0] = poses.subarray(7 * link, 7 * link + 7);
  return new Matrix4().compose(new Vector3(x, y, z), new Quaternion(qx, qy, qz, w), new Vector3(1, 1, 1));
}

export function matrixOf({ position, quaternion_wxyz: [w, x, y, z] }: Pose): Matrix4 {
  return new Matrix4().compose(new Vector3(...position), new Quaternion(x, y, z, w), new Vector3(1, 1, 1));
}

/** The appearance of a link in all layers: a tint, and a factor of its opacity. */
interface Look {
  tint: Color | null;
  fade: number;
  paint: Color | null;
}

export class RobotScene {
  readonly root = new Group();
  private readonly links: Group[];
  private readonly layers = new Map<LayerKind, Group[]>();

  constructor(links: number) {
    this.links = Array.from({ length: links }, () => {
      const group = new Group();
      group.matrixAutoUpdate = false;
      this.root.add(group);
      return group;
    });
  }

  /** Sets the poses of all links. */
  pose(poses: Float64Array): void {
    this.links.forEach((group, link) => {
      group.matrix.copy(poseOf(poses, link));
      group.matrixWorldNeedsUpdate = true;
    });
    this.root.updateMatrixWorld(true);
  }

  link(index: number): Group | undefined {
    return this.links[index];
  }

  has(layer: LayerKind): boolean {
    return this.layers.has(layer);
  }

  /** Adds an empty layer. */
  begin(layer: LayerKind): void {
    this.drop(layer);
    this.layers.set(
      layer,
      this.links.map((link) => {
        const group = new Group();
        link.add(group);
        return group;
      }),
    );
  }

  add(layer: LayerKind, link: number, object: Object3D): void {
    this.layers.get(layer)?.[link]?.add(object);
    object.updateMatrixWorld(true);
  }

  drop(layer: LayerKind): void {
    for (const group of this.layers.get(layer) ?? []) {
      group.removeFromParent();
      group.traverse((object) => {
        if (!(object instanceof Mesh)) return;
        const mesh = object as Mesh<Mesh["geometry"], MeshLambertMaterial>;
        mesh.geometry.dispose();
        mesh.material.map?.dispose();
        mesh.material.dispose();
      });
    }
    this.layers.delete(layer);
  }

  dispose(): void {
    for (const layer of LAYERS) this.drop(layer);
    this.root.removeFromParent();
  }

  /** All visible meshes. */
  meshes(): Mesh[] {
    const found: Mesh[] = [];
    for (const groups of this.layers.values()) {
      for (const group of groups) {
        if (!group.visible) continue;
        group.traverse((object) => {
          if (object instanceof Mesh) found.push(object as Mesh);
        });
      }
    }
    return found;
  }

  /** Shows layers and links with these tints and opacities. */
  show(
    layers: Record<LayerKind, Layer>,
    hidden: ReadonlySet<number>,
    wireframe: boolean,
    look: (link: number, piece: number, layer: LayerKind) => Look,
  ): void {
    for (const [kind, groups] of this.layers) {
      const layer = layers[kind];
      groups.forEach((group, link) => {
        group.visible = layer.on && layer.opacity > 0 && !hidden.has(link);
        if (!group.visible) return;
        group.traverse((object) => {
          const data = dataOf(object);
          if (!data || !(object instanceof Mesh)) return;
          const material = object.material as MeshLambertMaterial;
          paint(material, data, look(link, data.piece, kind), layer.opacity, wireframe);
          object.castShadow = material.opacity > SHADOWLESS && !wireframe;
        });
      });
    }
  }

  /** The bounding box of everything, or of some links. */
  bounds(of?: ReadonlySet<number>): Box3 {
    this.root.updateMatrixWorld(true);
    const box = new Box3();
    this.links.forEach((group, link) => {
      if (!of || of.has(link)) box.expandByObject(group);
    });
    if (box.isEmpty()) {
      for (const group of this.links) box.expandByPoint(new Vector3().setFromMatrixPosition(group.matrix));
      if (!box.isEmpty()) box.expandByScalar(0.1);
    }
    return box;
  }
}

function paint(material: MeshLambertMaterial, data: MeshData, look: Look, opacity: number, wireframe: boolean): void {
  const visible = opacity * look.fade * data.opacity;
  const transparent = visible < 0.999;
  if (material.transparent !== transparent || material.wireframe !== wireframe) material.needsUpdate = true;
  material.transparent = transparent;
  material.depthWrite = !transparent;
  material.opacity = visible;
  material.wireframe = wireframe;
  material.color.copy(look.paint ?? data.color);
  if (look.tint) material.emissive.copy(look.tint).multiplyScalar(0.45);
  else material.emissive.setScalar(0);
}

/** The appearance of faded links. */
const FADED = 0.18;

/** How each link looks: selected, in contact, painted by findings or by parts, or faded. */
export function looks(state: Readonly<State>): (link: number, piece: number, layer: LayerKind) => Look {
  const tints = tinted(state);
  const paint = painted(state);
  const { contacts, shapes } = state;
  const touching = new Color(color("--error"));
  const ghost = ghosted(state);
  const isPainted = paintNow(state) !== null || state.compared !== null;
  return (link, piece, layer) => {
    const isExact = layer === shapes;
    const place = layer === "pieces" || layer.startsWith("piece-") ? piece : 0;
    // In the layer of the checked shapes, only the shapes that touch; in other layers the whole link.
    const touches =
      !isPainted &&
      (isExact ? (contacts?.places.has(placeKey(link, place)) ?? false) : (contacts?.links.has(link) ?? false));
    let fade = 1;
    if (ghost) {
      const isOne = ghost.some(([other, k]) => other === link && k === place);
      fade = isExact && isOne ? 1 : ghost.some(([other]) => other === link) ? 0.3 : FADED;
    }
    return { tint: tints.get(link) ?? (touches ? touching : null), fade, paint: touches ? touching : paint(link) };
  };
}

function tinted({ robot, selected, hovered, pair, tab }: Readonly<State>): Map<number, Color> {
  const tints = new Map<number, Color>();
  const tint = (link: number | null | undefined, name: string): void => {
    if (link !== null && link !== undefined) tints.set(link, new Color(color(name)));
  };
  if (tab === "Skips") for (const [link] of pair ?? []) tint(link, "--mark");
  for (const [part, own, parent] of [
    [hovered, "--hover", "--parent"],
    [selected, "--accent", "--parent"],
  ] as const) {
    if (part?.kind === "link") tint(part.index, own);
    else if (part) {
      tint(robot?.joints[part.index]?.parent, parent);
      tint(robot?.joints[part.index]?.child, own === "--hover" ? "--child" : own);
    }
  }
  return tints;
}

function painted(state: Readonly<State>): (link: number) => Color | null {
  const { robot, byPart, report, compared } = state;
  if (robot && compared) {
    const changes = new Map(compared.changes.map(({ link, change }) => [link, change]));
    return (link) => {
      const change = changes.get(robot.nameOf(link));
      return new Color(color(change ? CHANGE_COLORS[change] : "--open"));
    };
  }
  const by = paintNow(state);
  const parts = new Map<number, Color>();
  if (byPart)
    robot?.parts.forEach(({ links }, part) => {
      for (const link of links) parts.set(link, new Color(partColor(part)));
    });
  if (!robot || by === null) return (link) => parts.get(link) ?? null;
  const worst = paintOf(robot, report.report, by);
  const names = { error: "--error", warning: "--warning", info: "--info", unverified: "--open" };
  return (link) => {
    const found = worst.get(link);
    // If only one rule counts, a link that it does not name is neither good nor bad.
    const rest = report.report && by === "worst" ? "--good" : "--open";
    return new Color(color(found ? names[found] : rest));
  };
}

const OPACITY = 0.22;

/** Transparent copies of what is drawn of the robot, in other configurations. */
export class Ghosts {
  readonly group = new Group();

  /** A copy for each of these poses of all links, each in a colour. The meshes' data is shared. */
  show(scene: RobotScene | null, poses: readonly Float64Array[], colors: readonly string[]): void {
    for (const child of this.group.children) if (child instanceof Mesh) (child.material as MeshBasicMaterial).dispose();
    this.group.clear();
    if (!scene || poses.length === 0) return;
    const meshes = scene.meshes().flatMap((mesh) => {
      const of = dataOf(mesh);
      const link = of && scene.link(of.link);
      return link
        ? [{ mesh, link: of.link, within: link.matrixWorld.clone().invert().multiply(mesh.matrixWorld) }]
        : [];
    });
    poses.forEach((all, k) => {
      const color = new Color(colors[k] ?? "#fff");
      const material = new MeshBasicMaterial({ color, opacity: OPACITY, transparent: true, depthWrite: false });
      for (const { mesh, link, within } of meshes) {
        const ghost = new Mesh(mesh.geometry, material);
        ghost.matrixAutoUpdate = false;
        ghost.matrix.copy(poseOf(all, link)).multiply(within);
        this.group.add(ghost);
      }
    });
  }
}
