// Curves of some pixels' width, in one colour or by values, still or with streaks that move along them.

import { Color, InstancedBufferAttribute, InstancedBufferGeometry, Float32BufferAttribute, Mesh, ShaderMaterial, Vector2, Vector4 } from "three";
import { raw } from "../color.js";
import { SCALE_GLSL } from "../scale.js";

// Each segment is a rectangle on the screen, drawn a little nearer to the camera so that the surface it lies on does not hide it.
const VERTEX = `
attribute vec3 start;
attribute vec3 end;
attribute vec2 parts;
attribute vec2 along;
uniform vec2 resolution;
uniform float width;
uniform float nearer;
varying float vPart;
varying float vAlong;
void main() {
  vec4 a = modelViewMatrix * vec4(start, 1.0);
  vec4 b = modelViewMatrix * vec4(end, 1.0);
  float front = projectionMatrix[3][2] / (1.0 - projectionMatrix[2][2]) * 1.001;
  if (a.z > front && b.z < front) a = mix(b, a, (front - b.z) / (a.z - b.z));
  if (b.z > front && a.z < front) b = mix(a, b, (front - a.z) / (b.z - a.z));
  a.xyz *= 1.0 - nearer / max(length(a.xyz), nearer * 2.0);
  b.xyz *= 1.0 - nearer / max(length(b.xyz), nearer * 2.0);
  vec4 p = projectionMatrix * a;
  vec4 q = projectionMatrix * b;
  vec2 direction = (q.xy / q.w - p.xy / p.w) * resolution;
  direction = length(direction) > 1e-6 ? normalize(direction) : vec2(1.0, 0.0);
  vec4 at = position.x < 0.5 ? p : q;
  vec2 offset = vec2(-direction.y, direction.x) * position.y + direction * (position.x * 2.0 - 1.0) * 0.5;
  at.xy += offset * width / resolution * at.w;
  vPart = mix(parts.x, parts.y, position.x);
  vAlong = mix(along.x, along.y, position.x);
  gl_Position = at;
}`;

const FRAGMENT = `
uniform sampler2D colors;
uniform int scaleKind;
uniform bool scaleSigned;
uniform float scaleGain;
uniform bool scaled;
uniform vec3 color;
uniform bool moving;
uniform float phase;
varying float vPart;
varying float vAlong;
${SCALE_GLSL}
void main() {
  vec3 shown = scaled ? texture2D(colors, vec2((place(vPart * scaleGain) * 255.0 + 0.5) / 256.0, 0.5)).rgb : color;
  float streak = fract(vAlong - phase);
  gl_FragColor = vec4(shown, moving ? 0.12 + 0.88 * streak * streak : 1.0);
}`;

/** Lengths of a streak and the gap after it, in radii of the scene. */
const PERIOD = 0.35;

export class LinesLayer {
  constructor(app, shape, scene) {
    const { points, lengths, closed, values, width } = shape;
    this.scale = shape.scale === null ? null : app.scales[shape.scale];
    this.moving = shape.moving;
    this.color = shape.color;
    const segments = [];
    const steps = [];
    const period = scene.camera.sphere.radius * PERIOD;
    let first = 0;
    for (const length of lengths) {
      let travelled = 0;
      // Paths have their streaks at different places.
      const shift = (first * 0.618034) % 1;
      for (let i = 0; i + 1 < length + (closed ? 1 : 0); i++) {
        const [a, b] = [first + i, first + ((i + 1) % length)];
        const long = Math.hypot(...[0, 1, 2].map((k) => points[3 * b + k] - points[3 * a + k])) / period;
        segments.push([a, b]);
        steps.push(shift + travelled, shift + travelled + long);
        travelled += long;
      }
      first += length;
    }
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const gather = (end) => Float32Array.from(segments.flatMap((segment) => Array.from(points.subarray(3 * segment[end], 3 * segment[end] + 3))));
    geometry.setAttribute("start", new InstancedBufferAttribute(gather(0), 3));
    geometry.setAttribute("end", new InstancedBufferAttribute(gather(1), 3));
    const part = (i) => (values ? (values[i] - (this.scale.low ?? 0)) / this.scale.whole : 0);
    geometry.setAttribute("parts", new InstancedBufferAttribute(Float32Array.from(segments.flatMap(([a, b]) => [part(a), part(b)])), 2));
    geometry.setAttribute("along", new InstancedBufferAttribute(Float32Array.from(steps), 2));
    geometry.instanceCount = segments.length;
    this.uniforms = {
      ...(this.scale ?? app.scales[0])?.uniforms, scaled: { value: this.scale !== null }, color: { value: new Color() }, width: { value: width },
      nearer: { value: scene.camera.sphere.radius * 0.006 }, resolution: { value: new Vector2(1, 1) }, moving: { value: this.moving }, phase: { value: 0 },
    };
    const material = new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: this.uniforms, transparent: this.moving, depthWrite: !this.moving });
    this.object = new Mesh(geometry, material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 3;
    const viewport = new Vector4();
    this.object.onBeforeRender = (renderer) => {
      renderer.getViewport(viewport);
      this.uniforms.resolution.value.set(viewport.z, viewport.w);
      material.uniformsNeedUpdate = true;
    };
  }

  update({ style, phase }) {
    this.uniforms.color.value.copy(raw(style(this.color)));
    this.uniforms.phase.value = phase;
  }
}
