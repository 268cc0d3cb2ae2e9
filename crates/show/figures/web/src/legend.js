// The legend: the colour map with values at their places and how they are spread over the area, the threshold, and the value under
// the cursor; or the colours of classes. Its end and those of classes can be dragged.

import { h, s } from "./dom.js";
import { plain, short } from "./format.js";
import { gradientOf } from "./scale.js";

/** Columns of the histogram, and its height in units of its own. */
const COLUMNS = 60;
const HEIGHT = 30;

export class Legend {
  /** `spread` gives, for the scenes that are shown, shares of the area between values: `[from, to, share]`. `onchange` is told of a new end. */
  constructor(scale, spread, onchange) {
    Object.assign(this, { scale, spread, onchange });
    this.bar = h("div", { class: "bar" });
    this.marks = h("div", { class: "ticks" });
    this.limit = h("div", { class: "limit-mark" });
    this.pointer = h("div", { class: "pointer" });
    this.title = h("div", { class: "legend-title" });
    this.columns = s("svg", { class: "spread", viewBox: `0 0 ${COLUMNS} ${HEIGHT}`, preserveAspectRatio: "none", "aria-hidden": "true" });
    this.handle = scale.low === null && this.#endHandle();
    this.edges = h("div", {});
    this.box = h("div", { class: "bar-box" }, this.bar, this.limit, this.pointer, this.edges, this.handle);
    this.classes = h("div", { class: "classes" });
    this.element = h("div", { class: "legend", role: "group" }, this.title, this.columns, this.box, this.marks, this.classes);
  }

  /** A handle on the bar. `move` is told where a drag began and how far it went, in widths of the bar; `nudge` of arrow keys, 1 or -1. */
  #handle(attributes, { start, move, nudge, reset }) {
    const handle = h("div", { role: "slider", tabindex: "0", ...attributes,
      onpointerdown: (event) => {
        const width = this.bar.clientWidth;
        const [from, began] = [event.clientX, start()];
        handle.setPointerCapture(event.pointerId);
        handle.onpointermove = ({ clientX }) => {
          move(began, (clientX - from) / width);
          this.onchange();
        };
        handle.onpointerup = () => (handle.onpointermove = null);
        handle.focus();
        event.preventDefault();
      },
      ondblclick: () => {
        reset();
        this.onchange();
      },
      onkeydown: (event) => {
        const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
        if (!by) return;
        nudge(by);
        this.onchange();
        event.preventDefault();
      },
    });
    return handle;
  }

  /** What is dragged to the end of the bar becomes its end. */
  #endHandle() {
    const { scale } = this;
    return this.#handle({ class: "bar-handle", "data-control": "scale-end", "aria-label": "End of the colour scale", title: "Drag: where the colours end. Double click: as it was" }, {
      start: () => scale.end,
      move: (end, by) => (scale.custom = end * Math.min(10, Math.max(0.02, 1 + by))),
      nudge: (by) => (scale.custom = scale.end * 1.1 ** by),
      reset: () => (scale.custom = null),
    });
  }

  /** A handle for each end of a class. */
  #edgeHandles() {
    const { scale } = this;
    return scale.edges.map((_, i) => this.#handle({ class: "bar-handle edge", "data-control": `band-end-${i}`, "aria-label": `End ${i + 1} of the tolerance bands`, title: "Drag: where the band ends. Double click or Escape: as it was" }, {
      start: () => [scale.edges[i], scale.end * (scale.signed ? 2 : 1)],
      move: ([edge, width], by) => scale.moveEdge(i, edge + by * width),
      nudge: (by) => scale.moveEdge(i, scale.edges[i] + (by * scale.end) / 100),
      reset: () => scale.takeBackEdges(),
    }));
  }

  update() {
    const { scale } = this;
    const { title, unit } = scale.data;
    const banded = scale.kind === "bands";
    this.title.textContent = unit ? `${title}, ${unit}` : title;
    const over = scale.low === null && scale.largest > scale.end * (1 + 1e-12);
    if (over) this.title.append(h("span", { class: "over" }, "and more"));
    this.bar.style.background = banded ? this.#bands() : scale.kind === "steps" ? this.#steps() : gradientOf(scale.table);
    this.marks.replaceChildren(...scale.marks().map((value) => {
      const mark = h("span", {}, short(value, 3));
      mark.style.left = `${100 * this.#at(value)}%`;
      return mark;
    }));
    this.limit.style.left = `${100 * this.#at(scale.threshold)}%`;
    this.limit.hidden = !scale.painting;
    this.#updateClasses(banded);
    const names = banded && scale.classNames(plain);
    const [low, high] = [scale.low ?? (scale.signed ? -scale.end : 0), (scale.low ?? 0) + scale.end];
    this.element.setAttribute("aria-label", banded ? `Legend: ${title} in classes ${names.join(", ")} ${unit}`
      : `Legend: ${title} from ${short(low)} to ${short(high)}${over ? " and more" : ""} ${unit}`);
    if (this.handle) this.#tell(this.handle, scale.end);
    this.element.classList.toggle("muted", scale.painting);
    this.#spread();
  }

  #tell(handle, value) {
    handle.setAttribute("aria-valuenow", String(Number(value.toPrecision(6))));
    handle.setAttribute("aria-valuetext", this.scale.withUnit(short(value)));
  }

  #updateClasses(banded) {
    const { scale } = this;
    this.classes.hidden = this.edges.hidden = !banded;
    if (!banded) return;
    if (this.edges.children.length !== scale.edges.length) this.edges.replaceChildren(...this.#edgeHandles());
    scale.edges.forEach((edge, i) => {
      const handle = this.edges.children[i];
      handle.style.left = `${100 * scale.place(edge)}%`;
      this.#tell(handle, edge);
    });
    const swatch = (i) => h("span", { class: "swatch", style: `background:${scale.colorAt(scale.classPlace(i))}` });
    this.classes.replaceChildren(...scale.classNames(plain).map((name, i) => h("span", {}, swatch(i), name)));
  }

  #bands() {
    const { scale } = this;
    const places = [0, ...scale.edges.map((edge) => scale.place(edge)), 1].map((place) => 100 * place);
    const stops = places.slice(1).map((end, i) => `${scale.colorAt(scale.classPlace(i))} ${places[i]}% ${end}%`);
    return `linear-gradient(to right, ${stops.join(", ")})`;
  }

  /** Where a value stands: in steps, between their ends. */
  #at(value) {
    const { scale } = this;
    return scale.kind === "steps" ? scale.linear(value) : scale.place(value);
  }

  #steps() {
    const { scale } = this;
    const count = scale.signed ? 20 : 10;
    const stops = Array.from({ length: count }, (_, i) => {
      const color = scale.colorAt((i + 0.5) / count);
      return `${color} ${(100 * i) / count}% ${(100 * (i + 1)) / count}%`;
    });
    return `linear-gradient(to right, ${stops.join(", ")})`;
  }

  #spread() {
    const found = this.spread();
    this.columns.style.display = found.length ? "" : "none";
    if (!found.length) return;
    const heights = new Float64Array(COLUMNS);
    for (const [from, to, share] of found) {
      const [a, b] = [from, to].map((value) => COLUMNS * this.#at(value));
      // What is beyond the end counts into the last column.
      const [first, last] = [Math.min(COLUMNS - 1, Math.floor(a)), Math.min(COLUMNS - 1, Math.floor(b))];
      for (let i = first; i <= last; i++) {
        const part = b > a ? (Math.min(b, i + 1) - Math.max(a, i)) / (b - a) : 1;
        heights[i] += share * Math.max(0, part);
      }
    }
    const highest = Math.max(...heights) || 1;
    this.columns.replaceChildren(...Array.from(heights, (height, i) => {
      // Roots, so that small shares are seen beside large ones.
      const tall = HEIGHT * Math.sqrt(height / highest);
      return s("rect", { x: i + 0.06, width: 0.88, y: HEIGHT - tall, height: tall });
    }));
  }

  point(place) {
    this.pointer.hidden = place === null;
    if (place !== null) this.pointer.style.left = `${100 * place}%`;
  }
}
