// The engine in a WebAssembly module: calls as JSON with arrays of bytes beside them.

const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** An error of a call; its message is a sentence. */
export class PompeiuError extends Error {
  name = "PompeiuError";
}

/** Answers calls in this thread. */
export class Engine {
  #exports;

  /** An engine of the bytes of the module. `told` gets an object while an answer is computed. */
  static async from(bytes, told = () => {}) {
    const engine = new Engine();
    const imports = {
      now: () => performance.now(),
      told: (pointer, length) => told(JSON.parse(decoder.decode(engine.#slice(pointer, length)))),
    };
    const { instance } = await WebAssembly.instantiate(bytes, { pompeiu: imports });
    engine.#exports = instance.exports;
    return engine;
  }

  /** Bytes of memory that the module has taken. */
  get memory() {
    return this.#exports.memory.buffer.byteLength;
  }

  #slice(pointer, length) {
    return new Uint8Array(this.#exports.memory.buffer, pointer, length);
  }

  #give(bytes) {
    const pointer = this.#exports.array(bytes.byteLength) >>> 0;
    if (pointer === 0) throw new PompeiuError("there is not enough memory for the file; use the command, which has no limit of 4 GiB");
    this.#slice(pointer, bytes.byteLength).set(bytes);
  }

  /** Answers a call: an object, and the arrays beside it. */
  call(call, arrays = []) {
    this.#give(encoder.encode(JSON.stringify(call)));
    for (const array of arrays) this.#give(array);
    const count = this.#exports.call();
    const all = Array.from({ length: count }, (_, i) => this.#slice(this.#exports.pointer(i) >>> 0, this.#exports.length(i)));
    const reply = JSON.parse(decoder.decode(all[0]));
    if (reply.error) throw new PompeiuError(reply.error);
    return { reply, arrays: all.slice(1).map((bytes) => bytes.slice()) };
  }
}
