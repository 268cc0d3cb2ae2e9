// Charts, as SVG: what is proven is drawn full, what is possible lighter.

import { h, s } from "../dom.js";
import { percent, short, textOf, ticks } from "../format.js";

const [WIDTH, HEIGHT] = [320, 132];
const [LEFT, RIGHT, TOP, BOTTOM] = [38, 8, 8, 30];
const INNER = { width: WIDTH - LEFT - RIGHT, height: HEIGHT - TOP - BOTTOM };

/** Least and greatest of all places and values of the series. */
function extents(series) {
  const [xs, ys] = [[], []];
  for (const { kind, x, y, edges, shares, points } of series) {
    if (kind === "histogram") {
      xs.push(...edges);
      ys.push(0, ...shares.map(([, upper]) => upper));
    } else if (kind === "scatter") {
      xs.push(...points.map(({ at }) => at[0]));
      ys.push(...points.map(({ at }) => at[1]));
    } else {
      xs.push(...x);
      ys.push(...y.flat());
    }
  }
  return [xs, ys];
}

/** From values to pixels along one axis. */
class Axis {
  constructor({ logarithmic, low, high }, values, from, to) {
    Object.assign(this, { logarithmic, from, to });
    const known = logarithmic ? values.filter((value) => value > 0) : values;
    const bound = (given, choose, otherwise) => (given !== null && !(logarithmic && given <= 0) ? given : known.length ? known.reduce((a, b) => choose(a, b)) : otherwise);
    this.low = bound(low, Math.min, logarithmic ? 1 : 0);
    this.high = bound(high, Math.max, 1);
    if (!(this.high > this.low)) [this.low, this.high] = logarithmic ? [this.low / 2, this.low * 2] : [this.low - (low === null ? 0.5 : 0), this.low + 0.5];
  }

  #part(value) {
    if (!this.logarithmic) return (value - this.low) / (this.high - this.low);
    return Math.log(value / this.low) / Math.log(this.high / this.low);
  }

  at(value) {
    return this.from + this.#part(value) * (this.to - this.from);
  }

  shows(value) {
    return !this.logarithmic || value > 0;
  }

  valueAt(pixel) {
    const part = Math.min(1, Math.max(0, (pixel - this.from) / (this.to - this.from)));
    return this.logarithmic ? this.low * (this.high / this.low) ** part : this.low + part * (this.high - this.low);
  }

  ticks(count) {
    if (!this.logarithmic) return ticks(this.low, this.high, count).filter((value) => value >= this.low && value <= this.high);
    const [first, last] = [Math.ceil(Math.log10(this.low) - 1e-9), Math.floor(Math.log10(this.high) + 1e-9)];
    if (last - first < 1) return [this.low, this.high];
    const step = Math.ceil((last - first) / count);
    return Array.from({ length: Math.floor((last - first) / step) + 1 }, (_, i) => Number(`1e${first + i * step}`));
  }
}

function frame(title, { x, y }, xAxis, yAxis, yTicks) {
  const shown = (axis, value) => short(axis.percent ? value * 100 : value, 3);
  const nearest = (value) => HEIGHT - BOTTOM - yAxis.at(value);
  return s("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": title },
    s("title", {}, title),
    yTicks.filter((value) => nearest(value) > -0.5).map((value) => [
      s("line", { class: "grid", x1: LEFT, x2: WIDTH - RIGHT, y1: yAxis.at(value), y2: yAxis.at(value) }),
      s("text", { x: LEFT - 5, y: yAxis.at(value) + 3.5, "text-anchor": "end" }, shown(y, value)),
    ]),
    xAxis.ticks(4).map((value) => [
      s("line", { class: "tick", x1: xAxis.at(value), x2: xAxis.at(value), y1: HEIGHT - BOTTOM, y2: HEIGHT - BOTTOM + 4 }),
      s("text", { x: xAxis.at(value), y: HEIGHT - BOTTOM + 14, "text-anchor": "middle" }, shown(x, value)),
    ]),
    s("line", { class: "axis", x1: LEFT, x2: WIDTH - RIGHT, y1: HEIGHT - BOTTOM, y2: HEIGHT - BOTTOM }),
    s("text", { class: "label", x: WIDTH - RIGHT, y: HEIGHT - 3, "text-anchor": "end" }, x.label),
    s("text", { class: "label", x: 2, y: HEIGHT - 3 }, y.label));
}

const pixels = (value) => value.toFixed(2);

function line({ x, y }, index, xAxis, yAxis) {
  let drawing = false;
  const d = x.map((value, i) => {
    if (!xAxis.shows(value) || !yAxis.shows(y[i])) {
      drawing = false;
      return "";
    }
    const move = drawing ? "L" : "M";
    drawing = true;
    return `${move}${pixels(xAxis.at(value))} ${pixels(yAxis.at(y[i]))}`;
  }).join("");
  return s("path", { class: `curve series-${index % 4}`, d });
}

/** The area between two curves, and a line in the middle. */
function band({ x: all, y: enclosures, falling }, index, xAxis, yAxis) {
  const kept = all.map((_, i) => i).filter((i) => xAxis.shows(all[i]) && enclosures[i].every((end) => yAxis.shows(end)));
  const [x, y] = [kept.map((i) => all[i]), kept.map((i) => enclosures[i])];
  let area = "";
  if (falling) {
    // Between two places the curve is somewhere in their box, for it never rises.
    let low = "";
    area = `M${xAxis.at(xAxis.low)} ${yAxis.at(yAxis.high)}`;
    x.forEach((place, i) => {
      area += `H${pixels(xAxis.at(place))}V${pixels(yAxis.at(y[i][1]))}`;
      low = `L${pixels(xAxis.at(place))} ${pixels(yAxis.at(y[i][0]))}H${pixels(xAxis.at(x[i - 1] ?? xAxis.low))}` + low;
    });
    area += `H${xAxis.at(xAxis.high)}V${yAxis.at(yAxis.low)}${low}Z`;
  } else if (x.length) {
    const point = (end) => (place, i) => `${pixels(xAxis.at(place))} ${pixels(yAxis.at(y[i][end]))}`;
    area = `M${x.map(point(1)).join("L")}L${x.map(point(0)).reverse().join("L")}Z`;
  }
  const middle = x.map((place, i) => `${i ? "L" : "M"}${pixels(xAxis.at(place))} ${pixels(yAxis.at((y[i][0] + y[i][1]) / 2))}`).join("");
  return s("g", { class: `series-${index % 4}` }, s("path", { class: "band", d: area }), s("path", { class: "curve", d: middle }));
}

function histogram({ edges, shares }, scale, xAxis, yAxis) {
  return s("g", { class: "histogram" }, shares.map(([lower, upper], i) => {
    const [from, to] = [xAxis.at(edges[i]) + 0.4, xAxis.at(edges[i + 1]) - 0.4];
    const fill = scale ? scale.colorOf((edges[i] + edges[i + 1]) / 2) : "var(--accent)";
    const bar = (class_, bottom, top) => s("rect", {
      class: class_, x: from, y: yAxis.at(top), width: Math.max(0.5, to - from), height: Math.max(0, yAxis.at(bottom) - yAxis.at(top)), fill,
    });
    return s("g", {}, s("title", {}, `${short(edges[i])} to ${short(edges[i + 1])}: ${percent([lower, upper])}`),
      bar("possible", lower, upper), bar("proven", yAxis.low, lower));
  }));
}

function scatter(app, { points }, index, xAxis, yAxis) {
  return s("g", { class: `scatter series-${index % 4}` }, points.map(({ at: [x, y], label, place }, i) => {
    if (!xAxis.shows(x) || !yAxis.shows(y)) return null;
    const choose = place && (() => app.choosePlace(place, label));
    return s("circle", {
      class: place ? "to-place" : undefined, cx: xAxis.at(x), cy: yAxis.at(y), r: 3.4, "data-point": i, onclick: choose,
      tabindex: place ? "0" : undefined, role: place ? "button" : undefined, "aria-label": place ? label : undefined,
      onkeydown: choose && ((event) => (event.key === "Enter" || event.key === " ") && choose()),
    }, s("title", {}, `${label && `${label}: `}${short(x)}, ${short(y)}`));
  }));
}

/** A bar for each step of a player. */
function bars(app, { title, x, y, series: [{ values }], player: index }) {
  const height = 74;
  const player = index === null ? null : app.players[index];
  const sizes = values.map((value) => (y.logarithmic ? Math.max(value, Number.MIN_VALUE) : Math.max(value, 0)));
  const measure = y.logarithmic ? Math.log10 : (value) => value;
  const positive = sizes.filter((size) => size > 1e-300);
  const [most, least] = [measure(Math.max(...positive, 1e-300)), y.logarithmic ? measure(Math.min(...positive, 1e300)) : 0];
  const bottom = height - 18;
  const tall = (size) => 6 + (bottom - 14) * (most > least ? Math.max(0, measure(size) - least) / (most - least) : 1);
  const step = (WIDTH - 16) / values.length;
  const rects = sizes.map((size, i) => s("rect", { class: "step", x: 8 + i * step + 1, y: bottom - tall(size), width: Math.max(1, step - 2), height: tall(size), rx: 1.5 }));
  const texts = sizes.map((size, i) => s("text", { x: 8 + (i + 0.5) * step, y: bottom - tall(size) - 3, "text-anchor": "middle" }, short(size, 2)));
  const svg = s("svg", { viewBox: `0 0 ${WIDTH} ${height}`, role: "img", "aria-label": title }, s("title", {}, title), rects, texts,
    s("text", { class: "label", x: 8, y: height - 4 }, y.label || x.label));
  const update = () => {
    const present = player?.on ? Math.min(player.position, values.length - 1) : -1;
    rects.forEach((rect, i) => rect.classList.toggle("chosen", i === present));
    texts.forEach((text, i) => (text.style.display = values.length <= 6 || i === present ? "" : "none"));
  };
  if (player) chooseByClick(svg, (pixel) => player.set(Math.min(values.length - 1, Math.max(0, Math.floor((pixel - 8) / step)))));
  return { svg, update };
}

/** A click chooses what belongs to its place, in pixels of the chart. */
function chooseByClick(svg, choose) {
  svg.addEventListener("pointerdown", (event) => {
    const box = svg.getBoundingClientRect();
    choose(((event.clientX - box.left) / box.width) * WIDTH);
  });
  svg.classList.add("clickable");
}

function axesChart(app, chart) {
  const { series, title, x, y, scale: indexOfScale, setsThreshold, player: indexOfPlayer } = chart;
  const scale = indexOfScale === null ? null : app.scales[indexOfScale];
  const player = indexOfPlayer === null ? null : app.players[indexOfPlayer];
  const [xs, ys] = extents(series);
  const xAxis = new Axis(x, xs, LEFT, WIDTH - RIGHT);
  const yAxis = new Axis(y, ys, HEIGHT - BOTTOM, TOP);
  const yTicks = y.percent && yAxis.low === 0 && yAxis.high === 1 ? [0, 0.5, 1] : yAxis.ticks(3);
  const svg = frame(title, chart, xAxis, yAxis, yTicks);
  const draw = { line, band, histogram: (one) => histogram(one, scale, xAxis, yAxis), scatter: (one, i) => scatter(app, one, i, xAxis, yAxis) };
  const shapes = series.map((one, i) => svg.appendChild(draw[one.kind](one, i, xAxis, yAxis)));
  const marks = svg.appendChild(s("g", {}));
  const places = series.find(({ kind }) => kind === "line" || kind === "band")?.x;
  if (setsThreshold) chooseByClick(svg, (pixel) => app.setThreshold(scale, xAxis.valueAt(pixel)));
  else if (player && places) {
    chooseByClick(svg, (pixel) => {
      const distance = (i) => Math.abs(xAxis.at(places[i]) - pixel);
      player.set(places.reduce((best, _, i) => (distance(i) < distance(best) ? i : best), 0));
    });
  }
  const upright = (class_, at) => s("line", { class: class_, x1: at, x2: at, y1: TOP, y2: HEIGHT - BOTTOM });
  const thresholds = () => (scale ? [scale.threshold, scale.signed && -scale.threshold] : [])
    .filter((at) => at !== false && at >= xAxis.low && at <= xAxis.high).map((at) => upright("limit", xAxis.at(at)));
  /** Lines and dots at the present step. */
  const present = () => {
    if (!player?.on) return [];
    const i = player.position;
    const curves = series.filter(({ kind, x: at }) => (kind === "line" || kind === "band") && i < at.length && xAxis.shows(at[i]));
    const dots = curves.map(({ kind, x: at, y: values }) => [at[i], kind === "band" ? (values[i][0] + values[i][1]) / 2 : values[i]])
      .concat(series.filter(({ kind, points }) => kind === "scatter" && i < points.length).map(({ points }) => points[i].at))
      .filter(([a, b]) => xAxis.shows(a) && yAxis.shows(b));
    return [curves.length > 0 && upright("present", xAxis.at(curves[0].x[i])), dots.map(([a, b]) => s("circle", { class: "present", cx: xAxis.at(a), cy: yAxis.at(b), r: 3.4 }))]
      .flat().filter((mark) => mark);
  };
  let colors = null;
  const update = () => {
    // Colours follow the scale; curves stay.
    const state = scale && `${scale.kind} ${scale.end}`;
    if (colors !== state) {
      colors = state;
      series.forEach((one, i) => {
        if (one.kind !== "histogram") return;
        const anew = histogram(one, scale, xAxis, yAxis);
        shapes[i].replaceWith(anew);
        shapes[i] = anew;
      });
    }
    marks.replaceChildren(...thresholds(), ...present());
  };
  return { svg, update };
}

export function chart(app, given) {
  const data = { ...given, title: textOf(given.title) };
  const { svg, update } = data.series[0]?.kind === "bars" ? bars(app, data) : axesChart(app, data);
  const named = data.series.filter(({ label }) => label);
  const key = named.length > 1 && h("ul", { class: "chart-key" }, data.series.map(({ label }, i) => label && h("li", { class: `series-${i % 4}` }, label)));
  return { element: h("div", { class: "chart", "data-key": data.key }, svg, key), update };
}
