// The page of two surfaces and their deviation.

import { Box3, BufferAttribute, BufferGeometry, Mesh, Scene, Vector3 } from "three";
import { decode, spread } from "./decode.js";
import { checkbox, choice, h, say, select } from "./dom.js";
import { enclosure, plain, short } from "./format.js";
import { Legend } from "./legend.js";
import { acrossPair, PairMark, RingMark } from "./marks.js";
import { answer, distribution, facts, regions, stages, statistics, threshold } from "./panels.js";
import { Scale } from "./scale.js";
import { failure, savePicture, shell, themeColor } from "./shell.js";
import { colorTexture, raw, solidMaterial, extentOf, Surface } from "./surface.js";
import { View } from "./view.js";

const STAGE_MS = 900;
/** With more places than that, rings would hide what they point at. */
const RINGS = 8;
/** How much of its colour the rest of a surface loses while a region is looked at. */
const FADED = 0.72;
const MODES = {
  missing: { text: "Missing in B", hint: "A \u2192 B", directions: [0] },
  invented: { text: "Invented by B", hint: "B \u2192 A", directions: [1] },
  both: { text: "Side by side", directions: [0, 1] },
};

/** Decodes the arrays and puts them on the card; what is measured in a direction belongs to the surface measured from. */
async function directionOf(data, from, to, surface) {
  const { measured } = from;
  const bounds = await decode(measured.bounds);
  for (const stage of measured.stages) {
    stage.positions = await decode(stage.positions);
    stage.indices = await decode(stage.indices);
  }
  for (const region of measured.regions) region.faces = await decode(region.faces);
  return { from, to, measured, bounds, surface };
}

export class DeviationApp {
  static async open(data) {
    const surfaces = [];
    for (const { positions, places, indices, triangleFaces, measured } of data.surfaces) {
      surfaces.push(new Surface({
        positions: spread(await decode(positions), await decode(places)), indices: await decode(indices),
        faces: triangleFaces && (await decode(triangleFaces)), values: measured && (await decode(measured.values)),
      }));
    }
    const directions = [];
    for (const i of [0, 1]) {
      const [from, to] = [data.surfaces[i], data.surfaces[1 - i]];
      directions.push(from.measured ? await directionOf(data, from, to, surfaces[i]) : null);
    }
    return new DeviationApp(data, surfaces, directions);
  }

  constructor(data, surfaces, directions) {
    Object.assign(this, { data, surfaces });
    this.byIndex = directions;
    this.directions = directions.filter((direction) => direction);
    this.signed = data.signed;
    this.unit = data.unit;
    this.unitName = data.unit || "the unit of the files";
    this.largest = Math.max(...this.directions.map((direction) => this.largestOf(direction))) || 1;
    this.table = Uint8Array.from(data.colors.table);
    this.contrast = `rgb(${data.colors.contrast.join(", ")})`;
    this.scale = new Scale(this.signed);
    const first = directions[0] ? 0 : 1;
    this.state = {
      mode: first === 0 ? "missing" : "invented", direction: first, painting: false, stage: -1, region: -1, range: "own",
      threshold: data.threshold ?? this.distanceCoveringArea(this.directions[0], 0.05),
    };
    this.view = new View(extentOf(surfaces), data.up);
    this.#buildScenes();
    this.#buildPage();
    this.#pointing();
    this.update();
  }

  /** A length with its unit, where that is known. */
  lengthText(text) {
    return this.unit ? `${text} ${this.unit}` : text;
  }

  get direction() {
    return this.byIndex[this.state.direction];
  }

  largestOf({ measured, surface }) {
    return Math.max(measured.distance[1], surface.largest);
  }

  /** The least recorded distance that all but such a part of the area is within. */
  distanceCoveringArea(direction, part) {
    const { at, upper } = direction.measured.exceedance;
    const i = upper.findIndex((fraction) => fraction <= part);
    return i < 0 || at[i] === 0 ? this.largestOf(direction) : at[i];
  }

  // ---- scenes

  #point(position) {
    return new Vector3(...position.map((x, k) => (x - this.data.origin[k]) / this.data.scale));
  }

  #buildScenes() {
    const texture = colorTexture(this.table);
    this.scenes = this.byIndex.map((direction, i) => {
      if (!direction) return null;
      const { measured, surface, from } = direction;
      const scene = new Scene();
      const painted = surface.painted(texture, this.contrast);
      const ghost = this.surfaces[1 - i].ghost();
      ghost.renderOrder = 2;
      scene.add(painted, ghost);
      const stages = measured.stages.map(({ positions, indices }) => {
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new BufferAttribute(positions, 3));
        geometry.setIndex(new BufferAttribute(indices, 1));
        const mesh = new Mesh(geometry, solidMaterial(raw(this.contrast), 2));
        mesh.frustumCulled = false;
        mesh.visible = false;
        scene.add(mesh);
        return mesh;
      });
      const [start, end] = [this.#point(measured.witness.from), this.#point(measured.witness.to)];
      const label = this.lengthText(short(measured.distance[0], 5));
      return { scene, painted, ghost, stages, pair: new PairMark(start, end, label), ends: [start, end], rings: [], ringsOf: this.#stageRings(measured), chosen: null,
        label: this.signed ? `${from.label}, signed distance from ${direction.to.label}` : `${from.label}, distance from ${direction.to.label}` };
    });
    this.ghostShown = true;
    this.pairShown = true;
    this.view.painters.push((pane, project) => {
      const scene = this.scenes[pane.direction];
      if (this.pairShown) scene.pair.draw(pane, project);
      for (const ring of scene.rings) ring.draw(pane, project);
      scene.regionRing?.draw(pane, project);
    });
  }

  /** Where what is left is, place by place, so that it can be found once it is smaller than a pixel. */
  #stageRings(measured) {
    const near = this.view.sphere.radius * 0.1;
    return measured.stages.map(({ positions }) => {
      const places = [];
      for (let i = 0; i < positions.length; i += 3) {
        const point = new Vector3().fromArray(positions, i);
        let place = places.find(({ seed }) => seed.distanceTo(point) < near);
        if (!place) {
          if (places.length === RINGS) return [];
          places.push((place = { seed: point, box: new Box3() }));
        }
        place.box.expandByPoint(point);
      }
      return places.map(({ box }) => new RingMark("left", box.getCenter(new Vector3()), box.getSize(new Vector3()).length() / 2));
    });
  }

  // ---- the page

  #buildPage() {
    const modes = Object.entries(MODES).filter(([, { directions }]) => directions.every((i) => this.byIndex[i]));
    this.modes = choice("What is shown", modes.map(([value, { text, hint }]) => ({ value, text, hint, id: `mode-${value}` })), this.state.mode, (mode) => this.setMode(mode));
    this.sides = choice("Numbers of", this.directions.map(({ from, to }) => ({
      value: String(this.data.surfaces.indexOf(from)), text: `${from.label} \u2192 ${to.label}`, id: `direction-${from.label}`,
    })), String(this.state.direction), (i) => this.setDirection(Number(i)));
    const scaleKind = select("scale", "Colours", [["linear", "linear"], ["root", "square root"], ["logarithmic", "logarithmic"]], "linear", (kind) => {
      this.scale.kind = kind;
      this.update();
    });
    const range = select("range", "up to", [["own", "the largest here"], ["all", "the largest of both"], ["most", "99\u202f% of the area"], ["threshold", "the threshold"]], "own", (end) => {
      this.state.range = end;
      this.update();
    });
    const upward = select("upward", "Up", [["x", "x"], ["y", "y"], ["z", "z"]], this.data.up, (axis) => this.view.turnUpward(axis));
    const ghost = checkbox("show-other", "Other surface", true, (on) => {
      this.ghostShown = on;
      this.update();
    });
    const pair = checkbox("show-pair", "Farthest pair", true, (on) => {
      this.pairShown = on;
      if (!on) this.scenes.forEach((scene) => scene?.pair.remove());
      this.update();
    });
    const save = h("button", { type: "button", id: "save", onclick: () => savePicture(this.view, "deviation") }, "Save picture");
    this.legend = new Legend(this.table, this.unit);
    this.legend.point(null);
    this.reading = h("div", { class: "reading", id: "reading", hidden: true });
    this.spoken = h("div", { class: "hidden", id: "spoken", role: "status", "aria-live": "polite" });
    this.view.element.append(this.legend.element, this.reading, this.spoken);
    this.parts = [answer, threshold, regions, stages, distribution, statistics, facts].map((part) => part(this)).filter((part) => part);
    const [one, two] = this.data.surfaces;
    this.shell = shell({
      title: this.data.title, subtitle: `A: ${one.name}  \u00b7  B: ${two.name}`,
      toolbar: [this.modes.element, h("div", { class: "options" }, scaleKind.element, range.element, ghost.element, pair.element, upward.element, save)],
      view: this.view.element, panel: [this.sides.element, this.parts.map(({ element }) => element)],
      onTheme: () => this.update(),
    });
  }

  setMode(mode) {
    this.state.mode = mode;
    const shown = MODES[mode].directions;
    if (!shown.includes(this.state.direction)) this.#turnTo(shown[0]);
    this.modes.choose(mode);
    this.update();
  }

  setDirection(direction) {
    this.#turnTo(direction);
    if (this.state.mode !== "both") this.state.mode = direction === 0 ? "missing" : "invented";
    this.modes.choose(this.state.mode);
    this.update();
  }

  #turnTo(direction) {
    if (direction === this.state.direction) return;
    this.state.direction = direction;
    this.state.region = -1;
    this.state.stage = Math.min(this.state.stage, this.direction.measured.stages.length - 1);
    this.sides.choose(String(direction));
  }

  setThreshold(at) {
    this.state.threshold = at;
    this.state.painting = true;
    this.update();
  }

  setPainting(on) {
    this.state.painting = on;
    this.update();
  }

  setStage(stage) {
    this.state.stage = stage;
    this.update();
  }

  playStages() {
    clearInterval(this.playing);
    const last = this.direction.measured.stages.length - 1;
    this.setStage(0);
    this.playing = setInterval(() => {
      if (this.state.stage >= last) clearInterval(this.playing);
      else this.setStage(this.state.stage + 1);
    }, STAGE_MS);
  }

  showAll() {
    this.state.region = -1;
    this.update();
    this.view.flyHome();
  }

  flyToPair() {
    this.state.region = -1;
    this.update();
    const [from, to] = this.scenes[this.state.direction].ends;
    const middle = from.clone().add(to).multiplyScalar(0.5);
    const radius = Math.max(from.distanceTo(to) * 0.9, this.view.sphere.radius * 1e-7);
    const present = this.view.camera.position.clone().sub(this.view.controls.target);
    const isFree = (direction) => {
      const eye = middle.clone().addScaledVector(direction, radius * 4.5);
      return this.surfaces.every((surface) => !surface.blocked(eye, from) && !surface.blocked(eye, to));
    };
    // Surroundings are shown too, or nobody knows where the place is.
    const around = Math.max(radius, Math.min(this.view.sphere.radius * 0.06, radius * 6));
    this.view.fitTo(middle, around, acrossPair(from, to, present, isFree));
    say(this.spoken, `Looking at the farthest pair, ${this.lengthText(enclosure(this.direction.measured.distance))}`);
  }

  chooseRegion(i) {
    if (this.state.region === i) {
      this.showAll();
      return;
    }
    this.state.region = i;
    const region = this.direction.measured.regions[i];
    const radius = Math.max(region.extent / 2 / this.data.scale, this.view.sphere.radius * 1e-6);
    const center = this.#point(region.center);
    const present = this.view.camera.position.clone().sub(this.view.controls.target);
    const [from, to] = [this.#point(region.point), this.#point(region.nearest)];
    const isFree = (direction) => !this.direction.surface.blocked(center.clone().addScaledVector(direction, radius * 5 + this.view.sphere.radius * 0.2), from);
    this.view.fitTo(center, Math.max(radius * 1.7, this.view.sphere.radius * 0.03), acrossPair(from, to, present, isFree));
    this.update();
    say(this.spoken, `Looking at region ${i + 1}, ${this.lengthText(enclosure(region.peak))}`);
  }

  colorOf(value) {
    const at = Math.round(this.scale.place(value) * 255) * 3;
    return `rgb(${this.table[at]} ${this.table[at + 1]} ${this.table[at + 2]})`;
  }

  // ---- bringing everything up to date

  update() {
    const { state } = this;
    // Side by side, colours mean the same on both sides.
    const own = state.mode === "both" ? this.largest : this.largestOf(this.direction);
    this.scale.end = { own, all: this.largest, most: this.distanceCoveringArea(this.direction, 0.01), threshold: state.threshold }[state.range] || 1;
    const background = raw(themeColor("--view"));
    const neutral = raw(themeColor("--neutral"));
    this.view.element.dataset.mode = state.mode;
    this.byIndex.forEach((direction, i) => {
      if (!direction) return;
      const scene = this.scenes[i];
      const staged = state.stage >= 0 && scene.stages.length > 0;
      scene.scene.background = background;
      scene.painted.userData.scale(this.scale);
      scene.painted.userData.paint(staged ? "neutral" : state.painting ? "threshold" : "map", state.threshold);
      scene.painted.material.uniforms.neutral.value.copy(neutral);
      scene.ghost.visible = this.ghostShown;
      scene.ghost.material.uniforms.neutral.value.copy(raw(themeColor("--ghost")));
      scene.ghost.material.uniforms.opacity.value = 0.42;
      scene.stages.forEach((mesh, k) => (mesh.visible = k === Math.min(state.stage, scene.stages.length - 1)));
      for (const ring of scene.rings) ring.remove();
      scene.rings = staged ? scene.ringsOf[Math.min(state.stage, scene.stages.length - 1)] : [];
      this.#highlight(scene, direction, i === state.direction ? state.region : -1);
    });
    const shown = MODES[state.mode].directions;
    if (this.panes !== state.mode) {
      this.panes = state.mode;
      const narrow = () => (this.view.element.clientWidth < this.view.element.clientHeight ? 1 : shown.length);
      this.view.show(shown.map((i) => ({ scene: this.scenes[i].scene, label: this.scenes[i].label, direction: i, trace: (ray) => this.surfaces[i].trace(ray) })), narrow());
    }
    this.legend.update(this.scale, this.signed ? "signed distance" : "distance", own, state.threshold, state.painting);
    for (const part of this.parts) part.update?.();
    this.view.invalidate();
  }

  #highlight(scene, { measured, surface }, region) {
    if (scene.region === region) return;
    scene.region = region;
    if (scene.chosen) {
      scene.scene.remove(scene.chosen);
      scene.chosen.geometry.dispose();
      scene.chosen = null;
    }
    scene.painted.material.uniforms.fade.value = 0;
    scene.regionRing?.remove();
    scene.regionRing = null;
    if (region < 0) return;
    const { faces, center, extent } = measured.regions[region];
    scene.regionRing = new RingMark("region", this.#point(center), extent / 2 / this.data.scale, { label: String(region + 1), always: faces.length === 0 });
    if (faces.length === 0) return;
    scene.chosen = surface.part(scene.painted, faces);
    scene.scene.add(scene.chosen);
    scene.painted.material.uniforms.fade.value = FADED;
  }

  // ---- reading values

  #pointing() {
    let waiting = null;
    this.view.onpointer = (type, at, event) => {
      if (type === "pointerdown" && this.state.mode === "both" && at.pane) this.setDirection(at.pane.direction);
      if (type === "pointerleave" || event.buttons) {
        waiting = null;
        this.#read(null);
        return;
      }
      if (!waiting) {
        requestAnimationFrame(() => {
          if (waiting) this.#read(this.pick(waiting.x, waiting.y), waiting);
          waiting = null;
        });
      }
      waiting = at;
    };
    this.view.onread = () => {
      const at = this.view.middle(Math.max(0, this.view.panes.findIndex((pane) => pane.direction === this.state.direction)));
      const hit = this.pick(at.x, at.y);
      this.#read(hit, at);
      say(this.spoken, hit ? this.sentence(hit) : "No surface in the middle of the view.");
    };
  }

  /** What is under a place of the canvas: the triangle, its face, the value there, and what is proven of the face. */
  pick(x, y) {
    const { pane, ray } = this.view.rayAt(x, y);
    const hit = pane?.trace(ray);
    if (!hit) return null;
    const { bounds } = this.byIndex[pane.direction];
    const position = hit.point.map((coordinate, k) => coordinate * this.data.scale + this.data.origin[k]);
    return { ...hit, direction: pane.direction, position, bounds: [bounds[2 * hit.face], bounds[2 * hit.face + 1]] };
  }

  sentence({ value, face, bounds, direction }) {
    const { from } = this.byIndex[direction];
    return `About ${this.lengthText(short(value, 5))} here; face ${face} of ${from.label} reaches ${this.lengthText(enclosure(bounds))}.`;
  }

  #read(hit, at) {
    this.reading.hidden = !hit;
    this.legend.point(hit ? this.scale.place(hit.value) : null);
    if (!hit) return;
    const unit = this.unit && ` ${this.unit}`;
    this.reading.replaceChildren(
      h("div", { class: "value" }, h("span", { class: "swatch", style: `background:${this.colorOf(hit.value)}` }), h("b", { class: "number" }, short(hit.value, 6)), unit),
      h("div", {}, `face ${hit.face} of ${this.byIndex[hit.direction].from.label}: largest in `, h("span", { class: "number" }, enclosure(hit.bounds))),
      h("div", { class: "where" }, `at (${hit.position.map((x) => plain(Number(x.toPrecision(7)))).join(", ")})`));
    Object.assign(this.reading.dataset, { face: hit.face, value: hit.value, lower: hit.bounds[0], upper: hit.bounds[1] });
    const { clientWidth, clientHeight } = this.view.element;
    const box = this.reading.getBoundingClientRect();
    this.reading.style.left = `${at.x + 18 + box.width > clientWidth ? Math.max(4, at.x - 18 - box.width) : at.x + 18}px`;
    this.reading.style.top = `${Math.min(clientHeight - box.height - 4, Math.max(4, at.y + 14))}px`;
  }
}

export async function openDeviation(data) {
  try {
    return await DeviationApp.open(data);
  } catch (error) {
    failure(error);
    throw error;
  }
}
