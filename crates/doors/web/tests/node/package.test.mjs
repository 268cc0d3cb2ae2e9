// The npm package, packed and installed as people do: typed arrays in, JSON and typed arrays out.
// usage: POMPEIU_PACKAGE=file.tgz node --test

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { Worker } from "node:worker_threads";

const MESHES = new URL("../../../../../examples/meshes/", import.meta.url).pathname;
let folder, load, PompeiuError, entry;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "pompeiu-"));
  writeFileSync(join(folder, "package.json"), JSON.stringify({ private: true, type: "module" }));
  execFileSync("npm", ["install", "--silent", "--offline", "--no-audit", "--no-fund", process.env.POMPEIU_PACKAGE], { cwd: folder, stdio: "pipe" });
  entry = pathToFileURL(createRequire(join(folder, "package.json")).resolve("pompeiu"));
  ({ load, PompeiuError } = await import(entry));
});

after(() => rmSync(folder, { recursive: true }));

// A triangle, and one that leans away from it by up to 0.3.
const FLAT = new Float32Array([0, 0, 0, 2, 0, 0, 0, 2, 0]);
const LEANING = new Float64Array([0, 0, 0, 1, 0, 0.3, 0, 1, 0]);
const FACE = new Uint32Array([0, 1, 2]);

test("typed arrays are compared", async () => {
  const told = [];
  const pompeiu = await load({ onProgress: (progress) => told.push(progress) });
  const meshes = [pompeiu.mesh(LEANING, FACE), pompeiu.mesh(FLAT, [0, 1, 2])];
  const { answer, arrays, exitCode } = pompeiu.ask("deviation", meshes, { threshold: 0.15 });
  const { mean, share_above_threshold: share } = answer.report.a_to_b.statistics;
  assert.ok(mean.lower <= 0.1 && 0.1 <= mean.upper, JSON.stringify(mean));
  assert.ok(share.lower <= 0.25 && 0.25 <= share.upper, JSON.stringify(share));
  assert.equal(exitCode, 1);
  assert.ok(arrays.a_to_b instanceof Float64Array);
  assert.ok(Math.abs(arrays.a_to_b[1] - 0.3) < 1e-12 && arrays.a_to_b[0] === 0, String(arrays.a_to_b));
  assert.ok(told.length > 0);
  assert.ok(pompeiu.page().startsWith("<!DOCTYPE html>"));
  assert.equal(Buffer.from(pompeiu.document().slice(0, 4)).toString(), "%PDF");
});

test("a file is read, changed, and written", async () => {
  const pompeiu = await load();
  const torus = pompeiu.read(readFileSync(join(MESHES, "torus.obj")), "torus.obj");
  const { answer, meshes } = pompeiu.ask("simplify", [torus], { within: 0.01 });
  assert.ok(answer.report.distance.upper <= 0.01);
  const { positions, faces } = meshes.mesh;
  assert.deepEqual([positions.length, faces.length], [3 * answer.report.vertices, 3 * answer.report.faces]);
  assert.ok(faces.length < torus.faces.length);
  const again = pompeiu.read(meshes.mesh.write("ply"), "light.ply");
  assert.deepEqual(again.positions, positions);
  torus.free();
  assert.throws(() => torus.positions, PompeiuError);
  assert.throws(() => pompeiu.ask("simplify", [again], { withn: 1 }), /did you mean `within`/);
});

test("it works in a worker", async () => {
  const code = `import(${JSON.stringify(String(entry))}).then(async ({ load }) => {
    const pompeiu = await load();
    const mesh = pompeiu.mesh([0, 0, 0, 2, 0, 0, 0, 2, 0], [0, 1, 2]);
    require("node:worker_threads").parentPort.postMessage(pompeiu.ask("info", [mesh]).answer.report.area);
  })`;
  const worker = new Worker(code, { eval: true });
  const area = await new Promise((resolve, reject) => worker.on("message", resolve).on("error", reject));
  assert.equal(area, 2);
  await worker.terminate();
});

test("it is bundled for browsers and for node", (context) => {
  try {
    execFileSync("npm", ["install", "--silent", "--no-audit", "--no-fund", "esbuild@0.25"], { cwd: folder, stdio: "pipe" });
  } catch {
    return context.skip("esbuild cannot be had");
  }
  writeFileSync(join(folder, "main.js"), `import { load } from "pompeiu";
    const pompeiu = await load();
    const mesh = pompeiu.mesh([0, 0, 0, 2, 0, 0, 0, 2, 0], [0, 1, 2]);
    console.log(pompeiu.ask("info", [mesh]).answer.report.area);`);
  for (const platform of ["browser", "node"]) {
    const bundle = join(folder, platform, "main.mjs");
    execFileSync("npx", ["esbuild", "main.js", "--bundle", "--format=esm", `--platform=${platform}`, `--outfile=${bundle}`], { cwd: folder, stdio: "pipe" });
    // esbuild leaves the address of the module beside the script as it is.
    copyFileSync(new URL("pompeiu.wasm", entry), join(folder, platform, "pompeiu.wasm"));
    assert.equal(execFileSync("node", [bundle], { encoding: "utf8" }), "2\n");
  }
});
