// The module answers as the native program does, to the last bit, beside times.
// usage: POMPEIU=program POMPEIU_MODULE=file.wasm node --test

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { Engine, PompeiuError } from "../../page/engine.js";

const MESHES = new URL("../../../../../examples/meshes/", import.meta.url).pathname;
const module = readFileSync(process.env.POMPEIU_MODULE);

/** What is no answer but a time, and what only one of the two has. */
const TIMES = new Set(["timing_ms", "elapsed", "build", "search", "refine", "build_ms", "search_ms", "refine_ms", "certificate", "path"]);
const timeless = (value) =>
  Array.isArray(value) ? value.map(timeless)
    : value && typeof value === "object" ? Object.fromEntries(Object.entries(value).filter(([key]) => !TIMES.has(key)).map(([key, one]) => [key, timeless(one)]))
    : value;

/** The answer of the command; refutations and unproven answers have other exit codes than 0. */
function native(...words) {
  try {
    return JSON.parse(execFileSync(process.env.POMPEIU, [...words, "--json", "--quiet"], { encoding: "utf8", maxBuffer: 2 ** 30 }));
  } catch (error) {
    if (![1, 3].includes(error.status)) throw error;
    return JSON.parse(error.stdout);
  }
}

async function engineWith(...names) {
  const engine = await Engine.from(module);
  const meshes = names.map((name) => engine.call({ call: "read", name }, [readFileSync(join(MESHES, name))]).reply.mesh);
  return { engine, meshes };
}

const PAIRS = [["sphere.obj", "torus.obj"], ["sphere.obj", "rough-sphere.obj"], ["lantern.obj", "cylinder.obj"]];
const QUESTIONS = [
  ["distance", {}, []],
  ["deviation", { threshold: 0.1, unit: "mm" }, ["--within", "0.1", "--unit", "mm"]],
  ["deviation", { bands: ["-0.05..0.1"], signed: true }, ["--band", "-0.05..0.1", "--signed"]],
  ["align", {}, []],
];

for (const names of PAIRS) {
  for (const [command, options, words] of QUESTIONS) {
    test(`${command} of ${names.join(" and ")} ${words.join(" ")}`, async () => {
      const { engine, meshes } = await engineWith(...names);
      const { reply } = engine.call({ call: "ask", command, meshes, options });
      const expected = native(command, ...names.map((name) => join(MESHES, name)), ...words);
      assert.deepEqual(timeless(reply.answer), timeless(expected));
    });
  }
}

const CHANGES = [
  ["simplify", { relative: 0.01 }, (name, out) => [name, "--relative", "0.01", "-o", out]],
  ["remesh", { relative: 0.05 }, (name, out) => [name, "--relative", "0.05", "-o", out]],
  ["repair", {}, (name, out) => [name, out]],
];

for (const [command, options, words] of CHANGES) {
  test(`${command}, and the file that is written`, async () => {
    const folder = mkdtempSync(join(tmpdir(), "pompeiu-"));
    try {
      const { engine, meshes } = await engineWith("rough-sphere.obj");
      const { reply } = engine.call({ call: "ask", command, meshes, options });
      const out = join(folder, "out.ply");
      const expected = native(command, ...words(join(MESHES, "rough-sphere.obj"), out));
      assert.deepEqual(timeless(reply.answer), timeless(expected));
      const [bytes] = engine.call({ call: "write", mesh: reply.meshes.mesh.mesh, format: "ply" }).arrays;
      assert.ok(readFileSync(out).equals(bytes));
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
}

test("info, with the pairs of faces that intersect", async () => {
  const { engine, meshes } = await engineWith("torus.obj");
  const { reply } = engine.call({ call: "ask", command: "info", meshes, options: { intersections: true } });
  assert.deepEqual(timeless(reply.answer), timeless(native("info", join(MESHES, "torus.obj"), "--intersections")));
});

/** Numbers that are nearly equal, and everything else that is equal. */
function assertClose(found, expected, place = "answer") {
  if (typeof found === "number" && typeof expected === "number") {
    return assert.ok(Math.abs(found - expected) <= 1e-9 * Math.max(1, Math.abs(expected)), `${place}: ${found} and ${expected}`);
  }
  if (found === null || typeof found !== "object") return assert.equal(found, expected, place);
  assert.deepEqual(Object.keys(found).sort(), Object.keys(expected).sort(), place);
  for (const key of Object.keys(found)) assertClose(found[key], expected[key], `${place}.${key}`);
}

// Its linear systems are solved by a library whose sums depend on the vectors of the processor.
test("flatten, beside rounding", async () => {
  const { engine, meshes } = await engineWith("torus.obj");
  const { reply } = engine.call({ call: "ask", command: "flatten", meshes });
  assertClose(timeless(reply.answer), timeless(native("flatten", join(MESHES, "torus.obj"))));
});

test("a time limit ends the work, so the clock runs", async () => {
  const { engine, meshes } = await engineWith("sphere.obj", "rough-sphere.obj");
  const { reply } = engine.call({ call: "ask", command: "deviation", meshes, limits: { time_limit: 0.001 } });
  assert.equal(reply.answer.stop, "time");
  assert.equal(reply.exit_code, 3);
});

test("what cannot be answered is a sentence", async () => {
  const { engine, meshes } = await engineWith("sphere.obj");
  const fails = (call, arrays, pattern) => assert.throws(() => engine.call(call, arrays), (error) => error instanceof PompeiuError && pattern.test(error.message));
  fails({ call: "read", name: "a.ply" }, [new TextEncoder().encode("ply\nhello")], /^a\.ply: /);
  fails({ call: "ask", command: "deviation", meshes }, [], /is about 2 meshes, found 1/);
  fails({ call: "ask", command: "deviation", meshes, options: { treshold: 1 } }, [], /did you mean `threshold`/);
  fails({ call: "ask", command: "nothing", meshes }, [], /there is no command `nothing` here/);
  fails({ call: "write", mesh: 99, format: "ply" }, [], /there is no mesh 99/);
  fails({ call: "write", mesh: meshes[0], format: "doc" }, [], /cannot be written as `doc`/);
  fails({ call: "document" }, [], /nothing was found yet/);
});
