// Arrays as the page holds them: base64 of zlib of the bytes of all elements, sorted by significance.

const TYPES = { f32: Float32Array, f64: Float64Array, u32: Uint32Array };

/** A typed array, from its description in the page's data. */
export async function decode({ type, length, coding, data }) {
  const Type = TYPES[type];
  const width = Type.BYTES_PER_ELEMENT;
  const planes = await inflate(bytesOf(data));
  if (planes.length !== length * width) {
    throw new Error(`${length * width} bytes of an array were announced, and ${planes.length} are there`);
  }
  const bytes = new Uint8Array(planes.length);
  for (let plane = 0; plane < width; plane++) {
    const from = plane * length;
    for (let i = 0, to = plane; i < length; i++, to += width) bytes[to] = planes[from + i];
  }
  const array = new Type(bytes.buffer);
  return coding === "highwater" ? fromHighwater(array) : array;
}

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The position of each corner, from positions that corners share. */
export function spread(positions, places) {
  const all = new Float32Array(3 * places.length);
  for (let i = 0; i < places.length; i++) {
    for (let k = 0; k < 3; k++) all[3 * i + k] = positions[3 * places[i] + k];
  }
  return all;
}

/** Indices in the order of first use: each says how far it is below the first that was not used yet. */
function fromHighwater(codes) {
  let unused = 0;
  for (let i = 0; i < codes.length; i++) {
    const code = codes[i];
    codes[i] = unused - code;
    if (code === 0) unused++;
  }
  return codes;
}
