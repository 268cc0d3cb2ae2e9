// Above the view: which scenes are shown, how values are coloured, what is drawn, from where.

import { checkbox, choice, h, select } from "./dom.js";
import { savePicture } from "./shell.js";

/** The kinds of scales, and what they are called. */
const KINDS = [["linear", "linear"], ["root", "square root"], ["logarithmic", "logarithmic"], ["steps", "ten steps"]];

export function toolbar(app) {
  const { data, view } = app;
  const home = !hasHome(data) && h("button", { type: "button", "data-control": "show-all", onclick: () => app.showAll() }, "Show all");
  const save = h("button", { type: "button", "data-control": "save", onclick: () => savePicture(view, data.picture) }, "Save picture");
  const options = [...app.scales.flatMap((scale) => scaleControls(app, scale)), ...toggleControls(app), ...arrowControls(app), ...motionControls(app), ...spaceControls(app), ...upwardControls(app)];
  const arrangements = data.arrangements.length > 1 &&
    choice("arrangement", "What is shown", data.arrangements.map(({ key, text, hint }) => ({ value: key, text, hint })), app.arrangement.key,
      (key) => app.setArrangement(data.arrangements.find((arrangement) => arrangement.key === key)));
  const update = () => {
    if (arrangements) arrangements.choose(app.arrangement.key);
    // What changes nothing that is shown is not offered.
    for (const { control, serves } of options) control.element.hidden = !app.shown.some(serves);
  };
  return { elements: [arrangements && arrangements.element, h("div", { class: "options" }, options.map(({ control }) => control.element), home, save)], update };
}

/** Whether a card has the button that shows all. */
const hasHome = (data) => data.cards.flatMap(({ blocks }) => blocks).some(({ kind, of }) => kind === "buttons" && of.some(({ kind }) => kind === "showAll"));

function scaleControls(app, scale) {
  const suffix = app.scales.length > 1 ? `, ${scale.data.title}` : "";
  const serves = (scene) => scene.scales.includes(scale);
  const kind = scale.low === null && select("scale", `Colours${suffix}`, scale.edges.length ? [["bands", "tolerance bands"], ...KINDS] : KINDS, scale.kind, (kind) => {
    scale.kind = kind;
    scale.takeBackEdges();
    app.update();
  });
  const ranges = scale.data.ranges.map(({ text }, i) => [String(i), text]);
  const range = ranges.length > 1 && select("range", `up to${suffix}`, ranges, String(scale.range), (i) => {
    scale.range = Number(i);
    scale.custom = null;
    scale.takeBackEdges();
    app.update();
  });
  return [kind, range].filter((control) => control).map((control) => ({ control, serves }));
}

function toggleControls(app) {
  return app.toggles.map((toggle, i) => ({
    control: checkbox(`toggle-${i}`, toggle.text, toggle.on, (on) => {
      toggle.on = on;
      app.update();
    }),
    serves: (scene) => scene.layers.some((layer) => layer.toggle === i),
  }));
}

/** Whether a scene has such a shape. */
const has = (condition) => (scene) => scene.data.layers.some(({ frames }) => frames.some(condition));

function arrowControls(app) {
  const serves = has(({ kind }) => kind === "arrows");
  if (!app.scenes.some(serves)) return [];
  const equal = checkbox("equal-arrows", "of one length", false, (on) => {
    app.arrows.equal = on;
    app.update();
  });
  const slider = h("input", {
    type: "range", "data-control": "arrow-density", min: 0, max: 100, step: 1, value: String(app.arrows.density), "aria-label": "Density of arrows",
    oninput: () => {
      app.arrows.density = slider.valueAsNumber;
      app.update();
    },
  });
  return [equal, { element: h("label", { class: "select" }, h("span", {}, "density"), slider) }].map((control) => ({ control, serves }));
}

function motionControls(app) {
  const serves = has(({ kind, moving }) => kind === "lines" && moving);
  if (!app.scenes.some(serves)) return [];
  return [{ control: checkbox("motion", "Motion", app.motion, (on) => {
    app.motion = on;
    app.update();
  }), serves }];
}

/** The directions of the usual views, from the meshes to the eye, for each axis that points up. */
const VIEWS = {
  x: { front: [0, 1, 0], back: [0, -1, 0], left: [0, 0, -1], right: [0, 0, 1], top: [1, 1e-3, 0], bottom: [-1, 1e-3, 0] },
  y: { front: [0, 0, 1], back: [0, 0, -1], left: [-1, 0, 0], right: [1, 0, 0], top: [0, 1, 1e-3], bottom: [0, -1, 1e-3] },
  z: { front: [0, -1, 0], back: [0, 1, 0], left: [-1, 0, 0], right: [1, 0, 0], top: [0, -1e-3, 1], bottom: [0, -1e-3, -1] },
};

/** Views from the sides, numbers at places, and a section, where there is one space. */
function spaceControls(app) {
  const cameras = app.cameras.filter(({ flat }) => !flat);
  if (cameras.length !== 1) return [];
  const [camera] = cameras;
  const serves = (scene) => scene.camera === camera;
  const views = select("direction", "View", [["", "free"], ...Object.keys(VIEWS.y).map((name) => [name, name])], "", (name) => {
    if (name) camera.flyFrom(VIEWS[camera.upward][name]);
  });
  camera.onstart = () => { views.input.value = ""; };
  const all = [{ control: views, serves }];
  if (app.scenes.some(({ flags }) => flags.length)) {
    all.push({ control: checkbox("flags", "Numbers", app.flags, (on) => {
      app.flags = on;
      app.update();
    }), serves: (scene) => scene.flags.length > 0 });
  }
  if (app.section) all.push({ control: app.section.control, serves });
  return all;
}

function upwardControls(app) {
  const cameras = app.cameras.filter(({ flat }) => !flat);
  if (!cameras.length) return [];
  const control = select("upward", "Up", [["x", "x"], ["y", "y"], ["z", "z"]], cameras[0].upward, (axis) => {
    for (const camera of cameras) camera.turnUpward(axis);
  });
  return [{ control, serves: (scene) => !scene.camera.flat }];
}
