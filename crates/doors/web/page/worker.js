// The worker of the page: it answers calls one after the other, and is ended where one is cancelled.

let engine;
let current;

async function inflate(packed) {
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function answer({ id, packed, call, arrays }) {
  current = id;
  try {
    if (packed) {
      engine = await Engine.from(await inflate(packed), (told) => postMessage({ id: current, told }));
      postMessage({ id, reply: {}, arrays: [] });
      return;
    }
    const { reply, arrays: made } = engine.call(call, arrays);
    postMessage({ id, reply, arrays: made, memory: engine.memory }, made.map((bytes) => bytes.buffer));
  } catch (error) {
    // A module that has trapped is not asked again.
    const failed = error instanceof WebAssembly.RuntimeError;
    const message = failed
      ? "the work ended because the memory of the page, 4 GiB at most, or its stack did not suffice; use the command, which has neither limit"
      : error.message;
    postMessage({ id, error: message, failed });
  }
}

// One after the other: what comes while the module is unpacked waits for it.
let last = Promise.resolve();
onmessage = ({ data }) => {
  last = last.then(() => answer(data));
};
