// From values to places on the colour map: the one rule that shader, legend and charts follow.

import { colorTexture, raw } from "./color.js";
import { ticks } from "./format.js";

/** Decades that the logarithmic scale shows below its end. */
const DECADES = 4;
export const KINDS = ["linear", "root", "logarithmic", "steps", "bands"];
/** Steps of a discrete scale. */
const STEPS = 10;
/** Ends of classes that the card knows at most. */
const MOST_EDGES = 15;
/** How far the bar goes beyond the outermost end of a class. */
const BEYOND_EDGES = 1.1;
/** The part of the colour map that classes take: its ends are too dark to be told apart when lit. */
const CLASSES = [0.12, 0.88];

/** Places are from 0 to 1; signed values have theirs on both sides of the middle. */
export class Scale {
  constructor(data) {
    this.data = data;
    this.signed = data.signed;
    /** The lowest value, where it is not zero by nature. */
    this.low = data.low;
    /** Ends of classes, ascending: each class has one colour. */
    this.edges = (data.bands ?? []).slice(0, MOST_EDGES);
    /** Whether ends of classes were moved from where they were given. */
    this.moved = false;
    this.kind = this.edges.length ? "bands" : "linear";
    /** An end that was dragged to; a choice of the list takes it back. */
    this.custom = null;
    /** All values are divided by it for the card, so that very small and very large units fit into single precision. */
    this.whole = data.end || 1;
    this.end = this.whole;
    this.range = data.range ?? 0;
    this.threshold = data.threshold ?? this.whole;
    this.painting = data.painting ?? false;
    this.table = Uint8Array.from(data.colors.table);
    this.contrast = `rgb(${data.colors.contrast.join(", ")})`;
    this.uniforms = {
      colors: { value: colorTexture(this.table) }, scaleKind: { value: 0 }, scaleSigned: { value: this.signed }, scaleGain: { value: 1 },
      threshold: { value: 1 }, painting: { value: false }, contrast: { value: raw(this.contrast) }, banded: { value: false },
      edgeCount: { value: 0 }, edges: { value: new Float32Array(MOST_EDGES) },
    };
  }

  /** A number of this scale with its unit, where that is known. */
  withUnit(text) {
    return this.data.unit ? `${text} ${this.data.unit}` : text;
  }

  /** Where the scale of these scenes ends by one of the choices. */
  #endOf(range, scenes) {
    const choice = this.data.ranges[range];
    if (!choice) return this.whole;
    if (!choice.ends) return this.threshold;
    return Math.max(0, ...choice.ends.filter(([scene]) => scenes.includes(scene)).map(([, end]) => end));
  }

  /** Brings the end and the card up to date for the scenes that are shown. */
  update(scenes) {
    this.largest = this.#endOf(0, scenes);
    this.uniforms.banded.value = this.kind === "bands";
    this.end = (this.custom ?? this.#endOf(this.range, scenes)) || 1;
    // All ends of classes are on the bar, where they were given and where they are.
    if (this.kind === "bands") this.end = Math.max(this.end, ...[...this.data.bands ?? [], ...this.edges].map((edge) => Math.abs(edge) * BEYOND_EDGES));
    this.uniforms.edgeCount.value = this.edges.length;
    this.edges.forEach((edge, i) => (this.uniforms.edges.value[i] = edge / this.whole));
    this.uniforms.scaleKind.value = KINDS.indexOf(this.kind);
    this.uniforms.scaleGain.value = this.whole / this.end;
    this.uniforms.threshold.value = (this.threshold - (this.low ?? 0)) / this.whole;
    this.uniforms.painting.value = this.painting;
  }

  /** Where the size of a value belongs, from 0 at the low end to 1 at the high end, not limited. */
  #size(size) {
    const part = size / this.end;
    if (this.kind === "root") return Math.sqrt(part);
    if (this.kind === "logarithmic") return 1 + Math.log10(Math.max(part, 1e-300)) / DECADES;
    if (this.kind === "steps") return (Math.min(STEPS - 1, Math.floor(part * STEPS)) + 0.5) / STEPS;
    return part;
  }

  /** Where a value stands on the bar when colours go by steps. */
  linear(value) {
    const part = Math.min(1, Math.abs(value) / this.end);
    return this.signed ? 0.5 + 0.5 * Math.sign(value) * part : part;
  }

  /** Moves the end of a class, as far as its neighbours and the bar allow, to a number with few digits. */
  moveEdge(index, value) {
    const step = 10 ** (Math.floor(Math.log10(this.end)) - 2);
    const most = this.end / BEYOND_EDGES;
    const low = Math.max((this.edges[index - 1] ?? -Infinity) + step, this.signed ? -most : 0);
    const high = Math.min((this.edges[index + 1] ?? Infinity) - step, most);
    if (!(low < high)) return;
    this.edges[index] = Math.min(high, Math.max(low, Number((Math.round(value / step) * step).toPrecision(6))));
    this.moved = true;
  }

  /** The ends of classes as they were given. */
  takeBackEdges() {
    if (!this.moved) return;
    this.edges = this.data.bands.slice(0, MOST_EDGES);
    this.moved = false;
  }

  /** The class of a value: the first end belongs to the class above it, the others to those below. */
  classOf(value) {
    return value < this.edges[0] ? 0 : 1 + this.edges.slice(1).filter((edge) => value > edge).length;
  }

  /** Where the colour of a class is on the map. */
  classPlace(index) {
    return CLASSES[0] + ((CLASSES[1] - CLASSES[0]) * index) / this.edges.length;
  }

  /** What classes are called, from the lowest. */
  classNames(name) {
    const all = this.edges.map(name);
    return [`< ${all[0]}`, ...all.slice(1).map((edge, i) => `${all[i]} \u2026 ${edge}`), `> ${all.at(-1)}`];
  }

  place(value) {
    if (this.low !== null) return Math.min(1, Math.max(0, (value - this.low) / this.end));
    const size = Math.min(1, Math.max(0, this.#size(Math.abs(value))));
    return this.signed ? 0.5 + 0.5 * Math.sign(value) * size : size;
  }

  colorOf(value) {
    return this.colorAt(this.kind === "bands" ? this.classPlace(this.classOf(value)) : this.place(value));
  }

  colorAt(place) {
    const at = Math.round(place * 255) * 3;
    return `rgb(${this.table[at]} ${this.table[at + 1]} ${this.table[at + 2]})`;
  }

  /** Values to write at the legend. */
  marks() {
    if (this.low !== null) return ticks(this.low, this.low + this.end, 5);
    let sizes;
    if (this.kind === "logarithmic") {
      const top = Math.floor(Math.log10(this.end) + 1e-9);
      sizes = Array.from({ length: DECADES }, (_, i) => Number(`1e${top - i}`)).reverse();
    } else {
      sizes = ticks(0, this.end, this.signed ? 2 : 4);
    }
    return this.signed ? [...sizes.filter((x) => x > 0).reverse().map((x) => -x), ...sizes] : sizes;
  }
}

/** The same rule in the shader's language, with sizes already divided by the end. */
export const SCALE_GLSL = `
float place(float part) {
  float size = abs(part);
  if (scaleKind == 1) size = sqrt(size);
  if (scaleKind == 3) size = (min(floor(size * ${STEPS}.0), ${STEPS - 1}.0) + 0.5) / ${STEPS}.0;
  if (scaleKind == 2) size = 1.0 + log2(max(size, 1e-30)) * ${(Math.log10(2) / DECADES).toFixed(9)};
  size = clamp(size, 0.0, 1.0);
  return scaleSigned ? 0.5 + 0.5 * sign(part) * size : size;
}`;

/** The colour of the class of a value, with the same ends divided by the whole. */
export const CLASSES_GLSL = `
uniform bool banded;
uniform int edgeCount;
uniform float edges[${MOST_EDGES}];
vec3 classColor(float part) {
  float index = 0.0;
  for (int i = 0; i < ${MOST_EDGES}; i++) {
    if (i >= edgeCount) break;
    if (i == 0 ? part >= edges[i] : part > edges[i]) index += 1.0;
  }
  float at = ${CLASSES[0]} + ${CLASSES[1] - CLASSES[0]} * index / float(edgeCount);
  return texture2D(colors, vec2((at * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}`;

/** The table as a gradient for style sheets. */
export function gradientOf(table) {
  const entries = table.length / 3;
  const stops = Array.from({ length: 33 }, (_, i) => {
    const entry = Math.round((i * (entries - 1)) / 32) * 3;
    return `rgb(${table[entry]} ${table[entry + 1]} ${table[entry + 2]})`;
  });
  return `linear-gradient(to right, ${stops.join(", ")})`;
}
