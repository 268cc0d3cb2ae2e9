// Where calls are answered: in a worker of the page, or by the program that serves it.
// `call` gives a promise of `{reply, arrays}`, `cancel` ends what is running, and `generation` changes when meshes are forgotten.

class Cancelled extends Error {}

class WorkerEngine {
  generation = 0;
  #source;
  #packed;
  #worker = null;
  #waiting = new Map();
  #last = 0;
  memory = 0;

  constructor(source, packed) {
    this.#source = source;
    this.#packed = packed;
  }

  /** Starts the worker, where it does not run yet. */
  start() {
    if (this.#worker) return;
    const url = URL.createObjectURL(new Blob([this.#source], { type: "text/javascript" }));
    this.#worker = new Worker(url);
    URL.revokeObjectURL(url);
    this.#worker.onmessage = ({ data }) => this.#answered(data);
    this.#worker.onerror = (event) => this.#end(new Error(event.message || "the worker ended"));
    // A failure is that of the call that follows.
    this.#send({ packed: this.#packed }).catch((error) => this.#end(error));
  }

  #send(message, told) {
    const id = ++this.#last;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject, told });
      this.#worker.postMessage({ id, ...message });
    });
  }

  #answered({ id, told, error, failed, reply, arrays, memory }) {
    const waiting = this.#waiting.get(id);
    if (!waiting) return;
    if (told) return void waiting.told?.(told);
    this.#waiting.delete(id);
    if (memory) this.memory = memory;
    if (error === undefined) return void waiting.resolve({ reply, arrays });
    waiting.reject(new Error(error));
    if (failed) this.#end(new Error(error));
  }

  #end(error) {
    this.#worker?.terminate();
    this.#worker = null;
    this.generation += 1;
    const all = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const { reject } of all) reject(error);
  }

  async call(call, arrays = [], told = undefined) {
    this.start();
    return this.#send({ call, arrays }, told);
  }

  cancel() {
    this.#end(new Cancelled("cancelled"));
  }
}

/** Milliseconds between questions how far a call is, and between reports that the page is open. */
const ASK = 200;
const REPORT = 20_000;

class ServerEngine {
  generation = 0;
  #page = crypto.randomUUID();
  #last = 0;
  #running = new Set();

  /** Reports that the page is open until it is closed. */
  start() {
    const report = () => void this.#fetch(`alive/${this.#page}`, { method: "POST" }).catch(() => {});
    report();
    setInterval(report, REPORT);
    addEventListener("pagehide", () => navigator.sendBeacon(`bye/${this.#page}`));
    addEventListener("pageshow", ({ persisted }) => {
      if (!persisted) return;
      // The program has forgotten the meshes of a page that was left.
      this.generation += 1;
      report();
    });
  }

  async #fetch(path, options = {}) {
    let response;
    try {
      response = await fetch(path, options);
    } catch (error) {
      if (options.signal?.aborted) throw new Cancelled("cancelled");
      throw new Error("The program that serves this page has ended; start pompeiu app again.");
    }
    if (!response.ok) throw new Error(await response.text());
    return response;
  }

  /** A file that the program was started with. */
  async file(index) {
    return (await this.#fetch(`file/${index}`)).blob();
  }

  async call(call, arrays = [], told = undefined) {
    const running = { number: ++this.#last, abort: new AbortController() };
    this.#running.add(running);
    const asking = told && setInterval(() => void this.#ask(told), ASK);
    try {
      const parts = [new TextEncoder().encode(JSON.stringify(call)), ...arrays];
      const body = new Blob([`${JSON.stringify(parts.map(({ byteLength }) => byteLength))}\n`, ...parts]);
      const { signal } = running.abort;
      const response = await this.#fetch(`call/${this.#page}/${running.number}`, { method: "POST", body, signal });
      const [json, ...made] = ServerEngine.#unframed(new Uint8Array(await response.arrayBuffer()));
      const reply = JSON.parse(new TextDecoder().decode(json));
      if (reply.error) throw new Error(reply.error);
      return { reply, arrays: made };
    } catch (error) {
      throw running.abort.signal.aborted ? new Cancelled("cancelled") : error;
    } finally {
      clearInterval(asking);
      this.#running.delete(running);
    }
  }

  async #ask(told) {
    try {
      const said = await (await this.#fetch(`told/${this.#page}`)).json();
      if (said && this.#running.size) told(said);
    } catch {
      // What is wrong is said by the call itself.
    }
  }

  /** A line of lengths, then the arrays. */
  static #unframed(bytes) {
    let at = bytes.indexOf(10) + 1;
    const lengths = JSON.parse(new TextDecoder().decode(bytes.subarray(0, at)));
    return lengths.map((length) => bytes.subarray(at, (at += length)));
  }

  cancel() {
    for (const { number, abort } of this.#running) {
      navigator.sendBeacon(`cancel/${this.#page}/${number}`);
      abort.abort();
    }
  }
}
