// A plane that cuts surfaces open, and the curves where it meets them.

import { Group, Vector4 } from "three";
import { h } from "./dom.js";
import { short } from "./format.js";
import { LinesLayer } from "./layers/lines.js";

/** What lies beyond is not drawn: a normal and how far along it the plane is; a normal of zero cuts nothing. Shared by all materials. */
export const SECTION = { value: new Vector4(0, 0, 0, 0) };

/** Whether a point is cut away. */
export const isCut = ([x, y, z]) => {
  const { x: a, y: b, z: c, w } = SECTION.value;
  return a * x + b * y + c * z > w;
};

/** Curves of the first meshes, in this order. */
const COLORS = ["--accent", "--second"];
const STEPS = 1000;

/** Segments in which a plane meets the triangles of a mesh, as six numbers each. */
export function sectionOf({ positions, indices }, axis, at) {
  const points = [];
  const side = (i) => positions[3 * i + axis] - at;
  for (let t = 0; t < indices.length; t += 3) {
    const corners = [indices[t], indices[t + 1], indices[t + 2]];
    const [a, b, c] = corners.map(side);
    // A corner on the plane counts as above, so that each edge is met once.
    if ((a >= 0) === (b >= 0) && (b >= 0) === (c >= 0)) continue;
    const sides = [a, b, c];
    for (let k = 0; k < 3; k++) {
      const [i, j] = [k, (k + 1) % 3];
      if ((sides[i] >= 0) === (sides[j] >= 0)) continue;
      const part = sides[i] / (sides[i] - sides[j]);
      for (let m = 0; m < 3; m++) {
        const [from, to] = [positions[3 * corners[i] + m], positions[3 * corners[j] + m]];
        points.push(m === axis ? at : from + part * (to - from));
      }
    }
  }
  return Float32Array.from(points);
}

export class Section {
  constructor(app) {
    this.app = app;
    const space = app.data.spaces.findIndex(({ up }) => up !== null);
    this.camera = app.cameras[space];
    this.meshes = app.meshes.filter((mesh) => mesh.space === space).slice(0, COLORS.length);
    Object.assign(this, { on: false, axis: 2, part: 0.5, turned: false });
    this.low = [0, 1, 2].map((k) => Math.min(...this.meshes.map(({ positions }) => extreme(positions, k, Math.min))));
    this.high = [0, 1, 2].map((k) => Math.max(...this.meshes.map(({ positions }) => extreme(positions, k, Math.max))));
    this.curves = new Map();
    this.control = { element: this.#build() };
  }

  #build() {
    const change = (fields) => {
      Object.assign(this, fields);
      this.#cut();
    };
    this.check = h("input", { type: "checkbox", "data-control": "section", onchange: () => change({ on: this.check.checked }) });
    const axes = h("select", { "data-control": "section-axis", "aria-label": "Across", onchange: () => change({ axis: Number(axes.value) }) },
      ["x", "y", "z"].map((name, k) => h("option", { value: k, selected: k === this.axis }, name)));
    this.slider = h("input", { type: "range", "data-control": "section-at", min: 0, max: STEPS, value: STEPS / 2, "aria-label": "Where the section is",
      oninput: () => change({ part: this.slider.valueAsNumber / STEPS }) });
    const turn = h("button", { type: "button", "data-control": "section-turn", title: "Show the other side", onclick: () => change({ turned: !this.turned }) }, "\u21c4");
    this.place = h("output", { class: "number", "data-key": "section-place" });
    const key = this.meshes.map(({ name }, i) => h("span", { class: `section-key series-${i}` }, name));
    this.more = h("span", { class: "section-more", hidden: true }, axes, this.slider, this.place, turn, key);
    return h("span", { class: "section-controls" }, h("label", { class: "check" }, this.check, "Section"), this.more);
  }

  #cut() {
    const { axis, on } = this;
    this.more.hidden = !on;
    this.slider.value = String(this.part * STEPS);
    const at = this.low[axis] + this.part * (this.high[axis] - this.low[axis]);
    const sign = this.turned ? -1 : 1;
    SECTION.value.set(...[0, 1, 2].map((k) => (on && k === axis ? sign : 0)), on ? sign * at : 0);
    const { origin, scale } = this.camera.space;
    this.place.textContent = `${"xyz"[axis]} = ${short(at * scale + origin[axis], 5)}`;
    for (const [scene, group] of this.curves) scene.scene.remove(group);
    this.curves.clear();
    if (on) this.#draw(axis, at);
    this.app.update();
  }

  #draw(axis, at) {
    const all = this.meshes.map((mesh) => sectionOf(mesh, axis, at));
    for (const scene of this.app.scenes.filter(({ camera }) => camera === this.camera)) {
      const group = new Group();
      group.layers.mask = 1;
      const lines = all.map((points, i) => (points.length === 0 ? null : new LinesLayer(this.app,
        { points, lengths: new Array(points.length / 6).fill(2), closed: false, values: null, scale: null, width: 3, moving: false, color: COLORS[i] }, scene)));
      for (const line of lines) if (line) group.add(line.object);
      group.userData.lines = lines.filter((line) => line);
      scene.scene.add(group);
      this.curves.set(scene, group);
    }
  }

  /** Colours follow the theme. */
  update(look) {
    for (const group of this.curves.values()) for (const line of group.userData.lines) line.update(look);
  }
}

function extreme(positions, k, choose) {
  let found = positions[k];
  for (let i = k; i < positions.length; i += 3) found = choose(found, positions[i]);
  return found;
}
