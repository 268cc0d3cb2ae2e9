// A page: scenes in a view, cards beside it, and what they have in common: the scenes that are shown, the chosen one, scales,
// players, switches and the chosen place.

import { panel } from "./blocks/blocks.js";
import { playerControls } from "./blocks/player.js";
import { SpaceCamera } from "./camera.js";
import { raw } from "./color.js";
import { h, say } from "./dom.js";
import { textOf } from "./format.js";
import { Legend } from "./legend.js";
import { Pins } from "./pins.js";
import { Reading } from "./reading.js";
import { SceneView } from "./scene.js";
import { Section } from "./section.js";
import { shell, themeColor } from "./shell.js";
import { toolbar } from "./toolbar.js";
import { vantage } from "./vantage.js";
import { View } from "./view.js";

/** How far streaks travel in a second, in lengths from one to the next. */
const STREAKS_PER_SECOND = 0.5;

/** Surroundings that are shown with a place, in radii of it. */
const AROUND = 2.5;

export class App {
  constructor(data, { meshes, scales, values, bounds, players }) {
    Object.assign(this, { data, meshes, scales, values, bounds, players });
    this.toggles = data.toggles.map(({ text, on }) => ({ text, on }));
    this.arrows = { density: 40, equal: false };
    this.motion = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.phase = 0;
    this.place = null;
    this.scenes = [];
    this.flags = true;
    this.pins = new Pins(this);
    this.spoken = h("div", { class: "hidden", id: "spoken", role: "status", "aria-live": "polite" });
    if (data.scenes.length) this.#tryView();
    this.#buildPage();
    for (const player of players) player.onchange = () => this.update();
    this.update();
    if (this.view && data.opening !== null) this.#open(data.opening);
  }

  // ---- scenes

  /** The first view: all of a scene, turned so that its farthest pair is seen. */
  #open(index) {
    this.setScene(index);
    const { pair, camera } = this.scenes[index];
    if (!pair) return;
    const scene = this.scenes[index];
    const distance = camera.fittingAll(camera.direction);
    const { direction } = vantage(scene, { point: scene.point(pair.from), center: camera.sphere.center, distance });
    camera.lookFrom(direction);
  }

  /** Without WebGL there is a picture, and all the numbers. */
  #tryView() {
    try {
      this.view = new View();
    } catch {
      this.scenes = this.data.scenes.map(({ name, places }) => ({ name, places, scales: this.scales }));
      this.scene = this.data.arrangements[0].scenes[0];
      this.arrangement = null;
      for (const scale of this.scales) scale.update(this.data.scenes.map((_, i) => i));
      return;
    }
    this.#buildView();
  }

  #buildView() {
    this.cameras = this.data.spaces.map((space, i) => {
      const shapes = this.data.scenes.filter((scene) => scene.space === i).flatMap(({ layers }) => layers).flatMap(({ frames }) => frames);
      const arrays = [...this.meshes.filter((mesh) => mesh.space === i).map(({ positions }) => positions),
        ...shapes.filter(({ kind }) => kind === "lines" || kind === "points").map(({ points }) => points)];
      return new SpaceCamera(space, arrays, this.view.canvas, () => this.view.invalidate());
    });
    this.view.cameras = this.cameras;
    for (const camera of this.cameras) camera.onend = () => this.#tellCameras();
    this.scenes = this.data.scenes.map((scene) => new SceneView(this, scene, this.cameras[scene.space]));
    this.arrangement = this.data.arrangements[0];
    this.scene = this.arrangement.scenes[0];
    this.legends = this.scales.map((scale, i) => new Legend(scale, () => this.#spread(i), () => this.update()));
    this.reading = new Reading(this);
    if (this.cameras.filter(({ flat }) => !flat).length === 1) this.section = new Section(this);
    this.view.onclick = ({ x, y }) => this.pins.toggle(this.pick(x, y), { x, y });
    addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.#takeBack();
    });
    this.view.element.append(h("div", { class: "legends" }, this.legends.map(({ element }) => element)), this.reading.element, this.spoken);
    this.view.onframe = () => this.#move();
  }

  /** Tells the page around this one from where people look. */
  #tellCameras() {
    if (parent !== window) parent.postMessage({ pompeiu: "cameras", cameras: this.cameras.map(({ looking }) => looking) }, "*");
  }

  /** Looks from where another page of the same spaces was looked at. */
  look(cameras) {
    if (!this.view || cameras.length !== this.cameras.length) return;
    cameras.forEach((looking, i) => { this.cameras[i].looking = looking; });
  }

  /** Moves streaks on; tells whether there are any. */
  #move() {
    const moving = this.motion ? this.shown.filter((scene) => scene.moves) : [];
    if (!moving.length) {
      this.moved = undefined;
      return false;
    }
    const now = performance.now();
    this.phase = (this.phase + ((now - (this.moved ?? now)) / 1000) * STREAKS_PER_SECOND) % 1;
    this.moved = now;
    for (const { layers } of moving) for (const { shown } of layers) if (shown?.moving) shown.uniforms.phase.value = this.phase;
    return true;
  }

  get shown() {
    return this.arrangement ? this.arrangement.scenes.map((i) => this.scenes[i]) : [];
  }

  /** Plays a film from the start, unless people want no motion; two pictures that alternate wait to be asked for. */
  begin() {
    const { below } = this.data;
    const player = below && this.players[below.player];
    const isFilm = player?.repeats && !player.optional && below.steps.length > 2;
    if (this.motion && isFilm && this.shown.some((scene) => scene.follows(below.player))) player.play(below.steps.length - 1);
  }

  // ---- the page

  #buildPage() {
    const { data } = this;
    this.toolbar = this.view && toolbar(this);
    this.panel = panel(this);
    this.below = data.below && playerControls(this, data.below);
    const below = this.below && h("div", { class: "below" }, this.below.element);
    this.shell = shell({
      title: data.title, subtitle: textOf(data.subtitle), banner: data.banner, toolbar: this.toolbar?.elements ?? [], view: this.view?.element ?? this.#still(),
      below, panel: this.panel.element, onTheme: () => this.update(),
    });
    if (!this.view) document.body.append(this.spoken);
  }

  /** Instead of the view. */
  #still() {
    if (!this.data.scenes.length) return undefined;
    const note = h("p", { class: "note", role: "alert", id: "no-view" }, "This browser has no WebGL, so nothing can be turned here. All numbers are beside or below.");
    const { still } = this.data;
    return h("div", { class: "still" }, note, still && h("img", { src: `data:image/png;base64,${still}`, alt: this.data.title }));
  }

  /** Escape: the chosen place, or else the last pinned point, or else what was painted and moved on scales. */
  #takeBack() {
    if (this.place) {
      this.place = null;
      this.update();
    } else if (!this.pins.removeLast()) {
      for (const scale of this.scales) {
        scale.painting = false;
        scale.takeBackEdges();
      }
      this.update();
    }
  }

  setArrangement(arrangement) {
    this.arrangement = arrangement;
    if (!arrangement.scenes.includes(this.scene)) this.#turnTo(arrangement.scenes[0]);
    this.update();
  }

  /** Chooses a scene: its numbers are told. Where it is not shown, an arrangement that has it is. */
  setScene(scene) {
    this.#turnTo(scene);
    if (!this.view) {
      this.update();
      return;
    }
    const { arrangements } = this.data;
    const alone = arrangements.find(({ scenes }) => scenes.length === 1 && scenes[0] === scene);
    if (this.arrangement.scenes.length === 1 || !this.arrangement.scenes.includes(scene)) {
      this.arrangement = alone ?? arrangements.find(({ scenes }) => scenes.includes(scene)) ?? this.arrangement;
    }
    this.update();
  }

  #turnTo(scene) {
    if (scene === this.scene) return;
    this.scene = scene;
    this.place = null;
  }

  setThreshold(scale, at) {
    scale.threshold = at;
    scale.painting = true;
    this.update();
  }

  showAll() {
    this.place = null;
    this.update();
    this.view?.flyHome();
  }

  lookAtPair() {
    this.place = null;
    this.update();
    if (!this.view) return;
    const scene = this.scenes[this.scene];
    const { pair, camera } = scene;
    if (!pair) return;
    const [from, to] = [scene.point(pair.from), scene.point(pair.to)];
    const middle = from.clone().add(to).multiplyScalar(0.5);
    const radius = Math.max(from.distanceTo(to) * 0.9, camera.sphere.radius * 1e-7);
    // Surroundings are shown too, or nobody knows where the place is.
    const distance = camera.fittingBall(Math.max(radius, Math.min(camera.sphere.radius * 0.06, radius * 6)));
    const found = vantage(scene, { point: from, center: middle, distance, pair: [from, to] });
    camera.flyTo(middle, found.distance, found.direction);
    say(this.spoken, `Looking at the pair ${textOf(pair.label)}`);
  }

  isChosen({ scene, place }) {
    return this.place !== null && this.place.scene === scene && this.place.place === place;
  }

  /** Looks at a place, or at all again if it is the chosen one. */
  choosePlace(id, name) {
    if (this.isChosen(id)) {
      this.showAll();
      return;
    }
    if (id.scene !== this.scene) this.setScene(id.scene);
    this.place = id;
    if (!this.view) {
      this.update();
      return;
    }
    const scene = this.scenes[id.scene];
    const place = scene.places[id.place];
    const { camera } = scene;
    const whole = camera.sphere.radius;
    const radius = Math.max(place.radius / camera.space.scale, whole * 1e-6);
    const center = scene.point(place.center);
    const distance = camera.fittingBall(Math.min(Math.max(radius * AROUND, whole * 0.06), Math.max(whole, radius * 1.2)));
    const samples = scene.samplesOf(place);
    const found = vantage(scene, { point: place.pair ? scene.point(place.pair.from) : center, center, distance, samples });
    camera.flyTo(center, found.distance, found.direction);
    this.update();
    say(this.spoken, `Looking at ${name}`);
  }

  // ---- bringing everything up to date

  update() {
    if (this.view) this.#updateView();
    this.toolbar?.update();
    if (this.below) {
      this.below.update();
      this.below.element.parentNode.hidden = !this.shown.some((scene) => scene.follows(this.data.below.player));
    }
    this.panel.update();
    this.view?.invalidate();
  }

  #updateView() {
    const { arrangement, shown } = this;
    for (const scale of this.scales) scale.update(arrangement.scenes);
    const theme = { background: raw(themeColor("--view")), neutral: raw(themeColor("--neutral")), ghost: raw(themeColor("--ghost")) };
    const style = (name) => (name.startsWith("--") ? themeColor(name) : name);
    const look = { theme, style, arrows: this.arrows, phase: this.phase, ratio: this.view.renderer.getPixelRatio() };
    for (const i of arrangement.scenes) {
      const scene = this.scenes[i];
      scene.update(look, this.place?.scene === i ? scene.places[this.place.place] : null);
    }
    this.section?.update(look);
    this.view.element.dataset.arrangement = arrangement.key;
    if (this.panes !== arrangement) {
      this.panes = arrangement;
      this.reading.clear();
      this.view.show(shown);
    }
    this.view.active = Math.max(0, arrangement.scenes.indexOf(this.scene));
    this.scales.forEach((scale, i) => {
      this.legends[i].element.hidden = !shown.some(({ scales }) => scales.includes(scale));
      this.legends[i].update();
    });
  }

  /** Shares of the area of the chosen scene between values: as proven where sizes are shown, from what is drawn where signs are. */
  #spread(index) {
    const scale = this.scales[index];
    if (!scale.signed) {
      const cards = this.data.cards.filter(({ scene }) => scene === this.scene).flatMap(({ blocks }) => blocks);
      const series = cards.filter(({ kind, of }) => kind === "chart" && of.scale === index).flatMap(({ of }) => of.series).find(({ kind }) => kind === "histogram");
      return series ? series.shares.map(([lower, upper], i) => [series.edges[i], series.edges[i + 1], (lower + upper) / 2]) : [];
    }
    const surface = this.scenes[this.scene].surfaces.find(({ values }) => values?.scale === scale);
    return surface ? surface.values.spread(surface.mesh) : [];
  }

  /** What is under a place of the canvas: the triangle, its face, the value there, and what is proven of the face. */
  pick(x, y) {
    const { pane, index, ray } = this.view.rayAt(x, y);
    const hit = pane?.scene.trace(ray);
    return hit ? { ...hit, pane: index, scene: this.scenes.indexOf(pane.scene), position: pane.scene.position(hit.point) } : null;
  }
}
