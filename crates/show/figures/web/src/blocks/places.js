// Places in order, each with a value; a click looks at it.

import { h } from "../dom.js";
import { enclosure, exactly, textOf } from "../format.js";
import { pointText, quoted } from "../pins.js";
import { saveText } from "../shell.js";

export function places(app, { key, scale: index, items, none }) {
  const scale = index === null ? null : app.scales[index];
  const buttons = items.map(({ place, ends, note }, i) => {
    const swatch = scale && h("span", { class: "swatch" });
    const element = h("button", { type: "button", class: "place", "data-place": i, "aria-pressed": "false", onclick: () => app.choosePlace(place, `place ${i + 1}, ${enclosure(ends)}`) },
      h("b", {}, String(i + 1)), swatch,
      h("span", {}, h("span", { class: "number", title: exactly(ends) }, enclosure(ends, 3, 6)), h("small", {}, textOf(note)), pairOf(app, place) && h("small", { class: "number" }, `at ${pointText(pairOf(app, place).from)}`)));
    return { element, update: () => {
      element.setAttribute("aria-pressed", String(app.isChosen(place)));
      if (scale) swatch.style.background = scale.colorOf(ends[1]);
    } };
  });
  const rows = buttons.length ? buttons.map(({ element }) => h("li", {}, element)) : h("li", { class: "note" }, none);
  const save = items.some(({ place }) => pairOf(app, place)) &&
    h("button", { type: "button", "data-control": `${key}-csv`, onclick: () => saveText(csv(app, items), `${app.data.picture}-${key}.csv`, "text/csv") }, "Save as CSV");
  const list = h("ol", { class: "places", "data-key": key }, rows);
  return { element: save ? h("div", { class: "group" }, list, save) : list, update: () => buttons.forEach((button) => button.update()) };
}

const pairOf = (app, { scene, place }) => app.data.scenes[scene].places[place].pair;

/** Each place with its ends, its point and the nearest point of the other surface. */
function csv(app, items) {
  const head = "number,lower,upper,x,y,z,nearest_x,nearest_y,nearest_z,note";
  const row = ({ place, ends, note }, i) => {
    const pair = pairOf(app, place);
    return [i + 1, ...ends, ...(pair ? [...pair.from, ...pair.to] : Array(6).fill("")), quoted(textOf(note))].join(",");
  };
  return [head, ...items.map(row)].join("\n") + "\n";
}
