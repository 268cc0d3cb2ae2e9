// What is under the cursor: the value there, its face and what is proven of it; and the same place in the other panes.

import { h, say } from "./dom.js";
import { enclosure, plain, short } from "./format.js";

export class Reading {
  constructor(app) {
    this.app = app;
    this.element = h("div", { class: "reading", id: "reading", hidden: true });
    const { view } = app;
    let waiting = null;
    view.onpointer = (type, at, event) => {
      if (type === "pointerdown" && at.pane && view.panes.length > 1) app.setScene(app.scenes.indexOf(at.pane.scene));
      if (type === "pointerleave" || event.buttons) {
        waiting = null;
        this.clear();
        return;
      }
      if (!waiting) {
        requestAnimationFrame(() => {
          if (waiting) this.#show(app.pick(waiting.x, waiting.y), waiting);
          waiting = null;
        });
      }
      waiting = at;
    };
    view.onread = () => {
      const at = view.middle(view.active);
      const hit = app.pick(at.x, at.y);
      this.#show(hit, at);
      say(app.spoken, hit ? this.#sentence(hit) : "No surface in the middle of the view.");
    };
  }

  clear() {
    this.#show(null);
  }

  #sentence({ value, vector, scale, mesh, face, bounds, scene }) {
    const place = `${mesh.element} ${face} of ${mesh.name}`;
    if (value === undefined) return `${place}.`;
    const amount = scale.withUnit(short(value, 5));
    if (vector) return `${this.app.scenes[scene].label}: length ${amount}, ${place}.`;
    return bounds ? `About ${amount} here; ${place} reaches ${scale.withUnit(enclosure(bounds))}.` : `About ${amount} here; ${place}.`;
  }

  #show(hit, at) {
    const { app } = this;
    this.element.hidden = !hit;
    app.legends.forEach((legend) => legend.point(hit?.value !== undefined && hit.scale === legend.scale ? legend.scale.place(hit.value) : null));
    this.#markOthers(hit);
    if (!hit) return;
    const { value, vector, scale, mesh, face, bounds, position } = hit;
    const numbers = (all, digits) => `(${all.map((x) => plain(Number(x.toPrecision(digits)))).join(", ")})`;
    this.element.replaceChildren(...[
      value !== undefined && h("div", { class: "value" }, h("span", { class: "swatch", style: `background:${scale.colorOf(value)}` }),
        h("b", { class: "number" }, short(value, 6)), scale.data.unit && ` ${scale.data.unit}`),
      h("div", {}, `${mesh.element} ${face} of ${mesh.name}`, bounds && [": largest in ", h("span", { class: "number" }, enclosure(bounds))]),
      vector && h("div", { class: "where" }, numbers(vector, 5)),
      h("div", { class: "where" }, `at ${numbers(app.scenes[hit.scene].camera.flat ? position.slice(0, 2) : position, 7)}`)].filter((child) => child));
    Object.assign(this.element.dataset, { face, value, lower: bounds?.[0], upper: bounds?.[1] });
    const { clientWidth, clientHeight } = app.view.element;
    const box = this.element.getBoundingClientRect();
    this.element.style.left = `${at.x + 18 + box.width > clientWidth ? Math.max(4, at.x - 18 - box.width) : at.x + 18}px`;
    this.element.style.top = `${Math.min(clientHeight - box.height - 4, Math.max(4, at.y + 14))}px`;
  }

  /** Marks the point on linked meshes in the other panes. */
  #markOthers(hit) {
    this.app.shown.forEach((scene, pane) => {
      const mesh = hit && pane !== hit.pane && scene.surfaces.filter((surface) => surface.readable).map((surface) => surface.mesh).find((mesh) => mesh.link === hit.mesh.link);
      scene.mark(mesh ? mesh.pointAt(hit.triangle, hit.weights) : null);
    });
  }
}
