// The canvas: panes side by side that share one camera, orbiting by pointer, touch and keyboard, flying to places, and marks
// drawn over the panes. A frame is drawn only when something changed.

import { LinearSRGBColorSpace, MathUtils, Matrix4, PerspectiveCamera, Ray, Spherical, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { h, s } from "./dom.js";

const FIELD_OF_VIEW = 32;
const FLIGHT_MS = 700;
const STEP = MathUtils.degToRad(5);
const KEYS = "Arrow keys orbit, with Shift they move; plus and minus zoom; Home shows all; Enter reads the value in the middle.";

export class View {
  /** `sphere` holds all there is to see, `outline` some points of it. */
  constructor({ sphere, outline }, upward) {
    Object.assign(this, { sphere, outline });
    this.panes = [];
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
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
    this.painters = [];
    this.turnUpward(upward);
    new ResizeObserver(() => this.#resize()).observe(this.element);
    for (const type of ["pointermove", "pointerleave", "pointerdown"]) {
      this.canvas.addEventListener(type, (event) => this.onpointer?.(type, this.#at(event), event));
    }
    this.canvas.addEventListener("dblclick", (event) => {
      const { pane, ray } = this.#at(event);
      const hit = ray && pane?.trace?.(ray);
      if (hit) this.flyTo(new Vector3(...hit.point), this.camera.position.distanceTo(new Vector3(...hit.point)) / 2);
    });
  }

  /** Panes are shown from left to right, or in rows: each has a scene, a label, and what a ray meets in it. */
  show(panes, columns = panes.length) {
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    const before = this.placed && this.#fittingAll(direction);
    this.panes = panes;
    this.columns = columns;
    // Narrower panes are looked at from farther away.
    if (before) this.zoom(this.#fittingAll(direction) / before);
    this.labels.replaceChildren(...panes.map((pane) => h("div", { class: "pane-label" }, pane.label)));
    this.labels.style.setProperty("--columns", columns);
    this.element.classList.toggle("several", panes.length > 1);
    this.marks.replaceChildren();
    for (const pane of panes) {
      pane.clip = s("rect", {});
      const id = `pane-${panes.indexOf(pane)}`;
      pane.marks = s("g", { "clip-path": `url(#${id})` });
      this.marks.append(s("clipPath", { id }, pane.clip), pane.marks);
    }
    this.#resize();
  }

  turnUpward(axis) {
    this.upward = axis;
    this.camera.up.set(axis === "x" ? 1 : 0, axis === "y" ? 1 : 0, axis === "z" ? 1 : 0);
    this.controls?.dispose();
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.zoomSpeed = 1.4;
    this.controls.minDistance = this.sphere.radius * 1e-9;
    this.controls.maxDistance = this.sphere.radius * 40;
    this.controls.addEventListener("change", () => this.invalidate());
    this.controls.addEventListener("start", () => (this.flight = null));
    this.home();
  }

  /** All of it, seen from a corner. */
  home() {
    const direction = new Vector3(...{ x: [0.35, 0.6, 1], y: [0.6, 0.35, 1], z: [0.6, -1, 0.45] }[this.upward]).normalize();
    this.camera.position.copy(direction).multiplyScalar(this.#fittingAll(direction)).add(this.sphere.center);
    this.controls.target.copy(this.sphere.center);
    this.flight = null;
    this.controls.update();
    this.invalidate();
  }

  flyHome() {
    this.flyTo(this.sphere.center, this.#fittingAll(this.camera.position.clone().sub(this.controls.target).normalize()));
  }

  /** How far from a ball of that radius the camera has to be to see it whole. */
  #fitting(radius) {
    const { width, height } = this.#size(0);
    const half = MathUtils.degToRad(FIELD_OF_VIEW / 2);
    const narrow = Math.min(half, Math.atan(Math.tan(half) * (width / height || 1)));
    return (radius * 1.04) / Math.sin(narrow);
  }

  /** How far away the camera has to be to see all of it from a direction, with some room for labels. */
  #fittingAll(direction) {
    const { width, height } = this.#size(0);
    const up = Math.tan(MathUtils.degToRad(FIELD_OF_VIEW / 2)) * 0.86;
    const right = up * (width / height || 1);
    const turned = new Matrix4().lookAt(direction, new Vector3(), this.camera.up).transpose();
    let distance = 0;
    for (const point of this.outline) {
      const seen = point.clone().sub(this.sphere.center).applyMatrix4(turned);
      distance = Math.max(distance, seen.z + Math.max(Math.abs(seen.x) / right, Math.abs(seen.y) / up));
    }
    return distance || this.#fitting(this.sphere.radius);
  }

  /** Moves to look at `target` from `distance`, from where it is or from a given direction. */
  flyTo(target, distance, direction) {
    const from = this.camera.position.clone().sub(this.controls.target);
    const to = (direction?.clone() ?? from.clone()).normalize().multiplyScalar(distance);
    this.flight = { began: performance.now(), from, to, start: this.controls.target.clone(), target: target.clone() };
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.flight.began = -Infinity;
    this.invalidate();
  }

  fitTo(center, radius, direction) {
    this.flyTo(center, Math.max(this.#fitting(radius), this.controls.minDistance * 4), direction);
  }

  #fly() {
    const { began, from, to, start, target } = this.flight;
    const t = Math.min(1, (performance.now() - began) / FLIGHT_MS);
    const eased = t * t * (3 - 2 * t);
    if (t === 1) this.flight = null;
    // Distances shrink by factors, directions turn: far and near look alike on the way.
    const length = Math.exp(MathUtils.lerp(Math.log(from.length()), Math.log(to.length()), eased));
    const turned = from.clone().normalize().lerp(to.clone().normalize(), eased);
    if (turned.lengthSq() < 1e-6) turned.copy(to);
    this.controls.target.lerpVectors(start, target, t === 1 ? 1 : eased);
    this.camera.position.copy(t === 1 ? to : turned.normalize().multiplyScalar(length)).add(this.controls.target);
    this.controls.update();
    if (this.flight) this.invalidate();
  }

  invalidate() {
    this.element.dataset.state = "moving";
    this.pending ??= requestAnimationFrame(() => this.#frame());
  }

  #frame() {
    this.pending = null;
    if (this.flight) this.#fly();
    this.drawNow();
    if (!this.pending) {
      this.element.dataset.state = "still";
      this.element.dataset.frames = Number(this.element.dataset.frames ?? 0) + 1;
    }
  }

  drawNow() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const reach = this.camera.position.distanceTo(this.sphere.center);
    this.camera.near = Math.max(reach - this.sphere.radius * 1.5, distance * 0.02);
    this.camera.far = Math.max(reach + this.sphere.radius * 1.5, distance * 2);
    this.panes.forEach((pane, i) => {
      const { x, y, width, height } = this.#size(i);
      if (width < 1 || height < 1) return;
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.camera.updateMatrixWorld();
      const below = this.canvas.clientHeight - y - height;
      this.renderer.setViewport(x, below, width, height);
      this.renderer.setScissor(x, below, width, height);
      this.renderer.render(pane.scene, this.camera);
      for (const [name, value] of Object.entries({ x, y, width, height })) pane.clip.setAttribute(name, value);
      for (const painter of this.painters) painter(pane, (point) => this.project(point, i));
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
    if (!this.placed) {
      this.placed = true;
      this.home();
    }
    this.invalidate();
  }

  /** A point of the scene in pixels of the canvas, with its depth; null behind the camera. */
  project(point, i) {
    const { x, y, width, height } = this.#size(i);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const seen = point.clone().applyMatrix4(this.camera.matrixWorldInverse);
    if (seen.z >= 0) return null;
    const pixels = height / (2 * Math.tan(MathUtils.degToRad(FIELD_OF_VIEW / 2))) / -seen.z;
    return { x: x + width / 2 + seen.x * pixels, y: y + height / 2 - seen.y * pixels, pixels };
  }

  /** The pane and the ray under a place of the canvas. */
  rayAt(x, y) {
    const i = this.panes.findIndex((_, i) => {
      const size = this.#size(i);
      return x >= size.x && x < size.x + size.width && y >= size.y && y < size.y + size.height;
    });
    if (i < 0) return {};
    const size = this.#size(i);
    this.camera.aspect = size.width / size.height;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    const across = new Vector2(((x - size.x) / size.width) * 2 - 1, 1 - ((y - size.y) / size.height) * 2);
    const half = Math.tan(MathUtils.degToRad(FIELD_OF_VIEW / 2));
    const direction = new Vector3(across.x * half * this.camera.aspect, across.y * half, -1).transformDirection(this.camera.matrixWorld);
    return { pane: this.panes[i], index: i, ray: new Ray(this.camera.position.clone(), direction) };
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

  orbit(right, upwards) {
    this.#turn((spherical) => {
      spherical.theta -= right;
      spherical.phi -= upwards;
    });
  }

  zoom(factor) {
    this.#turn((spherical) => {
      spherical.radius = MathUtils.clamp(spherical.radius * factor, this.controls.minDistance, this.controls.maxDistance);
    });
  }

  #turn(change) {
    this.flight = null;
    const toUp = this.camera.up.clone();
    // Spherical angles are about y.
    const axis = { x: ([x, y, z]) => [y, x, -z], y: (v) => v, z: ([x, y, z]) => [x, z, -y] }[this.upward];
    const back = { x: ([x, y, z]) => [y, x, -z], y: (v) => v, z: ([x, y, z]) => [x, -z, y] }[this.upward];
    const offset = this.camera.position.clone().sub(this.controls.target);
    const spherical = new Spherical().setFromVector3(new Vector3(...axis(offset.toArray())));
    change(spherical);
    spherical.makeSafe();
    const turned = new Vector3(...back(new Vector3().setFromSpherical(spherical).toArray()));
    this.camera.position.copy(this.controls.target).add(turned);
    this.camera.up.copy(toUp);
    this.controls.update();
    this.invalidate();
  }

  #move(right, upwards) {
    const distance = this.camera.position.distanceTo(this.controls.target) * 0.04;
    const by = new Vector3(right * distance, upwards * distance, 0).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(by);
    this.controls.target.add(by);
    this.controls.update();
    this.invalidate();
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = arrows[event.key];
    if (arrow && event.shiftKey) this.#move(...arrow);
    else if (arrow) this.orbit(arrow[0] * STEP, arrow[1] * STEP);
    else if (event.key === "+" || event.key === "=") this.zoom(1 / 1.15);
    else if (event.key === "-") this.zoom(1.15);
    else if (event.key === "Home" || event.key === "0") this.flyHome();
    else if (event.key === "Enter" || event.key === " ") this.onread?.();
    else return;
    event.preventDefault();
  }
}
