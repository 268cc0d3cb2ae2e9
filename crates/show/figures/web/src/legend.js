// The legend: the colour map with values at their places, the threshold, and the value under the cursor.

import { h } from "./dom.js";
import { short } from "./format.js";
import { gradientOf } from "./scale.js";

export class Legend {
  constructor(table, unit) {
    this.unit = unit;
    this.bar = h("div", { class: "bar" });
    this.bar.style.background = gradientOf(table);
    this.marks = h("div", { class: "ticks" });
    this.limit = h("div", { class: "limit-mark" });
    this.pointer = h("div", { class: "pointer" });
    this.title = h("div", { class: "legend-title" });
    this.element = h("div", { class: "legend", id: "legend", role: "img" }, this.title, h("div", { class: "bar-box" }, this.bar, this.limit, this.pointer), this.marks);
  }

  update(scale, title, largest, threshold, painting) {
    const over = largest > scale.end * (1 + 1e-12);
    this.title.textContent = this.unit ? `${title}, ${this.unit}` : title;
    const marks = scale.marks();
    this.marks.replaceChildren(...marks.map((value) => {
      const mark = h("span", {}, short(value, 3));
      mark.style.left = `${100 * scale.place(value)}%`;
      return mark;
    }), over ? h("span", { class: "over" }, "and more") : "");
    this.limit.style.left = `${100 * scale.place(threshold)}%`;
    this.limit.hidden = !painting;
    this.element.setAttribute("aria-label",
      `Legend: ${title} from ${short(scale.signed ? -scale.end : 0)} to ${short(scale.end)}${over ? " and more" : ""} ${this.unit}`);
    this.element.classList.toggle("muted", painting);
  }

  point(place) {
    this.pointer.hidden = place === null;
    if (place !== null) this.pointer.style.left = `${100 * place}%`;
  }
}
