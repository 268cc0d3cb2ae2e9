// Charts of the side panel, as SVG: what is proven is drawn full, what is possible lighter.

import { s } from "./dom.js";
import { percent, short, ticks } from "./format.js";

const [WIDTH, HEIGHT] = [320, 132];
const [LEFT, RIGHT, TOP, BOTTOM] = [38, 8, 8, 30];
const INNER = { width: WIDTH - LEFT - RIGHT, height: HEIGHT - TOP - BOTTOM };

function frame(title, { xLow, xHigh, yHigh, xLabel, yLabel, yTicks }) {
  const x = (value) => LEFT + ((value - xLow) / (xHigh - xLow || 1)) * INNER.width;
  const y = (value) => TOP + (1 - value / (yHigh || 1)) * INNER.height;
  const svg = s("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": title },
    s("title", {}, title),
    yTicks.map((value) => [
      s("line", { class: "grid", x1: LEFT, x2: WIDTH - RIGHT, y1: y(value), y2: y(value) }),
      s("text", { x: LEFT - 5, y: y(value) + 3.5, "text-anchor": "end" }, short(value * 100, 3)),
    ]),
    ticks(xLow, xHigh, 4).map((value) => [
      s("line", { class: "tick", x1: x(value), x2: x(value), y1: HEIGHT - BOTTOM, y2: HEIGHT - BOTTOM + 4 }),
      s("text", { x: x(value), y: HEIGHT - BOTTOM + 14, "text-anchor": "middle" }, short(value, 3)),
    ]),
    s("line", { class: "axis", x1: LEFT, x2: WIDTH - RIGHT, y1: HEIGHT - BOTTOM, y2: HEIGHT - BOTTOM }),
    s("text", { class: "label", x: WIDTH - RIGHT, y: HEIGHT - 3, "text-anchor": "end" }, xLabel),
    s("text", { class: "label", x: 2, y: HEIGHT - 3 }, yLabel));
  return { svg, x, y };
}

const unitOf = (app) => (app.unit ? `distance in ${app.unit}` : "distance");

/** The line at the threshold, in a chart over distances. */
function limit(app, x, [low, high]) {
  const at = app.state.threshold;
  return [at, app.signed && -at].filter((value) => value !== false && value >= low && value <= high)
    .map((value) => s("line", { class: "limit", x1: x(value), x2: x(value), y1: TOP, y2: HEIGHT - BOTTOM }));
}

export function histogram(app) {
  const { edges, lower, upper } = app.direction.measured.histogram;
  const [xLow, xHigh] = [edges[0] ?? 0, edges.at(-1) ?? 1];
  const yHigh = Math.max(...upper, 1e-9);
  const { svg, x, y } = frame(`Histogram: share of the area of ${app.direction.from.label} by distance`,
    { xLow, xHigh, yHigh, xLabel: unitOf(app), yLabel: "% of area", yTicks: ticks(0, yHigh, 3) });
  lower.forEach((low, i) => {
    const [from, to] = [x(edges[i]) + 0.4, x(edges[i + 1]) - 0.4];
    const bar = (class_, bottom, top) => s("rect", {
      class: class_, x: from, y: y(top), width: Math.max(0.5, to - from), height: Math.max(0, y(bottom) - y(top)),
      fill: app.colorOf((edges[i] + edges[i + 1]) / 2),
    });
    svg.append(s("g", {}, s("title", {}, `${short(edges[i])} to ${short(edges[i + 1])}: ${percent([low, upper[i]])}`),
      bar("possible", low, upper[i]), bar("proven", 0, low)));
  });
  svg.append(...limit(app, x, [xLow, xHigh]));
  return svg;
}

/** The share of the area farther than each distance: between two curves. */
export function cumulative(app, choose) {
  const { at, lower, upper } = app.direction.measured.exceedance;
  const xHigh = Math.max(app.largestOf(app.direction), at.at(-1) ?? 0) || 1;
  const { svg, x, y } = frame(`Share of the area of ${app.direction.from.label} that is farther than a distance`,
    { xLow: 0, xHigh, yHigh: 1, xLabel: unitOf(app), yLabel: "% farther than", yTicks: [0, 0.5, 1] });
  // Between two places the curve is somewhere in their box, for it never rises.
  let high = `M${x(0)} ${y(1)}`;
  let low = "";
  at.forEach((place, i) => {
    high += `H${x(place).toFixed(2)}V${y(upper[i]).toFixed(2)}`;
    low = `L${x(place).toFixed(2)} ${y(lower[i]).toFixed(2)}H${x(at[i - 1] ?? 0).toFixed(2)}` + low;
  });
  const mean = at.map((place, i) => `${i ? "L" : "M"}${x(place).toFixed(2)} ${y((lower[i] + upper[i]) / 2).toFixed(2)}`).join("");
  svg.append(s("path", { class: "band", d: `${high}H${x(xHigh)}V${y(0)}${low}Z` }), s("path", { class: "curve", d: mean }), ...limit(app, x, [0, xHigh]));
  svg.addEventListener("pointerdown", (event) => {
    const box = svg.getBoundingClientRect();
    const part = (((event.clientX - box.left) / box.width) * WIDTH - LEFT) / INNER.width;
    choose(Math.min(1, Math.max(0, part)) * xHigh);
  });
  svg.classList.add("clickable");
  return svg;
}

/** How the enclosure closed, stage by stage; the gap on a logarithmic scale. */
export function convergence(stages, chosen, unit) {
  const height = 74;
  const gaps = stages.map(({ lower, upper }) => Math.max(upper - lower, Number.MIN_VALUE));
  const positive = gaps.filter((gap) => gap > 1e-300);
  const [most, least] = [Math.log10(Math.max(...positive, 1e-300)), Math.log10(Math.min(...positive, 1e300))];
  const bottom = height - 18;
  const tall = (gap) => 6 + (bottom - 14) * (most > least ? Math.max(0, Math.log10(gap) - least) / (most - least) : 1);
  const step = (WIDTH - 16) / stages.length;
  const title = `Width of the enclosure at ${stages.length} stages, from ${short(gaps[0], 3)} to ${short(gaps.at(-1), 3)} ${unit}`;
  return s("svg", { viewBox: `0 0 ${WIDTH} ${height}`, role: "img", "aria-label": title }, s("title", {}, title),
    gaps.map((gap, i) => [
      s("rect", { class: i === chosen ? "stage chosen" : "stage", x: 8 + i * step + 1, y: bottom - tall(gap), width: Math.max(1, step - 2), height: tall(gap), rx: 1.5 }),
      (stages.length <= 6 || i === chosen) && s("text", { x: 8 + (i + 0.5) * step, y: bottom - tall(gap) - 3, "text-anchor": "middle" }, short(gap, 2)),
    ]),
    s("text", { class: "label", x: 8, y: height - 4 }, `width of the enclosure${unit && `, ${unit}`} (logarithmic), stage by stage`));
}
