// Arrows on a surface: as many as can be told apart, one scale of lengths for all panes.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, InstancedMesh, Matrix4, ShaderMaterial, Vector3 } from "three";

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

/** Faces for arrows: in each cell of a grid the one whose middle is nearest to the cell's. */
export function facesForArrows(positions, spacing) {
  const best = new Map();
  for (let face = 0; face < positions.length / 9; face++) {
    const at = 9 * face;
    const middle = [0, 1, 2].map((k) => (positions[at + k] + positions[at + 3 + k] + positions[at + 6 + k]) / 3);
    const cell = middle.map((x) => Math.floor(x / spacing));
    const off = middle.reduce((sum, x, k) => sum + (x / spacing - cell[k] - 0.5) ** 2, 0);
    const key = cell.join();
    const known = best.get(key);
    if (!known || off < known.off) best.set(key, { face, off, middle });
  }
  return [...best.values()];
}

export class Arrows {
  /** `vectors` has three coordinates for each face. */
  constructor(positions, vectors, radius) {
    Object.assign(this, { positions, vectors, radius });
    this.colors = [new Color(), new Color()];
    this.meshes = [];
  }

  /** Places them: `longest` is the length of the longest vector of all panes, which becomes `length` long. */
  place(scene, chosen, longest, length, equal) {
    for (const mesh of this.meshes) {
      scene.remove(mesh);
      mesh.geometry.dispose();
      mesh.material.dispose();
      mesh.dispose();
    }
    const matrices = [];
    const [a, b, along, across, up] = Array.from({ length: 5 }, () => new Vector3());
    for (const { face, middle } of chosen) {
      const corner = (i, k) => this.positions[9 * face + 3 * i + k];
      a.set(...[0, 1, 2].map((k) => corner(1, k) - corner(0, k)));
      b.set(...[0, 1, 2].map((k) => corner(2, k) - corner(0, k)));
      up.crossVectors(a, b).normalize();
      along.fromArray(this.vectors, 3 * face);
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
      scene.add(mesh);
      return mesh;
    });
    this.count = matrices.length;
  }

  set visible(on) {
    for (const mesh of this.meshes) mesh.visible = on;
  }
}
