// What a program of others calls: URDDs are validated, and robots opened, from files in memory or a zip archive; and
// descriptions are linted, made URDDs of, imported, and robots exported, in memory.

import { Urdd as Module } from "./module.mjs";

/** Loads the module: from the package itself, or from these bytes; that which lints and generates when it is needed first. */
export async function load(bytes, lintBytes) {
  const url = new URL("./urdd.wasm", import.meta.url);
  return new Urdd(await Module.of(bytes ?? (await own(url))), lintBytes);
}

async function own(url) {
  if (url.protocol === "file:")
    return (await import("node:fs/promises")).readFile(url);
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: status ${response.status}`);
  return response.arrayBuffer();
}

/** The files of a folder on disk, for Node. */
export async function folder(path) {
  const { readFile, readdir } = await import("node:fs/promises");
  const { basename, join, relative, resolve, sep } = await import("node:path");
  const files = {};
  for (const entry of await readdir(path, {
    recursive: true,
    withFileTypes: true,
  })) {
    if (!entry.isFile()) continue;
    const file = join(entry.parentPath ?? entry.path, entry.name);
    files[relative(path, file).replaceAll(sep, "/")] = await readFile(file);
  }
  return { name: basename(resolve(path)), files };
}

export class Urdd {
  #module;
  #makerBytes;
  #making = null;
  #maker = null;

  constructor(module, makerBytes) {
    this.#module = module;
    this.#makerBytes = makerBytes;
  }

  async lint(source, question = {}) {
    return this.#made(source, (maker, files) => maker.lint(files, question));
  }

  async descriptions(source) {
    return this.#made(source, (maker, files) => maker.descriptions(files));
  }

  async generate(source, options = {}, progress = () => undefined) {
    return this.#made(source, (maker, files) => {
      maker.tell = progress;
      const path = options.path ?? theOnly(maker.descriptions(files)).path;
      const made = maker.generate(files, { ...options, path });
      return { ...made, name: made.robot, files: taken(maker, made.files) };
    });
  }

  async importRobot(source, options = {}) {
    return this.#made(source, (maker, files) => {
      const path = options.path ?? theOnly(maker.descriptions(files)).path;
      const made = maker.importRobot(files, { ...options, path });
      return { ...made, files: taken(maker, made.files) };
    });
  }

  async export(source, format, options = {}) {
    return this.#made(source, (maker, files) => {
      const output = options.output ?? "robot";
      const made = maker.export(files, { ...options, format, output });
      return { ...made, files: taken(maker, made.files) };
    });
  }

  async #made(source, job) {
    const maker = await this.#loadMaker();
    const text = typeof source === "string" ? encode(source) : source;
    const given =
      text instanceof Uint8Array
        ? { name: "robot", files: { "robot.urdf": text } }
        : source;
    const files = filesOf(maker, given);
    try {
      return job(maker, files);
    } finally {
      maker.closeFiles(files);
    }
  }

  async #loadMaker() {
    const url = new URL("./make.wasm", import.meta.url);
    const made = async () =>
      Module.of((await this.#makerBytes) ?? (await own(url)));
    this.#making ??= made();
    try {
      this.#maker = await this.#making;
    } catch (error) {
      // It may be there the next time.
      this.#making = null;
      throw error;
    }
    return this.#maker;
  }

  validate(source) {
    const files = filesOf(this.#module, source);
    try {
      return this.#module.validate(files, source.name);
    } finally {
      this.#module.closeFiles(files);
    }
  }

  explain(code) {
    return (this.#maker ?? this.#module).explain(code);
  }

  robot(source) {
    return new Robot(this.#module, filesOf(this.#module, source));
  }
}

/** The description that is meant where none is named. */
function theOnly(found) {
  const [one, ...more] = found.filter(({ format }) => format !== "xacro");
  if (!one && found.length > 0)
    throw new Error(
      `\`${found[0].path}\` is a xacro file, a program, which is not run here: expand it by xacro, and give what comes out`,
    );
  if (!one) throw new Error("there is no URDF, MJCF, SDF or USD among the files");
  if (more.length > 0)
    throw new Error(
      `there are several descriptions, such as \`${one.path}\` and \`${more[0].path}\`: name one as \`path\``,
    );
  return one;
}

/** The content of files of the module, which are closed. */
function taken(module, handle) {
  const all = module.list(handle).files;
  const files = all.map(({ path }) => [path, module.read(handle, path)]);
  module.closeFiles(handle);
  return Object.fromEntries(files);
}

function filesOf(module, source) {
  return source.zip
    ? module.zip(source.name, source.zip)
    : module.files(source.name, source.files);
}

function encode(text) {
  return new TextEncoder().encode(text);
}

export class Robot {
  #module;
  #files;
  #handle;

  constructor(module, files) {
    this.#module = module;
    this.#files = files;
    this.#handle = module.open(files);
  }

  get about() {
    return this.#ask({ ask: "about" });
  }

  linkPoses(q) {
    return this.#ask({ ask: "link_poses", q: [...q] });
  }

  linkPosesBatch(values) {
    return this.#module.linkPosesBatch(this.#open(), values);
  }

  random(k) {
    return this.#ask({ ask: "random", k });
  }

  clamp(q) {
    return this.#ask({ ask: "clamp", q: [...q] });
  }

  inverseKinematics(question) {
    return this.#ask({ ask: "inverse_kinematics", ...question });
  }

  loopErrors(q) {
    return this.#loops({ errors: { q: [...q] } });
  }

  closeLoops(q, held = []) {
    return this.#loops({ close: { q: [...q], held } });
  }

  freeDofs(q) {
    return this.#loops({ free_dofs: { q: [...q] } });
  }

  loopResiduals(q) {
    return this.#loops({ residuals: { q: [...q] } });
  }

  loopJacobian(q) {
    return this.#loops({ jacobian: { q: [...q] } });
  }

  loopVelocities(q, independent) {
    return this.#loops({
      velocities: { q: [...q], independent: [...independent] },
    });
  }

  closestPoints(q, kind = "pieces") {
    return this.#ask({ ask: "closest_points", q: [...q], kind });
  }

  nearest(q, k = 1, among = {}) {
    return this.#collisions({ nearest: { q: [...q], k } }, among);
  }

  skippedContacts(kind = "pieces") {
    return this.#ask({ ask: "skipped_contacts", kind });
  }

  inCollision(q, among = {}) {
    return this.#collisions({ in_collision: { q: [...q] } }, among);
  }

  isWithin(q, margin, among = {}) {
    return this.#collisions({ is_within: { q: [...q], margin } }, among);
  }

  blockedEdge(start, end, { margin, resolution, open_loops, ...among } = {}) {
    const edge = { start: [...start], end: [...end], margin, resolution, open_loops };
    return this.#collisions({ blocked_edge: edge }, among);
  }

  firstContact(start, end, { margin, resolution, open_loops, ...among } = {}) {
    const edge = { start: [...start], end: [...end], margin, resolution, open_loops };
    return this.#collisions({ first_contact: edge }, among);
  }

  gradients(q, k = 1, among = {}) {
    return this.#collisions({ gradients: { q: [...q], k } }, among);
  }

  penetrations(q, among = {}) {
    return this.#collisions({ penetrations: { q: [...q] } }, among);
  }

  get limits() {
    return this.#ask({ ask: "limits" });
  }

  get linkMasses() {
    return this.#ask({ ask: "link_masses" });
  }

  centreOfMass(q) {
    return this.#ask({ ask: "centre_of_mass", q: [...q] });
  }

  gravityTorques(q, { gravity, payload } = {}) {
    return this.#ask({ ask: "gravity_torques", q: [...q], gravity, payload });
  }

  get collisionModel() {
    return this.#ask({ ask: "collision_model" });
  }

  clearances(q) {
    return this.#ask({ ask: "clearances", q: [...q] });
  }

  skips(kind = "pieces") {
    return this.#ask({ ask: "skips", kind });
  }

  shapes(kind) {
    return this.#ask({ ask: "shapes", kind });
  }

  sphereChecker({ covers = false } = {}) {
    const made = this.#module.sphereChecker(this.#open(), { covers });
    return new SphereChecker(this.#module, made, covers ? "maybe" : "contact");
  }

  mesh(path) {
    this.#open();
    return this.#module.mesh(this.#files, path);
  }

  close() {
    if (this.#handle === 0) return;
    this.#module.close(this.#handle);
    this.#module.closeFiles(this.#files);
    this.#handle = 0;
  }

  #open() {
    if (this.#handle === 0) throw new Error("this robot is closed");
    return this.#handle;
  }

  #loops(about) {
    return this.#ask({ ask: "loops", about });
  }

  /** The kind of shapes alone, or all of what is asked about. */
  #collisions(about, among) {
    const all = typeof among === "string" ? { kind: among } : among;
    return this.#ask({ ask: "collisions", about, ...all });
  }

  #ask(question) {
    return this.#module.ask(this.#open(), question);
  }
}

export class SphereChecker {
  #module;
  #checker;
  #touching;

  constructor(module, { checker, num_dofs }, touching) {
    this.#module = module;
    this.#checker = checker;
    this.#touching = touching;
    this.numDofs = num_dofs;
  }

  around(obstacles) {
    const made = this.#module.spheresAround(this.#open(), obstacles);
    return new SphereChecker(this.#module, made, this.#touching);
  }

  inCollision(q) {
    return this.isWithin(q, 0);
  }

  inCollisionBatch(values) {
    return this.isWithinBatch(values, 0);
  }

  isWithin(q, margin) {
    return this.#within([...q], margin, true)[0];
  }

  isWithinBatch(values, margin) {
    return this.#within(values, margin, false);
  }

  blockedEdge(start, end, options = {}) {
    const [part] = this.#edges([...start], [...end], options, false, true);
    return Number.isNaN(part) ? null : part;
  }

  blockedEdgeBatch(starts, ends, options = {}) {
    return this.#edges(starts, ends, options, false, false);
  }

  firstContact(start, end, options = {}) {
    const ends = [[...start], [...end]];
    const [free, blocked] = this.#edges(...ends, options, true, true);
    return Number.isNaN(blocked) ? null : { free, blocked };
  }

  firstContactBatch(starts, ends, options = {}) {
    return this.#edges(starts, ends, options, true, false);
  }

  close() {
    if (this.#checker === 0) return;
    this.#module.closeSpheres(this.#checker);
    this.#checker = 0;
  }

  #open() {
    if (this.#checker === 0) throw new Error("this checker is closed");
    return this.#checker;
  }

  #within(values, margin, isOne) {
    const found = this.#module.spheresWithin(
      this.#open(),
      values,
      margin,
      isOne,
    );
    return Array.from(found, (touches) => (touches ? this.#touching : "free"));
  }

  #edges(starts, ends, options, isFirst, isOne) {
    const { margin = 0, resolution = 0.01, open_loops = false } = options;
    const settings = { margin, resolution, openLoops: open_loops, isFirst, isOne };
    return this.#module.spheresEdges(this.#open(), starts, ends, settings);
  }
}
