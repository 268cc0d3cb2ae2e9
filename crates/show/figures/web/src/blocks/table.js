// Tables: sorted by a click on the head of a column, with rows that lead to places.

import { h } from "../dom.js";
import { enclosure, exactly, short, textOf } from "../format.js";

/** What rows are sorted by. */
const sortKey = (cell) => {
  if (cell.ends) return cell.kind === "lower" ? cell.ends[0] : cell.ends[1];
  if (cell.kind === "number" || cell.kind === "bar") return cell.value;
  return cell.kind === "text" ? textOf(cell.text) : cell.alt ?? "";
};

const compare = (a, b) => (typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), undefined, { numeric: true }));

export function table(app, { key, caption, columns, rows, sortable }) {
  const longest = Math.max(...rows.flatMap(({ cells }) => cells).filter(({ kind }) => kind === "bar").map(({ value }) => Math.abs(value)), 0) || 1;
  const lines = rows.map((row) => line(app, row, longest));
  const body = h("tbody", {}, lines.map(({ element }) => element));
  const heads = columns.map((title, i) => h(title || sortable ? "th" : "td", { scope: title || sortable ? "col" : undefined },
    sortable && title ? h("button", { type: "button", class: "sort", "data-control": "sort", onclick: () => sort(i) }, title) : title));
  let [by, down] = [-1, false];
  const sort = (column) => {
    down = by === column && !down;
    by = column;
    heads.forEach((head, i) => (i === by ? head.setAttribute("aria-sort", down ? "descending" : "ascending") : head.removeAttribute("aria-sort")));
    // Rows that compare equal keep the order they were given in.
    const order = lines.map((_, i) => i).sort((a, b) => {
      const order = compare(sortKey(rows[a].cells[column]), sortKey(rows[b].cells[column]));
      return (down ? -order : order) || a - b;
    });
    body.append(...order.map((i) => lines[i].element));
  };
  const element = h("div", { class: "table-box" }, h("table", { class: "numbers", "data-key": key, "data-columns": columns.length },
    caption && h("caption", { class: "hidden" }, caption), columns.some((title) => title) && h("thead", {}, h("tr", {}, heads)), body));
  return { element, update: () => lines.forEach((line) => line.update?.()) };
}

function line(app, { cells, place }, longest) {
  const [first, ...rest] = cells;
  const name = contentOf(first, longest).children;
  const button = place && h("button", { type: "button", class: "to-place", "data-control": "row", onclick: () => app.choosePlace(place, button.textContent) }, name);
  const element = h("tr", {}, h("th", { scope: "row" }, button ?? name), rest.map((cell) => {
    const { attributes, children } = contentOf(cell, longest);
    return h("td", attributes, children);
  }));
  return { element, update: place && (() => {
    button.setAttribute("aria-pressed", String(app.isChosen(place)));
    element.classList.toggle("chosen", app.isChosen(place));
  }) };
}

function contentOf(cell, longest) {
  const exact = (x) => ({ "data-exact": String(x) });
  switch (cell.kind) {
    case "text": return { children: textOf(cell.text) };
    case "number": return { attributes: exact(cell.value), children: short(cell.value, cell.digits) };
    case "enclosure": return { attributes: { title: exactly(cell.ends), "data-lower": cell.ends[0], "data-upper": cell.ends[1] }, children: enclosure(cell.ends, 3, 6) };
    case "lower": return { attributes: exact(cell.ends[0]), children: enclosure(cell.ends).slice(1, -1).split(", ")[0] };
    case "upper": return { attributes: exact(cell.ends[1]), children: enclosure(cell.ends).slice(1, -1).split(", ")[1] };
    case "bar": return { attributes: { class: "bar-cell", "aria-hidden": "true" }, children: h("span", { class: "value-bar", style: `width:${(100 * Math.abs(cell.value)) / longest}%` }) };
    case "picture": return { attributes: { class: "picture-cell" }, children: h("img", { src: `data:image/png;base64,${cell.png}`, alt: cell.alt }) };
    default: return { children: "" };
  }
}
