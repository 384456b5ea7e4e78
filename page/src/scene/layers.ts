/** Creates the meshes of layers from the engine's data. */

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  FrontSide,
  Mesh,
  MeshLambertMaterial,
  SphereGeometry,
  SRGBColorSpace,
} from "three";
import type { Material, Object3D } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { Engine, LinkMesh } from "../engine/client";
import type { Progress } from "../engine/link";
import type { ShapeKind, SourceShape, Shape } from "../engine/protocol";
import type { RobotModel } from "../model";
import { LAYERS, sphereLevel } from "../state";
import type { LayerKind } from "../state";
import { message } from "../ui/format";
import type { MeshData, RobotScene } from "./robot";
import { bare, dressed } from "./sources";

const IMAGE = /\.(?:png|jpe?g|webp|bmp|gif|tga)$/i;
const PLAIN = new Color(0x9aa3b2);
/** Spheres of a level that are drawn. */
const MOST_SPHERES = 5000;
/** Number of images fetched at once. */
const AT_ONCE = 6;

/** A colour for a piece: consecutive pieces differ. */
function pieceColor(link: number, piece: number): Color {
  const hue = (0.58 + 0.61803 * piece + 0.137 * link) % 1;
  return new Color().setHSL(hue, 0.5, 0.56, SRGBColorSpace);
}

/** Loads a layer. Returns a line for each item that could not be loaded. */
export async function load(
  layer: LayerKind,
  scene: RobotScene,
  model: RobotModel,
  engine: Engine,
  onProgress: (progress: Progress) => void,
): Promise<string[]> {
  switch (layer) {
    case "original":
    case "plain":
      return pictures(layer, scene, model, engine, onProgress);
    case "collision":
      return collision(scene, engine);
    case "hulls":
    case "pieces": {
      if (!model.about.meshes[layer]) return [missing(layer)];
      const meshes = await engine.ask("meshes", { kind: layer }, onProgress);
      scene.begin(layer);
      return meshes.flatMap((mesh) => solid(layer, scene, mesh) ?? []);
    }
    default: {
      const level = sphereLevel(layer);
      if (level !== null) return levelOf(layer, level, scene, model);
      const shapes = await engine.ask("shapes", { kind: layer as ShapeKind });
      scene.begin(layer);
      for (const shape of shapes) scene.add(layer, shape.link, about(layer, shape));
      return [];
    }
  }
}

/** A level of the spheres of links. */
function levelOf(layer: LayerKind, level: number, scene: RobotScene, model: RobotModel): string[] {
  scene.begin(layer);
  const found = model.spheres[level];
  if (!found) return ["this robot has no such level of spheres"];
  // One geometry for all: there may be very many.
  const unit = new SphereGeometry(1, 24, 16);
  found.spheres.slice(0, MOST_SPHERES).forEach(({ link, centre, radius }, piece) => {
    const color = pieceColor(link, piece);
    const mesh = new Mesh(unit, material(color));
    mesh.position.set(...centre);
    mesh.scale.setScalar(radius);
    scene.add(layer, link, tagged(mesh, layer, link, piece, color, 0.55));
  });
  const left = found.spheres.length - MOST_SPHERES;
  return left > 0 ? [`${left} of the spheres are not drawn`] : [];
}

/** The URDF's collision elements, each in a colour. */
async function collision(scene: RobotScene, engine: Engine): Promise<string[]> {
  const shapes = (await engine.ask("sources", {})).filter(({ geometry }) => geometry === "Collision");
  const colors = new Map(shapes.map((shape) => [shape, pieceColor(shape.link, shape.element)]));
  const found = await bare(shapes, engine, (shape) => colors.get(shape) ?? null);
  scene.begin("collision");
  if (shapes.length === 0) return ["the URDF has no collision geometry"];
  return shapes.flatMap((shape, k) => {
    const object = found[k];
    if (!object || object instanceof Error) return object?.message ?? [];
    dress(object, "collision", shape.link, shape.element);
    scene.add("collision", shape.link, object);
    return [];
  });
}

function missing(layer: string): string {
  const module = { hulls: "convex_hull_meshes_module", pieces: "convex_decomposition_meshes_module" }[layer];
  return `${module ?? "plain_meshes_module"} is missing or cannot be read`;
}

function material(color: Color, opacity = 1): MeshLambertMaterial {
  return rimmed(new MeshLambertMaterial({ color, opacity, transparent: opacity < 1 }));
}

function solid(layer: LayerKind, scene: RobotScene, mesh: LinkMesh): string | null {
  if (!mesh.positions || !mesh.indices) return mesh.error ?? "it cannot be read";
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(mesh.positions, 3));
  geometry.setIndex(new BufferAttribute(mesh.indices, 1));
  const color = pieceColor(mesh.link, layer === "pieces" ? mesh.piece : 0);
  const paint = material(color);
  paint.flatShading = true;
  scene.add(layer, mesh.link, tagged(new Mesh(geometry, paint), layer, mesh.link, mesh.piece, color));
  return null;
}

function tagged(mesh: Mesh, layer: LayerKind, link: number, piece: number, color: Color, opacity = 1): Mesh {
  // If surfaces of two layers coincide, the later layer is visible.
  const paint = mesh.material as MeshLambertMaterial;
  paint.polygonOffset = true;
  paint.polygonOffsetFactor = -LAYERS.indexOf(layer);
  paint.polygonOffsetUnits = -LAYERS.indexOf(layer);
  const of: MeshData = { link, piece, layer, color: color.clone(), opacity };
  mesh.userData = { of };
  return mesh;
}

/** A box or a sphere. */
function about(layer: LayerKind, { link, piece, solid }: Shape): Mesh {
  const color = pieceColor(link, piece);
  const paint = material(color);
  let mesh: Mesh;
  if (solid.radius !== undefined) {
    mesh = new Mesh(new SphereGeometry(solid.radius, 32, 20), paint);
  } else {
    const [x, y, z] = solid.half_extents ?? [0, 0, 0];
    mesh = new Mesh(new BoxGeometry(2 * x, 2 * y, 2 * z), paint);
  }
  mesh.position.set(...solid.position);
  const [w, x, y, z] = solid.quaternion_wxyz ?? [1, 0, 0, 0];
  mesh.quaternion.set(x, y, z, w);
  return tagged(mesh, layer, link, piece, color, 0.55);
}

/** The plain meshes, with the source's colours or without. */
async function pictures(
  layer: "original" | "plain",
  scene: RobotScene,
  model: RobotModel,
  engine: Engine,
  onProgress: (progress: Progress) => void,
): Promise<string[]> {
  const lists = model.about.meshes.plain;
  if (!lists) return [missing(layer)];
  const faults: string[] = [];
  const textured = layer === "original" ? await withTextures(engine) : new Map<number, SourceShape[]>();
  const plain = lists.flatMap((meshes, link) =>
    textured.has(link) ? [] : meshes.map((mesh, piece) => ({ link, piece, path: mesh.glb, source: null })),
  );
  const jobs = [
    ...plain,
    ...[...textured.values()].flatMap((shapes) =>
      shapes.map((source) => ({ link: source.link, piece: source.element, path: source.path, source })),
    ),
  ];
  scene.begin(layer);
  const loader = new GLTFLoader();
  let done = 0;
  const waiting = jobs.slice();
  const work = async (): Promise<void> => {
    for (let job = waiting.shift(); job; job = waiting.shift()) {
      const { link, piece, path, source } = job;
      try {
        const picture = source ? await ofSource(source, engine) : await ofFile(path, engine, loader);
        dress(picture, layer, link, piece);
        scene.add(layer, link, picture);
      } catch (error) {
        faults.push(`${path ?? model.nameOf(link)}: ${message(error)}`);
      }
      onProgress({ done: ++done, of: jobs.length, what: "meshes" });
    }
  };
  await Promise.all(Array.from({ length: AT_ONCE }, work));
  return faults;
}

async function ofFile(path: string | null, engine: Engine, loader: GLTFLoader): Promise<Object3D> {
  if (path === null) throw new Error("its .glb is not in this URDD");
  return (await loader.parseAsync(await engine.ask("file", { path }), "")).scene;
}

async function ofSource(shape: SourceShape, engine: Engine): Promise<Object3D> {
  if (shape.path !== null && isTextured(shape)) return dressed(shape, engine);
  const [object] = await bare([shape], engine, () => null);
  if (object instanceof Error) throw object;
  return object ?? dressed(shape, engine);
}

/** Whether the shape looks different from its plain mesh, which has no textures. */
function isTextured(shape: SourceShape): boolean {
  return shape.side_files.some((file) => IMAGE.test(file));
}

/** The visual elements of each link that has a texture: a plain mesh has only colours. */
async function withTextures(engine: Engine): Promise<Map<number, SourceShape[]>> {
  const found = new Map<number, SourceShape[]>();
  // Unknown for a legacy URDD, or if the URDF cannot be read.
  const sources = await engine.ask("sources", {}).catch(() => []);
  const visual = sources.filter(({ geometry, shape }) => geometry === "Visual" && shape !== null);
  const links = new Set(visual.filter(isTextured).map(({ link }) => link));
  for (const link of links)
    found.set(
      link,
      visual.filter((shape) => shape.link === link),
    );
  return found;
}

/** Replaces the materials of a file by the page's, with the same colours. */
function dress(picture: Object3D, layer: LayerKind, link: number, piece: number): void {
  for (const mesh of simple(picture)) {
    const known = mesh.material as Partial<MeshLambertMaterial> | undefined;
    const color = layer === "plain" ? PLAIN : (known?.color ?? PLAIN);
    const opacity = layer === "plain" ? 1 : (known?.opacity ?? 1);
    const paint = material(color, opacity);
    if (layer === "original" && known?.map) paint.map = known.map;
    paint.flatShading = !mesh.geometry.getAttribute("normal");
    paint.side = known?.side ?? FrontSide;
    mesh.material = paint;
    tagged(mesh, layer, link, piece, color, opacity);
  }
}

/** The meshes of a scene, each with one material, without lines and points. */
function simple(picture: Object3D): Mesh[] {
  const found: Mesh[] = [];
  const gone: Object3D[] = [];
  picture.traverse((object) => {
    if (object instanceof Mesh) found.push(object as Mesh);
    else if ("isLine" in object || "isPoints" in object) gone.push(object);
  });
  for (const object of gone) object.removeFromParent();
  return found.flatMap((mesh) => {
    const { material, geometry } = mesh;
    if (!Array.isArray(material)) return [mesh];
    const parts = geometry.groups.map(({ start, count, materialIndex }) => {
      const part = new BufferGeometry();
      for (const [name, attribute] of Object.entries(geometry.attributes)) part.setAttribute(name, attribute);
      part.setIndex(geometry.index);
      part.setDrawRange(start, count);
      return new Mesh(part, material[materialIndex ?? 0] ?? material[0]);
    });
    mesh.geometry = new BufferGeometry();
    mesh.material = material[0] as Material;
    mesh.add(...parts);
    return parts;
  });
}

/** Light along the outline, which makes a dark robot visible on a dark background. */
const rim = { value: new Color(0) };

export function rimColor(color: string): void {
  rim.value.set(color);
}

/** The same material, with light along the outline. */
function rimmed(material: MeshLambertMaterial): MeshLambertMaterial {
  material.onBeforeCompile = (shader): void => {
    shader.uniforms["rim"] = rim;
    shader.fragmentShader = `uniform vec3 rim;\n${shader.fragmentShader.replace(
      "#include <opaque_fragment>",
      "outgoingLight += rim * (0.09 + pow(1.0 - abs(dot(normalize(normal), normalize(vViewPosition))), 2.0));\n#include <opaque_fragment>",
    )}`;
  };
  return material;
}
