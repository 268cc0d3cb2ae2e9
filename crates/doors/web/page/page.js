// The page: files are taken, a task is asked, and what was found is shown beside it.

const $ = (id) => document.getElementById(id);
const MIB = 2 ** 20;
/** Bytes that a page can address, and those that tasks take for each face: measured on bunnies of 6,944 and 69,451 faces, with some to spare. */
const MOST_MEMORY = 4096 * MIB;
const BYTES_PER_FACE = { deviation: 2000, info: 500, simplify: 1200, remesh: 1200, flatten: 5000, repair: 500 };
/** Larger files are refused before they are read: the file and its mesh would not fit beside each other. */
const MOST_FILE = 1024 * MIB;
/** What a search may take of it; beyond, its answer holds but is wider than asked. */
const MOST_SEARCH = 3000 * MIB;
const MOST_FILES = 2;
/** Of pairs with so many faces, what this many seconds give is drawn before the whole answer is computed. */
const MANY_FACES = 200_000;
const FIRST_ANSWER = 0.7;
/** Sizes that are apart by the factor of two units. */
const FACTORS = [10, 25.4, 100, 304.8, 1000];

const bytesOf = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
const integer = (n) => n.toLocaleString("en");
const few = (x) => Number(x.toPrecision(6)).toString();
/** Six digits that are not below, or not above, a number that is not negative. */
function outward(x, up) {
  const shown = Number(x.toPrecision(6));
  if (x === 0 || (up ? shown >= x : shown <= x)) return shown.toString();
  const last = 10 ** (Math.floor(Math.log10(x)) - 5);
  return Number((shown + (up ? last : -last)).toPrecision(6)).toString();
}
const element = (tag, attributes = {}, ...children) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children);
  return made;
};

/** Where a program serves the page: the names of the files that it begins with. */
const served = JSON.parse($("served").textContent);
const engine = served ? new ServerEngine() : new WorkerEngine($("worker").textContent, bytesOf($("module").textContent));
const state = { files: [], task: null, busy: false, found: null, cameras: null, form: {}, turn: 0 };

// ---- what is said

function setState(name) {
  document.documentElement.dataset.state = name;
}

function say(text) {
  $("status").textContent = text;
}

function refuse(message, name = "refused") {
  $("failure").textContent = message;
  $("failure").hidden = false;
  say(name === "cancelled" ? "Cancelled." : "Refused.");
  setState(name);
}

function showWork(on) {
  state.busy = on;
  $("work").hidden = !on;
  $("progress").removeAttribute("value");
  for (const button of document.querySelectorAll("#run, #choose, #examples button, #files button")) button.disabled = on;
}

function told({ doing, share, direction, bounds }) {
  if (share !== null) $("progress").value = share;
  if (bounds) say(`${direction === "a_to_b" ? "Model to scan" : "Scan to model"}: the largest distance met is ${few(bounds[0])}, bounded so far by ${few(bounds[1])}`);
  else say(doing);
}

// ---- files

async function take(list) {
  if (state.busy) return;
  const given = [...list];
  clearResult();
  $("failure").hidden = true;
  if (given.length === 0) return;
  const merged = given.length === 1 && state.files.length === 1 ? [...state.files, ...given] : given;
  if (merged.length > MOST_FILES) return void refuse(`${merged.length} files were dropped; drop one to describe and change it, or two to compare them.`);
  const large = served ? undefined : given.find(({ size }) => size > MOST_FILE);
  if (large) return void refuse(`${large.name}: the file has ${integer(Math.round(large.size / MIB))} MiB, and a page can hold 4 GiB in all; use the command instead: ${commandLine(merged.length === 2 ? ["deviation", ...merged.map(({ name }) => name)] : ["info", large.name])}`);
  setState("reading");
  say(`Reading ${merged.map(({ name }) => name).join(" and ")}`);
  showWork(true);
  try {
    const files = [];
    for (const file of merged) {
      const known = !(file instanceof File) ? file : { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()), facts: null, generation: -1 };
      files.push(known);
      await ensure(known);
    }
    for (const old of state.files) if (!files.includes(old)) await forget(old);
    state.files = files;
  } catch (error) {
    showWork(false);
    showFiles();
    return void (error instanceof Cancelled ? refuse("Reading was cancelled.", "cancelled") : refuse(error.message));
  }
  showWork(false);
  showFiles();
  chooseTask(state.files.length === 2 ? "deviation" : "info");
  await run();
}

/** Reads a file unless the engine has it. */
async function ensure(file) {
  if (file.generation === engine.generation && file.facts) return;
  const { reply } = await engine.call({ call: "read", name: file.name }, [file.bytes], told);
  file.facts = reply;
  file.generation = engine.generation;
}

async function forget(file) {
  if (file.generation === engine.generation) await engine.call({ call: "forget", mesh: file.facts.mesh });
}

function showFiles() {
  const roles = state.files.length === 2 ? ["A", "B"] : [""];
  $("files").replaceChildren(...state.files.map(({ name, facts }, i) => element("li", {},
    element("strong", {}, roles[i]), element("span", {}, name),
    i === 1 ? element("button", { type: "button", id: "swap", onclick: () => void swap() }, "Swap model and scan") : "",
    element("span", { class: "note" }, `${roles[i] && ["model, as it should be: ", "scan, as it is: "][i]}${integer(facts.input.vertices)} vertices, ${integer(facts.input.faces)} faces, diagonal ${few(facts.diagonal)}`))));
}

async function swap() {
  if (state.busy) return;
  keepForm();
  state.files.reverse();
  showFiles();
  await run();
}

// ---- tasks

function keepForm() {
  for (const input of $("fields").querySelectorAll("[name]")) {
    state.form[`${state.task} ${input.name}`] = input.type === "checkbox" ? input.checked : input.value;
  }
}

function presets() {
  const { diagonal } = state.files[0].facts;
  const short = (share) => Number((diagonal * share).toPrecision(2)).toString();
  return { "simplify within": short(0.002), "remesh edge_length": short(0.02) };
}

function chooseTask(name) {
  state.task = name;
  const task = TASKS[name];
  const same = Object.entries(TASKS).filter(([, other]) => other.files === task.files);
  const fields = [];
  if (same.length > 1) {
    const select = element("select", { id: "which", onchange: () => { keepForm(); clearResult(); chooseTask(select.value); $("which").focus(); } },
      ...same.map(([value, { label }]) => element("option", { value, selected: value === name }, label)));
    fields.push(element("div", { class: "field" }, element("label", { for: "which" }, "What to do"), select));
  }
  const presetsNow = presets();
  for (const { name: field, label, hint, values, check } of task.fields) {
    const kept = state.form[`${name} ${field}`] ?? presetsNow[`${name} ${field}`];
    const id = `field-${field}`;
    if (check) {
      const input = element("input", { type: "checkbox", id, name: field });
      input.checked = kept === true;
      fields.push(element("label", { class: "check" }, input, label));
      continue;
    }
    const described = hint ? { "aria-describedby": `${id}-hint` } : {};
    const input = values
      ? element("select", { id, name: field }, ...values.map((value) => element("option", { value }, value || "not stated")))
      : element("input", { type: "text", id, name: field, autocomplete: "off", spellcheck: "false", ...described });
    input.value = kept ?? "";
    fields.push(element("div", { class: "field" }, element("label", { for: id }, label), input, hint ? element("small", { id: `${id}-hint` }, hint) : ""));
  }
  $("fields").replaceChildren(...fields);
  $("run").textContent = task.label;
  $("task").hidden = false;
  suggest();
}

/** Says where sizes or places suggest that units differ or meshes are not aligned. */
function suggest() {
  $("hint").hidden = true;
  if (state.files.length !== 2) return;
  const [a, b] = state.files.map(({ facts }) => facts);
  const ratio = Math.max(a.diagonal, b.diagonal) / Math.min(a.diagonal, b.diagonal);
  const factor = FACTORS.find((factor) => Math.abs(ratio / factor - 1) < 0.02);
  const middle = ({ bounds: [low, high] }) => low.map((x, k) => (x + high[k]) / 2);
  const [from, to] = [middle(a), middle(b)];
  const apart = Math.hypot(...from.map((x, k) => x - to[k]));
  const hint = factor ? `One is about ${factor} times the size of the other; are they in the same unit?`
    : apart > 0.1 * Math.max(a.diagonal, b.diagonal) ? "The middles of both are far apart: if they are not aligned, move the scan onto the model first." : "";
  $("hint").textContent = hint;
  $("hint").hidden = !hint;
}

/** A sentence where the memory of the page will not do. */
function tooLarge(command) {
  if (served) return null;
  const faces = state.files.reduce((sum, { facts }) => sum + facts.input.faces, 0);
  const needed = faces * BYTES_PER_FACE[state.task];
  return needed > MOST_MEMORY
    ? `This needs about ${integer(Math.ceil(needed / MIB))} MiB for ${integer(faces)} faces, and a page has 4096; use the command instead: ${command}`
    : null;
}

async function run() {
  if (state.busy) return;
  keepForm();
  clearResult();
  const task = TASKS[state.task];
  const form = Object.fromEntries(task.fields.map(({ name }) => [name, state.form[`${state.task} ${name}`] ?? ""]));
  const options = optionsOf(task, form);
  const wrong = Object.entries(options).find(([, value]) => Number.isNaN(value));
  const command = task.command(state.files.map(({ name }) => name), options);
  $("command").textContent = command;
  $("same").hidden = false;
  const refusal = wrong ? `${wrong[0].replaceAll("_", " ")}: enter a number` : tooLarge(command);
  if (refusal) return void refuse(refusal);
  setState("working");
  say("Working");
  showWork(true);
  const started = performance.now();
  try {
    for (const file of state.files) await ensure(file);
    const meshes = state.files.map(({ facts }) => facts.mesh);
    const ask = async (limits) => (await engine.call({ call: "ask", command: state.task, meshes, options, limits: { ...(served ? {} : { memory_limit: MOST_SEARCH }), ...limits } }, [], told)).reply;
    const first = state.task === "deviation" && !options.align ? await firstAnswer(meshes, options.unit ?? "", ask, command) : null;
    const reply = first ?? await ask({});
    state.found = { reply, command, task: state.task };
    say("Drawing");
    await show(state.found);
    showWork(false);
    showResult(performance.now() - started);
  } catch (error) {
    showWork(false);
    if (error instanceof Cancelled) refuse("The work was cancelled; start it again, or drop other files.", "cancelled");
    else refuse(error.message);
  }
}

/** What can be said at once while the deviation is computed: an interval, and for many faces a picture of what a short time gives. The answer, if that is whole. */
async function firstAnswer(meshes, unit, ask, command) {
  const faces = state.files.reduce((sum, { facts }) => sum + facts.input.faces, 0);
  if (faces < MANY_FACES) {
    const { reply } = await engine.call({ call: "ask", command: "distance", meshes, options: { tolerance: 0.01 } }, [], told);
    showInterval(reply.answer.report.hausdorff, unit);
    return null;
  }
  const reply = await ask({ time_limit: FIRST_ANSWER });
  const { report } = reply.answer;
  if (!endedByTime(report) && !(report.bands && endedByTime(report.bands))) return reply;
  showInterval(report.distance, unit);
  say("Drawing the first answer");
  await show({ reply, command, task: state.task });
  return null;
}

/** Whether the time was over before both directions were done; a verdict can be known even then. */
const endedByTime = ({ a_to_b, b_to_a }) => [a_to_b, b_to_a].some(({ stop, search }) => stop === "time" || search?.stop === "time");

/** Draws what was found; a page that comes after another is seen from where that was. */
async function show(found) {
  const { arrays } = await engine.call({ call: "page", command_line: found.command });
  found.html = new TextDecoder().decode(arrays[0]);
  const frame = element("iframe", { title: "Result", sandbox: "allow-scripts allow-downloads", onload: () => {
    if (state.cameras) frame.contentWindow.postMessage({ pompeiu: "cameras", cameras: state.cameras }, "*");
  } });
  frame.srcdoc = found.html;
  $("view").replaceChildren(frame);
}

function showInterval({ lower, upper }, unit) {
  $("interval").textContent = `H(A, B) is proven to be in [${outward(lower, false)}, ${outward(upper, true)}]${unit && ` ${unit}`}`;
  $("interval").hidden = false;
}

// ---- results

function clearResult() {
  [state.found, state.cameras] = [null, null];
  for (const id of ["results", "same", "interval", "failure"]) $(id).hidden = true;
  $("view").replaceChildren($("welcome") ?? "");
}

/** What was found, in a sentence. */
function summary({ task, reply }) {
  const { report } = reply.answer;
  if (task === "deviation") return report.verdict?.sentence ?? "Compared; with a threshold or a band there is a verdict.";
  if (task === "info") return `${integer(report.vertices)} vertices, ${integer(report.faces)} faces; see the measures and defects beside the surface.`;
  const made = reply.meshes.mesh?.input;
  const proven = report.distance;
  const distance = typeof proven?.upper === "number" ? `; at a distance of at most ${few(proven.upper)} from the input, proven` : "";
  return made ? `${integer(made.faces)} faces, from ${integer(reply.answer.inputs[0].faces)}${distance}.` : "Done.";
}

function showResult(milliseconds) {
  const { found } = state;
  const { report } = found.reply.answer;
  if (found.task === "deviation") showInterval(report.distance, found.reply.answer.request.unit);
  const early = found.reply.exit_code === 3 ? " It ended early: what is shown holds, but is wider than asked." : "";
  say([summary(found), ...found.reply.notes].join(" ") + early + ` (${(milliseconds / 1000).toFixed(1)} s)`);
  const name = stem(state.files[0].name);
  const buttons = [];
  const add = (id, label, make) => buttons.push(element("button", { type: "button", id: `download-${id}`, onclick: () => void download(make) }, label));
  const mesh = found.reply.meshes.mesh?.mesh;
  if (mesh !== undefined) {
    const formats = found.task === "flatten" ? ["obj", "glb"] : ["obj", "ply", "stl", "glb"];
    for (const format of formats) add(format, format.toUpperCase(), async () => [(await engine.call({ call: "write", mesh, format })).arrays[0], `${name}-${found.task}.${format}`, "application/octet-stream"]);
  }
  if (found.task === "flatten") add("svg", "SVG", async () => [(await engine.call({ call: "drawing" })).arrays[0], `${name}-flat.svg`, "image/svg+xml"]);
  add("json", "JSON", async () => [JSON.stringify(found.reply.answer), `${name}-${found.task}.json`, "application/json"]);
  add("page", "Page", async () => [found.html, `${name}-${found.task}.html`, "text/html"]);
  if (found.task === "deviation") add("pdf", "PDF", async () => [(await engine.call({ call: "document", command_line: found.command })).arrays[0], `${name}-${found.task}.pdf`, "application/pdf"]);
  $("downloads").replaceChildren(...buttons);
  $("results").hidden = false;
  $("same").hidden = false;
  setState("done");
  // Where the result is below everything else it would not be seen.
  if (matchMedia("(max-width: 899px)").matches) $("view").scrollIntoView({ block: "start" });
}

async function download(make) {
  try {
    const [content, name, type] = await make();
    const link = element("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  } catch (error) {
    if (!(error instanceof Cancelled)) refuse(error.message);
  }
}

async function copyCommand() {
  try {
    await navigator.clipboard.writeText($("command").textContent);
    $("copy").textContent = "Copied";
  } catch {
    // Without the right to write to the clipboard the text is selected, to be copied by hand.
    getSelection().selectAllChildren($("command"));
    $("copy").textContent = "Selected";
  }
  setTimeout(() => { $("copy").textContent = "Copy"; }, 2000);
}

// ---- the start

const EXAMPLES = [["Sphere and rough sphere", ["sphere.obj", "rough-sphere.obj"]], ["Lantern and cylinder", ["lantern.obj", "cylinder.obj"]], ["Torus", ["torus.obj"]]];

function start() {
  const contents = JSON.parse($("example-files").textContent);
  const known = EXAMPLES.filter(([, names]) => names.every((name) => contents[name]));
  $("examples").append(...known.map(([label, names]) => element("button", { type: "button", onclick: () => void take(names.map((name) => new File([bytesOf(contents[name])], name))) }, label)));
  for (const holder of ["module", "served", "example-files"]) $(holder).remove();
  $("choose").addEventListener("click", () => $("chooser").click());
  $("chooser").addEventListener("change", () => { void take($("chooser").files); $("chooser").value = ""; });
  $("task").addEventListener("submit", (event) => { event.preventDefault(); void run(); });
  $("cancel").addEventListener("click", () => engine.cancel());
  $("copy").addEventListener("click", () => void copyCommand());
  addEventListener("keydown", (event) => { if (event.key === "Escape" && state.busy) engine.cancel(); });
  addEventListener("message", ({ data, source }) => {
    if (data?.pompeiu === "cameras" && source === $("view").querySelector("iframe")?.contentWindow) state.cameras = data.cameras;
  });
  addEventListener("dragover", (event) => { event.preventDefault(); document.body.classList.add("dragging"); });
  addEventListener("dragleave", (event) => { if (!event.relatedTarget) document.body.classList.remove("dragging"); });
  addEventListener("drop", (event) => { event.preventDefault(); document.body.classList.remove("dragging"); void take(event.dataTransfer.files); });
  document.documentElement.dataset.ready = "true";
  // The module is unpacked while files are chosen.
  engine.start();
  if (served?.files.length) void takeServed();
}

/** The files that the program was started with. */
async function takeServed() {
  try {
    await take(await Promise.all(served.files.map(async (name, i) => new File([await engine.file(i)], name))));
  } catch (error) {
    refuse(error.message);
  }
}

start();
