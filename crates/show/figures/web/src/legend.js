// The legend: the colour map with values at their places and how they are spread over the area, the threshold, and the value under
// the cursor; or the colours of classes. Its end can be dragged.

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
    this.handle = scale.low === null && this.#handle();
    this.box = h("div", { class: "bar-box" }, this.bar, this.limit, this.pointer, this.handle);
    this.classes = h("div", { class: "classes" });
    this.element = h("div", { class: "legend", role: "group" }, this.title, this.classes, this.columns, this.box, this.marks);
  }

  /** What is dragged to the end of the bar becomes its end. */
  #handle() {
    const { scale } = this;
    const set = (end) => {
      scale.custom = end;
      this.onchange();
    };
    const handle = h("div", { class: "bar-handle", role: "slider", tabindex: "0", "data-control": "scale-end", "aria-label": "End of the colour scale", title: "Drag: where the colours end. Double click: as it was",
      onpointerdown: (event) => {
        const width = this.bar.clientWidth;
        const [from, end] = [event.clientX, scale.end];
        handle.setPointerCapture(event.pointerId);
        handle.onpointermove = ({ clientX }) => set(end * Math.min(10, Math.max(0.02, 1 + (clientX - from) / width)));
        handle.onpointerup = () => (handle.onpointermove = null);
        event.preventDefault();
      },
      ondblclick: () => set(null),
      onkeydown: (event) => {
        const by = { ArrowLeft: 1 / 1.1, ArrowDown: 1 / 1.1, ArrowRight: 1.1, ArrowUp: 1.1 }[event.key];
        if (!by) return;
        set(scale.end * by);
        event.preventDefault();
      },
    });
    return handle;
  }

  update() {
    const { scale } = this;
    const { title, unit } = scale.data;
    const banded = scale.kind === "bands";
    this.title.textContent = unit ? `${title}, ${unit}` : title;
    for (const element of [this.box, this.marks, this.columns]) element.style.display = banded ? "none" : "";
    this.classes.hidden = !banded;
    if (banded) {
      const names = scale.classNames(plain);
      this.classes.replaceChildren(...names.map((name, i) => h("span", {}, h("span", { class: "swatch", style: `background:${scale.colorAt(scale.classPlace(i))}` }), name)));
      this.element.setAttribute("aria-label", `Legend: ${title} in classes ${names.join(", ")} ${unit}`);
      return;
    }
    this.bar.style.background = scale.kind === "steps" ? this.#steps() : gradientOf(scale.table);
    const over = scale.low === null && scale.largest > scale.end * (1 + 1e-12);
    if (over) this.title.append(h("span", { class: "over" }, "and more"));
    this.marks.replaceChildren(...scale.marks().map((value) => {
      const mark = h("span", {}, short(value, 3));
      mark.style.left = `${100 * this.#at(value)}%`;
      return mark;
    }));
    this.limit.style.left = `${100 * this.#at(scale.threshold)}%`;
    this.limit.hidden = !scale.painting;
    const [low, high] = [scale.low ?? (scale.signed ? -scale.end : 0), (scale.low ?? 0) + scale.end];
    this.element.setAttribute("aria-label", `Legend: ${title} from ${short(low)} to ${short(high)}${over ? " and more" : ""} ${unit}`);
    if (this.handle) {
      this.handle.setAttribute("aria-valuenow", String(Number(scale.end.toPrecision(6))));
      this.handle.setAttribute("aria-valuetext", scale.withUnit(short(scale.end)));
    }
    this.element.classList.toggle("muted", scale.painting);
    this.#spread();
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
