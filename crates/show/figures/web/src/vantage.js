// Where a place is seen from: from outside of what is drawn, with nothing in the way.

import { Ray, Vector3 } from "three";
import { acrossPair } from "./layers/marks.js";

/** Directions that are tried, evenly spread. */
const DIRECTIONS = 160;
/** From how steep a view on a surface gains no more: seen from straight above, depths cannot be told. */
const STEEP = 0.8;
const GOLDEN_ANGLE = Math.PI * (3 - Math.sqrt(5));

/** Evenly spread on the sphere. */
const SPREAD = Array.from({ length: DIRECTIONS }, (_, i) => {
  const z = 1 - (2 * i + 1) / DIRECTIONS;
  const across = Math.sqrt(1 - z * z);
  return new Vector3(across * Math.cos(GOLDEN_ANGLE * i), across * Math.sin(GOLDEN_ANGLE * i), z);
});

/** The views of one point of a scene that may be chosen. */
class Views {
  /** `samples` are points that should be seen, too. */
  constructor(scene, point, samples, present) {
    const { camera } = scene;
    this.meshes = scene.surfaces.filter(({ readable }) => readable).map(({ mesh }) => mesh);
    this.size = camera.sphere.radius;
    this.up = camera.camera.up;
    this.present = present.clone().normalize();
    this.samples = samples;
    // What is drawn may be simpler than what was measured: rays begin on what is drawn.
    const feet = this.meshes.map((mesh) => mesh.foot(point)).filter((foot) => foot);
    const foot = feet.reduce((near, other) => (near && near.point.distanceTo(point) <= other.point.distanceTo(point) ? near : other), null);
    this.point = foot && foot.point.distanceTo(point) < this.size * 0.02 ? foot.point : point;
    this.normal = foot?.normal;
  }

  /** Just off the surface, on the side of a direction. */
  #off(direction) {
    return this.point.clone().addScaledVector(direction, this.size * 1e-4);
  }

  /** How far from the point the last surface in a direction is: 0 where nothing is in the way. */
  depth(direction) {
    const ray = new Ray(this.#off(direction), direction);
    return Math.max(0, ...this.meshes.map((mesh) => mesh.last(ray)));
  }

  #sees(eye, point) {
    return !this.meshes.some((mesh) => mesh.blocked(eye, point));
  }

  /** Whether the point is seen by an eye that nothing is around. */
  isFree(eye) {
    const direction = eye.clone().sub(this.point).normalize();
    return this.depth(direction) === 0;
  }

  /** How well the place is seen from a direction by an eye at `eye`. */
  worth(direction, eye) {
    const toEye = (point) => point.clone().lerp(eye, 1e-3);
    const seen = this.samples.filter((sample) => this.#sees(eye, toEye(sample))).length / (this.samples.length || 1);
    const steep = this.normal ? Math.min(STEEP, Math.abs(this.normal.dot(direction))) : 0;
    // From straight above or below, nobody knows which side is which.
    const fallen = Math.max(0, Math.abs(direction.dot(this.up)) - 0.8);
    return 2 * seen + 1.5 * steep + 0.5 * direction.dot(this.present) - 3 * fallen;
  }
}

/**
 * The direction from `center` to an eye that is `distance` away, and the distance, so that the eye is outside of all surfaces and sees the
 * point. A point inside of closed surfaces is looked at from beyond them, where the way in is shortest.
 */
export function vantage(scene, { point, center, distance, samples = [], pair = null, present = scene.camera.direction }) {
  const views = new Views(scene, point, samples, present);
  const eye = (direction) => center.clone().addScaledVector(direction, distance);
  if (pair) {
    const across = acrossPair(...pair, views.present, (direction) => views.isFree(eye(direction)) && pair.every((end) => !scene.hides(eye(direction), end)));
    if (across.free) return { direction: across.direction, distance };
  }
  let best = null;
  for (const direction of [views.present, ...SPREAD]) {
    if (!views.isFree(eye(direction))) continue;
    const worth = views.worth(direction, eye(direction));
    if (!best || worth > best.worth) best = { direction: direction.clone(), distance, worth };
  }
  if (best) return best;
  const ways = SPREAD.map((direction) => ({ direction, depth: views.depth(direction) }));
  const { direction, depth } = ways.reduce((short, other) => (other.depth < short.depth ? other : short));
  return { direction: direction.clone(), distance: Math.max(distance, depth + center.distanceTo(point) + views.size * 0.3) };
}
