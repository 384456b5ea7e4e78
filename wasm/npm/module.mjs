// The module for JavaScript: bytes in, JSON out.

export class Urdd {
  /** Told of the progress of a long job: an object with `what`, `done` and `of`. */
  tell = () => undefined;
  /** Gives the content of a file that was named and not given; null if there is none. */
  content = () => null;
  /** Writes a question as JSON. */
  write = asked;
  /** What is said where the module has no memory left. */
  noMemory = "the module has no memory left";

  constructor(instance) {
    this.exports = instance.exports;
  }

  /** Of the module's bytes, or of what was compiled of them. */
  static async of(source) {
    const module =
      source instanceof WebAssembly.Module
        ? source
        : await WebAssembly.compile(source);
    // The module that generates imports these functions; the other imports nothing.
    const progress = (at, length) =>
      urdd.tell(JSON.parse(urdd.#text(at, length)));
    const read = (at, length) =>
      urdd.#lent(urdd.content(urdd.#text(at, length)));
    const instance = await WebAssembly.instantiate(module, {
      urdd: { progress, read },
    });
    const urdd = new Urdd(instance);
    return urdd;
  }

  /** The module's memory, bytes. */
  get memory() {
    return this.exports.memory.buffer.byteLength;
  }

  /** Whether it validates and explains: the module of a page in one file does not. */
  get validates() {
    return "urdd_validate" in this.exports;
  }

  /** The files in a zip archive of a URDD. */
  zip(name, zip) {
    const files = this.#with([encode(name), zip], (...words) =>
      this.exports.urdd_files_of_zip(...words),
    );
    if (files === 0) {
      this.#with([zip], (...words) =>
        this.#json(this.exports.urdd_zip_fault(...words)),
      );
      throw new Error("this zip archive has no URDD");
    }
    return files;
  }

  /** The files in a zip archive, whatever they are. */
  unzipped(zip) {
    return this.#with([zip], (...words) =>
      this.#json(this.exports.urdd_files_of_any_zip(...words)),
    ).files;
  }

  /** Files by path: of each its bytes, or its size, where its bytes may come later by `give`. */
  files(name, files) {
    const handle = this.#with([encode(name)], (...words) =>
      this.exports.urdd_files_new(...words),
    );
    for (const [path, content] of Object.entries(files)) {
      if (typeof content === "number") this.name(handle, path, content);
      else this.give(handle, path, content);
    }
    return handle;
  }

  /** Names a file, with its size. */
  name(files, path, size) {
    this.#with([encode(path)], (...words) =>
      this.exports.urdd_files_name(files, ...words, Math.min(size, 0xffffffff)),
    );
  }

  give(files, path, content) {
    this.#with([encode(path), content], (...words) =>
      this.exports.urdd_files_give(files, ...words),
    );
  }

  /** Sets the content of a file, in place of any that it had. */
  put(files, path, content) {
    this.#with([encode(path), content], (...words) =>
      this.exports.urdd_files_put(files, ...words),
    );
  }

  /** States that nobody knows where a file belongs; without a path, that names may lead out of the files. */
  lose(files, path) {
    this.#with([encode(path)], (...words) =>
      this.exports.urdd_files_lost(files, ...words),
    );
  }

  list(files) {
    return this.#json(this.exports.urdd_files_list(files));
  }

  read(files, path) {
    return this.#with([encode(path)], (...words) =>
      this.#bytes(this.exports.urdd_files_read(files, ...words)),
    );
  }

  /** The paths of files that are not among those of before with the same content. */
  changed(files, before) {
    return this.#json(this.exports.urdd_files_changed(files, before));
  }

  /** `positions` (x, y, z of each vertex) and `indices` (three of each triangle). */
  mesh(files, path) {
    const bytes = this.#with([encode(path)], (...words) =>
      this.#bytes(this.exports.urdd_mesh(files, ...words)),
    );
    const [vertices] = new Uint32Array(bytes.buffer, 0, 2);
    return {
      positions: new Float32Array(bytes.buffer, 8, 3 * vertices),
      indices: new Uint32Array(bytes.buffer, 8 + 12 * vertices),
    };
  }

  validate(files, name) {
    return this.#with([encode(name)], (...words) =>
      this.#json(this.exports.urdd_validate(files, ...words)),
    );
  }

  /** `question`: the path of the URDF, and the programs that it is `for`. */
  lint(files, question) {
    return this.#asked(question, (...words) =>
      this.exports.urdd_lint(files, ...words),
    );
  }

  /** The descriptions among files. */
  descriptions(files) {
    return this.#json(this.exports.urdd_descriptions(files));
  }

  /**
   * A URDD of a description among files: `files` of the answer is the handle of its files. What did not change is taken
   * from the files of `donor`, which this made before.
   */
  generate(files, question, donor = 0) {
    return this.#asked(question, (...words) =>
      this.exports.urdd_generate(files, donor, ...words),
    );
  }

  /** The URDF of an MJCF, SDF or USD among files, likewise. */
  importRobot(files, question) {
    return this.#asked(question, (...words) =>
      this.exports.urdd_import(files, ...words),
    );
  }

  /** The robot of a URDD for another program, likewise. */
  export(files, question) {
    return this.#asked(question, (...words) =>
      this.exports.urdd_export(files, ...words),
    );
  }

  explain(code) {
    return this.#with([encode(code)], (...words) =>
      this.#json(this.exports.urdd_explain(...words)),
    );
  }

  closeFiles(files) {
    if (files !== 0) this.exports.urdd_files_close(files);
  }

  open(files) {
    return this.exports.urdd_robot_open(files);
  }

  close(handle) {
    this.exports.urdd_robot_close(handle);
  }

  /** x, y, z and the quaternion w, x, y, z of each link, in each of the configurations that follow each other. */
  linkPosesBatch(handle, values) {
    const answer = this.#with([binary(values)], (at) =>
      this.#bytes(
        this.exports.urdd_robot_link_poses_batch(handle, at, values.length),
      ),
    );
    return new Float64Array(answer.buffer);
  }

  ask(handle, question) {
    return this.#asked(question, (...words) =>
      this.exports.urdd_robot_ask(handle, ...words),
    );
  }

  /** The spheres of a robot: `checker`, and `num_dofs`, the number of values of a configuration. */
  sphereChecker(handle, question) {
    return this.#asked(question, (...words) =>
      this.exports.urdd_robot_sphere_checker(handle, ...words),
    );
  }

  /** The same spheres among obstacles. */
  spheresAround(checker, obstacles) {
    return this.#asked(obstacles, (...words) =>
      this.exports.urdd_spheres_around(checker, ...words),
    );
  }

  /** A 1 for each of the configurations that follow each other, or of one alone, in which spheres are so near. */
  spheresWithin(checker, values, margin, isOne) {
    return this.#with([binary(values)], (at) =>
      this.#bytes(
        this.exports.urdd_spheres_within(
          checker,
          at,
          values.length,
          margin,
          isOne,
        ),
      ),
    );
  }

  /** Where each motion is blocked, NaN where it is free; with `isFirst` also the last part that is free, before it. */
  spheresEdges(checker, starts, ends, settings) {
    const { margin, resolution, openLoops, isFirst, isOne } = settings;
    if (starts.length !== ends.length)
      throw new Error(
        `there are ${starts.length} values of starts, and ${ends.length} of ends`,
      );
    const answer = this.#with([binary(starts), binary(ends)], (from, _, to) =>
      this.#bytes(
        this.exports.urdd_spheres_edges(
          checker,
          from,
          to,
          ends.length,
          margin,
          resolution,
          Boolean(openLoops),
          isFirst,
          isOne,
        ),
      ),
    );
    return new Float64Array(answer.buffer);
  }

  closeSpheres(checker) {
    this.exports.urdd_spheres_close(checker);
  }

  #asked(question, call) {
    return this.#with([encode(this.write(question))], (...words) =>
      this.#json(call(...words)),
    );
  }

  #text(pointer, length) {
    const { buffer } = this.exports.memory;
    const bytes = new Uint8Array(buffer, pointer >>> 0, length);
    return new TextDecoder().decode(bytes);
  }

  /** The address of an answer with these bytes; 0 without any, or without memory for it. */
  #lent(bytes) {
    if (bytes === null) return 0;
    const at = this.exports.urdd_alloc(bytes.length + 5) >>> 0;
    if (at === 0) return 0;
    const { buffer } = this.exports.memory;
    new DataView(buffer).setUint32(at, bytes.length + 1, true);
    const answer = new Uint8Array(buffer, at + 4, bytes.length + 1);
    answer[0] = 1;
    answer.set(bytes, 1);
    return at;
  }

  /** Calls with the address and the length of each input. */
  #with(inputs, call) {
    const words = inputs.flatMap((bytes) => {
      const at = this.exports.urdd_alloc(bytes.length) >>> 0;
      if (at === 0) throw new Error(this.noMemory);
      new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
      return [at, bytes.length];
    });
    try {
      return call(...words);
    } finally {
      for (let k = 0; k < words.length; k += 2)
        this.exports.urdd_free(words[k], words[k + 1]);
    }
  }

  #answer(pointer) {
    const at = pointer >>> 0;
    if (at === 0) throw new Error(this.noMemory);
    const buffer = this.exports.memory.buffer;
    const length = new DataView(buffer).getUint32(at, true);
    const bytes = new Uint8Array(buffer, at + 4, length).slice();
    this.exports.urdd_free_answer(at);
    return bytes;
  }

  #json(pointer) {
    const answer = JSON.parse(new TextDecoder().decode(this.#answer(pointer)));
    const isObject = answer !== null && typeof answer === "object";
    if (isObject && "error" in answer && !("urdds" in answer))
      throw new Error(String(answer.error));
    return answer;
  }

  #bytes(pointer) {
    const answer = this.#answer(pointer);
    if (answer[0] !== 1)
      throw new Error(new TextDecoder().decode(answer.slice(1)));
    return answer.slice(1);
  }
}

/** A question as JSON, which has no infinite numbers and would drop them. */
function asked(question) {
  return JSON.stringify(question, function (key, value) {
    if (typeof value === "number" && !Number.isFinite(value)) {
      const place = Array.isArray(this) ? `element ${key} of a list` : key;
      throw new RangeError(`${place} must be a finite number, not ${value}`);
    }
    return value;
  });
}

function encode(text) {
  return new TextEncoder().encode(text);
}

/** Numbers as bytes. */
function binary(values) {
  const { buffer, byteOffset, byteLength } =
    values instanceof Float64Array ? values : new Float64Array(values);
  return new Uint8Array(buffer, byteOffset, byteLength);
}
