// A scene: its layers on the graphics card, which of them are shown, and what a ray meets.

import { Scene, Vector3 } from "three";
import { ArrowsLayer } from "./layers/arrows.js";
import { LinesLayer } from "./layers/lines.js";
import { DotMark, FlagMark, PairsLayer, RingMark } from "./layers/marks.js";
import { PointsLayer } from "./layers/points.js";
import { PiecesLayer, SurfaceLayer } from "./layers/surface.js";
import { raw } from "./color.js";
import { isCut } from "./section.js";

const LAYERS = { surface: SurfaceLayer, arrows: ArrowsLayer, pieces: PiecesLayer, lines: LinesLayer, points: PointsLayer, pairs: PairsLayer };

/** Places that are marked with numbers at most: more hide what they point at. */
const FLAGS = 12;

export class SceneView {
  constructor(app, data, camera) {
    Object.assign(this, { app, data, camera, label: data.label, name: data.name, places: data.places });
    this.scene = new Scene();
    const values = data.layers.flatMap(({ frames }) => frames).map((shape) => shape.values).find((values) => typeof values === "number");
    this.scales = [...new Set(data.layers.flatMap(({ frames }) => frames).flatMap((shape) =>
      [shape.scale ?? null, typeof shape.values === "number" ? app.data.values[shape.values].scale : null, shape.vectors === undefined ? null : app.data.values[shape.vectors].scale])
      .filter((scale) => scale !== null))].map((scale) => app.scales[scale]);
    this.contrast = raw(values === undefined ? "rgb(220, 30, 30)" : app.values[values].scale.contrast);
    // Numbers on poles are for places that have a point of their own.
    const flagged = data.places.map((place, i) => [place, i]).filter(([{ pair, label }]) => pair && label);
    this.flags = flagged.slice(0, FLAGS).map(([{ pair, label }, i]) => {
      const point = this.point(pair.from);
      return new FlagMark(point, label, () => this.#isBehind(point), () => app.choosePlace({ scene: app.scenes.indexOf(this), place: i }, `place ${label}`));
    });
    this.layers = data.layers.map((layer) => ({ ...layer, built: [], shown: null }));
    /** Marks of what is chosen and of what the cursor points at in another pane. */
    this.ring = null;
    this.dot = null;
    this.shownMarks = [];
  }

  /** A point of the page's coordinates in those of the view. */
  point(position) {
    return new Vector3(...position.map((x, k) => (x - this.camera.space.origin[k]) / this.camera.space.scale));
  }

  /** The other way round. */
  position(point) {
    return point.map((x, k) => x * this.camera.space.scale + this.camera.space.origin[k]);
  }

  /** What a layer shows now; frames are put on the card when they are first shown. */
  #frame(layer) {
    const player = layer.player === null ? null : this.app.players[layer.player];
    if ((player && !player.on) || (layer.toggle !== null && !this.app.toggles[layer.toggle].on)) return null;
    const i = player ? Math.min(player.position, layer.frames.length - 1) : 0;
    return (layer.built[i] ??= new LAYERS[layer.frames[i].kind](this.app, layer.frames[i], this));
  }

  get surfaces() {
    return this.layers.map(({ shown }) => shown).filter((shown) => shown instanceof SurfaceLayer);
  }

  /** Some points of a place, the corners of triangles that stand out. */
  samplesOf({ mesh: index, faces }, count = 12) {
    const mesh = index === null ? null : this.app.meshes[index];
    const wanted = new Set(faces);
    const inside = mesh && wanted.size ? Array.from({ length: mesh.triangles }, (_, t) => t).filter((t) => wanted.has(mesh.faceOf(t))) : [];
    const step = Math.max(1, Math.floor(inside.length / count));
    return inside.filter((_, i) => i % step === 0).slice(0, count).map((t) => mesh.pointAt(t, [1 / 3, 1 / 3, 1 / 3]));
  }

  /** The first pair of points that is given, shown or not. */
  get pair() {
    return this.data.layers.flatMap(({ frames }) => frames).find(({ kind, pairs }) => kind === "pairs" && pairs.length > 0)?.pairs[0];
  }

  update(look, place) {
    this.scene.background = look.theme.background;
    for (const layer of this.layers) {
      const shown = this.#frame(layer);
      if (shown !== layer.shown) {
        if (layer.shown) this.scene.remove(layer.shown.object);
        if (shown) this.scene.add(shown.object);
        layer.shown = shown;
      }
      shown?.update({ ...look, plain: layer.plainWhile !== null && this.app.players[layer.plainWhile].on, place: place?.mesh === layer.frames[0].mesh ? place : null });
    }
    if (this.place !== place) {
      this.place = place;
      this.ring = place && new RingMark("region", this.point(place.center), place.radius / this.camera.space.scale, { label: place.pair ? "" : place.label, always: place.faces.length === 0 });
    }
    const marks = [...(this.app.flags ? this.flags : []), ...this.app.pins.marks(this), ...this.layers.flatMap(({ shown }) => shown?.marks ?? []), this.ring, this.dot].filter((mark) => mark);
    for (const mark of this.shownMarks) if (!marks.includes(mark)) mark.remove();
    this.shownMarks = marks;
  }

  /** Marks where the cursor points at in another pane, or nothing. */
  mark(point) {
    if (!point && !this.dot) return;
    this.dot?.remove();
    this.dot = point && new DotMark(point);
    this.shownMarks = this.shownMarks.filter((mark) => !(mark instanceof DotMark)).concat(this.dot ?? []);
    this.app.view.invalidate();
  }

  /** Whether something hides a point, or it is cut away. */
  #isBehind(point) {
    if (isCut(point.toArray())) return true;
    const eye = this.camera.camera.position;
    return this.hides(eye, point);
  }

  draw(pane, project) {
    for (const mark of this.shownMarks) mark.draw(pane, project);
  }

  /** The nearest of what a ray meets of surfaces that one cannot see through. */
  trace(ray) {
    let nearest = null;
    for (const surface of this.surfaces) {
      const hit = surface.readable && surface.trace(ray);
      if (hit && (!nearest || hit.distance < nearest.distance)) nearest = hit;
    }
    return nearest;
  }

  /** Whether a surface that one cannot see through is between two points. */
  hides(from, to) {
    return this.surfaces.some(({ readable, mesh }) => readable && mesh.blocked(from, to));
  }

  /** Whether a player has something to show in it. */
  follows(player) {
    return this.layers.some((layer) => layer.player === player);
  }

  /** Whether streaks move in it. */
  get moves() {
    return this.layers.some(({ shown }) => shown?.moving);
  }
}
