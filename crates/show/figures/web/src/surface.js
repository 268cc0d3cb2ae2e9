// A surface on the graphics card: painted by its values, or as a ghost around the other one; and what a ray meets on it.

import {
  Box3, BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, LinearFilter, Mesh, Ray, RGBAFormat, ShaderMaterial, Sphere, UnsignedByteType, Vector3,
} from "three";
import { MeshBVH } from "three-mesh-bvh/src/core/MeshBVH.js";
import { CENTER } from "three-mesh-bvh/src/core/Constants.js";
import { KINDS, SCALE_GLSL } from "./scale.js";

const VERTEX = `
attribute float part;
varying float vPart;
varying vec3 vPosition;
void main() {
  vPart = part;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  vPosition = seen.xyz;
  gl_Position = projectionMatrix * seen;
}`;

// Normals are those of the faces: a mesh is its faces, and smoothing would hide what is measured. The light comes from beside
// the camera and is weak, so that colours stay comparable with the legend.
const LIT = `
varying vec3 vPosition;
vec3 facing() { return normalize(cross(dFdx(vPosition), dFdy(vPosition))); }
float light() { return 0.68 + 0.36 * max(0.0, dot(facing(), normalize(vec3(0.25, 0.4, 1.0)))); }
`;

const PAINTED = `
uniform sampler2D colors;
uniform int scaleKind;
uniform bool scaleSigned;
uniform float scaleGain;
uniform float threshold;
uniform int paint;
uniform float fade;
uniform vec3 neutral;
uniform vec3 contrast;
varying float vPart;
${LIT}
${SCALE_GLSL}
void main() {
  vec3 color = texture2D(colors, vec2((place(vPart * scaleGain) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  if (paint == 1) color = abs(vPart) > threshold ? contrast : mix(neutral, color, 0.12);
  if (paint == 2) color = neutral;
  color = mix(color, neutral, fade);
  gl_FragColor = vec4(color * light(), 1.0);
}`;

const GHOST = `
uniform vec3 neutral;
uniform float opacity;
${LIT}
void main() {
  float rim = 1.0 - abs(dot(facing(), normalize(vPosition)));
  gl_FragColor = vec4(neutral, opacity * (0.35 + 1.4 * rim * rim));
}`;

const SOLID = `
uniform vec3 neutral;
${LIT}
void main() { gl_FragColor = vec4(neutral * light(), 1.0); }`;

/** Colours are in sRGB from the table to the screen. */
export function raw(color) {
  return new Color().setStyle(color, "srgb-linear");
}

export function colorTexture(table) {
  const entries = table.length / 3;
  const bytes = new Uint8Array(4 * entries).fill(255);
  for (let i = 0; i < entries; i++) bytes.set(table.subarray(3 * i, 3 * i + 3), 4 * i);
  const texture = new DataTexture(bytes, entries, 1, RGBAFormat, UnsignedByteType);
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export function solidMaterial(color, inFront = 0) {
  return new ShaderMaterial({
    vertexShader: VERTEX, fragmentShader: SOLID, side: DoubleSide, uniforms: { neutral: { value: color } },
    polygonOffset: inFront !== 0, polygonOffsetFactor: -inFront, polygonOffsetUnits: -4 * inFront,
  });
}

export class Surface {
  /**
   * Positions are relative to the page's origin and in its scale; three indices for each triangle; the face of each triangle
   * where they are not the same; a value for each vertex where some were measured. Surfaces that differ in values only share
   * the rest with the first one.
   */
  constructor({ positions, indices, faces, values, like }) {
    Object.assign(this, { positions, indices, faces, values, like });
    this.triangles = indices.length / 3;
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute("position", like?.geometry.getAttribute("position") ?? new BufferAttribute(positions, 3));
    this.geometry.setIndex(like?.geometry.index ?? new BufferAttribute(indices, 1));
    this.largest = 0;
    if (values) {
      for (const value of values) if (Math.abs(value) > this.largest) this.largest = Math.abs(value);
      // Divided by the largest, so that very small and very large units fit into single precision.
      const by = this.largest || 1;
      this.geometry.setAttribute("part", new BufferAttribute(Float32Array.from(values, (value) => value / by), 1));
    }
    this.geometry.computeBoundingBox();
  }

  faceOf(triangle) {
    return this.faces ? this.faces[triangle] : triangle;
  }

  /** The surface in the colours of its values. */
  painted(texture, contrast) {
    const uniforms = {
      colors: { value: texture }, scaleKind: { value: 0 }, scaleSigned: { value: false }, scaleGain: { value: 1 },
      threshold: { value: 1 }, paint: { value: 0 }, fade: { value: 0 }, neutral: { value: new Color() }, contrast: { value: raw(contrast) },
    };
    const material = new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: PAINTED, side: DoubleSide, uniforms });
    const mesh = new Mesh(this.geometry, material);
    mesh.frustumCulled = false;
    const largest = this.largest || 1;
    mesh.userData.scale = (scale) => {
      uniforms.scaleKind.value = KINDS.indexOf(scale.kind);
      uniforms.scaleSigned.value = scale.signed;
      uniforms.scaleGain.value = largest / scale.end;
    };
    mesh.userData.paint = (how, threshold) => {
      uniforms.paint.value = ["map", "threshold", "neutral"].indexOf(how);
      uniforms.threshold.value = threshold / largest;
    };
    return mesh;
  }

  ghost() {
    const uniforms = { neutral: { value: new Color() }, opacity: { value: 0.3 } };
    const mesh = new Mesh(this.geometry, new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: GHOST, side: DoubleSide, transparent: true, depthWrite: false, uniforms,
    }));
    mesh.frustumCulled = false;
    return mesh;
  }

  /** The part that has these faces, in the colours of the whole. */
  part(whole, faces) {
    const wanted = new Set(faces);
    const index = [];
    for (let t = 0; t < this.triangles; t++) {
      if (wanted.has(this.faceOf(t))) index.push(this.indices[3 * t], this.indices[3 * t + 1], this.indices[3 * t + 2]);
    }
    const geometry = new BufferGeometry();
    for (const name of ["position", "part"]) geometry.setAttribute(name, this.geometry.getAttribute(name));
    geometry.setIndex(index);
    const { material } = whole;
    // Everything but how much it fades is shared with the whole.
    const uniforms = { ...material.uniforms, fade: { value: 0 } };
    const mesh = new Mesh(geometry, new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: PAINTED, side: DoubleSide, uniforms, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -4,
    }));
    mesh.frustumCulled = false;
    return mesh;
  }

  /** The tree that rays are traced with, built when the first one is. */
  get tree() {
    if (this.like) return this.like.tree;
    this.built ??= new MeshBVH(this.geometry, { indirect: true, strategy: CENTER, targetLeafSize: 8 });
    return this.built;
  }

  /** What a ray meets first: the triangle, weights of its corners, and the value there. */
  trace(ray) {
    const hit = this.tree.raycastFirst(ray, DoubleSide);
    if (!hit) return null;
    const weights = this.weights(hit.faceIndex, ray);
    const corners = [0, 1, 2].map((k) => this.indices[3 * hit.faceIndex + k]);
    const values = this.values && corners.map((i) => this.values[i]);
    const value = values && weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2];
    return { triangle: hit.faceIndex, face: this.faceOf(hit.faceIndex), distance: hit.distance, point: hit.point.toArray(), weights, values, value };
  }

  blocked(from, to) {
    const direction = new Vector3().subVectors(to, from);
    const length = direction.length();
    const hit = this.tree.raycastFirst(new Ray(from, direction.divideScalar(length)), DoubleSide);
    return hit !== null && hit.distance < length * 0.999;
  }

  /** Barycentric coordinates of where a ray crosses a triangle's plane, limited to the triangle. */
  weights(triangle, ray) {
    const [a, b, c] = [0, 1, 2].map((k) => new Vector3().fromArray(this.positions, 3 * this.indices[3 * triangle + k]));
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

/** Points enough to know how large surfaces look. */
const OUTLINE = 3000;

/** A ball around the middle of all surfaces, and some of their points. */
export function extentOf(surfaces) {
  const box = surfaces.reduce((all, { geometry }) => all.union(geometry.boundingBox), new Box3());
  const sphere = new Sphere(box.getCenter(new Vector3()), 0);
  const outline = [];
  for (const { positions } of surfaces) {
    const step = Math.ceil(positions.length / 3 / OUTLINE);
    const point = new Vector3();
    for (let i = 0; i < positions.length / 3; i++) {
      point.fromArray(positions, 3 * i);
      sphere.radius = Math.max(sphere.radius, point.distanceTo(sphere.center));
      if (i % step === 0) outline.push(point.clone());
    }
  }
  // A single point is looked at from somewhere, too.
  sphere.radius ||= 1;
  return { sphere, outline };
}
