// A surface: coloured by values, plain, or a ghost around others; and pieces of a surface that stand out.

import { Box3, BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh as Drawn, ShaderMaterial, Vector3 } from "three";
import { RingMark } from "./marks.js";
import { CLASSES_GLSL, SCALE_GLSL } from "../scale.js";
import { SECTION } from "../section.js";

export const SURFACE_VERTEX = `
attribute float part;
varying float vPart;
varying vec3 vPosition;
varying vec3 vPlace;
void main() {
  vPart = part;
  vPlace = position;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  vPosition = seen.xyz;
  gl_Position = projectionMatrix * seen;
}`;

// Normals are those of the faces: a mesh is its faces, and smoothing would hide what is measured. The light comes from beside
// the camera and is weak, so that colours stay comparable with the legend.
const LIT = `
varying vec3 vPosition;
varying vec3 vPlace;
uniform vec4 section;
void cut() { if (dot(vPlace, section.xyz) > section.w) discard; }
vec3 facing() { return normalize(cross(dFdx(vPosition), dFdy(vPosition))); }
float light() { return 0.68 + 0.36 * max(0.0, dot(facing(), normalize(vec3(0.25, 0.4, 1.0)))); }
`;

const PAINTED = `
uniform sampler2D colors;
uniform int scaleKind;
uniform bool scaleSigned;
uniform float scaleGain;
uniform float threshold;
uniform bool painting;
uniform bool plain;
uniform float fade;
uniform vec3 neutral;
uniform vec3 contrast;
varying float vPart;
${LIT}
${SCALE_GLSL}
${CLASSES_GLSL}
void main() {
  cut();
  vec3 color = banded ? classColor(vPart) : texture2D(colors, vec2((place(vPart * scaleGain) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  if (painting) color = abs(vPart) > threshold ? contrast : mix(neutral, color, 0.12);
  if (plain) color = neutral;
  color = mix(color, neutral, fade);
  gl_FragColor = vec4(color * light(), 1.0);
}`;

const GHOST = `
uniform vec3 neutral;
uniform float opacity;
${LIT}
void main() {
  cut();
  float rim = 1.0 - abs(dot(facing(), normalize(vPosition)));
  gl_FragColor = vec4(neutral, opacity * (0.35 + 1.4 * rim * rim));
}`;

const SOLID = `
uniform vec3 neutral;
${LIT}
void main() {
  cut();
  gl_FragColor = vec4(neutral * light(), 1.0);
}`;

export function solidMaterial(color, inFront = 0) {
  return new ShaderMaterial({
    vertexShader: SURFACE_VERTEX, fragmentShader: SOLID, side: DoubleSide, uniforms: { neutral: { value: color }, section: SECTION },
    polygonOffset: inFront !== 0, polygonOffsetFactor: -inFront, polygonOffsetUnits: -4 * inFront,
  });
}

/** How much of its colour the rest of a surface loses while a place on it is looked at. */
const FADED = 0.72;
/** With more places than that, rings would hide what they point at. */
const RINGS = 8;

function drawn(geometry, material) {
  const object = new Drawn(geometry, material);
  object.frustumCulled = false;
  return object;
}

/** A mesh in the colours of its values, plain, or as a ghost. */
export class SurfaceLayer {
  constructor(app, { mesh, paint, values, bounds }) {
    this.mesh = app.meshes[mesh];
    this.paint = paint;
    this.values = values === null ? null : app.values[values];
    this.bounds = bounds === null ? null : app.bounds[bounds];
    this.neutral = { value: new Color() };
    if (this.values) {
      this.uniforms = { ...this.values.scale.uniforms, plain: { value: false }, fade: { value: 0 }, neutral: this.neutral, section: SECTION };
      this.object = drawn(this.mesh.withValues(this.values), this.#material(this.uniforms));
    } else if (paint === "ghost") {
      this.object = drawn(this.mesh.geometry, new ShaderMaterial({
        vertexShader: SURFACE_VERTEX, fragmentShader: GHOST, side: DoubleSide, transparent: true, depthWrite: false,
        uniforms: { neutral: this.neutral, opacity: { value: 0.42 }, section: SECTION },
      }));
      this.object.renderOrder = 2;
    } else {
      this.object = drawn(this.mesh.geometry, solidMaterial(this.neutral.value));
    }
  }

  #material(uniforms, more) {
    return new ShaderMaterial({ vertexShader: SURFACE_VERTEX, fragmentShader: PAINTED, side: DoubleSide, uniforms, ...more });
  }

  /** Whether the cursor reads it: what one can see through is not in the way. */
  get readable() {
    return this.paint !== "ghost";
  }

  trace(ray) {
    const hit = this.mesh.trace(ray);
    if (!hit) return null;
    const bounds = this.bounds && Array.from(this.bounds.subarray(2 * hit.face, 2 * hit.face + 2));
    return { ...hit, ...this.values?.at(this.mesh, hit.triangle, hit.weights), scale: this.values?.scale, bounds };
  }

  update({ theme, plain, place }) {
    this.neutral.value.copy(this.paint === "ghost" ? theme.ghost : theme.neutral);
    if (!this.values) return;
    this.uniforms.plain.value = plain;
    const chosen = place && place.mesh !== null && place.faces.length > 0 ? place : null;
    if (this.place === chosen) return;
    this.place = chosen;
    if (this.part) {
      this.object.remove(this.part);
      this.part.geometry.dispose();
      this.part = null;
    }
    this.uniforms.fade.value = chosen ? FADED : 0;
    if (!chosen) return;
    // Everything but how much it fades is shared with the whole.
    this.part = drawn(this.mesh.part(this.object.geometry, chosen.faces), this.#material({ ...this.uniforms, fade: { value: 0 } },
      { polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -4 }));
    this.object.add(this.part);
  }
}

/** Triangles that stand out, and where they are once they are smaller than a pixel. */
export class PiecesLayer {
  constructor(app, { points, indices }, scene) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(points, 3));
    geometry.setIndex(new BufferAttribute(indices, 1));
    this.object = drawn(geometry, solidMaterial(scene.contrast, 2));
    this.marks = this.#rings(points, scene.camera.sphere.radius * 0.1);
  }

  /** A ring around each place; none if there are too many. */
  #rings(points, near) {
    const places = [];
    for (let i = 0; i < points.length; i += 3) {
      const point = new Vector3().fromArray(points, i);
      let place = places.find(({ seed }) => seed.distanceTo(point) < near);
      if (!place) {
        if (places.length === RINGS) return [];
        places.push((place = { seed: point, box: new Box3() }));
      }
      place.box.expandByPoint(point);
    }
    return places.map(({ box }) => new RingMark("left", box.getCenter(new Vector3()), box.getSize(new Vector3()).length() / 2));
  }

  update() {}
}
