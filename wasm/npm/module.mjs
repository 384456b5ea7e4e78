// The module for JavaScript: bytes in, JSON out.

export class Urdd {
  /** Told of the progress of a long job: an object with `what`, `done` and `of`. */
  tell = () => undefined;

  constructor(instance) {
    this.exports = instance.exports;
  }

  static async of(bytes) {
    const module = await WebAssembly.compile(bytes);
    // The module that generates imports these functions; the other imports nothing. All files are given to it at once.
    const progress = (at, length) => urdd.tell(urdd.#text(at, length));
    const instance = await WebAssembly.instantiate(module, {
      urdd: { progress, read: () => 0 },
    });
    const urdd = new Urdd(instance);
    return urdd;
  }

  /** The files in a zip archive. */
  zip(name, zip) {
    const nameBytes = encode(name);
    const files = this.#with([nameBytes, zip], (at) =>
      this.exports.urdd_files_of_zip(
        at[0],
        nameBytes.length,
        at[1],
        zip.length,
      ),
    );
    if (files === 0) {
      this.#with([zip], (at) =>
        this.#json(this.exports.urdd_zip_fault(at[0], zip.length)),
      );
    }
    return files;
  }

  /** Files by path: of each its bytes, or its size, where its bytes may come later by `give`. */
  files(name, files) {
    const bytes = encode(name);
    const handle = this.#with([bytes], (at) =>
      this.exports.urdd_files_new(at[0], bytes.length),
    );
    for (const [path, content] of Object.entries(files)) {
      if (typeof content !== "number") this.give(handle, path, content);
      else {
        const at = encode(path);
        this.#with([at], ([place]) =>
          this.exports.urdd_files_name(handle, place, at.length, content),
        );
      }
    }
    return handle;
  }

  give(files, path, content) {
    const name = encode(path);
    this.#with([name, content], (at) =>
      this.exports.urdd_files_give(
        files,
        at[0],
        name.length,
        at[1],
        content.length,
      ),
    );
  }

  list(files) {
    return this.#json(this.exports.urdd_files_list(files));
  }

  read(files, path) {
    const name = encode(path);
    return this.#with([name], (at) =>
      this.#bytes(this.exports.urdd_files_read(files, at[0], name.length)),
    );
  }

  /** `positions` (x, y, z of each vertex) and `indices` (three of each triangle). */
  mesh(files, path) {
    const name = encode(path);
    const bytes = this.#with([name], (at) =>
      this.#bytes(this.exports.urdd_mesh(files, at[0], name.length)),
    );
    const [vertices] = new Uint32Array(bytes.buffer, 0, 2);
    return {
      positions: new Float32Array(bytes.buffer, 8, 3 * vertices),
      indices: new Uint32Array(bytes.buffer, 8 + 12 * vertices),
    };
  }

  validate(files, name) {
    const bytes = encode(name);
    return this.#with([bytes], (at) =>
      this.#json(this.exports.urdd_validate(files, at[0], bytes.length)),
    );
  }

  /** `question`: the path of the URDF, and the programs that it is `for`. */
  lint(files, question) {
    const bytes = encode(asked(question));
    return this.#with([bytes], (at) =>
      this.#json(this.exports.urdd_lint(files, at[0], bytes.length)),
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
    const bytes = encode(asked(question));
    return this.#with([bytes], (at) =>
      this.#json(
        this.exports.urdd_generate(files, donor, at[0], bytes.length),
      ),
    );
  }

  /** The URDF of an MJCF or SDF among files, likewise. */
  importRobot(files, question) {
    const bytes = encode(asked(question));
    return this.#with([bytes], (at) =>
      this.#json(this.exports.urdd_import(files, at[0], bytes.length)),
    );
  }

  /** The robot of a URDD for another program, likewise. */
  export(files, question) {
    const bytes = encode(asked(question));
    return this.#with([bytes], (at) =>
      this.#json(this.exports.urdd_export(files, at[0], bytes.length)),
    );
  }

  explain(code) {
    const bytes = encode(code);
    return this.#with([bytes], (at) =>
      this.#json(this.exports.urdd_explain(at[0], bytes.length)),
    );
  }

  closeFiles(files) {
    this.exports.urdd_files_close(files);
  }

  open(files) {
    return this.exports.urdd_robot_open(files);
  }

  close(handle) {
    this.exports.urdd_robot_close(handle);
  }

  /** x, y, z and the quaternion w, x, y, z of each link, in each of the configurations that follow each other. */
  linkPosesBatch(handle, values) {
    const bytes = new Uint8Array(new Float64Array(values).buffer);
    const answer = this.#with([bytes], (at) =>
      this.#bytes(
        this.exports.urdd_robot_link_poses_batch(handle, at[0], values.length),
      ),
    );
    return new Float64Array(answer.buffer);
  }

  ask(handle, question) {
    const bytes = encode(asked(question));
    return this.#with([bytes], (at) =>
      this.#json(this.exports.urdd_robot_ask(handle, at[0], bytes.length)),
    );
  }

  #text(pointer, length) {
    const { buffer } = this.exports.memory;
    const bytes = new Uint8Array(buffer, pointer >>> 0, length);
    return JSON.parse(new TextDecoder().decode(bytes));
  }

  #with(inputs, call) {
    const places = inputs.map((bytes) => {
      const at = this.exports.urdd_alloc(bytes.length) >>> 0;
      if (at === 0) throw new Error("the module has no memory left");
      new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
      return at;
    });
    try {
      return call(places);
    } finally {
      places.forEach((at, k) => this.exports.urdd_free(at, inputs[k].length));
    }
  }

  #answer(pointer) {
    const at = pointer >>> 0;
    if (at === 0) throw new Error("the module has no memory left");
    const buffer = this.exports.memory.buffer;
    const length = new DataView(buffer).getUint32(at, true);
    const bytes = new Uint8Array(buffer, at + 4, length).slice();
    this.exports.urdd_free_answer(at);
    return bytes;
  }

  #json(pointer) {
    const answer = JSON.parse(new TextDecoder().decode(this.#answer(pointer)));
    if (answer !== null && typeof answer === "object" && "error" in answer)
      throw new Error(answer.error);
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
