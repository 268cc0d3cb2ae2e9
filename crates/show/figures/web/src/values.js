// Numbers or vectors on a mesh: at corners, vertices or faces.

import { BufferAttribute } from "three";

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
