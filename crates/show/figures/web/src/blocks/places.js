// Places in order, each with a value; a click looks at it.

import { h } from "../dom.js";
import { enclosure, exactly, textOf } from "../format.js";

export function places(app, { key, scale: index, items, none }) {
  const scale = index === null ? null : app.scales[index];
  const buttons = items.map(({ place, ends, note }, i) => {
    const swatch = scale && h("span", { class: "swatch" });
    const element = h("button", { type: "button", class: "place", "data-place": i, "aria-pressed": "false", onclick: () => app.choosePlace(place, `place ${i + 1}, ${enclosure(ends)}`) },
      h("b", {}, String(i + 1)), swatch,
      h("span", {}, h("span", { class: "number", title: exactly(ends) }, enclosure(ends, 3, 6)), h("small", {}, textOf(note))));
    return { element, update: () => {
      element.setAttribute("aria-pressed", String(app.isChosen(place)));
      if (scale) swatch.style.background = scale.colorOf(ends[1]);
    } };
  });
  const rows = buttons.length ? buttons.map(({ element }) => h("li", {}, element)) : h("li", { class: "note" }, none);
  return { element: h("ol", { class: "places", "data-key": key }, rows), update: () => buttons.forEach((button) => button.update()) };
}
