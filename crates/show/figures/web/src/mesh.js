// A mesh on the graphics card, and what a ray meets on it.

import { BufferAttribute, BufferGeometry, DoubleSide, Ray, Vector3 } from "three";
import { MeshBVH } from "three-mesh-bvh/src/core/MeshBVH.js";
import { isCut, SECTION } from "./section.js";
import { CENTER } from "three-mesh-bvh/src/core/Constants.js";

export class Mesh {
  /**
   * Positions of corners, in the coordinates of the view; three indices of corners for each triangle; the vertex of each corner;
   * the face of each triangle where they are not the same. Linked meshes have triangles that correspond.
   */
  constructor({ name, element, space, link, faceCount, positions, indices, places, faces }) {
    Object.assign(this, { name, element, space, link, faceCount, positions, indices, places, faces });
    this.triangles = indices.length / 3;
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute("position", new BufferAttribute(positions, 3));
    this.geometry.setIndex(new BufferAttribute(indices, 1));
  }

  faceOf(triangle) {
    return this.faces ? this.faces[triangle] : triangle;
  }

  /** Corners of each triangle by themselves: values differ from face to face. */
  get apart() {
    if (!this.separate) {
      const corners = new Float32Array(3 * this.indices.length);
      this.indices.forEach((index, i) => corners.set(this.positions.subarray(3 * index, 3 * index + 3), 3 * i));
      this.separate = { position: new BufferAttribute(corners, 3), index: new BufferAttribute(Uint32Array.from(this.indices, (_, i) => i), 1) };
    }
    return this.separate;
  }

  /** The mesh with these values; everything else is shared. */
  withValues(values) {
    const geometry = new BufferGeometry();
    const { position, index } = values.on === "face" ? this.apart : { position: this.geometry.getAttribute("position"), index: this.geometry.index };
    geometry.setAttribute("position", position);
    geometry.setIndex(index);
    geometry.setAttribute("part", values.attribute(this));
    return geometry;
  }

  /** The part of a geometry of this mesh that has these faces. */
  part(geometry, faces) {
    const wanted = new Set(faces);
    const index = [];
    for (let t = 0; t < this.triangles; t++) {
      if (wanted.has(this.faceOf(t))) for (let k = 0; k < 3; k++) index.push(geometry.index.array[3 * t + k]);
    }
    const part = new BufferGeometry();
    for (const [name, attribute] of Object.entries(geometry.attributes)) part.setAttribute(name, attribute);
    part.setIndex(index);
    return part;
  }

  /** The tree that rays are traced with, built when the first one is. */
  get tree() {
    this.built ??= new MeshBVH(this.geometry, { indirect: true, strategy: CENTER, targetLeafSize: 8 });
    return this.built;
  }

  /** What a ray meets first: the triangle, its face, and weights of its corners. */
  trace(ray) {
    const hit = this.#firstHit(ray);
    if (!hit) return null;
    return {
      mesh: this, triangle: hit.faceIndex, face: this.faceOf(hit.faceIndex), distance: hit.distance, point: hit.point.toArray(),
      weights: this.weights(hit.faceIndex, ray),
    };
  }

  /** The first hit that is not cut away. */
  #firstHit(ray) {
    if (SECTION.value.lengthSq() === 0) return this.tree.raycastFirst(ray, DoubleSide);
    const hits = this.tree.raycast(ray, DoubleSide).filter(({ point }) => !isCut(point.toArray()));
    return hits.reduce((first, hit) => (first && first.distance <= hit.distance ? first : hit), null);
  }

  /** The nearest point of what is drawn. */
  nearest(point) {
    return this.tree.closestPointToPoint(point)?.point.clone() ?? null;
  }

  /** The nearest point of what is drawn, with the normal there. */
  foot(point) {
    const found = this.tree.closestPointToPoint(point);
    if (!found) return null;
    const [a, b, c] = this.corners(found.faceIndex);
    return { point: found.point.clone(), normal: b.sub(a).cross(c.sub(a)).normalize() };
  }

  /** How far along a ray its last hit is; 0 without one. */
  last(ray) {
    return this.tree.raycast(ray, DoubleSide).reduce((last, { distance }) => Math.max(last, distance), 0);
  }

  blocked(from, to) {
    const direction = new Vector3().subVectors(to, from);
    const length = direction.length();
    const hit = this.tree.raycastFirst(new Ray(from, direction.divideScalar(length)), DoubleSide);
    return hit !== null && hit.distance < length * 0.999;
  }

  corners(triangle) {
    return [0, 1, 2].map((k) => new Vector3().fromArray(this.positions, 3 * this.indices[3 * triangle + k]));
  }

  /** The point of a triangle with these weights. */
  pointAt(triangle, weights) {
    return this.corners(triangle).reduce((sum, corner, k) => sum.addScaledVector(corner, weights[k]), new Vector3());
  }

  /** Barycentric coordinates of where a ray crosses a triangle's plane, limited to the triangle. */
  weights(triangle, ray) {
    const [a, b, c] = this.corners(triangle);
    const [u, v] = [b.clone().sub(a), c.clone().sub(a)];
    const across = new Vector3().crossVectors(ray.direction, v);
    const determinant = u.dot(across);
    if (determinant === 0) return [1, 0, 0];
    const from = ray.origin.clone().sub(a);
    let second = from.dot(across) / determinant;
    let third = ray.direction.dot(from.cross(u)) / determinant;
    second = Math.min(1, Math.max(0, second));
    third = Math.min(1 - second, Math.max(0, third));
    return [1 - second - third, second, third];
  }
}
