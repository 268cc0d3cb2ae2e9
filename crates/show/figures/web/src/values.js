// Numbers or vectors on a mesh: at corners, vertices or faces.

import { BufferAttribute, Vector3 } from "three";

/** Columns that sizes are counted in. */
const FINE = 200;

export class Values {
  constructor({ mesh, scale, on, width, data }) {
    Object.assign(this, { mesh, scale, on, width, data });
    this.vector = width === 3;
    if (this.vector) {
      this.sizes = new Float64Array(data.length / 3);
      for (let i = 0; i < this.sizes.length; i++) this.sizes[i] = Math.hypot(data[3 * i], data[3 * i + 1], data[3 * i + 2]);
    } else {
      this.sizes = data;
    }
  }

  /** The element that a corner of a triangle has its value from. */
  #element(mesh, triangle, corner) {
    if (this.on === "face") return mesh.faceOf(triangle);
    const index = mesh.indices[3 * triangle + corner];
    return this.on === "vertex" ? mesh.places[index] : index;
  }

  /** Parts of the whole scale for the corners of a mesh as it is drawn; corners of a face lie apart where values are those of faces. */
  attribute(mesh) {
    const [low, by] = [this.scale.low ?? 0, this.scale.whole];
    const part = (element) => (this.sizes[element] - low) / by;
    if (this.on === "face") {
      const parts = new Float32Array(3 * mesh.triangles);
      for (let t = 0; t < mesh.triangles; t++) parts.fill(part(mesh.faceOf(t)), 3 * t, 3 * t + 3);
      return new BufferAttribute(parts, 1);
    }
    return new BufferAttribute(Float32Array.from(mesh.places, (place, i) => part(this.on === "vertex" ? place : i)), 1);
  }

  /** Areas of the triangles of a mesh, each between its least and its greatest value; made once. */
  spread(mesh) {
    if (this.spreadOver) return this.spreadOver;
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    const columns = new Map();
    for (let t = 0; t < mesh.triangles; t++) {
      [a, b, c].forEach((corner, k) => corner.fromArray(mesh.positions, 3 * mesh.indices[3 * t + k]));
      const area = b.sub(a).cross(c.sub(a)).length();
      const value = [0, 1, 2].reduce((sum, k) => sum + this.sizes[this.#element(mesh, t, k)] / 3, 0);
      const column = Math.floor((value / this.scale.whole) * FINE);
      columns.set(column, (columns.get(column) ?? 0) + area);
    }
    const width = this.scale.whole / FINE;
    this.spreadOver = [...columns].map(([column, area]) => [column * width, (column + 1) * width, area]);
    return this.spreadOver;
  }

  /** Shares of the area between levels, ascending: below the first, between two, above the last; of what is drawn, linear on triangles. */
  shares(mesh, levels) {
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    this.areas ??= Float64Array.from({ length: mesh.triangles }, (_, t) => {
      [a, b, c].forEach((corner, k) => corner.fromArray(mesh.positions, 3 * mesh.indices[3 * t + k]));
      return b.sub(a).cross(c.sub(a)).length() / 2;
    });
    const below = new Float64Array(levels.length);
    let whole = 0;
    for (let t = 0; t < mesh.triangles; t++) {
      const values = [0, 1, 2].map((k) => this.sizes[this.#element(mesh, t, k)]).sort((p, q) => p - q);
      whole += this.areas[t];
      for (let i = 0; i < levels.length; i++) below[i] += this.areas[t] * partBelow(values, levels[i]);
    }
    const places = [0, ...below, whole];
    return places.slice(1).map((end, i) => (end - places[i]) / whole);
  }

  /** At a point of a triangle: the value, those of the corners, and the vector if there is one. */
  at(mesh, triangle, weights) {
    const elements = [0, 1, 2].map((corner) => this.#element(mesh, triangle, corner));
    const mix = (corners) => (this.on === "face" ? corners[0] : weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2]);
    if (!this.vector) {
      const values = elements.map((element) => this.data[element]);
      return { values, value: mix(values) };
    }
    const vector = [0, 1, 2].map((k) => mix(elements.map((element) => this.data[3 * element + k])));
    const value = this.on === "face" ? this.sizes[elements[0]] : Math.hypot(...vector);
    return { values: elements.map((element) => this.sizes[element]), value, vector };
  }
}

/** The part of a triangle where a linear function with these values at its corners, ascending, is below a level. */
function partBelow([a, b, c], level) {
  if (level <= a) return 0;
  if (level < b) return ((level - a) / (b - a)) * ((level - a) / (c - a));
  if (level < c) return 1 - ((c - level) / (c - b)) * ((c - level) / (c - a));
  return 1;
}
