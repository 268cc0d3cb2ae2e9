// Points as discs of some pixels, in one colour or by values.

import { BufferAttribute, BufferGeometry, Color, Points, ShaderMaterial } from "three";
import { raw } from "../color.js";
import { SCALE_GLSL } from "../scale.js";

const VERTEX = `
attribute float part;
uniform float size;
uniform float nearer;
varying float vPart;
void main() {
  vPart = part;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  seen.xyz *= 1.0 - nearer / max(length(seen.xyz), nearer * 2.0);
  gl_PointSize = size;
  gl_Position = projectionMatrix * seen;
}`;

const FRAGMENT = `
uniform sampler2D colors;
uniform int scaleKind;
uniform bool scaleSigned;
uniform float scaleGain;
uniform bool scaled;
uniform vec3 color;
uniform vec3 rim;
varying float vPart;
${SCALE_GLSL}
void main() {
  float away = length(gl_PointCoord - 0.5) * 2.0;
  if (away > 1.0) discard;
  vec3 inside = scaled ? texture2D(colors, vec2((place(vPart * scaleGain) * 255.0 + 0.5) / 256.0, 0.5)).rgb : color;
  gl_FragColor = vec4(away > 0.72 ? rim : inside, 1.0);
}`;

export class PointsLayer {
  constructor(app, { points, values, scale, color, size }, scene) {
    this.scale = scale === null ? null : app.scales[scale];
    this.color = color;
    this.size = size;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(points, 3));
    const part = (value) => (value - (this.scale.low ?? 0)) / this.scale.whole;
    geometry.setAttribute("part", new BufferAttribute(values ? Float32Array.from(values, part) : new Float32Array(points.length / 3), 1));
    this.uniforms = {
      ...(this.scale ?? app.scales[0])?.uniforms, scaled: { value: this.scale !== null }, color: { value: new Color() }, rim: { value: new Color() },
      size: { value: size }, nearer: { value: scene.camera.sphere.radius * 0.008 },
    };
    this.object = new Points(geometry, new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: this.uniforms }));
    this.object.frustumCulled = false;
    this.object.renderOrder = 4;
  }

  update({ style, ratio }) {
    this.uniforms.color.value.copy(raw(style(this.color)));
    this.uniforms.rim.value.copy(raw(style("--halo")));
    this.uniforms.size.value = this.size * ratio;
  }
}
