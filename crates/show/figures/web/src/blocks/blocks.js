// The cards beside the view, block by block. A block gives an element, and what brings it up to date.

import { card, choice, h } from "../dom.js";
import { enclosure, exactly, short, textOf } from "../format.js";
import { chart } from "./chart.js";
import { classes } from "./classes.js";
import { places } from "./places.js";
import { playerControls } from "./player.js";
import { table } from "./table.js";
import { threshold } from "./threshold.js";

const BLOCKS = {
  text: (app, text) => ({ element: h("p", {}, textOf(text)) }),
  note: (app, text) => ({ element: h("p", { class: "note" }, textOf(text)) }),
  headline: (app, statistic) => ({ element: h("p", { class: "headline" }, h("span", {}, statistic.name), amount(statistic), h("span", { class: "unit" }, statistic.unit)) }),
  statistics, facts, run, buttons, threshold, player: playerControls, places, chart, table, classes,
};

/** The cards of the page; those of a scene are there while it is the chosen one. */
export function panel(app) {
  const cards = app.data.cards.map(({ title, scene, blocks }) => {
    const parts = blocks.map(({ kind, of }) => BLOCKS[kind](app, of));
    return { scene, element: card(title, parts.map(({ element }) => element)), update: () => parts.forEach((part) => part.update?.()) };
  });
  const scenes = [...new Set(cards.map(({ scene }) => scene))].filter((scene) => scene !== null).sort((a, b) => a - b);
  const sides = scenes.length > 1 && choice("scene", "Numbers of", scenes.map((i) => ({ value: String(i), text: app.scenes[i].name })), String(app.scene), (i) => app.setScene(Number(i)));
  const element = h("div", {});
  let shown = null;
  const update = () => {
    const present = cards.filter(({ scene }) => scene === null || scene === app.scene);
    if (shown !== app.scene) {
      shown = app.scene;
      // What has the focus stays where it is.
      if (sides && !sides.element.parentNode) element.append(sides.element);
      for (const { element: child } of cards) if (!present.some((card) => card.element === child)) child.remove();
      present.forEach(({ element: child }, i) => {
        const at = element.children[i + (sides ? 1 : 0)] ?? null;
        if (at !== child) element.insertBefore(child, at);
      });
      if (sides && scenes.includes(app.scene)) sides.choose(String(app.scene));
    }
    for (const card of present) card.update();
  };
  return { element, update };
}

/** A number or an enclosure of one. */
function amount({ key, value }) {
  return value.ends
    ? h("output", { "data-key": key, class: "number", title: exactly(value.ends), "data-lower": value.ends[0], "data-upper": value.ends[1] }, enclosure(value.ends))
    : h("output", { "data-key": key, class: "number", "data-exact": String(value.number) }, short(value.number, value.digits));
}

function row(name, value, note) {
  return h("div", { class: "row" }, h("dt", {}, name), h("dd", {}, value, note && h("small", {}, note)));
}

function statistics(app, all) {
  const withUnit = (statistic) => [amount(statistic), statistic.unit && h("span", { class: "unit" }, ` ${statistic.unit}`)];
  if (all.every(({ note }) => note.length === 0)) {
    return { element: h("div", { class: "rows" }, all.map((statistic) => h("p", { class: "fact" }, h("span", {}, statistic.name), h("span", {}, withUnit(statistic))))) };
  }
  return { element: h("dl", { class: "rows" }, all.map((statistic) =>
    row(statistic.name, withUnit(statistic), textOf(statistic.note)))) };
}

function facts(app, all) {
  return { element: h("dl", { class: "rows facts" }, all.map(({ name, value, note }) => row(name, textOf(value), textOf(note)))) };
}

function run(app) {
  const { command, spaces, version } = app.data;
  const origins = spaces.filter(({ origin }) => origin.some((x) => x !== 0));
  return { element: h("dl", { class: "rows facts" },
    command && row("command", h("code", {}, command)),
    origins.map(({ origin }) => row("origin of the view", `(${origin.map((x) => short(x, 7)).join(", ")})`)),
    version && row("written by", `pompeiu ${version}`)) };
}

function buttons(app, all) {
  const button = ({ kind, text }) => kind === "lookAtPair"
    ? h("button", { type: "button", "data-control": "look-at-pair", class: "primary", onclick: () => app.lookAtPair() }, text)
    : h("button", { type: "button", "data-control": "show-all", onclick: () => app.showAll() }, text);
  return { element: h("div", { class: "buttons" }, all.map(button)) };
}
