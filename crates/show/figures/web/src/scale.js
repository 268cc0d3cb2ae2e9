// From values to places on the colour map: the one rule that shader, legend and charts follow.

import { ticks } from "./format.js";

/** Decades that the logarithmic scale shows below its end. */
const DECADES = 4;
export const KINDS = ["linear", "root", "logarithmic"];

/** Places are from 0 to 1; signed values have theirs on both sides of the middle. */
export class Scale {
  constructor(signed) {
    this.signed = signed;
    this.kind = "linear";
    this.end = 1;
  }

  /** Where the size of a value belongs, from 0 at the low end to 1 at the high end, not limited. */
  #size(size) {
    const part = size / this.end;
    if (this.kind === "root") return Math.sqrt(part);
    if (this.kind === "logarithmic") return 1 + Math.log10(Math.max(part, 1e-300)) / DECADES;
    return part;
  }

  place(value) {
    const size = Math.min(1, Math.max(0, this.#size(Math.abs(value))));
    return this.signed ? 0.5 + 0.5 * Math.sign(value) * size : size;
  }

  /** Values to write at the legend. */
  marks() {
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
  if (scaleKind == 2) size = 1.0 + log2(max(size, 1e-30)) * ${(Math.log10(2) / DECADES).toFixed(9)};
  size = clamp(size, 0.0, 1.0);
  return scaleSigned ? 0.5 + 0.5 * sign(part) * size : size;
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
