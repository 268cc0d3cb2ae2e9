// A camera of a space: orbiting by pointer, touch and keyboard in space, moving in the plane; flying to places.

import { MathUtils, Matrix4, MOUSE, PerspectiveCamera, Ray, Spherical, TOUCH, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const FIELD_OF_VIEW = 32;
const FLIGHT_MS = 700;
const HALF = Math.tan(MathUtils.degToRad(FIELD_OF_VIEW / 2));
/** Points enough to know how large meshes look. */
const OUTLINE = 3000;
const HOME = { x: [0.35, 0.6, 1], y: [0.6, 0.35, 1], z: [0.6, -1, 0.45] };

/** A ball around all points, and some of them. */
export function extentOf(arrays) {
  const [low, high] = [new Vector3(Infinity, Infinity, Infinity), new Vector3(-Infinity, -Infinity, -Infinity)];
  const point = new Vector3();
  for (const positions of arrays) {
    for (let i = 0; i < positions.length; i += 3) {
      point.fromArray(positions, i);
      low.min(point);
      high.max(point);
    }
  }
  const sphere = { center: low.x <= high.x ? low.add(high).multiplyScalar(0.5) : new Vector3(), radius: 0 };
  const outline = [];
  const total = arrays.reduce((sum, positions) => sum + positions.length / 3, 0);
  const step = Math.ceil(total / (OUTLINE * Math.min(arrays.length, 4)));
  for (const positions of arrays) {
    for (let i = 0; i < positions.length / 3; i++) {
      point.fromArray(positions, 3 * i);
      sphere.radius = Math.max(sphere.radius, point.distanceTo(sphere.center));
      if (i % step === 0) outline.push(point.clone());
    }
  }
  // A single point is looked at from somewhere, too.
  sphere.radius ||= 1;
  return { sphere, outline };
}

export class SpaceCamera {
  /** `space` says where its origin is and which axis points up, which is none in the plane; `onchange` asks for a frame. */
  constructor(space, arrays, canvas, onchange) {
    Object.assign(this, { space, canvas, onchange, ...extentOf(arrays) });
    this.flat = space.up === null;
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
    this.size = { x: 0, y: 0, width: 1, height: 1 };
    this.turnUpward(space.up ?? "y");
  }

  turnUpward(axis) {
    this.upward = axis;
    this.camera.up.set(axis === "x" ? 1 : 0, axis === "y" ? 1 : 0, axis === "z" ? 1 : 0);
    const enabled = this.controls?.enabled ?? true;
    this.controls?.dispose();
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enabled = enabled;
    this.controls.zoomSpeed = 1.4;
    this.controls.minDistance = this.sphere.radius * 1e-9;
    this.controls.maxDistance = this.sphere.radius * 40;
    if (this.flat) {
      this.controls.enableRotate = false;
      this.controls.mouseButtons.LEFT = MOUSE.PAN;
      this.controls.touches.ONE = TOUCH.PAN;
      this.controls.zoomToCursor = true;
    }
    this.controls.addEventListener("change", () => this.onchange());
    this.controls.addEventListener("start", () => {
      this.flight = null;
      this.onstart?.();
    });
    this.controls.addEventListener("end", () => this.onend?.());
    this.home();
  }

  get direction() {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  /** All of it, in space seen from a corner. */
  home() {
    const direction = this.flat ? new Vector3(0, 0, 1) : new Vector3(...HOME[this.upward]).normalize();
    this.camera.position.copy(direction).multiplyScalar(this.fittingAll(direction)).add(this.sphere.center);
    this.controls.target.copy(this.sphere.center);
    this.flight = null;
    this.controls.update();
    this.onchange();
  }

  flyHome() {
    this.flyTo(this.sphere.center, this.fittingAll(this.direction));
  }

  /** All of it, seen from a direction. */
  flyFrom(direction) {
    const to = new Vector3(...direction).normalize();
    this.flyTo(this.sphere.center, this.fittingAll(to), to);
  }

  /** How far from a ball of that radius the camera has to be to see it whole. */
  #fitting(radius) {
    const { width, height } = this.size;
    const half = MathUtils.degToRad(FIELD_OF_VIEW / 2);
    const narrow = Math.min(half, Math.atan(HALF * (width / height || 1)));
    return (radius * 1.04) / Math.sin(narrow);
  }

  /** How far away the camera has to be to see all of it from a direction, with some room for labels. */
  fittingAll(direction) {
    const { width, height } = this.size;
    const up = HALF * 0.86;
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
    const to = ((!this.flat && direction?.clone()) || from.clone()).normalize().multiplyScalar(distance);
    this.flight = { began: performance.now(), from, to, start: this.controls.target.clone(), target: target.clone() };
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.flight.began = -Infinity;
    this.onchange();
  }

  /** How far away the camera has to be to see a ball of that radius. */
  fittingBall(radius) {
    return Math.max(this.#fitting(radius), this.controls.minDistance * 4);
  }

  /** All of it at once, seen from a direction, without a flight. */
  lookFrom(direction) {
    this.home();
    this.camera.position.copy(direction).normalize().multiplyScalar(this.fittingAll(direction)).add(this.sphere.center);
    this.controls.update();
  }

  /** From where it is looked, and where to. */
  get looking() {
    return { position: this.camera.position.toArray(), target: this.controls.target.toArray() };
  }

  set looking({ position, target }) {
    this.flight = null;
    this.camera.position.fromArray(position);
    this.controls.target.fromArray(target);
    this.controls.update();
    this.onchange();
  }

  /** Goes on with a flight. */
  fly() {
    if (!this.flight) return;
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
    if (this.flight) this.onchange();
  }

  /** Made ready to draw a pane of that size. */
  aim({ width, height }) {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const reach = this.camera.position.distanceTo(this.sphere.center);
    this.camera.near = Math.max(reach - this.sphere.radius * 1.5, distance * 0.02);
    this.camera.far = Math.max(reach + this.sphere.radius * 1.5, distance * 2);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    return this.camera;
  }

  /** A point of the space in pixels of the canvas, with the size of a unit there; null behind the camera. */
  project(point, { x, y, width, height }) {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const seen = point.clone().applyMatrix4(this.camera.matrixWorldInverse);
    if (seen.z >= 0) return null;
    const pixels = height / (2 * HALF) / -seen.z;
    return { x: x + width / 2 + seen.x * pixels, y: y + height / 2 - seen.y * pixels, pixels };
  }

  /** The ray under a place of the canvas, in a pane of that size. */
  ray(x, y, size) {
    this.camera.aspect = size.width / size.height;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    const [right, up] = [((x - size.x) / size.width) * 2 - 1, 1 - ((y - size.y) / size.height) * 2];
    const direction = new Vector3(right * HALF * this.camera.aspect, up * HALF, -1).transformDirection(this.camera.matrixWorld);
    return new Ray(this.camera.position.clone(), direction);
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
    this.onchange();
    this.onend?.();
  }

  move(right, upwards) {
    const distance = this.camera.position.distanceTo(this.controls.target) * 0.04;
    const by = new Vector3(right * distance, upwards * distance, 0).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(by);
    this.controls.target.add(by);
    this.controls.update();
    this.onchange();
    this.onend?.();
  }
}
