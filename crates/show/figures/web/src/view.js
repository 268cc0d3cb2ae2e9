// The canvas: panes side by side, each a scene seen by the camera of its space, and marks drawn over them. A frame is drawn only
// when something changed.

import { LinearSRGBColorSpace, MathUtils, Vector3, WebGLRenderer } from "three";
import { h, s } from "./dom.js";

const STEP = MathUtils.degToRad(5);
const KEYS = "Arrow keys orbit, with Shift they move; plus and minus zoom; Home shows all; Enter reads the value in the middle, P pins it; Escape takes the last choice back.";

export class View {
  constructor() {
    this.panes = [];
    this.cameras = [];
    /** The pane that keys act on. */
    this.active = 0;
    this.canvas = h("canvas", {
      id: "view", tabindex: "0", role: "application", "aria-roledescription": "three-dimensional view",
      "aria-label": `The surfaces. ${KEYS}`, onkeydown: (event) => this.#key(event),
    });
    this.marks = s("svg", { class: "marks", "aria-hidden": "true" });
    this.labels = h("div", { class: "pane-labels" });
    this.crosshair = h("div", { class: "crosshair", "aria-hidden": "true" });
    this.element = h("div", { class: "view" }, this.canvas, this.marks, this.labels, this.crosshair);
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
    // Colours are those of the screen throughout: the maps are tables of what is to be seen.
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setScissorTest(true);
    new ResizeObserver(() => this.#resize()).observe(this.element);
    // Only the camera of the pane under the cursor follows it. It has to be known before the controls are told of an event.
    for (const type of ["pointerdown", "wheel"]) {
      this.canvas.addEventListener(type, (event) => this.#enable(this.#at(event).pane), { capture: true, passive: true });
    }
    for (const type of ["pointermove", "pointerleave", "pointerdown"]) {
      this.canvas.addEventListener(type, (event) => this.onpointer?.(type, this.#at(event), event));
    }
    // A click is a press that did not become a turn.
    let pressed = null;
    this.canvas.addEventListener("pointerdown", ({ clientX, clientY, button }) => (pressed = button === 0 ? [clientX, clientY] : null));
    this.canvas.addEventListener("click", (event) => {
      if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4) this.onclick?.(this.#at(event));
    });
    this.canvas.addEventListener("dblclick", (event) => {
      const { pane, ray } = this.#at(event);
      const hit = ray && pane?.scene.trace(ray);
      if (!hit) return;
      const [camera, point] = [pane.scene.camera, new Vector3(...hit.point)];
      camera.flyTo(point, camera.camera.position.distanceTo(point) / 2);
    });
  }

  #enable(pane) {
    if (pane) for (const camera of this.cameras) camera.controls.enabled = camera === pane.scene.camera;
  }

  /** Scenes are shown from left to right, and in rows. */
  show(scenes) {
    const before = new Map(this.cameras.map((camera) => [camera, this.placed?.has(camera) && camera.fittingAll(camera.direction)]));
    this.panes = scenes.map((scene) => ({ scene }));
    this.active = 0;
    const narrow = this.element.clientWidth < this.element.clientHeight;
    this.columns = scenes.length > 3 ? Math.ceil(Math.sqrt(scenes.length)) : narrow ? 1 : scenes.length;
    this.labels.replaceChildren(...scenes.map(({ label }) => h("div", { class: "pane-label" }, label)));
    this.labels.style.setProperty("--columns", this.columns);
    this.element.classList.toggle("several", scenes.length > 1);
    this.marks.replaceChildren();
    this.panes.forEach((pane, i) => {
      pane.clip = s("rect", {});
      pane.marks = s("g", { "clip-path": `url(#pane-${i})` });
      this.marks.append(s("clipPath", { id: `pane-${i}` }, pane.clip), pane.marks);
    });
    this.#resize();
    // Narrower panes are looked at from farther away.
    for (const camera of new Set(scenes.map(({ camera }) => camera))) {
      if (before.get(camera)) camera.zoom(camera.fittingAll(camera.direction) / before.get(camera));
    }
  }

  flyHome() {
    for (const camera of this.cameras) camera.flyHome();
  }

  invalidate() {
    this.element.dataset.state = "moving";
    this.asked = true;
    this.pending ??= requestAnimationFrame(() => this.#frame());
  }

  #frame() {
    this.pending = null;
    this.asked = false;
    for (const camera of this.cameras) camera.fly();
    const moves = this.onframe?.();
    this.drawNow();
    if (!this.asked) {
      this.element.dataset.state = "still";
      this.element.dataset.frames = Number(this.element.dataset.frames ?? 0) + 1;
    }
    // What moves by itself is not waited for.
    if (moves) this.pending ??= requestAnimationFrame(() => this.#frame());
  }

  drawNow() {
    this.panes.forEach((pane, i) => {
      const size = this.#size(i);
      const { x, y, width, height } = size;
      if (width < 1 || height < 1) return;
      const below = this.canvas.clientHeight - y - height;
      this.renderer.setViewport(x, below, width, height);
      this.renderer.setScissor(x, below, width, height);
      this.renderer.render(pane.scene.scene, pane.scene.camera.aim(size));
      for (const [name, value] of Object.entries(size)) pane.clip.setAttribute(name, value);
      pane.scene.draw(pane, (point) => this.project(point, i));
    });
  }

  /** Where a pane is, in pixels from the upper left corner of the canvas. */
  #size(i) {
    const columns = this.columns || 1;
    const rows = Math.max(1, Math.ceil(this.panes.length / columns));
    const [width, height] = [this.canvas.clientWidth / columns, this.canvas.clientHeight / rows];
    return { x: (i % columns) * width, y: Math.floor(i / columns) * height, width, height };
  }

  #resize() {
    const [width, height] = [this.element.clientWidth, this.element.clientHeight];
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.placed ??= new Set();
    this.panes.forEach(({ scene: { camera } }, i) => {
      camera.size = this.#size(i);
      if (this.placed.has(camera)) return;
      this.placed.add(camera);
      camera.home();
    });
    this.invalidate();
  }

  project(point, i) {
    return this.panes[i].scene.camera.project(point, this.#size(i));
  }

  /** The pane and the ray under a place of the canvas. */
  rayAt(x, y) {
    const i = this.panes.findIndex((_, i) => {
      const size = this.#size(i);
      return x >= size.x && x < size.x + size.width && y >= size.y && y < size.y + size.height;
    });
    if (i < 0) return {};
    return { pane: this.panes[i], index: i, ray: this.panes[i].scene.camera.ray(x, y, this.#size(i)) };
  }

  #at(event) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    return { x, y, ...this.rayAt(x, y) };
  }

  /** The middle of a pane, for those who read values by keyboard. */
  middle(i = 0) {
    const { x, y, width, height } = this.#size(i);
    return { x: x + width / 2, y: y + height / 2, ...this.rayAt(x + width / 2, y + height / 2) };
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const camera = this.panes[this.active]?.scene.camera;
    if (!camera) return;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = arrows[event.key];
    if (arrow && (event.shiftKey || camera.flat)) camera.move(...arrow);
    else if (arrow) camera.orbit(arrow[0] * STEP, arrow[1] * STEP);
    else if (event.key === "+" || event.key === "=") camera.zoom(1 / 1.15);
    else if (event.key === "-") camera.zoom(1.15);
    else if (event.key === "Home" || event.key === "0") camera.flyHome();
    else if (event.key === "Enter" || event.key === " ") this.onread?.();
    else if (event.key === "p" || event.key === "P") this.onclick?.(this.middle(this.active));
    else return;
    event.preventDefault();
  }
}
