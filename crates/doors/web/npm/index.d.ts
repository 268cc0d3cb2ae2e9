/** An error of a call; its message is a sentence that says what to do. */
export class PompeiuError extends Error {}

/** What is told while an answer is computed. */
export interface Progress {
  /** The current activity, in a few words. */
  doing: string;
  /** The share that is done, between 0 and 1; null where it is unknown. */
  share: number | null;
  /** The direction that is searched; null outside of a search. */
  direction: "a_to_b" | "b_to_a" | null;
  /** Bounds of the largest distance of that direction so far, not yet certified. */
  bounds: [number, number] | null;
}

/** What is known of a mesh that was read or made. */
export interface Facts {
  mesh: number;
  input: { path: string | null; vertices: number; faces: number; sha256: string | null };
  file: { format: string; compressed: boolean; polygons_triangulated: number; faces_dropped: number } | null;
  groups: string[];
  bounds: [[number, number, number], [number, number, number]];
  diagonal: number;
}

export type Format = "obj" | "ply" | "stl" | "off" | "vtp" | "vtu" | "glb";

/** A mesh that the engine holds until it is freed. */
export class Mesh {
  readonly id: number;
  readonly facts: Facts;
  /** Three coordinates for each vertex; a copy. */
  get positions(): Float64Array;
  /** Three indices for each face; a copy. */
  get faces(): Uint32Array;
  /** The mesh as the bytes of a file. */
  write(format: Format): Uint8Array;
  /** Releases its memory. */
  free(): void;
}

/** Limits of a computation; what is found within them holds, but may be wider than asked. */
export interface Limits {
  /** Seconds. */
  timeLimit?: number;
  /** Bytes. */
  memoryLimit?: number;
}

/** What a system found. */
export interface Found<A> {
  /** What the command prints with `--json`. */
  answer: A;
  /** 0 as asked, 1 refuted, 3 valid but less than asked. */
  exitCode: 0 | 1 | 3;
  /** What a person should know. */
  notes: string[];
  /** Resulting meshes. */
  meshes: Record<string, Mesh>;
  /** Numbers beside the answer, such as the distance of each vertex. */
  arrays: Record<string, Float64Array | Uint32Array | Uint8Array>;
}

/** The engine. */
export class Pompeiu {
  /** Reads a mesh from the bytes of a file of any known format, compressed or not. */
  read(bytes: Uint8Array, name: string): Mesh;
  /** Makes a mesh of three coordinates for each vertex and three indices for each face. */
  mesh(positions: ArrayLike<number>, faces: ArrayLike<number>, name?: string): Mesh;
  /** Asks a system: options are those of its request, with defaults for all others. */
  ask<C extends keyof Answers>(command: C, meshes: Mesh[], options?: Partial<Answers[C]["request"]>, limits?: Limits): Found<Answers[C]>;
  /** A page to explore of what was asked last: HTML. */
  page(commandLine?: string): string;
  /** A document for printing of the deviation that was asked last: PDF. */
  document(commandLine?: string): Uint8Array;
  /** The defaults of all options, by command. */
  defaults(): Record<string, Record<string, unknown>>;
}

/** Loads the engine: from the module beside the script, or from its bytes. */
export function load(options?: { wasm?: BufferSource; onProgress?: (progress: Progress) => void }): Promise<Pompeiu>;
