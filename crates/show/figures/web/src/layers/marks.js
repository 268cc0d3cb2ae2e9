// Marks over the panes: they keep their size on the screen, so a pair a thousandth of a millimetre apart can be seen from afar.

import { Group, Vector3 } from "three";
import { s } from "../dom.js";
import { textOf } from "../format.js";

/** The two points that prove a lower bound, joined, with the distance beside them. */
export class PairMark {
  constructor(from, to, label) {
    this.points = [from, to];
    this.label = label;
  }

  draw(pane, project) {
    this.element ??= s("g", { class: "pair" },
      s("line", { class: "halo" }), s("line", { class: "segment" }),
      s("circle", { class: "halo", r: 6.5 }), s("circle", { class: "to", r: 4.5 }),
      s("circle", { class: "halo", r: 7.5 }), s("circle", { class: "from", r: 5.5 }), s("text", {}, this.label));
    if (this.element.parentNode !== pane.marks) pane.marks.append(this.element);
    const [from, to] = this.points.map(project);
    this.element.toggleAttribute("hidden", !from || !to);
    this.element.style.display = from && to ? "" : "none";
    if (!from || !to) return;
    const [halo, segment, toHalo, toDot, fromHalo, fromDot, text] = this.element.children;
    for (const line of [halo, segment]) place(line, { x1: from.x, y1: from.y, x2: to.x, y2: to.y });
    for (const dot of [toHalo, toDot]) place(dot, { cx: to.x, cy: to.y });
    for (const dot of [fromHalo, fromDot]) place(dot, { cx: from.x, cy: from.y });
    // Beside the far point, away from the segment if there is room.
    const room = 9.5 * this.label.length + 13;
    const [low, high] = [Number(pane.clip.getAttribute("x")), Number(pane.clip.getAttribute("x")) + Number(pane.clip.getAttribute("width"))];
    const left = from.x >= to.x ? from.x + room < high || from.x - room < low : from.x - room < low;
    place(text, { x: from.x + (left ? 13 : -13), y: from.y - 11, "text-anchor": left ? "start" : "end" });
  }

  remove() {
    this.element?.remove();
  }
}

/** Rings with a larger radius on the screen, in pixels, would show nothing that cannot be seen without them. */
const NEEDLESS = 45;

/** A ring around a place, as large as what is there and never too small to see. */
export class RingMark {
  constructor(kind, center, radius, { label = "", always = false } = {}) {
    Object.assign(this, { kind, center, radius, label, always });
  }

  draw(pane, project) {
    this.element ??= s("g", { class: `ring ${this.kind}` }, s("circle", { class: "halo" }), s("circle", {}), s("text", {}, this.label));
    if (this.element.parentNode !== pane.marks) pane.marks.append(this.element);
    const at = project(this.center);
    const r = at && Math.max(13, this.radius * at.pixels + 5);
    const needed = at && (this.always || r <= NEEDLESS);
    this.element.style.display = needed ? "" : "none";
    if (!needed) return;
    const [halo, ring, text] = this.element.children;
    for (const circle of [halo, ring]) place(circle, { cx: at.x, cy: at.y, r });
    place(text, { x: at.x, y: at.y - r - 7, "text-anchor": "middle" });
  }

  remove() {
    this.element?.remove();
  }
}

/** A number on a pole over a place, fainter where something is in front of it. */
export class FlagMark {
  constructor(point, label, isHidden, choose) {
    Object.assign(this, { point, label, isHidden, choose });
  }

  draw(pane, project) {
    this.element ??= s("g", { class: "flag", onclick: this.choose }, s("line", { class: "halo" }), s("line", {}), s("circle", { class: "foot", r: 2.6 }), s("circle", { class: "head", r: 10 }), s("text", {}, this.label));
    if (this.element.parentNode !== pane.marks) pane.marks.append(this.element);
    const at = project(this.point);
    this.element.style.display = at ? "" : "none";
    if (!at) return;
    const [halo, pole, foot, head, text] = this.element.children;
    const top = at.y - 26;
    for (const line of [halo, pole]) place(line, { x1: at.x, y1: at.y, x2: at.x, y2: top });
    place(foot, { cx: at.x, cy: at.y });
    place(head, { cx: at.x, cy: top });
    place(text, { x: at.x, y: top + 4.2, "text-anchor": "middle" });
    this.element.classList.toggle("behind", this.isHidden());
  }

  remove() {
    this.element?.remove();
  }
}

/** A point that was pinned, with its value, and the way to the nearest point of the other surface. */
export class PinMark {
  constructor(point, nearest, number, label) {
    Object.assign(this, { point, nearest, number, label });
  }

  draw(pane, project) {
    this.element ??= s("g", { class: "pin" }, s("line", {}), s("circle", { class: "halo", r: 6 }), s("circle", { class: "at", r: 4 }), s("text", {}, `${this.number}: ${this.label}`));
    if (this.element.parentNode !== pane.marks) pane.marks.append(this.element);
    const at = project(this.point);
    const to = this.nearest && project(this.nearest);
    this.element.style.display = at ? "" : "none";
    if (!at) return;
    const [way, halo, dot, text] = this.element.children;
    place(way, { x1: at.x, y1: at.y, x2: (to ?? at).x, y2: (to ?? at).y });
    for (const circle of [halo, dot]) place(circle, { cx: at.x, cy: at.y });
    const right = Number(pane.clip.getAttribute("x")) + Number(pane.clip.getAttribute("width"));
    const fits = at.x + 12 + 8.2 * text.textContent.length < right;
    place(text, { x: at.x + (fits ? 10 : -10), y: at.y - 9, "text-anchor": fits ? "start" : "end" });
  }

  remove() {
    this.element?.remove();
  }
}

/** The way between two points, with its length. */
export class MeasureMark {
  constructor(from, to, label) {
    Object.assign(this, { from, to, label });
  }

  draw(pane, project) {
    this.element ??= s("g", { class: "measure" }, s("line", { class: "halo" }), s("line", {}), s("text", {}, this.label));
    if (this.element.parentNode !== pane.marks) pane.marks.append(this.element);
    const [from, to] = [project(this.from), project(this.to)];
    this.element.style.display = from && to ? "" : "none";
    if (!from || !to) return;
    const [halo, line, text] = this.element.children;
    for (const one of [halo, line]) place(one, { x1: from.x, y1: from.y, x2: to.x, y2: to.y });
    place(text, { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 + 18, "text-anchor": "middle" });
  }

  remove() {
    this.element?.remove();
  }
}

/** Pairs of points of a scene. */
export class PairsLayer {
  constructor(app, { pairs }, scene) {
    this.object = new Group();
    this.marks = pairs.map(({ from, to, label }) => new PairMark(scene.point(from), scene.point(to), textOf(label)));
  }

  update() {}
}

/** A dot at a point. */
export class DotMark {
  constructor(point) {
    this.point = point;
  }

  draw(pane, project) {
    this.element ??= s("g", { class: "dot" }, s("circle", { class: "halo", r: 6 }), s("circle", { r: 4 }));
    if (this.element.parentNode !== pane.marks) pane.marks.append(this.element);
    const at = project(this.point);
    this.element.style.display = at ? "" : "none";
    if (at) for (const circle of this.element.children) place(circle, { cx: at.x, cy: at.y });
  }

  remove() {
    this.element?.remove();
  }
}

function place(element, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, typeof value === "number" ? value.toFixed(2) : value);
  }
}

/** A direction to look at a pair from: across it, near the present one, with a free view if there is one, which it tells. */
export function acrossPair(from, to, present, isFree) {
  const along = new Vector3().subVectors(to, from);
  const look = present.clone().normalize();
  if (along.lengthSq() === 0) return { direction: look, free: isFree(look) };
  along.normalize();
  const first = look.addScaledVector(along, -look.dot(along));
  if (first.lengthSq() < 1e-6) first.set(along.y, along.z, along.x).addScaledVector(along, -new Vector3(along.y, along.z, along.x).dot(along));
  first.normalize();
  const second = new Vector3().crossVectors(along, first);
  const turned = (degrees) => {
    const angle = (degrees * Math.PI) / 180;
    return first.clone().multiplyScalar(Math.cos(angle)).addScaledVector(second, Math.sin(angle));
  };
  const all = [0, 25, -25, 50, -50, 75, -75, 100, -100, 130, -130, 160, -160, 180].map(turned);
  // A little from the side of the far point, where nothing of the other surface is near.
  const tilted = all.map((d) => d.addScaledVector(along, -0.35).normalize());
  const free = tilted.find(isFree);
  return { direction: free ?? tilted[0], free: free !== undefined };
}
