// The side panel of the deviation page, part by part. Each gives an element, and what brings it up to date.

import { card, checkbox, h, say } from "./dom.js";
import { count, enclosure, exactly, percent, plural, short } from "./format.js";
import { convergence, cumulative, histogram } from "./charts.js";

/** The enclosures, and the way to the pair that proves them. */
export function answer(app) {
  const row = (direction) => {
    const { measured, from, to } = direction;
    return h("div", { class: "row" },
      h("dt", {}, `${from.label} \u2192 ${to.label}`),
      h("dd", {}, h("output", { class: "number", title: exactly(measured.distance) }, enclosure(measured.distance)), h("small", {}, measured.stop)));
  };
  const { distance } = app.data;
  const fly = h("button", { type: "button", id: "fly-to-pair", class: "primary", onclick: () => app.flyToPair() }, "Fly to the farthest pair");
  const home = h("button", { type: "button", id: "show-all", onclick: () => app.showAll() }, "Show all");
  const element = card("Distance",
    distance && h("p", { class: "headline" },
      h("span", {}, "H(A, B)"), h("output", { id: "distance", class: "number", title: exactly(distance) }, enclosure(distance)), h("span", { class: "unit" }, app.unit)),
    h("dl", { class: "rows" }, app.directions.map(row)),
    h("div", { class: "buttons" }, fly, home));
  return { element };
}

/** What is out of tolerance, and how much of the area that is. */
export function threshold(app) {
  const top = app.largest;
  const slider = h("input", {
    type: "range", id: "threshold", min: 0, max: 1000, step: 1, "aria-label": `Threshold in ${app.unitName}`,
    oninput: () => app.setThreshold((slider.valueAsNumber / 1000) * top),
  });
  const number = h("input", {
    type: "number", id: "threshold-value", min: 0, step: "any", "aria-label": `Threshold in ${app.unitName}`,
    onchange: () => Number.isFinite(number.valueAsNumber) && app.setThreshold(Math.max(0, number.valueAsNumber)),
  });
  const paint = checkbox("paint-threshold", "Paint what is farther", app.state.painting, (on) => app.setPainting(on));
  const area = h("output", { id: "area-above", class: "number" });
  const faces = h("p", { id: "faces-above", class: "note" });
  const element = card("Out of tolerance",
    h("div", { class: "slider" }, slider, h("span", { class: "field" }, number, h("span", { class: "unit" }, app.unit))),
    paint.element, h("p", { class: "fact" }, h("span", { id: "area-label" }), area), faces);
  const update = () => {
    const direction = app.direction;
    const at = app.state.threshold;
    slider.value = String(Math.round((at / top) * 1000));
    slider.setAttribute("aria-valuetext", `${short(at)} ${app.unitName}`);
    if (document.activeElement !== number) number.value = String(Number(at.toPrecision(6)));
    // What is painted and counted is the number itself, not the digits shown.
    number.dataset.exact = String(at);
    paint.input.checked = app.state.painting;
    say(element.querySelector("#area-label"), `Area of ${direction.from.label} farther than that`);
    const fraction = areaAbove(direction.measured.exceedance, at);
    say(area, percent(fraction));
    area.dataset.lower = String(fraction[0]);
    area.dataset.upper = String(fraction[1]);
    const { above, open, within } = facesAbove(direction, at);
    say(faces, `${plural(above, "face")} of ${direction.from.label} proven to reach beyond it, ${plural(within, "face")} proven to stay within` +
      (open ? `, ${count(open)} undecided.` : "."));
    Object.assign(faces.dataset, { above, open, within });
  };
  return { element, update };
}

/** Encloses the fraction of the area farther than `at`: the curve falls, so its neighbours bound it. */
export function areaAbove({ at: places, lower, upper }, at) {
  // The last place that is not beyond `at`.
  let i = -1;
  for (let step = 2 ** Math.ceil(Math.log2(places.length + 1)); step >= 1; step /= 2) {
    if (i + step < places.length && places[i + step] <= at) i += step;
  }
  if (i >= 0 && places[i] === at) return [lower[i], upper[i]];
  return [i + 1 < places.length ? lower[i + 1] : 0, i >= 0 ? upper[i] : 1];
}

function facesAbove({ bounds }, at) {
  let [above, open] = [0, 0];
  for (let i = 0; i < bounds.length; i += 2) {
    if (bounds[i] > at) above++;
    else if (bounds[i + 1] > at) open++;
  }
  return { above, open, within: bounds.length / 2 - above - open };
}

/** What the search had left at each tolerance. */
export function stages(app) {
  if (!app.directions.some(({ measured }) => measured.stages.length)) return null;
  const slider = h("input", {
    type: "range", id: "stage", min: 0, step: 1, "aria-label": "Stage of the search",
    oninput: () => app.setStage(slider.valueAsNumber - 1),
  });
  const play = h("button", { type: "button", id: "play-stages", onclick: () => app.playStages() }, "Play");
  const text = h("output", { id: "stage-text", class: "stage-text" });
  const chart = h("div", { class: "chart" });
  const element = card("What the search had left",
    h("p", { class: "note" }, "Parts that could not yet be ruled out as the place of the maximum, at finer and finer tolerances."),
    h("div", { class: "slider" }, slider, play), text, chart);
  const update = () => {
    const { measured, from } = app.direction;
    const all = measured.stages;
    slider.max = String(all.length);
    slider.value = String(app.state.stage + 1);
    slider.disabled = play.disabled = all.length === 0;
    const stage = all[app.state.stage];
    const said = stage
      ? `At ${app.lengthText(short(stage.tolerance, 3))}: ${plural(stage.count, "part")} of ${from.label} left, distance in ${enclosure([stage.lower, stage.upper])}`
      : all.length ? `Off. Move the slider: ${plural(all.length, "stage")} were recorded.` : "No stages were recorded in this direction.";
    say(text, said);
    text.dataset.count = stage ? String(stage.count) : "";
    slider.setAttribute("aria-valuetext", said);
    chart.replaceChildren(all.length ? convergence(all, app.state.stage, app.unit) : "");
  };
  return { element, update };
}

/** The worst places, the worst first. */
export function regions(app) {
  if (!app.directions.some(({ measured }) => measured.regions.length)) return null;
  const list = h("ol", { class: "regions", id: "regions" });
  const element = card("Worst regions", list);
  let shown = null;
  const update = () => {
    const { direction } = app;
    if (shown !== direction) {
      shown = direction;
      list.replaceChildren(...direction.measured.regions.map((region, i) => h("li", {}, h("button", {
        type: "button", class: "region", "data-region": i, "aria-pressed": "false", onclick: () => app.chooseRegion(i),
      },
      h("b", {}, String(i + 1)),
      h("span", { class: "swatch" }),
      h("span", {}, h("span", { class: "number", title: exactly(region.peak) }, enclosure(region.peak, 3, 6)), h("small", {},
        `${app.lengthText(short(region.extent, 3))} across, area ${short(region.area, 3)}${app.unit && ` ${app.unit}\u00b2`}`))))));
      if (!direction.measured.regions.length) list.replaceChildren(h("li", { class: "note" }, "None were given in this direction."));
    }
    for (const button of list.querySelectorAll("button")) {
      const i = Number(button.dataset.region);
      button.setAttribute("aria-pressed", String(i === app.state.region));
      button.querySelector(".swatch").style.background = app.colorOf(direction.measured.regions[i].peak[1]);
    }
  };
  return { element, update };
}

/** How the values are spread over the area. */
export function distribution(app) {
  const bars = h("div", { class: "chart", id: "histogram" });
  const curve = h("div", { class: "chart", id: "cumulative" });
  const element = card("Distribution over the area", bars, curve);
  const update = () => {
    bars.replaceChildren(histogram(app));
    curve.replaceChildren(cumulative(app, (at) => app.setThreshold(at)));
  };
  return { element, update };
}

export function statistics(app) {
  const body = h("tbody", {});
  const element = card("Statistics", h("table", { class: "numbers", id: "statistics" },
    h("caption", { class: "hidden" }, "Each statistic with a lower and an upper end"),
    h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "over the area"), h("th", { scope: "col" }, "lower"), h("th", { scope: "col" }, "upper"))), body));
  let shown = null;
  const update = () => {
    const { direction } = app;
    if (shown === direction) return;
    shown = direction;
    body.replaceChildren(...direction.measured.statistics.map(({ label, lower, upper }) => {
      const [low, high] = enclosure([lower, upper]).slice(1, -1).split(", ");
      return h("tr", {}, h("th", { scope: "row" }, label), h("td", { "data-exact": String(lower) }, low), h("td", { "data-exact": String(upper) }, high));
    }));
  };
  return { element, update };
}

/** How the answer was proved, from which files, by what. */
export function facts(app) {
  const { surfaces, proof, facts: run, version, command, origin } = app.data;
  const fact = (name, ...value) => h("div", { class: "row" }, h("dt", {}, name), h("dd", {}, ...value));
  const element = h("div", {},
    card("How it was proved", proof.map((paragraph) => h("p", {}, paragraph))),
    card("Files and run", h("dl", { class: "rows facts" },
      surfaces.map((surface) => fact(surface.label, h("span", { class: "path" }, surface.path), h("small", {}, `${plural(surface.faces, "face")}, ${count(surface.vertices)} vertices`))),
      run.map(([name, value]) => fact(name, value)),
      command && fact("command", h("code", {}, command)),
      fact("origin of the view", `(${origin.map((x) => short(x, 7)).join(", ")})`),
      fact("written by", `pompeiu ${version}`))));
  return { element };
}
