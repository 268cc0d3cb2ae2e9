// What is beyond a threshold, and how much of the area and how many faces that is.

import { checkbox, h, say } from "../dom.js";
import { count, percent, plural, short } from "../format.js";

export function threshold(app, { scale: index, end: top, of, beyond, share, bounds: indexOfBounds }) {
  const scale = app.scales[index];
  const bounds = indexOfBounds === null ? null : app.bounds[indexOfBounds];
  const unit = scale.data.unit || "the unit of the files";
  const slider = h("input", {
    type: "range", "data-control": "threshold", min: 0, max: 1000, step: 1, "aria-label": `Threshold in ${unit}`,
    oninput: () => app.setThreshold(scale, (slider.valueAsNumber / 1000) * top),
  });
  const number = h("input", {
    type: "number", "data-control": "threshold-value", min: 0, step: "any", "aria-label": `Threshold in ${unit}`,
    onchange: () => Number.isFinite(number.valueAsNumber) && app.setThreshold(scale, Math.max(0, number.valueAsNumber)),
  });
  const paint = checkbox("paint-threshold", `Paint what is ${beyond}`, scale.painting, (on) => {
    scale.painting = on;
    app.update();
  });
  const area = h("output", { "data-key": "area-above", class: "number" });
  const faces = h("p", { "data-key": "faces-above", class: "note" });
  const element = h("div", { class: "group" },
    h("div", { class: "slider" }, slider, h("span", { class: "field" }, number, h("span", { class: "unit" }, scale.data.unit))),
    paint.element, share && h("p", { class: "fact" }, h("span", {}, `Area of ${of} ${beyond} than that`), area), bounds && faces);
  const update = () => {
    const at = scale.threshold;
    slider.value = String(Math.round((at / top) * 1000));
    slider.setAttribute("aria-valuetext", `${short(at)} ${unit}`);
    if (document.activeElement !== number) number.value = String(Number(at.toPrecision(6)));
    // What is painted and counted is the number itself, not the digits shown.
    number.dataset.exact = String(at);
    paint.input.checked = scale.painting;
    if (share) {
      const fraction = areaAbove(share, at);
      say(area, percent(fraction));
      area.dataset.lower = String(fraction[0]);
      area.dataset.upper = String(fraction[1]);
    }
    if (bounds) {
      const { above, open, within } = facesAbove(bounds, at);
      say(faces, `${plural(above, "face")} of ${of} proven to reach beyond it, ${plural(within, "face")} proven to stay within` +
        (open ? `, ${count(open)} undecided.` : "."));
      Object.assign(faces.dataset, { above, open, within });
    }
  };
  return { element, update };
}

/** Encloses the fraction of the area farther than `at`: the curve falls, so its neighbours bound it. */
export function areaAbove([places, shares], at) {
  // The last place that is not beyond `at`.
  let i = -1;
  for (let step = 2 ** Math.ceil(Math.log2(places.length + 1)); step >= 1; step /= 2) {
    if (i + step < places.length && places[i + step] <= at) i += step;
  }
  if (i >= 0 && places[i] === at) return shares[i];
  return [i + 1 < places.length ? shares[i + 1][0] : 0, i >= 0 ? shares[i][1] : 1];
}

function facesAbove(bounds, at) {
  let [above, open] = [0, 0];
  for (let i = 0; i < bounds.length; i += 2) {
    if (bounds[i] > at) above++;
    else if (bounds[i + 1] > at) open++;
  }
  return { above, open, within: bounds.length / 2 - above - open };
}
