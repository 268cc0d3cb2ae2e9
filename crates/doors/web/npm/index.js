// The engine for JavaScript: typed arrays and files in, JSON and typed arrays out. Calls are answered in the thread that makes them:
// in pages, load the package in a worker.

import { Engine, PompeiuError } from "./engine.js";

export { PompeiuError };

const VIEWS = { f64: Float64Array, u32: Uint32Array, u8: Uint8Array };

/** The bytes of the module, from the file beside this one. */
async function module() {
  const url = new URL("./pompeiu.wasm", import.meta.url);
  if (url.protocol === "file:" && globalThis.process?.versions?.node) {
    // Bundlers for browsers would look for a literal name, and not find it.
    const name = "node:fs/promises";
    const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ name);
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new PompeiuError(`${url}: ${response.status} ${response.statusText}; serve pompeiu.wasm beside the script`);
  return response.arrayBuffer();
}

/** A mesh that the engine holds. */
export class Mesh {
  #engine;

  constructor(engine, facts) {
    this.#engine = engine;
    this.id = facts.mesh;
    this.facts = facts;
    Object.freeze(this);
  }

  #array(name, View) {
    const { reply, arrays } = this.#engine.call({ call: "arrays", mesh: this.id });
    return new View(arrays[reply.arrays[name].index].buffer);
  }

  get positions() {
    return this.#array("positions", Float64Array);
  }

  get faces() {
    return this.#array("faces", Uint32Array);
  }

  write(format) {
    return this.#engine.call({ call: "write", mesh: this.id, format }).arrays[0];
  }

  free() {
    this.#engine.call({ call: "forget", mesh: this.id });
  }
}

const bytesOf = (array) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);

export class Pompeiu {
  #engine;

  constructor(engine) {
    this.#engine = engine;
  }

  read(bytes, name) {
    return new Mesh(this.#engine, this.#engine.call({ call: "read", name }, [bytes]).reply);
  }

  mesh(positions, faces, name = "") {
    const arrays = [bytesOf(Float64Array.from(positions)), bytesOf(Uint32Array.from(faces))];
    return new Mesh(this.#engine, this.#engine.call({ call: "mesh", name }, arrays).reply);
  }

  ask(command, meshes, options = {}, limits = {}) {
    const { timeLimit: time_limit, memoryLimit: memory_limit } = limits;
    const call = { call: "ask", command, meshes: meshes.map(({ id }) => id), options, limits: { time_limit, memory_limit } };
    const { reply, arrays } = this.#engine.call(call);
    const views = Object.entries(reply.arrays).map(([name, { index, entries }]) => [name, new VIEWS[entries](arrays[index].buffer)]);
    return {
      answer: reply.answer,
      exitCode: reply.exit_code,
      notes: reply.notes,
      meshes: Object.fromEntries(Object.entries(reply.meshes).map(([name, facts]) => [name, new Mesh(this.#engine, facts)])),
      arrays: Object.fromEntries(views),
    };
  }

  page(commandLine) {
    return new TextDecoder().decode(this.#engine.call({ call: "page", command_line: commandLine }).arrays[0]);
  }

  document(commandLine) {
    return this.#engine.call({ call: "document", command_line: commandLine }).arrays[0];
  }

  defaults() {
    return this.#engine.call({ call: "commands" }).reply.commands;
  }
}

/** Loads the engine. */
export async function load({ wasm, onProgress } = {}) {
  return new Pompeiu(await Engine.from(wasm ?? (await module()), onProgress));
}
