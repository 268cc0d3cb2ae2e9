// The tasks: their fields, the options of their requests, and the commands that do the same.

const UNITS = ["", "mm", "cm", "m", "in", "um"];

/** A length for the options: a number, or a number with its unit. */
const length = (text) => (text.trim() === "" || Number.isNaN(Number(text)) ? text.trim() || null : Number(text));
const positive = (text) => (text.trim() === "" ? null : Number(text));

const listed = (text) => text.trim().split(/[\s;]+/).filter(Boolean);

/** Words of a command that a shell passes on as they are. */
function quoted(word) {
  const text = String(word);
  return /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}

function commandLine(words) {
  return ["pompeiu", ...words.filter((word) => word !== null && word !== undefined)].map(quoted).join(" ");
}

/** Options that the command line calls otherwise than a request. */
const WORDS = { bands: "band", threshold: "within" };

/** The options of a command line from those of a request. */
function flags(options) {
  const words = [];
  for (const [name, value] of Object.entries(options)) {
    const flag = `--${(WORDS[name] ?? name).replaceAll("_", "-")}`;
    if (value === true) words.push(flag);
    else if (Array.isArray(value)) for (const one of value) words.push(flag, one);
    else if (value !== null && value !== false && value !== "" && value !== 0) words.push(flag, value);
  }
  return words;
}

/** What is left when nothing was typed in is left to the defaults. */
const given = (options) => Object.fromEntries(Object.entries(options).filter(([, value]) => value !== null && value !== "" && value !== false && !(Array.isArray(value) && value.length === 0)));

/** The options of a task from what is in its fields. */
function optionsOf({ fields }, form) {
  const read = ({ name, check, values, read = check || values ? (value) => value : positive }) => [name, read(form[name])];
  return given(Object.fromEntries(fields.map(read)));
}

const stem = (name) => name.replace(/\.gz$/i, "").replace(/\.[^.]*$/, "");

const TASKS = {
  deviation: {
    label: "Compare",
    files: 2,
    fields: [
      { name: "threshold", label: "Threshold", hint: "such as 0.1 or 0.1mm; empty: no verdict", read: length },
      { name: "bands", label: "Tolerance bands", hint: "such as -0.05..0.1; several with spaces", read: listed },
      { name: "unit", label: "Unit", values: UNITS },
      { name: "allow", label: "Allowed share", hint: "of each area, such as 0.01" },
      { name: "align", label: "Move the scan onto the model first", check: true, read: (on) => (on ? "rigid" : null) },
      { name: "signed", label: "Tell inside from outside", check: true },
    ],
    command: (names, options) => commandLine(["deviation", ...names, ...flags(options), "--report", "deviation.html", "--pdf", "deviation.pdf"]),
  },
  info: {
    label: "Describe",
    files: 1,
    fields: [{ name: "intersections", label: "Find faces that intersect", check: true }],
    command: (names, options) => commandLine(["info", ...names, ...flags(options)]),
  },
  simplify: {
    label: "Simplify",
    files: 1,
    fields: [
      { name: "within", label: "Within", hint: "largest distance, such as 0.1 or 0.5%; proven", read: length },
      { name: "faces", label: "or faces", hint: "their number; the distance follows" },
      { name: "features", label: "Keep edges above", hint: "degrees; empty: none" },
      { name: "repair", label: "Repair first", check: true },
    ],
    command: (names, options) => commandLine(["simplify", ...names, ...flags(options), "-o", `${stem(names[0])}-simplified.ply`]),
  },
  remesh: {
    label: "Remesh",
    files: 1,
    fields: [
      { name: "edge_length", label: "Edge length", hint: "such as 2 or 1%", read: length },
      { name: "within", label: "Within", hint: "largest distance, to be proven; may be empty", read: length },
      { name: "features", label: "Keep edges above", hint: "degrees; empty: none" },
    ],
    command: (names, options) => commandLine(["remesh", ...names, ...flags(options), "-o", `${stem(names[0])}-remeshed.ply`]),
  },
  flatten: {
    label: "Flatten",
    files: 1,
    fields: [],
    command: (names) => commandLine(["flatten", ...names, "-o", `${stem(names[0])}-flat.obj`, "--report", "flat.html"]),
  },
  repair: {
    label: "Repair",
    files: 1,
    fields: [
      { name: "weld", label: "Weld within", hint: "a length; empty: equal positions only", read: length },
      { name: "fill_holes", label: "Fill holes up to", hint: "edges; empty: none" },
      { name: "within", label: "Within", hint: "largest distance, to be proven; may be empty", read: length },
    ],
    command: (names, options) => commandLine(["repair", ...names, `${stem(names[0])}-repaired.ply`, ...flags(options)]),
  },
};
