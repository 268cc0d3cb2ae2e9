// Elements, made in one expression. Text always becomes a text node: nothing in a file's name can become markup.

const SVG = "http://www.w3.org/2000/svg";

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name in element && (typeof value === "boolean" || name === "value")) element[name] = value;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

export const h = (tag, attributes, ...children) => fill(document.createElement(tag), attributes, children);
export const s = (tag, attributes, ...children) => fill(document.createElementNS(SVG, tag), attributes, children);

let last = 0;
/** A name for an element that another one refers to. */
export const fresh = (stem) => `${stem}-${++last}`;

/** A part of the side panel under a heading of its own. */
export function card(title, ...children) {
  const id = fresh("card");
  return h("section", { class: "card", "aria-labelledby": id }, h("h2", { id }, title), ...children);
}

/** Choices of which exactly one holds: radio buttons that look like one switch. */
export function choice(control, label, options, chosen, onchange) {
  const name = fresh("choice");
  const inputs = new Map();
  const element = h("fieldset", { class: "choice" }, h("legend", {}, label), options.map(({ value, text, hint }) => {
    const input = h("input", { type: "radio", name, value, "data-control": `${control}-${value}`, checked: value === chosen, onchange: () => onchange(value) });
    inputs.set(value, input);
    return h("label", { title: hint }, input, h("span", {}, text, hint && h("small", {}, hint)));
  }));
  return { element, choose: (value) => { inputs.get(value).checked = true; } };
}

export function checkbox(control, label, checked, onchange) {
  const input = h("input", { type: "checkbox", "data-control": control, checked, onchange: () => onchange(input.checked) });
  return { element: h("label", { class: "check" }, input, label), input };
}

export function select(control, label, options, chosen, onchange) {
  const input = h("select", { "data-control": control, onchange: () => onchange(input.value) },
    options.map(([value, text]) => h("option", { value, selected: value === chosen }, text)));
  return { element: h("label", { class: "select" }, h("span", {}, label), input), input };
}

/** Says something to those who do not see the page change, and shows it to those who do. */
export const say = (element, text) => { if (element.textContent !== text) element.textContent = text; };
