// Arrows on a surface: as many as can be told apart, one scale of lengths for all panes.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, InstancedMesh, Matrix4, ShaderMaterial, Vector3 } from "three";
import { raw } from "../color.js";

// Arrows are flat and lie in their faces; beyond them a curved surface would hide them. So they are drawn a little nearer to the
// camera, along the line of sight, which moves nothing on the screen.
const VERTEX = `
uniform float nearer;
void main() {
  vec4 seen = modelViewMatrix * instanceMatrix * vec4(position, 1.0);
  seen.xyz *= 1.0 - nearer / max(length(seen.xyz), nearer * 2.0);
  gl_Position = projectionMatrix * seen;
}`;
const FRAGMENT = `
uniform vec3 color;
void main() { gl_FragColor = vec4(color, 1.0); }`;

/** An arrow of length 1 along x, grown by a margin all around. */
function shape(margin) {
  const [tail, neck, tip, half, wide] = [-0.5 - margin, 0.12 - margin * 0.8, 0.5 + margin * 2, 0.045 + margin, 0.19 + margin * 1.7];
  const points = [[tail, -half], [neck, -half], [neck, half], [tail, half], [neck, -wide], [tip, 0], [neck, wide]];
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(points.flatMap(([x, y]) => [x, y, 0])), 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3, 4, 5, 6]);
  return geometry;
}

/** Triangles for arrows: in each cell of a grid the one whose middle is nearest to the cell's. */
export function trianglesForArrows(mesh, spacing) {
  const best = new Map();
  const { positions, indices } = mesh;
  for (let triangle = 0; triangle < mesh.triangles; triangle++) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * indices[3 * triangle + k]);
    const middle = [0, 1, 2].map((k) => (positions[a + k] + positions[b + k] + positions[c + k]) / 3);
    const cell = middle.map((x) => Math.floor(x / spacing));
    const off = middle.reduce((sum, x, k) => sum + (x / spacing - cell[k] - 0.5) ** 2, 0);
    const key = cell.join();
    const known = best.get(key);
    if (!known || off < known.off) best.set(key, { triangle, off, middle });
  }
  return [...best.values()];
}

/** Of the radius of the scene, at the ends of the slider for the spacing of arrows. */
const SPACINGS = [0.24, 0.03];
const CENTER = [1 / 3, 1 / 3, 1 / 3];

/** Arrows for vectors; the longest of a scale is as long in all scenes and at all times. */
export class ArrowsLayer {
  constructor(app, { mesh, vectors }, scene) {
    this.mesh = app.meshes[mesh];
    this.values = app.values[vectors];
    this.radius = scene.camera.sphere.radius;
    this.colors = [new Color(), new Color()];
    this.meshes = [];
    this.object = new Group();
  }

  /** Places them: some for each of the given triangles. */
  #place({ density, equal }) {
    const [far, near] = SPACINGS;
    const spacing = this.radius * far * (near / far) ** (density / 100);
    const [length, longest] = [spacing * 1.5, this.values.scale.whole];
    // Neighbouring frames share their mesh and with it the choice of triangles.
    const known = (this.mesh.forArrows ??= {});
    if (known.spacing !== spacing) Object.assign(known, { spacing, chosen: trianglesForArrows(this.mesh, spacing) });
    for (const mesh of this.meshes) {
      this.object.remove(mesh);
      mesh.geometry.dispose();
      mesh.material.dispose();
      mesh.dispose();
    }
    const matrices = [];
    const [along, across] = [new Vector3(), new Vector3()];
    for (const { triangle, middle } of known.chosen) {
      const [a, b, c] = this.mesh.corners(triangle);
      const up = new Vector3().crossVectors(b.sub(a), c.sub(a)).normalize();
      along.fromArray(this.values.at(this.mesh, triangle, CENTER).vector);
      const size = along.length();
      const long = equal && size > longest * 1e-9 ? length : (length * size) / longest;
      if (!(long > length * 0.01) || up.lengthSq() === 0) continue;
      along.divideScalar(size);
      across.crossVectors(up, along).normalize();
      // Short arrows stay as thick as long ones for as long as they are longer than thick.
      const thick = Math.min(length, long * 1.6);
      matrices.push(new Matrix4().makeBasis(along.multiplyScalar(long), across.multiplyScalar(thick), up).setPosition(...middle));
    }
    this.meshes = [0.035, 0].map((margin, layer) => {
      const material = new ShaderMaterial({
        vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide,
        uniforms: { nearer: { value: this.radius * (layer === 0 ? 0.012 : 0.016) }, color: { value: this.colors[layer] } },
      });
      const mesh = new InstancedMesh(shape(margin), material, matrices.length);
      matrices.forEach((matrix, i) => mesh.setMatrixAt(i, matrix));
      mesh.frustumCulled = false;
      mesh.renderOrder = 1 + layer;
      this.object.add(mesh);
      return mesh;
    });
    this.count = matrices.length;
  }

  update({ arrows }) {
    this.colors[0].copy(raw("rgb(10, 16, 24)"));
    this.colors[1].copy(raw("rgb(255, 255, 255)"));
    const state = `${arrows.density} ${arrows.equal}`;
    if (this.placed === state) return;
    this.placed = state;
    this.#place(arrows);
  }
}
