// The npm package in Node: the same results as the native command, progress, cancel, and bad input.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { command, dice, liverLabel, readNifti, readNiftiFile, readPlyPoints, seed } from "./Support.mjs";

const folder = process.env.FLIPFREE_BROWSER_PACKAGE;
const urlOf = (name) => pathToFileURL(join(folder, name));
const { FlipFree, FlipFreeError, countVoxels, fillRuns, labelMapFile, surfaceFile, surfaceFormats } = await import(
  urlOf("index.js")
);

const scratch = mkdtempSync(join(tmpdir(), "flipfree-"));
let flipfree;
let phantom;
let liver;

function labelMapOf(organ, image) {
  const voxels = new Uint8Array(countVoxels(image));
  fillRuns(organ.runs, 1, image, voxels);
  return { ...image, voxels };
}

before(async () => {
  command(scratch, "phantom", "abdomen", "-o", ".");
  command(scratch, "segment", "abdomen.nii.gz", "--seed", ...seed.center.map(String), "--radius", `${seed.radius}`,
    "-o", "liver.ply", "--labels", "liver.nii.gz");
  flipfree = await FlipFree.load(readFileSync(urlOf("kernels.wasm")), urlOf("worker.js"));
  phantom = await flipfree.phantom("abdomen");
});

after(() => {
  flipfree?.close();
  rmSync(scratch, { recursive: true });
});

test("the phantom has the command's bits", () => {
  assert.deepEqual(phantom.image.voxels, readNiftiFile(join(scratch, "abdomen.nii.gz")).voxels);
  assert.deepEqual(phantom.labelMap.voxels, readNiftiFile(join(scratch, "abdomen-truth.nii.gz")).voxels);
  assert.deepEqual(phantom.image.spacing, [1.5, 1.5, 3]);
  const { center, radius } = phantom.seeds.find(({ label }) => label === liverLabel);
  assert.deepEqual([...center, Math.round(radius)], [...seed.center, seed.radius]);
});

test("the liver is the command's", async () => {
  const fractions = [];
  liver = await flipfree.segment(phantom.image, seed, { onProgress: (fraction) => fractions.push(fraction) });
  assert.equal(liver.stopReason, "at rest");
  assert.equal(liver.selfIntersections, 0);
  assert.deepEqual(liver.warnings, []);
  assert.ok(fractions.length > 2);
  assert.ok(fractions.every((fraction, at) => fraction >= (fractions[at - 1] ?? 0) && fraction <= 1), `${fractions}`);

  const found = labelMapOf(liver, phantom.image).voxels;
  const native = readNiftiFile(join(scratch, "liver.nii.gz")).voxels;
  const points = readPlyPoints(join(scratch, "liver.ply"));
  assert.equal(points.length, liver.surface.points.length);
  const farthest = points.reduce((most, value, at) => Math.max(most, Math.abs(value - liver.surface.points[at])), 0);
  console.log(`Dice with the command's liver ${dice(found, native)}, coordinates differ by at most ${farthest} mm`);
  assert.ok(dice(found, native) > 0.999);
});

test("scores are the command's", async () => {
  const parameters = { referenceLabel: liverLabel };
  const ofLabels = await flipfree.evaluate(labelMapOf(liver, phantom.image), phantom.labelMap, { parameters });
  const ofSurface = await flipfree.evaluate(liver.surface, phantom.labelMap, { parameters });
  const printed = command(scratch, "evaluate", "liver.nii.gz", "abdomen-truth.nii.gz", "--reference-label", "6");
  assert.ok(Math.abs(ofLabels.dice - Number(printed.match(/Dice +([\d.]+)/)[1])) < 1e-3);
  assert.equal(ofSurface.dice, ofLabels.dice);
  assert.equal(ofSurface.distanceOf, "mesh");
});

test("files are what the command reads", async () => {
  const blob = await labelMapFile(labelMapOf(liver, phantom.image));
  const bytes = Buffer.from(await blob.arrayBuffer());
  assert.deepEqual(readNifti(bytes).voxels, labelMapOf(liver, phantom.image).voxels);
  writeFileSync(join(scratch, "saved.nii.gz"), bytes);
  const evaluate = (name) =>
    command(scratch, "evaluate", name, "abdomen-truth.nii.gz", "--reference-label", `${liverLabel}`);
  const expected = evaluate("saved.nii.gz").match(/Dice +([\d.]+)/)[1];
  for (const format of surfaceFormats) {
    writeFileSync(join(scratch, `saved.${format}`), Buffer.from(await surfaceFile(liver.surface, format).arrayBuffer()));
    const printed = evaluate(`saved.${format}`);
    assert.match(printed, /valid: closed, Euler number 2, self-intersections 0/, format);
    assert.equal(printed.match(/Dice +([\d.]+)/)[1], expected, format);
  }
});

test("label maps of any grid come back on it", async () => {
  const [c, s] = [Math.cos(0.3), Math.sin(0.3)];
  const directions = [
    [1, 0, 0, 0, 1, 0, 0, 0, 1],
    [-1, 0, 0, 0, -1, 0, 0, 0, 1],
    [0, 0, 1, 1, 0, 0, 0, 1, 0],
    [0, 1, 0, 0, 0, -1, -1, 0, 0],
    [1, 0, 0, 0, 1, 0, 0, 0, -1],
    [c, -s, 0, s, c, 0, 0, 0, 1],
    [-c, 0, s, 0, -1, 0, s, 0, c],
  ];
  for (const direction of directions) {
    const parameters = { dimensions: [48, 40, 36], spacing: [1.5, 1.8, 2], origin: [-31.5, 12.25, 104], direction };
    const { image, labelMap, seeds } = await flipfree.phantom("sphere", { parameters });
    const sphere = await flipfree.segment(image, seeds[0], { parameters: { resolution: 16, levels: 1 } });
    writeFileSync(join(scratch, "grid.nii.gz"), Buffer.from(await (await labelMapFile(labelMap)).arrayBuffer()));
    writeFileSync(join(scratch, "grid.stl"), Buffer.from(await surfaceFile(sphere.surface, "stl").arrayBuffer()));
    const printed = command(scratch, "evaluate", "grid.stl", "grid.nii.gz");
    assert.ok(Number(printed.match(/Dice +([\d.]+)/)[1]) > 0.97, `${direction}: ${printed}`);
  }
});

test("a canceled run ends at once, and the next one works", async () => {
  const stop = new AbortController();
  let canceled = 0;
  const run = flipfree.segment(phantom.image, seed, {
    signal: stop.signal,
    onProgress: () => {
      canceled ||= performance.now();
      stop.abort(new Error("enough"));
    },
  });
  await assert.rejects(run, /^Error: enough$/);
  assert.ok(performance.now() - canceled < 1000);
  const again = await flipfree.segment(phantom.image, seed, { parameters: { resolution: 8, levels: 1, carving: false } });
  assert.equal(again.surface.points.length, 3 * 6 * 8 ** 2);
});

test("the command repeats a session with every parameter that there is", async () => {
  const presets = await Promise.all(["default", "published", "naive"].map((preset) => flipfree.defaultParameters(preset)));
  const [parameters, published] = presets;
  assert.ok(Object.keys(parameters).length > 35);
  assert.equal(published.guard, false);
  const quick = { resolution: 8, levels: 1, carving: false };
  const { voxels, ...grid } = phantom.image;
  const organ = { name: "liver", color: "#ffffff", seed, preset: "naive", parameters: { ...parameters, ...quick } };
  const session = { format: "flipfree-session", version: 1, image: { name: "abdomen.nii.gz", ...grid }, organs: [organ] };
  writeFileSync(join(scratch, "session.json"), JSON.stringify(session));
  command(scratch, "segment", "--session", "session.json", "-o", "repeated.ply");
  const here = await flipfree.segment(phantom.image, seed, { preset: "naive", parameters: organ.parameters });
  assert.deepEqual(readPlyPoints(join(scratch, "repeated.ply")), Float32Array.from(here.surface.points));
});

test("a volume too large for memory is refused, and the next one works", async () => {
  for (const [size, message] of [[1280, /needs more memory than the browser gives; crop it/], [1300, /more than 2\^31/], [4000, /more than 2\^31/]]) {
    const made = flipfree.phantom("cube", { parameters: { dimensions: [size, size, size] } });
    await assert.rejects(made, (error) => {
      assert.ok(error instanceof FlipFreeError, `${error}`);
      assert.match(error.message, message);
      return true;
    });
  }
  const { image } = await flipfree.phantom("cube", { parameters: { dimensions: [20, 20, 20] } });
  assert.equal(image.voxels.length, 8000);
});

test("bad input is named", async () => {
  const small = { size: [2, 2, 2], spacing: [1, 1, 1], origin: [0, 0, 0], direction: [1, 0, 0, 0, 1, 0, 0, 0, 1] };
  const flat = { ...small, size: [40, 40, 40], voxels: new Int16Array(64000) };
  const cases = [
    [phantom.image, { center: [9999, 0, 0], radius: 20 }, {}, /outside/],
    [phantom.image, { center: seed.center, radius: 0.1 }, {}, /radius/],
    [phantom.image, { center: [NaN, 0, 0], radius: 20 }, {}, /./],
    [phantom.image, seed, { parameters: { speling: 1 } }, /There is no parameter speling; there are startCenterOffset, /],
    [phantom.image, seed, { parameters: { foregroundMass: NaN } }, /foregroundMass/],
    [phantom.image, seed, { parameters: { startCenterOffset: [1] } }, /give 3 numbers, not 1/],
    [{ ...small, voxels: new Int16Array(7) }, seed, {}, /7 voxels, which does not fit its size, 2 x 2 x 2; give 8/],
    [{ ...small, voxels: new BigInt64Array(8) }, seed, {}, /BigInt64Array/],
    [{ ...small, spacing: [0, 1, 1], voxels: new Int16Array(8) }, seed, {}, /spacing/],
    [flat, { center: [20, 20, 20], radius: 8 }, {}, /./],
    [{ ...flat, voxels: new Float32Array(64000).fill(NaN) }, { center: [20, 20, 20], radius: 8 }, {}, /not a finite number/],
  ];
  for (const [image, where, options, message] of cases) {
    await assert.rejects(flipfree.segment(image, where, options), (error) => {
      assert.ok(error instanceof FlipFreeError, `${error}`);
      assert.match(error.message, message);
      assert.doesNotMatch(error.message, /port \d|Seed[A-Z]/);
      return true;
    });
  }
  await assert.rejects(flipfree.evaluate(phantom.labelMap, { ...flat }, {}), FlipFreeError);
});
