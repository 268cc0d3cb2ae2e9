// Shares of the area in the classes of a scale: as they were given, or as drawn once ends of classes were moved.

import { h } from "../dom.js";
import { plain } from "../format.js";
import { table } from "./table.js";

export function classes(app, { key, caption, scale: index, values: indexOfValues, outer: [low, high], shares }) {
  const scale = app.scales[index];
  const values = app.values[indexOfValues];
  const element = h("div", { class: "group" });
  const names = (edges) => {
    const all = edges.map(plain);
    return [`${low}, below ${all[0]}`, ...all.slice(1).map((edge, i) => `${all[i]} to ${edge}`), `${high}, above ${all.at(-1)}`];
  };
  const text = (name) => ({ kind: "text", text: [name] });
  // Multiplying by 100 rounds: one step outwards more than makes up for it.
  const percent = ([lower, upper]) => [lower * 100 * (1 - 2 ** -51), upper * 100 * (1 + 2 ** -51)];
  const given = () => names(scale.data.bands).map((name, i) => {
    const ends = percent(shares[i]);
    return { cells: [text(name), { kind: "lower", ends }, { kind: "upper", ends }] };
  });
  const drawn = () => {
    const estimates = values.shares(app.meshes[values.mesh], scale.edges);
    return names(scale.edges).map((name, i) => ({ cells: [text(name), { kind: "number", value: 100 * estimates[i], digits: 3 }] }));
  };
  let shown = null;
  const update = () => {
    const now = scale.moved ? scale.edges.join() : "";
    if (now === shown) return;
    shown = now;
    const columns = ["% of the area", ...(scale.moved ? ["about"] : ["lower", "upper"])];
    element.replaceChildren(table(app, { key, caption, columns, rows: scale.moved ? drawn() : given(), sortable: false }).element,
      scale.moved ? h("p", { class: "note", "data-key": `${key}-moved` }, "Ends of bands were moved here. These shares are computed in the browser from what is drawn: estimates, not proven. Escape takes the ends back.") : "");
  };
  return { element, update };
}
