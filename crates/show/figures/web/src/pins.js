// Points that were clicked on stay marked with what is known there; between the last two, the distance is measured.

import { Vector3 } from "three";
import { h, card } from "./dom.js";
import { enclosure, plain, short } from "./format.js";
import { MeasureMark, PinMark } from "./layers/marks.js";
import { saveText } from "./shell.js";

/** A pin closer to a click than this, in pixels, is taken away by it. */
const NEAR = 11;

export const pointText = (all, digits = 6) => `(${all.map((x) => plain(Number(x.toPrecision(digits)))).join(", ")})`;

export class Pins {
  constructor(app) {
    Object.assign(this, { app, all: [], next: 1, measuring: true });
    this.list = h("ol", { class: "places", "data-key": "pins" });
    this.measured = h("p", { class: "fact", "data-key": "measured" });
    const measure = h("input", { type: "checkbox", "data-control": "measure", checked: true, onchange: () => {
      this.measuring = measure.checked;
      this.#changed();
    } });
    const button = (control, text, onclick) => h("button", { type: "button", "data-control": control, onclick }, text);
    this.element = card("Pinned points", this.list, h("label", { class: "check" }, measure, "Measure between the last two"), this.measured,
      h("div", { class: "buttons" }, button("pins-csv", "Save as CSV", () => this.#save()), button("pins-clear", "Remove all", () => this.clear())),
      h("p", { class: "note" }, "Values between corners, nearest points and measured lengths are computed in the browser from what is drawn; enclosures are those of the analysis."));
  }

  /** Pins what is under a place of the canvas, or takes away the pin that is there. */
  toggle(hit, at) {
    const { app } = this;
    const beside = at && this.all.find((pin) => {
      const pane = app.shown.indexOf(pin.scene);
      const shown = pane >= 0 && app.view.project(pin.point, pane);
      return shown && Math.hypot(shown.x - at.x, shown.y - at.y) < NEAR;
    });
    if (beside) this.#remove(beside);
    else if (hit) this.#add(hit);
  }

  #add(hit) {
    const { app } = this;
    const scene = app.scenes[hit.scene];
    const point = new Vector3(...hit.point);
    const other = scene.camera.flat ? null : app.meshes.find((mesh) => mesh !== hit.mesh && mesh.space === hit.mesh.space);
    const nearest = other && app.data.scenes[hit.scene].places.some(({ pair }) => pair) ? other.nearest(point) : null;
    const label = hit.value === undefined ? `${hit.mesh.element} ${hit.face}` : hit.scale.withUnit(short(hit.value, 4));
    const pin = { ...hit, number: this.next++, scene, point, nearest: nearest && scene.position(nearest.toArray()) };
    pin.mark = new PinMark(point, nearest, String(pin.number), label);
    this.all.push(pin);
    this.#changed();
  }

  #remove(pin) {
    this.all = this.all.filter((other) => other !== pin);
    pin.mark.remove();
    this.#changed();
  }

  clear() {
    for (const { mark } of this.all) mark.remove();
    this.all = [];
    this.next = 1;
    this.#changed();
  }

  /** The last one goes; tells whether there was one. */
  removeLast() {
    const last = this.all.at(-1);
    if (last) this.#remove(last);
    return last !== undefined;
  }

  marks(scene) {
    const pins = this.all.filter((pin) => pin.scene === scene).map(({ mark }) => mark);
    return this.measure && this.measure.scene === scene ? [...pins, this.measure.mark] : pins;
  }

  #changed() {
    this.measure?.mark.remove();
    this.measure = null;
    const [a, b] = this.all.slice(-2);
    const unit = this.app.scales[0]?.data.unit ?? "";
    const text = (x) => (unit ? `${short(x, 6)} ${unit}` : short(x, 6));
    if (this.measuring && b && a.scene.camera === b.scene.camera) {
      const way = b.position.map((x, k) => x - a.position[k]);
      const length = Math.hypot(...way);
      this.measure = { scene: b.scene, mark: new MeasureMark(a.point, b.point, text(length)) };
      this.measured.replaceChildren(h("span", {}, `From ${a.number} to ${b.number}: ${pointText(way, 5)}`), h("output", { class: "number", "data-exact": String(length) }, text(length)));
    } else {
      this.measured.replaceChildren();
    }
    this.list.replaceChildren(...this.all.map((pin) => h("li", { class: "pin-row" }, h("b", {}, String(pin.number)),
      h("span", {}, pin.value !== undefined && h("span", { class: "number" }, pin.scale.withUnit(short(pin.value, 6))),
        h("small", {}, `${pin.mesh.element} ${pin.face} of ${pin.mesh.name}`, pin.bounds && `: largest in ${enclosure(pin.bounds)}`),
        h("small", {}, `at ${pointText(pin.position, 7)}`), pin.nearest && h("small", {}, `nearest ${pointText(pin.nearest, 7)}`)),
      h("button", { type: "button", "aria-label": `Remove point ${pin.number}`, onclick: () => this.#remove(pin) }, "\u00d7"))));
    const panel = this.app.panel.element;
    if (this.all.length && !this.element.parentNode) panel.parentNode.prepend(this.element);
    if (!this.all.length) this.element.remove();
    this.app.update();
  }

  #save() {
    const head = "number,mesh,element,value,lower,upper,x,y,z,nearest_x,nearest_y,nearest_z";
    const rows = this.all.map(({ number, mesh, face, value, bounds, position, nearest }) =>
      [number, quoted(mesh.name), face, value ?? "", bounds?.[0] ?? "", bounds?.[1] ?? "", ...position, ...(nearest ?? ["", "", ""])].join(","));
    saveText([head, ...rows].join("\n") + "\n", `${this.app.data.picture}-points.csv`, "text/csv");
  }
}

/** A text as a field of comma-separated values. */
export const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
