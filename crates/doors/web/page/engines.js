// Where calls are answered: in a worker of the page.
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
