// The legend: the colour map with values at their places, the threshold, and the value under the cursor.

import { h } from "./dom.js";
import { short } from "./format.js";
import { gradientOf } from "./scale.js";

export class Legend {
  constructor(scale) {
    this.scale = scale;
    this.bar = h("div", { class: "bar" });
    this.bar.style.background = gradientOf(scale.table);
    this.marks = h("div", { class: "ticks" });
    this.limit = h("div", { class: "limit-mark" });
    this.pointer = h("div", { class: "pointer" });
    this.title = h("div", { class: "legend-title" });
    this.element = h("div", { class: "legend", role: "img" }, this.title, h("div", { class: "bar-box" }, this.bar, this.limit, this.pointer), this.marks);
  }

  update() {
    const { scale } = this;
    const { title, unit } = scale.data;
    const over = scale.low === null && scale.largest > scale.end * (1 + 1e-12);
    this.title.textContent = unit ? `${title}, ${unit}` : title;
    this.marks.replaceChildren(...scale.marks().map((value) => {
      const mark = h("span", {}, short(value, 3));
      mark.style.left = `${100 * scale.place(value)}%`;
      return mark;
    }), over ? h("span", { class: "over" }, "and more") : "");
    this.limit.style.left = `${100 * scale.place(scale.threshold)}%`;
    this.limit.hidden = !scale.painting;
    const [low, high] = [scale.low ?? (scale.signed ? -scale.end : 0), (scale.low ?? 0) + scale.end];
    this.element.setAttribute("aria-label", `Legend: ${title} from ${short(low)} to ${short(high)}${over ? " and more" : ""} ${unit}`);
    this.element.classList.toggle("muted", scale.painting);
  }

  point(place) {
    this.pointer.hidden = place === null;
    if (place !== null) this.pointer.style.left = `${100 * place}%`;
  }
}
