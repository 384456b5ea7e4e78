/** The URDF's own shapes: its visual elements with colours and textures, its collision elements. */

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  Color,
  CylinderGeometry,
  DoubleSide,
  FileLoader,
  Group,
  LoadingManager,
  Mesh,
  MeshLambertMaterial,
  SphereGeometry,
  SRGBColorSpace,
} from "three";
import type { Object3D } from "three";
import { ColladaLoader } from "three/addons/loaders/ColladaLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MTLLoader } from "three/addons/loaders/MTLLoader.js";
import { OBJLoader } from "three/addons/loaders/OBJLoader.js";
import type { Engine } from "../engine/client";
import type { SourceShape } from "../engine/protocol";

const GLTF = /\.(?:glb|gltf)$/i;
const SAID_NOTHING = new Color(0xb9c0ca);

/** An empty group with the element's pose in its link. */
function placed(shape: SourceShape): Group {
  const group = new Group();
  const [w, x, y, z] = shape.quaternion_wxyz;
  group.position.set(...shape.position);
  group.quaternion.set(x, y, z, w);
  if (shape.shape?.Mesh?.scale) group.scale.set(...shape.shape.Mesh.scale);
  return group;
}

function material(shape: SourceShape, color: Color | null = null): MeshLambertMaterial {
  const own = shape.rgba && new Color().setRGB(shape.rgba[0], shape.rgba[1], shape.rgba[2], SRGBColorSpace);
  const opacity = shape.rgba?.[3] ?? 1;
  // A mirror turns triangles inside out.
  return new MeshLambertMaterial({
    color: color ?? own ?? SAID_NOTHING,
    opacity,
    transparent: opacity < 1,
    side: DoubleSide,
  });
}

/** A box, cylinder, capsule or sphere; null for a mesh or no shape. */
function primitive({ shape }: SourceShape): BufferGeometry | null {
  if (shape?.Box) return new BoxGeometry(...shape.Box.size);
  if (shape?.Sphere) return new SphereGeometry(shape.Sphere.radius, 32, 20);
  // Those of three.js are along y.
  if (shape?.Cylinder)
    return new CylinderGeometry(shape.Cylinder.radius, shape.Cylinder.radius, shape.Cylinder.length, 40).rotateX(
      Math.PI / 2,
    );
  if (shape?.Capsule)
    return new CapsuleGeometry(shape.Capsule.radius, shape.Capsule.length, 12, 32).rotateX(Math.PI / 2);
  return null;
}

/** A collision element, without the colours of its file: an object, or why there is none. */
export async function bare(
  shapes: SourceShape[],
  engine: Engine,
  color: (shape: SourceShape) => Color | null,
): Promise<(Object3D | Error)[]> {
  const paths = [...new Set(shapes.flatMap((shape) => shape.path ?? []))];
  const meshes = await engine.ask("triangles", { paths });
  return shapes.map((shape) => {
    const group = placed(shape);
    let geometry = primitive(shape);
    let flat = false;
    if (!geometry) {
      const { filename } = shape.shape?.Mesh ?? {};
      if (filename === undefined) return group;
      const mesh = shape.path === null ? undefined : meshes[paths.indexOf(shape.path)];
      if (!mesh?.positions || !mesh.indices) return new Error(mesh?.error ?? `${filename}: not in this URDD`);
      geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(mesh.positions.slice(), 3));
      geometry.setIndex(new BufferAttribute(mesh.indices.slice(), 1));
      flat = true;
      if (shape.path !== null && GLTF.test(shape.path)) geometry.rotateX(Math.PI / 2);
    }
    const paint = material(shape, color(shape));
    paint.flatShading = flat;
    group.add(new Mesh(geometry, paint));
    return group;
  });
}

/** A mesh with the colours and textures of its file. All files are from the URDD. */
export async function dressed(shape: SourceShape, engine: Engine): Promise<Object3D> {
  const { path } = shape;
  if (path === null) throw new Error(`${shape.shape?.Mesh?.filename ?? ""}: not in this URDD`);
  const bytes = await engine.ask("file", { path });
  const side = new Map<string, string>();
  for (const file of shape.side_files) {
    const content = await engine.ask("file", { path: file }).catch(() => null);
    if (content) side.set(file, URL.createObjectURL(new Blob([content])));
  }
  const folder = path.slice(0, path.lastIndexOf("/") + 1);
  const manager = new LoadingManager();
  // A missing file: an empty one, without a request.
  manager.setURLModifier((url) => (url.startsWith("blob:") ? url : (side.get(resolved(folder, url)) ?? "data:,")));
  const whole = new Promise<void>((resolve) => {
    manager.onLoad = resolve;
    manager.onError = (): void => undefined;
  });
  manager.itemStart(path);
  const group = placed(shape);
  try {
    group.add(await parsed(path, bytes, manager, side));
  } finally {
    manager.itemEnd(path);
    // Images load after the mesh; then their addresses are released.
    void whole.then(() => {
      for (const url of side.values()) URL.revokeObjectURL(url);
    });
  }
  await whole;
  return group;
}

async function parsed(
  path: string,
  bytes: ArrayBuffer,
  manager: LoadingManager,
  side: Map<string, string>,
): Promise<Object3D> {
  if (GLTF.test(path)) {
    const { scene } = await new GLTFLoader(manager).parseAsync(bytes, "");
    // glTF has y up; readers of URDFs rotate it.
    scene.rotation.x = Math.PI / 2;
    return scene;
  }
  const text = new TextDecoder().decode(bytes);
  if (/\.dae$/i.test(path)) {
    const found = new ColladaLoader(manager).parse(text, "");
    if (!found) throw new Error(`${path}: it cannot be read`);
    // Readers of URDFs apply the unit and ignore the up axis.
    found.scene.rotation.set(0, 0, 0);
    return found.scene;
  }
  if (/\.obj$/i.test(path)) {
    const loader = new OBJLoader(manager);
    for (const [file, url] of side) {
      if (!/\.mtl$/i.test(file)) continue;
      const words = (await new FileLoader().loadAsync(url)) as string;
      const materials = new MTLLoader(manager).parse(words, "");
      materials.preload();
      loader.setMaterials(materials);
    }
    return loader.parse(text);
  }
  throw new Error(`${path}: colours of this format are not supported`);
}

/** The path in the URDD of a reference in a file of this folder. */
function resolved(folder: string, url: string): string {
  const parts: string[] = [];
  let path = url;
  try {
    path = decodeURIComponent(url);
  } catch {
    // Not percent-encoded: unchanged.
  }
  for (const part of `${folder}${path.replaceAll("\\", "/")}`.split("/")) {
    if (part === "..") parts.pop();
    else if (part !== "." && part !== "") parts.push(part);
  }
  return parts.join("/");
}
