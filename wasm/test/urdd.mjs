// The module for JavaScript: bytes in, JSON out.

export class Urdd {
  constructor(instance) {
    this.exports = instance.exports;
  }

  static async of(bytes) {
    const module = await WebAssembly.compile(bytes);
    return new Urdd(await WebAssembly.instantiate(module, {}));
  }

  validateZip(name, zip) {
    const nameBytes = new TextEncoder().encode(name);
    return this.#with([nameBytes, zip], (at) =>
      this.#answer(this.exports.urdd_validate_zip(at[0], nameBytes.length, at[1], zip.length)),
    );
  }

  open(zip) {
    const handle = this.#with([zip], (at) => this.exports.urdd_robot_open_zip(at[0], zip.length));
    if (handle === 0) throw new Error("this is no zip archive of a URDD");
    return handle;
  }

  close(handle) {
    this.exports.urdd_robot_close(handle);
  }

  ask(handle, question) {
    const bytes = new TextEncoder().encode(JSON.stringify(question));
    const answer = this.#with([bytes], (at) =>
      this.#answer(this.exports.urdd_robot_ask(handle, at[0], bytes.length)),
    );
    if (answer !== null && typeof answer === "object" && "error" in answer) throw new Error(answer.error);
    return answer;
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
    const text = new TextDecoder().decode(new Uint8Array(buffer, at + 4, length).slice());
    this.exports.urdd_free_answer(at);
    return JSON.parse(text);
  }
}
