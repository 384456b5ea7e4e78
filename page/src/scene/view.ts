/** Canvas, camera and light. Draws only when something changed. */

import {
  Box3,
  Color,
  DirectionalLight,
  HemisphereLight,
  PCFShadowMap,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Sphere,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { h } from "../ui/dom";

/** Width of the picture that shadows are made from, pixels. */
const SHADOW_SIZE = 1024;
/** Towards the light that casts shadows. */
const SUN = new Vector3(0.35, -0.55, 1).normalize();

export class View {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  readonly controls: OrbitControls;
  /** Called before each frame. */
  readonly before: (() => void)[] = [];
  /** Called after the camera moved. */
  readonly moved: (() => void)[] = [];
  /** Number of drawn frames. */
  pictures = 0;
  private readonly renderer: WebGLRenderer;
  /** From above, with shadows; and from the camera, so that no side is black. */
  private readonly sun = new DirectionalLight(0xfff6e8, 1.7);
  private readonly light = new DirectionalLight(0xffffff, 0.9);
  private waiting = false;
  private bounds = new Box3();

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: false, preserveDrawingBuffer: false });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(2, -2, 1.5);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    // Only what moves the robot or changes what is drawn of it calls for new shadows, not the camera.
    this.renderer.shadowMap.autoUpdate = false;
    const sky = new HemisphereLight(0xffffff, 0x8a94a6, 1.5);
    sky.position.set(0, 0, 1);
    this.scene.add(sky, this.sun, this.sun.target);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.setScalar(SHADOW_SIZE);
    this.camera.add(this.light);
    this.light.position.set(-0.5, 0.6, 1);
    this.scene.add(this.camera);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => {
      this.invalidate();
      for (const listener of this.moved) listener();
    });
  }

  /** Follows the size of this element. */
  follow(element: HTMLElement): void {
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
  }

  invalidate(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw(): void {
    for (const listener of this.before) listener();
    this.renderer.render(this.scene, this.camera);
    this.pictures++;
  }

  background(color: string): void {
    this.scene.background = new Color(color);
    this.invalidate();
  }

  /** Aims the light that casts shadows at a robot that reaches this far from its box in all directions. */
  lightUp(box: Box3): void {
    const { center, radius } = box.getBoundingSphere(new Sphere());
    const reach = 2 * Math.max(radius, 1e-4);
    this.sun.target.position.copy(center);
    this.sun.position.copy(center).addScaledVector(SUN, 2 * reach);
    const { camera } = this.sun.shadow;
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0, far: 5 * reach });
    camera.updateProjectionMatrix();
    this.castShadows();
  }

  /** Draws shadows anew in the next picture. */
  castShadows(): void {
    this.renderer.shadowMap.needsUpdate = true;
  }

  /** The ray under a position in the window. */
  ray(x: number, y: number): Raycaster {
    const box = this.canvas.getBoundingClientRect();
    const place = new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(place, this.camera);
    ray.firstHitOnly = true;
    return ray;
  }

  /** The position of a point in the picture, in pixels from its corner; null behind the camera. */
  place(point: Vector3): { x: number; y: number } | null {
    const at = point.clone().project(this.camera);
    if (at.z > 1) return null;
    return { x: ((at.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - at.y) / 2) * this.canvas.clientHeight };
  }

  /** Fits a box into the picture, from the present direction or another one. */
  fit(bounds: Box3, from?: Vector3): void {
    if (bounds.isEmpty()) return;
    this.bounds = bounds.clone();
    const sphere = bounds.getBoundingSphere(new Sphere());
    const radius = Math.max(sphere.radius, 1e-4);
    const half = this.half();
    const away = from?.clone() ?? this.camera.position.clone().sub(this.controls.target);
    away.normalize().multiplyScalar((radius * 1.1) / Math.sin(half));
    this.controls.target.copy(sphere.center);
    this.camera.position.copy(sphere.center).add(away);
    this.planes();
    this.controls.update();
    this.invalidate();
  }

  /** Clipping planes for robots of any size. */
  planes(): void {
    const sphere = this.bounds.getBoundingSphere(new Sphere());
    const radius = Math.max(sphere.radius, 1e-4);
    this.camera.near = radius / 100;
    this.camera.far = radius * 200;
    this.controls.minDistance = radius / 20;
    this.controls.maxDistance = radius * 50;
    this.camera.updateProjectionMatrix();
  }

  /** Numbers of geometries and textures on the graphics card. */
  held(): { geometries: number; textures: number } {
    return { ...this.renderer.info.memory };
  }

  /** The picture as a PNG. */
  picture(): Promise<Blob | null> {
    this.draw();
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  /** The picture in this width, as a PNG. */
  small(width: number): Promise<Blob | null> {
    this.draw();
    const { canvas } = this;
    const small = h("canvas", { width, height: Math.round((width * canvas.height) / canvas.width) });
    small.getContext("2d")?.drawImage(canvas, 0, 0, small.width, small.height);
    return new Promise((resolve) => small.toBlob(resolve, "image/png"));
  }

  private resize(): void {
    const box = (this.canvas.parentElement ?? this.canvas).getBoundingClientRect();
    const [width, height] = [Math.max(1, box.width), Math.max(1, box.height)];
    this.renderer.setSize(width, height, false);
    const before = this.half();
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    // The visible part stays visible, as large as possible.
    if (!this.bounds.isEmpty()) {
      const { target } = this.controls;
      this.camera.position
        .sub(target)
        .multiplyScalar(Math.sin(before) / Math.sin(this.half()))
        .add(target);
      this.controls.update();
    }
    this.draw();
  }

  /** Half the angle of view along the picture's shorter side. */
  private half(): number {
    return Math.min(this.camera.fov, this.camera.fov * this.camera.aspect) * (Math.PI / 360);
  }
}
