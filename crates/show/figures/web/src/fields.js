// The page of several tangent fields on one surface: a field and the parts that it is split into.

import { Scene, Vector3 } from "three";
import { Arrows, facesForArrows } from "./arrows.js";
import { decode } from "./decode.js";
import { card, checkbox, choice, h, say, select } from "./dom.js";
import { plural, short } from "./format.js";
import { Legend } from "./legend.js";
import { Scale } from "./scale.js";
import { failure, savePicture, shell, themeColor } from "./shell.js";
import { colorTexture, raw, extentOf, Surface } from "./surface.js";
import { View } from "./view.js";

/** Of the radius of the scene, at the ends of the slider for the spacing of arrows. */
const SPACINGS = [0.24, 0.03];

/** Corners of each face by themselves: vectors differ from face to face. */
function apart(positions, indices) {
  const corners = new Float32Array(3 * indices.length);
  indices.forEach((index, i) => corners.set(positions.subarray(3 * index, 3 * index + 3), 3 * i));
  return corners;
}

function sizesOf(vectors) {
  const sizes = new Float64Array(vectors.length / 3);
  for (let i = 0; i < sizes.length; i++) sizes[i] = Math.hypot(vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]);
  return sizes;
}

export class FieldsApp {
  static async open(data) {
    const positions = apart(await decode(data.surface.positions), await decode(data.surface.indices));
    const vectors = [];
    for (const field of data.fields) vectors.push(await decode(field.vectors));
    return new FieldsApp(data, positions, vectors);
  }

  constructor(data, positions, vectors) {
    Object.assign(this, { data, positions });
    const indices = Uint32Array.from({ length: positions.length / 3 }, (_, i) => i);
    let like;
    this.fields = data.fields.map((field, i) => {
      const sizes = sizesOf(vectors[i]);
      const surface = new Surface({ positions, indices, values: Float64Array.from(indices, (k) => sizes[Math.floor(k / 3)]), like });
      like ??= surface;
      return { ...field, vectors: vectors[i], sizes, surface };
    });
    this.longest = Math.max(...this.fields.map(({ surface }) => surface.largest)) || 1;
    this.table = Uint8Array.from(data.colors.table);
    this.scale = new Scale(false);
    this.scale.end = this.longest;
    this.state = { shown: "all", arrows: true, equal: false, spacing: 40 };
    this.view = new View(extentOf([like]), data.up);
    const texture = colorTexture(this.table);
    for (const field of this.fields) {
      field.scene = new Scene();
      field.painted = field.surface.painted(texture, "rgb(0, 0, 0)");
      field.scene.add(field.painted);
      field.arrows = new Arrows(positions, field.vectors, this.view.sphere.radius);
    }
    this.#buildPage();
    this.#pointing();
    this.#placeArrows();
    this.update();
  }

  #buildPage() {
    const { state, data } = this;
    const choices = [{ value: "all", text: this.fields.length > 1 ? "All" : "Field", id: "show-field-all" },
      ...this.fields.map(({ label }, i) => ({ value: String(i), text: label, id: `show-field-${i}` }))];
    this.choices = choice("Fields shown", choices, "all", (shown) => {
      state.shown = shown;
      this.update();
    });
    const scale = select("scale", "Colours", [["linear", "linear"], ["root", "square root"], ["logarithmic", "logarithmic"]], "linear", (kind) => {
      this.scale.kind = kind;
      this.update();
    });
    const arrows = checkbox("show-arrows", "Arrows", true, (on) => {
      state.arrows = on;
      this.update();
    });
    const equal = checkbox("equal-arrows", "of one length", false, (on) => {
      state.equal = on;
      this.#placeArrows();
      this.update();
    });
    const slider = h("input", {
      type: "range", id: "arrow-density", min: 0, max: 100, step: 1, value: String(state.spacing), "aria-label": "Density of arrows",
      oninput: () => {
        state.spacing = slider.valueAsNumber;
        this.#placeArrows();
        this.update();
      },
    });
    const upward = select("upward", "Up", [["x", "x"], ["y", "y"], ["z", "z"]], data.up, (axis) => this.view.turnUpward(axis));
    const all = h("button", { type: "button", id: "show-all", onclick: () => this.view.flyHome() }, "Show all");
    const save = h("button", { type: "button", id: "save", onclick: () => savePicture(this.view, "fields") }, "Save picture");
    this.legend = new Legend(this.table, data.unit);
    this.legend.point(null);
    this.reading = h("div", { class: "reading", id: "reading", hidden: true });
    this.spoken = h("div", { class: "hidden", id: "spoken", role: "status", "aria-live": "polite" });
    this.view.element.append(this.legend.element, this.reading, this.spoken);
    shell({
      title: data.title, subtitle: `${data.surface.name}, ${plural(data.surface.faces, "face")}`,
      toolbar: [this.choices.element, h("div", { class: "options" }, scale.element, arrows.element, equal.element,
        h("label", { class: "select" }, h("span", {}, "density"), slider), upward.element, all, save)],
      view: this.view.element, panel: [this.#norms(), this.#products(), ...data.tables.map((table) => this.#table(table)), this.#facts()],
      onTheme: () => this.update(),
    });
  }

  #norms() {
    const most = Math.max(...this.fields.map(({ norm }) => norm)) || 1;
    return card("Norms", h("table", { class: "numbers", id: "norms" },
      h("caption", { class: "hidden" }, "Norm of each field"),
      h("tbody", {}, this.fields.map(({ label, norm }) => h("tr", {}, h("th", { scope: "row" }, label),
        h("td", { class: "bar-cell", "aria-hidden": "true" }, h("span", { class: "norm-bar", style: `width:${(100 * norm) / most}%` })),
        h("td", { "data-exact": String(norm) }, short(norm, 6)))))),
    h("p", { class: "fact" }, "What the parts leave over", h("output", { id: "residual", "data-exact": String(this.data.residual) }, short(this.data.residual, 3))));
  }

  #products() {
    const { innerProducts } = this.data;
    return card("Inner products", h("table", { class: "numbers matrix", id: "inner-products" },
      h("caption", { class: "hidden" }, "Inner product of each field with each"),
      h("thead", {}, h("tr", {}, h("td", {}), this.fields.map(({ label }) => h("th", { scope: "col" }, label)))),
      h("tbody", {}, innerProducts.map((row, i) => h("tr", {}, h("th", { scope: "row" }, this.fields[i].label),
        row.map((value) => h("td", { "data-exact": String(value) }, short(value, 3))))))));
  }

  #table({ title, head, rows }) {
    return card(title, h("table", { class: "numbers" },
      h("thead", {}, h("tr", {}, head.map((text) => h("th", { scope: "col" }, text)))),
      h("tbody", {}, rows.map(([first, ...rest]) => h("tr", {}, h("th", { scope: "row" }, first), rest.map((text) => h("td", {}, text)))))));
  }

  #facts() {
    const { surface, facts, command, version, notes } = this.data;
    const fact = (name, ...value) => h("div", { class: "row" }, h("dt", {}, name), h("dd", {}, ...value));
    return card("Surface and run", notes.map((note) => h("p", { class: "note" }, note)), h("dl", { class: "rows facts" },
      fact("surface", surface.path, h("small", {}, `${plural(surface.faces, "face")}, ${surface.vertices} vertices`)),
      facts.map(([name, value]) => fact(name, value)), command && fact("command", h("code", {}, command)), fact("written by", `pompeiu ${version}`)));
  }

  #placeArrows() {
    const { radius } = this.view.sphere;
    const [far, near] = SPACINGS;
    const spacing = radius * far * (near / far) ** (this.state.spacing / 100);
    const chosen = facesForArrows(this.positions, spacing);
    for (const { arrows, scene } of this.fields) arrows.place(scene, chosen, this.longest, spacing * 1.5, this.state.equal);
  }

  update() {
    const { state } = this;
    const shown = state.shown === "all" ? this.fields : [this.fields[Number(state.shown)]];
    for (const { scene, painted, arrows } of this.fields) {
      scene.background = raw(themeColor("--view"));
      painted.userData.scale(this.scale);
      arrows.colors[0].copy(raw("rgb(10, 16, 24)"));
      arrows.colors[1].copy(raw("rgb(255, 255, 255)"));
      arrows.visible = state.arrows;
    }
    if (this.panes !== state.shown) {
      this.panes = state.shown;
      this.view.show(shown.map((field) => ({ scene: field.scene, label: field.label, field, trace: (ray) => field.surface.trace(ray) })), shown.length > 1 ? 2 : 1);
    }
    this.legend.update(this.scale, "length of vectors", this.longest, 0, false);
    this.view.invalidate();
  }

  /** What is under a place of the canvas: the face and the vector of the field on it. */
  pick(x, y) {
    const { pane, ray } = this.view.rayAt(x, y);
    const hit = pane?.trace(ray);
    if (!hit) return null;
    const { vectors, sizes } = pane.field;
    return { face: hit.face, field: this.fields.indexOf(pane.field), size: sizes[hit.face], vector: Array.from(vectors.subarray(3 * hit.face, 3 * hit.face + 3)) };
  }

  #pointing() {
    let waiting = null;
    this.view.onpointer = (type, at, event) => {
      const out = type === "pointerleave" || event.buttons;
      if (!out && !waiting) {
        requestAnimationFrame(() => {
          if (waiting) this.#read(this.pick(waiting.x, waiting.y), waiting);
          waiting = null;
        });
      }
      waiting = out ? null : at;
      if (out) this.#read(null);
    };
    this.view.onread = () => {
      const at = this.view.middle();
      const hit = this.pick(at.x, at.y);
      this.#read(hit, at);
      say(this.spoken, hit ? `${this.fields[hit.field].label}: length ${short(hit.size, 5)} ${this.data.unit}, face ${hit.face}.` : "No surface in the middle of the view.");
    };
  }

  #read(hit, at) {
    this.reading.hidden = !hit;
    this.legend.point(hit ? this.scale.place(hit.size) : null);
    if (!hit) return;
    this.reading.replaceChildren(
      h("div", { class: "value" }, h("b", { class: "number" }, short(hit.size, 6)), this.data.unit && ` ${this.data.unit}`),
      h("div", {}, `${this.fields[hit.field].label}, face ${hit.face}`),
      h("div", { class: "where" }, `(${hit.vector.map((x) => short(x, 5)).join(", ")})`));
    const box = this.reading.getBoundingClientRect();
    const { clientWidth, clientHeight } = this.view.element;
    this.reading.style.left = `${Math.min(at.x + 18, Math.max(4, clientWidth - box.width - 4))}px`;
    this.reading.style.top = `${Math.min(clientHeight - box.height - 4, Math.max(4, at.y + 14))}px`;
  }

  /** Where a point of the surface is in the view. */
  place(position) {
    return new Vector3(...position.map((x, k) => (x - this.data.origin[k]) / this.data.scale));
  }
}

export async function openFields(data) {
  try {
    return await FieldsApp.open(data);
  } catch (error) {
    failure(error);
    throw error;
  }
}
