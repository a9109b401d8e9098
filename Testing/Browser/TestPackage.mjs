// The npm package in Node: the same results as the native command, progress, cancel, and bad input.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { gunzipSync, gzipSync } from "node:zlib";
import { dicomFiles } from "./Dicom.mjs";
import { nrrd, segmentPairs } from "./Volumes.mjs";
import { command, dice, fieldDataOf, liverLabel, readNifti, readNiftiFile, readPlyPoints, seed } from "./Support.mjs";

const folder = process.env.FLIPFREE_BROWSER_PACKAGE;
const urlOf = (name) => pathToFileURL(join(folder, name));
const {
  FlipFree, FlipFreeError, countVoxels, doubtfulConfidence, fillRuns, labelsIn, surfaceFormats,
} = await import(urlOf("index.js"));

const scratch = mkdtempSync(join(tmpdir(), "flipfree-"));
let flipfree;
let phantom;
let liver;
let printed;

function labelMapOf(organ, image) {
  const voxels = new Uint8Array(countVoxels(image));
  fillRuns(organ.runs, 1, image, voxels);
  return { ...image, voxels };
}

before(async () => {
  command(scratch, "phantom", "abdomen", "-o", ".");
  printed = command(scratch, "segment", "abdomen.nii.gz", "--seed", ...seed.center.map(String), "--radius", `${seed.radius}`,
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
  const { name, center, radius } = phantom.seeds.find(({ label }) => label === liverLabel);
  assert.equal(name, "liver");
  assert.deepEqual([...center, Math.round(radius)], [...seed.center, seed.radius]);
});

test("the liver is the command's", async () => {
  const fractions = [];
  liver = await flipfree.segment(phantom.image, seed, { onProgress: (fraction) => fractions.push(fraction) });
  assert.equal(liver.stopReason, "converged");
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
  assert.deepEqual(liver.seed, seed);
});

/** With two digits, as the command prints it. */
function floored(confidence) {
  return (Math.floor(100 * confidence) / 100).toFixed(2);
}

test("its confidence is the command's, as a whole and at each vertex", async () => {
  assert.equal(floored(liver.confidence), printed.match(/confidence ([\d.]+)/)[1]);
  assert.ok(liver.confidence > doubtfulConfidence);
  assert.equal(liver.vertexConfidence.length, liver.surface.points.length / 3);
  assert.ok(liver.vertexConfidence.every((value) => value >= 0 && value <= 1));
  assert.ok(liver.vertexConfidence.some((value) => value < 0.5) && liver.vertexConfidence.some((value) => value > 0.9));
  const header = readFileSync(join(process.env.FLIPFREE_BROWSER_SOURCE, "../../Filters/Kernels/Evidence/SurfaceConfidence.h"), "utf8");
  assert.equal(`${doubtfulConfidence}`, header.match(/DoubtfulConfidence = ([\d.]+)/)[1]);
  const aorta = { center: [168.75, 148.75, 139], radius: 6.2 };
  const found = await flipfree.segment(phantom.image, aorta);
  const native = command(scratch, "segment", "abdomen.nii.gz", "--seed", ...aorta.center.map(String), "--radius", `${aorta.radius}`, "-o", "aorta.vtp");
  assert.equal(floored(found.confidence), native.match(/confidence ([\d.]+)/)[1]);
  assert.match(found.warnings.join(), /doubtful: its confidence is 0\.\d\d, below 0\.85/);
  // The command writes the same numbers.
  assert.deepEqual(pointArrayOf(Buffer.from(await (await flipfree.surfaceFile(found, "vtp")).arrayBuffer()), "Confidence"), found.vertexConfidence);
});

/** A point array of floats in a VTP file that the package has made. */
function pointArrayOf(bytes, name) {
  const text = bytes.toString("latin1");
  const [, offset] = text.match(new RegExp(`<PointData><DataArray type="Float32" Name="${name}" NumberOfComponents="1" format="appended" offset="(\\d+)"/></PointData>`));
  const at = text.indexOf("\n_") + 2 + Number(offset);
  const size = bytes.readUInt32LE(at);
  return new Float32Array(Uint8Array.from(bytes.subarray(at + 8, at + 8 + size)).buffer);
}

/** A ball with a lobe on a neck, as in Testing/Support/lobed_ball.py. */
function lobedBall(brighter) {
  const size = [80, 48, 48];
  const voxels = new Int16Array(80 * 48 * 48);
  let state = 1;
  for (let voxel = 0; voxel < voxels.length; voxel += 1) {
    const x = 2 * (voxel % 80);
    const y = 2 * (Math.floor(voxel / 80) % 48);
    const z = 2 * Math.floor(voxel / (80 * 48));
    const offAxis = (y - 47) ** 2 + (z - 47) ** 2;
    const behind = x > 78 && ((x - 106) ** 2 + offAxis < 24 ** 2 || (x < 106 && offAxis < 11 ** 2));
    const inside = behind || (x - 48) ** 2 + offAxis < 30 ** 2 || (x > 48 && x < 106 && offAxis < 11 ** 2);
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    voxels[voxel] = 20 + 80 * inside + brighter * behind + ((state >>> 16) % 25) - 12;
  }
  return { size, spacing: [2, 2, 2], origin: [0, 0, 0], direction: [1, 0, 0, 0, 1, 0, 0, 0, 1], voxels };
}

test("it asks where it is not sure, and a point answers", async () => {
  assert.deepEqual(liver.questions, []);
  const parameters = { resolution: 16 };
  const lobed = { center: [48, 47, 47], radius: 18 };
  const kept = await flipfree.segment(lobedBall(0), lobed, { parameters });
  assert.equal(kept.questions.length, 1);
  const { place, volume, included, margin } = kept.questions[0];
  assert.ok(Math.hypot(place[0] - 100, place[1] - 46, place[2] - 46) < 12, `${place}`);
  assert.ok(Math.abs(volume - 32) < 12 && included === true && margin > 0);
  assert.equal(kept.warnings.length, 1);
  assert.match(kept.warnings[0], /^Is the part of \d+ ml at \(\d+, \d+, \d+\) mm organ\? an outside point at \d+ \d+ \d+ removes it\.$/);
  const without = await flipfree.segment(lobedBall(0), lobed, { parameters, outside: [place] });
  assert.deepEqual([without.questions, without.warnings], [[], []]);
  const cut = await flipfree.segment(lobedBall(6), lobed, { parameters });
  assert.equal(cut.questions.length, 1);
  assert.equal(cut.questions[0].included, false);
  assert.ok(Math.hypot(...[100, 46, 46].map((x, axis) => x - cut.questions[0].place[axis])) < 8);
  assert.match(cut.warnings[0], /^Is the part of \d+ ml at \(\d+, \d+, \d+\) mm organ\? an inside point at \d+ \d+ \d+ adds it\.$/);
});

test("a preview of a point is what the point changes", async () => {
  const image = lobedBall(12);
  const lobed = { center: [48, 47, 47], radius: 18 };
  const parameters = { resolution: 16 };
  await flipfree.segment(image, lobed, { parameters });
  const lobe = await flipfree.preview({ inside: [100, 47, 47] });
  assert.ok(Math.abs(lobe.volume - 58) < 6, `${lobe.volume}`); // a ball of 24 mm
  const voxels = lobe.runs.reduce((sum, end, at) => (at % 4 === 3 ? sum + end - lobe.runs[at - 1] : sum), 0);
  assert.ok(Math.abs(0.008 * voxels - lobe.volume) < 1e-9);
  assert.deepEqual(await flipfree.preview({ inside: [40, 47, 47] }), { runs: new Int32Array(), volume: 0 });
  await assert.rejects(flipfree.preview({ outside: [48, 47, 47] }), /The outside point \(48, 47, 47\) mm lies in the inner half/);
  await flipfree.segment(image, lobed, { parameters, inside: [[100, 47, 47]] });
  assert.equal((await flipfree.preview({ inside: [100, 47, 47] })).volume, 0);
  await flipfree.segment(image, lobed, { parameters: { ...parameters, carving: false } });
  assert.equal(await flipfree.preview({ inside: [100, 47, 47] }), null);
});

test("a label of a label map in place of a seed: the command's surface, corrected by points", async () => {
  const start = { labels: phantom.labelMap, label: 1 };
  const spleen = await flipfree.segment(phantom.image, start);
  const fill = ["segment", "abdomen.nii.gz", "--start-labels", "abdomen-truth.nii.gz", "--start-label", "1"];
  command(scratch, ...fill, "-o", "filled.ply", "--labels", "filled.nii.gz");
  assert.deepEqual(readPlyPoints(join(scratch, "filled.ply")), Float32Array.from(spleen.surface.points));
  const found = labelMapOf(spleen, phantom.image).voxels;
  assert.equal(dice(found, phantom.labelMap.voxels.map((value) => +(value === 1))), 1);
  assert.ok(spleen.seed.radius > 10);

  const outside = [beyond(spleen.surface, 0, 1, -4)];
  const corrected = await flipfree.segment(phantom.image, start, { outside });
  command(scratch, ...fill, "--outside", ...outside[0].map(String), "-o", "filled.ply");
  assert.deepEqual(readPlyPoints(join(scratch, "filled.ply")), Float32Array.from(corrected.surface.points));
  assert.ok(dice(found, labelMapOf(corrected, phantom.image).voxels) < 0.9995);

  // Asked for at once, each gets its own start.
  const quick = { parameters: { resolution: 8, levels: 1 } };
  const starts = [{ labels: phantom.labelMap, label: 2 }, seed, start, { labels: phantom.labelMap, label: 3 }];
  const together = await Promise.all(starts.map((one) => flipfree.segment(phantom.image, one, quick)));
  for (const [at, one] of starts.entries()) {
    assert.deepEqual(together[at].surface, (await flipfree.segment(phantom.image, one, quick)).surface);
  }
  for (const [labels, label, message] of [
    [phantom.labelMap, 99, /The start labels have no voxels with the value 99; they have 1, 2, 3/],
    [phantom.labelMap, -1, /label: give a whole number from 0 on, not -1/],
    [{ ...phantom.labelMap, spacing: [2, 2, 2] }, 1, /the start labels .* differ; resample one onto the grid of the other/i],
    [{ ...phantom.labelMap, size: [2, 2, 2] }, 1, /does not fit its size/],
    [{ ...phantom.labelMap, voxels: new Float32Array(countVoxels(phantom.image)).fill(NaN) }, 1, /not a finite number/],
  ]) {
    await assert.rejects(flipfree.segment(phantom.image, { labels, label }), (error) => {
      assert.ok(error instanceof FlipFreeError, `${error}`);
      assert.match(error.message, message);
      return true;
    });
  }
  assert.deepEqual((await flipfree.segment(phantom.image, start)).surface, spleen.surface);
});

test("labels are counted, and brought into the order of another grid", () => {
  const labels = labelsIn(phantom.labelMap);
  assert.deepEqual([...labels.keys()], [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11].filter((label) => labels.has(label)));
  assert.equal(labels.get(liverLabel), phantom.labelMap.voxels.filter((value) => value === liverLabel).length);
  const line = (voxels) => ({ ...phantom.labelMap, size: [voxels.length, 1, 1], voxels });
  assert.deepEqual([...labelsIn(line(Int16Array.of(0, 7, 7, 0, 3, 7)))], [[3, 1], [7, 3]]);
  assert.equal(labelsIn(line(new Uint8Array(4))).size, 0);
  assert.throws(() => labelsIn(line(Float32Array.of(0, 0.5))), /the value 0.5, which is not a label/);
  assert.throws(() => labelsIn(line(Int16Array.of(0, 0, -1))), /the value -1, which is not a label/);
  assert.throws(() => labelsIn(line(Int32Array.from({ length: 5000 }, (_, at) => at))), /more than 2000 values/);
});

/** An image without its first and last voxels along k, from behind and with its axes exchanged. */
function behind({ size, spacing, origin, direction, voxels }) {
  const [columns, rows, slices] = size;
  const turned = { size: [rows, slices - 2, columns], spacing: [spacing[1], spacing[2], spacing[0]] };
  const place = [0, 1, 2].map((row) => direction[3 * row + 1] * spacing[1] * (rows - 1) + direction[3 * row + 2] * spacing[2]);
  turned.origin = origin.map((value, row) => value + place[row]);
  turned.direction = [0, 1, 2].flatMap((row) => [-direction[3 * row + 1], direction[3 * row + 2], direction[3 * row]]);
  turned.voxels = new voxels.constructor(rows * (slices - 2) * columns);
  let to = 0;
  for (let i = 0; i < columns; ++i) {
    for (let k = 1; k < slices - 1; ++k) {
      for (let j = rows - 1; j >= 0; --j) {
        turned.voxels[to++] = voxels[i + columns * (j + rows * k)];
      }
    }
  }
  return turned;
}

test("label maps that are cropped and whose axes are in another order", async () => {
  const labels = behind(phantom.labelMap);
  assert.deepEqual(await flipfree.compareGrids(phantom.image, labels, "labels.nii"), { samePlaces: false, difference: "" });
  assert.equal((await flipfree.compareGrids(phantom.image, phantom.labelMap, "labels.nii")).samePlaces, true);
  const coarse = { ...labels, spacing: [9, 9, 9] };
  assert.match((await flipfree.compareGrids(phantom.image, coarse, "labels.nii")).difference, /The spacings of labels\.nii \(9, 9, 9\) mm .* differ; resample/);
  const quick = { parameters: { resolution: 8, levels: 1 } };
  const [whole, cropped] = await Promise.all(
    [phantom.labelMap, labels].map((one) => flipfree.segment(phantom.image, { labels: one, label: 2 }, quick)),
  );
  assert.deepEqual(cropped.surface, whole.surface);
  const scores = await flipfree.evaluate(labels, phantom.labelMap, { parameters: { segmentationLabel: 2, referenceLabel: 2 } });
  assert.equal(scores.dice, 1);
});

const labelsOf = ({ labels }) => labels.map(({ label }) => label);

/** A file of a label's surface, in the scratch folder. */
async function writeLabel(one, format, name) {
  const file = await flipfree.labelSurfaceFile(one, format, name);
  writeFileSync(join(scratch, file.name), Buffer.from(await file.data.arrayBuffer()));
  return file.name;
}

test("exact surfaces of all labels are closed, have the label map's voxels, and are the command's", async () => {
  const fractions = [];
  const found = await flipfree.labelSurfaces(phantom.labelMap, {
    parameters: { exact: true },
    onProgress: (fraction) => fractions.push(fraction),
  });
  assert.ok(fractions.length > 2);
  assert.ok(fractions.every((fraction, at) => fraction >= (fractions[at - 1] ?? 0) && fraction <= 1), `${fractions}`);
  assert.equal(found.wrongVoxels, 0);
  assert.equal(found.collapseDistance, 0);
  assert.ok(found.greatestDistance > 0 && found.greatestDistance < 2);
  const counts = labelsIn(phantom.labelMap);
  assert.deepEqual(labelsOf(found), [...counts.keys()]);
  const ofVoxel = (1.5 * 1.5 * 3) / 1000;
  for (const { label, volume, voxels, voxelVolume, wrongVoxels, area, eulerNumber, triangles, surface } of found.labels) {
    assert.equal(voxels, counts.get(label));
    assert.ok(Math.abs(voxelVolume - voxels * ofVoxel) < 1e-9);
    assert.ok(Math.abs(volume / voxelVolume - 1) < 0.005, `${label}: ${volume} ml, ${voxelVolume} ml`);
    assert.equal(wrongVoxels, 0);
    assert.ok(eulerNumber % 2 === 0);
    assert.equal(surface.points.length / 3 - triangles / 2, eulerNumber); // closed: three half edges a triangle
    assert.deepEqual([surface.corners.length, surface.offsets.length], [3 * triangles, triangles + 1]);
    assert.ok(area > 0);
    const { dice: overlap } = await flipfree.evaluate(surface, phantom.labelMap, { parameters: { referenceLabel: label } });
    assert.equal(overlap, 1);
  }
  assert.equal(await flipfree.selfIntersections(found.labels.find(({ label }) => label === liverLabel).surface), 0);

  for (const format of ["stl", "ply", "obj"]) {
    command(scratch, "surfaces", "abdomen-truth.nii.gz", "-o", "exact", "--exact", "--format", format, "-q");
    for (const one of found.labels) {
      const name = await writeLabel(one, format);
      assert.equal(name, `${one.label}.${format}`);
      assert.ok(readFileSync(join(scratch, name)).equals(readFileSync(join(scratch, "exact", name))), name);
    }
  }
  const rows = found.labels.map(({ surface, ...measures }) => ({ ...measures, name: "", file: `${measures.label}.obj` }));
  const table = await flipfree.labelTableFile(rows);
  assert.equal(await table.data.text(), readFileSync(join(scratch, "exact", table.name), "utf8"));
  command(scratch, "surfaces", "abdomen-truth.nii.gz", "-o", "exact", "--exact", "--format", "vtp", "-q");
  const name = await writeLabel(found.labels[0], "vtp");
  assert.deepEqual(fieldDataOf(join(scratch, name)), fieldDataOf(join(scratch, "exact", name)));
  const printed = command(scratch, "evaluate", name, "abdomen-truth.nii.gz", "--reference-label", "1");
  assert.match(printed, /valid: closed, Euler number 6, self-intersections 0/);
});

test("surfaces of labels: smooth ones, some of them, with fewer triangles, without specks", async () => {
  const made = (options) => flipfree.labelSurfaces(phantom.labelMap, options);
  const smooth = await made();
  assert.ok(smooth.wrongVoxels > 0);
  assert.equal(smooth.labels.reduce((sum, { wrongVoxels }) => sum + wrongVoxels, 0) > smooth.wrongVoxels, true);
  assert.deepEqual(labelsOf(await made({ only: [liverLabel, 1] })), [1, liverLabel]);
  const exact = await made({ only: [2], parameters: { exact: true } });
  const coarse = await made({ only: [2], parameters: { exact: true, edgeLength: 8 } });
  assert.equal(coarse.wrongVoxels, 0);
  assert.ok(coarse.labels[0].triangles < 0.5 * exact.labels[0].triangles);
  assert.ok(coarse.collapseDistance > 0 && coarse.collapseDistance <= 0.75); // half a voxel
  const large = await made({ parameters: { smallestPart: 50_000 } });
  const gone = large.labels.filter(({ surface }) => surface === null);
  assert.deepEqual(labelsOf({ labels: gone }), [4, 5, 10, 11]);
  assert.ok(gone.every(({ triangles, volume, voxels }) => triangles === 0 && volume === 0 && voxels > 0));
  await assert.rejects(flipfree.labelSurfaceFile(gone[0], "stl"), /Label 4 has no surface/);
});

test("bad input of labelSurfaces is named, one by one", async () => {
  const { labelMap } = phantom;
  const with5 = (voxels) => (voxels.fill(5, 100, 200), voxels);
  const count = countVoxels(labelMap);
  const float = with5(new Float32Array(count));
  assert.deepEqual(labelsOf(await flipfree.labelSurfaces({ ...labelMap, voxels: float })), [5]); // whole numbers
  for (const [change, options, message] of [
    [{ voxels: with5(new Float32Array(count)).fill(0.5, 150, 151) }, {}, /^The label map has the value 0\.5 at voxel \(\d+, \d+, \d+\); a label map holds whole numbers from 0 to 2147483647/],
    [{ voxels: with5(new Float32Array(count)).fill(NaN, 150, 151) }, {}, /has the value nan at voxel/],
    [{ voxels: with5(new Int16Array(count)).fill(-1, 0, 1) }, {}, /has the value -1 at voxel \(0, 0, 0\)/],
    [{ voxels: new Uint8Array(count) }, {}, /^The label map has no labels, since all voxels are 0; give one that has some/],
    [{ voxels: new Uint8Array(7) }, {}, /7 voxels, which does not fit its size/],
    [{ spacing: [0, 1, 1] }, {}, /^The label map has a spacing of \(0, 1, 1\) mm; make it positive/],
    [{ origin: [1e9, 0, 0] }, {}, /single precision/],
    [{}, { only: [1, 99] }, /^The label map has no voxel with label 99; change only; those of them that it has are 1$/],
    [{}, { only: 3 }, /^only: give a list of labels/],
    [{}, { only: [0.5] }, /^only: give a list of labels/],
    [{}, { only: [2 ** 32 + 6] }, /^only: give a list of labels/],
    [{}, { parameters: { distance: 0.2 } }, /^The value of distance is 0\.2; choose 0\.5 to 1$/],
    [{}, { parameters: { iterations: 1.5 } }, /^The value of iterations is 1\.5; choose a whole number, 0 to 10000$/],
    [{}, { parameters: { edgeLength: -1 } }, /^The value of edgeLength is -1; choose 0 to 1e\+06$/],
    [{}, { parameters: { triangles: -1 } }, /^The value of triangles is -1; choose a whole number, 0 or more$/],
    [{}, { parameters: { tolerance: NaN } }, /^The value of tolerance is nan; choose 0 to 10$/],
    [{}, { parameters: { exact: 2 } }, /^The value of exact is 2; choose 0 to 1$/],
    [{}, { parameters: { smallestPart: 1e9 } }, /^No part of any label has 1e\+09 mm3; lower smallestPart$/],
    [{}, { parameters: { speling: 1 } }, /There is no parameter speling; there are exact, distance, iterations, smallestPart/],
  ]) {
    await assert.rejects(flipfree.labelSurfaces({ ...labelMap, ...change }, options), (error) => {
      assert.ok(error instanceof FlipFreeError, `${error}`);
      assert.match(error.message, message);
      return true;
    });
  }
  for (const rows of [{}, [{}], [{ label: 1, name: "", file: "" }]]) {
    await assert.rejects(flipfree.labelTableFile(rows), (error) => {
      assert.ok(error instanceof FlipFreeError, `${error}`);
      assert.match(error.message, /^Rows need a name, a file and the numbers label, volume, voxels, voxelVolume,/);
      return true;
    });
  }
  const types = readFileSync(join(folder, "types/parametertypes.d.ts"), "utf8");
  assert.match(types, /LabelSurfaceParameters = \{\s+exact\?: boolean;\s+distance\?: number;/);
});

test("surfaces of labels are canceled, and the next ones are made", async () => {
  const stop = new AbortController();
  const onProgress = () => stop.abort(new Error("enough"));
  await assert.rejects(flipfree.labelSurfaces(phantom.labelMap, { signal: stop.signal, onProgress }), /^Error: enough$/);
  assert.equal((await flipfree.labelSurfaces(phantom.labelMap, { only: [4] })).labels.length, 1);
});

test("labels are called as their file says, and their surfaces as the command's", async () => {
  const segments = [{ label: 4, name: "left kidney", color: "1 0.5 0" }, { label: 6, name: "Leber", color: "" }];
  const pairs = segments.flatMap((one, number) => segmentPairs(number, one));
  writeFileSync(join(scratch, "named.seg.nrrd"), nrrd(phantom.labelMap, Int16Array.from(phantom.labelMap.voxels), pairs));
  const volume = await opened("named.seg.nrrd");
  assert.deepEqual(volume.segments, [{ label: 4, name: "left kidney", color: "#ff8000" }, { label: 6, name: "Leber", color: "" }]);
  assert.deepEqual((await opened("abdomen-truth.nii.gz")).segments, []);
  command(scratch, "surfaces", "named.seg.nrrd", "-o", "named", "--label", "4", "--label", "6", "-q");
  const { labels } = await flipfree.labelSurfaces(volume.image, { only: [4, 6] });
  const names = await Promise.all(labels.map((one, at) => writeLabel(one, "stl", segments[at].name)));
  assert.deepEqual(names, ["4-left_kidney.stl", "6-Leber.stl"]);
  for (const name of names) {
    assert.ok(readFileSync(join(scratch, name)).equals(readFileSync(join(scratch, "named", name))), name);
  }
});

/** The vertex that is farthest along an axis, moved by some millimeters. */
function beyond(surface, axis, sign, distance) {
  let best = 0;
  for (let at = 0; at < surface.points.length; at += 3) {
    best = sign * surface.points[at + axis] > sign * surface.points[best + axis] ? at : best;
  }
  const point = [...surface.points.subarray(best, best + 3)];
  point[axis] += sign * distance;
  return point;
}

function farthestApart(a, b) {
  assert.equal(a.length, b.length);
  return a.reduce((most, value, at) => Math.max(most, Math.abs(value - b[at])), 0);
}

/** Seconds that some work takes, and its result. */
async function timed(work) {
  const start = performance.now();
  return [await work(), (performance.now() - start) / 1000];
}

test("corrections are the command's, and fast after a run", async () => {
  const corrections = {
    inside: [beyond(liver.surface, 0, -1, 3)],
    outside: [[60, 83, 167]],
    boundary: [beyond(liver.surface, 1, -1, 1)],
    seeds: [{ center: [80, 100, 160], radius: 10 }],
  };
  // Another organ, after which nothing is kept of the liver.
  const other = () => flipfree.segment(phantom.image, { center: seed.center, radius: 20 }, { parameters: { resolution: 8, levels: 1 } });
  await other();
  const [, first] = await timed(() => flipfree.segment(phantom.image, seed));
  const [corrected, again] = await timed(() => flipfree.segment(phantom.image, seed, corrections));
  console.log(`First ${first.toFixed(2)} s, corrected ${again.toFixed(2)} s`);
  assert.ok(again < first);
  assert.equal(corrected.selfIntersections, 0);

  const table = ["kind,x,y,z,radius"];
  for (const kind of ["boundary", "outside", "inside"]) {
    table.push(...corrections[kind].map((point) => `${kind},${point.join()},`));
  }
  table.push("seed,80,100,160,10");
  writeFileSync(join(scratch, "points.csv"), table.join("\n"));
  command(scratch, "segment", "abdomen.nii.gz", "--seed", ...seed.center.map(String), "--radius", `${seed.radius}`,
    "--points", "points.csv", "-o", "corrected.ply", "--labels", "corrected.nii.gz");
  const native = readNiftiFile(join(scratch, "corrected.nii.gz")).voxels;
  const farthest = farthestApart(readPlyPoints(join(scratch, "corrected.ply")), corrected.surface.points);
  const overlap = dice(labelMapOf(corrected, phantom.image).voxels, native);
  console.log(`Dice with the command's corrected liver ${overlap}, coordinates differ by at most ${farthest} mm`);
  assert.ok(overlap > 0.999);
  assert.ok(dice(labelMapOf(liver, phantom.image).voxels, native) < 0.999);

  // In one go, and in another order, the same bits; and without them what was there before.
  await other();
  const { inside, outside, boundary, seeds } = corrections;
  const fresh = await flipfree.segment(phantom.image, seed, { seeds, boundary, outside, inside });
  assert.deepEqual(fresh.surface, corrected.surface);
  assert.deepEqual((await flipfree.segment(phantom.image, seed)).surface, liver.surface);
});

test("a vessel is the command's", async () => {
  const [size, spacing] = [64, 1.5];
  command(scratch, "phantom", "vessel", "--size", `${size}`, `${size}`, `${size}`, "--spacing", "1.5", "1.5", "1.5", "-o", ".");
  const center = ((size - 1) / 2) * spacing;
  const ends = [-0.95, 0.95].map((place) => [
    center + 36 * place,
    center + 16 * Math.sin(Math.PI * place),
    center + 10 * Math.cos(0.8 * Math.PI * place + 0.5),
  ]);
  const parameters = { dimensions: [size, size, size], spacing: [spacing, spacing, spacing] };
  const { image, labelMap } = await flipfree.phantom("vessel", { parameters });
  const fractions = [];
  const vessel = await flipfree.trace(image, ends, { onProgress: (fraction) => fractions.push(fraction) });
  command(scratch, "trace", "vessel.nii.gz", ...ends.flatMap((end) => ["--point", ...end.map(String)]),
    "-o", "vessel.ply", "--labels", "vessel-found.nii.gz");
  const found = labelMapOf(vessel, image).voxels;
  const farthest = farthestApart(readPlyPoints(join(scratch, "vessel.ply")), vessel.surface.points);
  const overlap = dice(found, readNiftiFile(join(scratch, "vessel-found.nii.gz")).voxels);
  console.log(`Dice with the command's vessel ${overlap}, coordinates differ by at most ${farthest} mm`);
  assert.ok(overlap > 0.999);
  assert.ok(dice(found, labelMap.voxels) > 0.9);
  assert.equal(vessel.selfIntersections, 0);
  assert.ok(fractions.every((fraction, at) => fraction >= (fractions[at - 1] ?? 0) && fraction <= 1), `${fractions}`);
  assert.equal(vessel.branches.length, 1);
  const [{ points, radii, parent }] = vessel.branches;
  assert.equal(points.length, 3 * radii.length);
  assert.equal(parent, -1);
  assert.ok(radii.every((radius) => radius > 3 && radius < 5) && vessel.radius > 3 && vessel.radius < 5);
  assert.ok(vessel.support > 0.9 && vessel.support <= 1);
  assert.ok(vessel.confidence > 0.6 && vessel.confidence <= vessel.support);

  for (const [wrong, options, message] of [
    [[ends[0]], {}, /A vessel needs at least two points, not 1; give one at each end/],
    [[ends[0], [9999, 0, 0]], {}, /The point \(9999, 0, 0\) mm lies outside the image/],
    [[ends[0], ends[0]], {}, /closer than 3 mm/],
    [[ends[0], [1, 2]], {}, /points, entry 2, is not a point; give \[x, y, z\]/],
    [7, {}, /points: give a list of points/],
    [ends, { parameters: { seed: 1 } }, /no parameter seed; there are radius, wallThickness, modality, levels, maximumIterations/],
    [ends, { parameters: { radius: NaN } }, /radius/],
  ]) {
    await assert.rejects(flipfree.trace(image, wrong, options), (error) => {
      assert.ok(error instanceof FlipFreeError, `${error}`);
      assert.match(error.message, message);
      return true;
    });
  }
});

test("scores are the command's", async () => {
  const parameters = { referenceLabel: liverLabel };
  const ofLabels = await flipfree.evaluate(labelMapOf(liver, phantom.image), phantom.labelMap, { parameters });
  const ofSurface = await flipfree.evaluate(liver.surface, phantom.labelMap, { parameters });
  const printed = command(scratch, "evaluate", "liver.nii.gz", "abdomen-truth.nii.gz", "--reference-label", "6");
  assert.ok(Math.abs(ofLabels.dice - Number(printed.match(/Dice +([\d.]+)/)[1])) < 1e-3);
  assert.equal(ofSurface.dice, ofLabels.dice);
  assert.equal(ofSurface.distanceOf, "mesh");
  assert.deepEqual(Object.keys(ofLabels), [
    "dice",
    "jaccard",
    "relativeVolumeDifference",
    "asd",
    "rms",
    "hd95",
    "hd",
    "segmentationVolume",
    "referenceVolume",
    "overlapOf",
    "distanceOf",
    "warnings",
  ]);
  const ofAll = await flipfree.evaluate(labelMapOf(liver, phantom.image), phantom.labelMap);
  assert.equal(ofAll.warnings.length, 1);
  assert.match(ofAll.warnings[0], /^The reference has the labels .*; to compare it with one, set referenceLabel\.$/);
});

test("files are what the command reads", async () => {
  const blob = await flipfree.labelMapFile(labelMapOf(liver, phantom.image));
  const bytes = Buffer.from(await blob.arrayBuffer());
  assert.deepEqual(readNifti(bytes).voxels, labelMapOf(liver, phantom.image).voxels);
  writeFileSync(join(scratch, "saved.nii.gz"), bytes);
  const evaluate = (name) =>
    command(scratch, "evaluate", name, "abdomen-truth.nii.gz", "--reference-label", `${liverLabel}`);
  const expected = evaluate("saved.nii.gz").match(/Dice +([\d.]+)/)[1];
  for (const format of surfaceFormats) {
    writeFileSync(join(scratch, `saved.${format}`), Buffer.from(await (await flipfree.surfaceFile(liver, format)).arrayBuffer()));
    const printed = evaluate(`saved.${format}`);
    assert.match(printed, /valid: closed, Euler number 2, self-intersections 0/, format);
    assert.equal(printed.match(/Dice +([\d.]+)/)[1], expected, format);
  }
});

/** Writes a result in every format, and expects the command's files to say the same of where it comes from. */
async function expectSameOrigin(name, result, names) {
  for (const format of surfaceFormats) {
    writeFileSync(join(scratch, `ours.${format}`), Buffer.from(await (await flipfree.surfaceFile(result, format, names)).arrayBuffer()));
  }
  const [ours, theirs] = ["ours", name].map((file) => fieldDataOf(join(scratch, `${file}.vtp`)));
  assert.deepEqual(JSON.parse(ours.Provenance[0]), JSON.parse(theirs.Provenance[0]));
  assert.deepEqual(ours.Certified, theirs.Certified);
  assert.deepEqual(ours.Confidence?.map(floored), theirs.Confidence?.map(floored));
  for (const format of ["stl", "ply"]) { // which know no names
    assert.ok(readFileSync(join(scratch, `ours.${format}`)).equals(readFileSync(join(scratch, `${name}.${format}`))), format);
  }
  const comments = readFileSync(join(scratch, "ours.ply"), "latin1").split("end_header")[0].match(/^comment (FlipFree|provenance) .*$/gm);
  assert.ok(comments.length > 2);
  assert.match(readFileSync(join(scratch, "ours.stl")).subarray(0, 80).toString(), /^FlipFree [\d.]+, millimeters, SPACE=LPS *$/);
}

test("surfaces say where they come from, and whether they are certified, as the command's do", async () => {
  const native = (name, ...words) => surfaceFormats.map((format) => command(scratch, ...words, "-o", `${name}.${format}`, "-q"));
  const quick = ["--resolution", "8", "--levels", "1"];
  const parameters = { resolution: 8, levels: 1 };
  const sphere = [...seed.center, seed.radius].map(String);
  const seeded = ["segment", "abdomen.nii.gz", "--seed", ...sphere.slice(0, 3), "--radius", sphere[3], ...quick];
  const names = { image: "abdomen.nii.gz", organ: "organ" };

  native("organ", ...seeded, "--outside", "60", "83", "167");
  const organ = await flipfree.segment(phantom.image, seed, { parameters, outside: [[60, 83, 167]] });
  assert.equal(organ.certified, true);
  await expectSameOrigin("organ", organ, names);

  native("organ", ...seeded, "--no-guard", "--no-carving");
  const unguarded = await flipfree.segment(phantom.image, seed, { parameters: { ...parameters, guard: false, carving: false } });
  assert.equal(unguarded.certified, false);
  await expectSameOrigin("organ", unguarded, names);

  native("organ", "segment", "abdomen.nii.gz", "--start-labels", "abdomen-truth.nii.gz", "--start-label", "1", ...quick);
  const filled = await flipfree.segment(phantom.image, { labels: phantom.labelMap, label: 1 }, { parameters });
  await expectSameOrigin("organ", filled, { ...names, startLabels: "abdomen-truth.nii.gz" });

  command(scratch, "phantom", "vessel", "--size", "48", "48", "48", "--spacing", "2", "2", "2", "-o", ".");
  const grid = { dimensions: [48, 48, 48], spacing: [2, 2, 2] };
  const { image } = await flipfree.phantom("vessel", { parameters: grid });
  const ends = [-0.9, 0.9].map((place) => [47 + 36 * place, 47 + 16 * Math.sin(Math.PI * place), 47 + 10 * Math.cos(0.8 * Math.PI * place + 0.5)]);
  native("aorta", "trace", "vessel.nii.gz", ...ends.flatMap((end) => ["--point", ...end.map(String)]), "--modality", "1");
  const vessel = await flipfree.trace(image, ends, { parameters: { modality: 1 } });
  assert.equal(vessel.certified, true);
  await expectSameOrigin("aorta", vessel, { image: "vessel.nii.gz", organ: "aorta" });

  // The text is a session by itself.
  writeFileSync(join(scratch, "text.json"), organ.provenance);
  command(scratch, "segment", "abdomen.nii.gz", "--session", "text.json", "-o", "again.ply", "-q");
  assert.deepEqual(readPlyPoints(join(scratch, "again.ply")), Float32Array.from(organ.surface.points));
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
    writeFileSync(join(scratch, "grid.nii.gz"), Buffer.from(await (await flipfree.labelMapFile(labelMap)).arrayBuffer()));
    writeFileSync(join(scratch, "grid.stl"), Buffer.from(await (await flipfree.surfaceFile(sphere, "stl")).arrayBuffer()));
    const printed = command(scratch, "evaluate", "grid.stl", "grid.nii.gz");
    assert.ok(Number(printed.match(/Dice +([\d.]+)/)[1]) > 0.97, `${direction}: ${printed}`);
  }
});

async function opened(name, ...beside) {
  const files = [name, ...beside].map((file) => ({ name: file, data: new Blob([readFileSync(join(scratch, file))]) }));
  return flipfree.readVolume(files);
}

test("files are read as the command reads them", async () => {
  const { image, warnings } = await opened("abdomen.nii.gz");
  assert.deepEqual(image.voxels, phantom.image.voxels);
  assert.deepEqual(warnings, []);
  for (const [at, value] of phantom.image.origin.entries()) {
    assert.ok(Math.abs(image.origin[at] - value) < 1e-4);
  }
  assert.deepEqual(image.spacing, phantom.image.spacing);

  // Cut off, packed in two members, and without an orientation.
  const packed = readFileSync(join(scratch, "abdomen.nii.gz"));
  const plain = gunzipSync(packed);
  const write = (name, bytes) => writeFileSync(join(scratch, name), bytes);
  write("cut.nii.gz", packed.subarray(0, packed.length / 2));
  await assert.rejects(opened("cut.nii.gz"), /'cut\.nii\.gz' cannot be read: its compressed stream breaks off/);
  write("cut.nii", plain.subarray(0, plain.length / 2));
  await assert.rejects(opened("cut.nii"), /holds fewer voxels than its header says/);
  write("members.nii.gz", Buffer.concat([gzipSync(plain.subarray(0, 5000)), gzipSync(plain.subarray(5000))]));
  assert.deepEqual((await opened("members.nii.gz")).image.voxels, phantom.image.voxels);
  for (const padding of [Buffer.alloc(1000), Buffer.from("junk"), Buffer.from([0x1f])]) {
    write("padded.nii.gz", Buffer.concat([packed, padding]));
    assert.deepEqual((await opened("padded.nii.gz")).image.voxels, phantom.image.voxels, `${padding.subarray(0, 4)}`);
  }
  const nowhere = Buffer.from(plain);
  nowhere.writeInt32LE(0, 252);
  write("nowhere.nii", nowhere);
  assert.match((await opened("nowhere.nii")).warnings.join(), /neither a qform nor an sform/);
  write("text.nii", "no volume");
  await assert.rejects(opened("text.nii"), /does not begin as its file extension requires/);

  // A header and its voxels.
  const grid = { ...phantom.image };
  write("pair.mhd", `ObjectType = Image\nNDims = 3\nDimSize = ${grid.size.join(" ")}\nElementSpacing = ${grid.spacing.join(" ")}\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nBinaryDataByteOrderMSB = False\n`
    + `Offset = ${grid.origin.join(" ")}\nElementType = MET_SHORT\nElementDataFile = pair.raw\n`);
  write("pair.raw", Buffer.from(grid.voxels.buffer));
  const pair = await opened("pair.raw", "pair.mhd");
  assert.deepEqual(pair.image.voxels, grid.voxels);
  assert.deepEqual(pair.image.origin, [...grid.origin]);
  await assert.rejects(opened("pair.mhd"), /There is no file 'pair\.raw'/);
});

test("lines and bytes before the voxels of an NRRD file are skipped, lines before it is inflated", async () => {
  const bytes = nrrd(phantom.image, phantom.image.voxels).toString("latin1");
  const [header, voxels] = [bytes.slice(0, bytes.indexOf("\n\n")), bytes.slice(bytes.indexOf("\n\n") + 2)];
  const file = async (fields, content) => {
    const data = new Blob([Buffer.from(`${fields}\n\n${content}`, "latin1")]);
    return (await flipfree.readVolume([{ name: "lines.nrrd", data }])).image.voxels;
  };
  const skipping = `${header}\nline skip: 2\nbyte skip: 3`;
  assert.deepEqual(await file(skipping, `one\ntwo\nabc${voxels}`), phantom.image.voxels);
  const packed = gzipSync(Buffer.from(`abc${voxels}`, "latin1")).toString("latin1");
  assert.deepEqual(await file(skipping.replace("raw", "gzip"), `one\ntwo\n${packed}`), phantom.image.voxels);
  await assert.rejects(file(`${header}\nline skip: 2000000000`, voxels), /fewer voxels/);
});

const ctGrid = { size: [6, 5, 4], spacing: [2, 1.5, 3], origin: [-40, -150, 300], direction: [1, 0, 0, 0, 1, 0, 0, 0, 1] };
const ctVoxels = Int16Array.from({ length: 120 }, (_, at) => at * 7 - 400);

function ctFiles(options) {
  const slices = dicomFiles(ctGrid, ctVoxels, options);
  return slices.map((bytes, at) => ({ name: `ct/${9 - at}.dcm`, data: new Blob([bytes]) })); // in no order of places
}

test("DICOM files are read as the command reads them", async () => {
  const [grid, voxels, files] = [ctGrid, ctVoxels, ctFiles()];
  const [series, ...others] = await flipfree.listSeries(files);
  assert.deepEqual(others, []);
  assert.deepEqual([series.slices, series.modality, series.spacing, series.problem], [4, "CT", grid.spacing, ""]);
  const { image, warnings, series: uid } = await flipfree.readVolume(files, { series: series.uid });
  assert.equal(uid, series.uid);
  assert.deepEqual(warnings, []);
  assert.deepEqual([...image.voxels], [...voxels]);
  assert.deepEqual([image.size, image.spacing, image.origin, image.direction], [grid.size, grid.spacing, grid.origin, grid.direction]);

  const other = [...files, { name: "ct/report.txt", data: new Blob(["no image"]) }];
  assert.deepEqual([...(await flipfree.readVolume(other)).image.voxels], [...voxels]);
  await assert.rejects(flipfree.readVolume(files, { series: "9" }), /9/);
  await assert.rejects(flipfree.readVolume(files.filter((_, at) => at !== 1)), /missing|even/);
  await assert.rejects(flipfree.readVolume([{ name: "notes.txt", data: new Blob(["no image"]) }]), FlipFreeError);
  const cut = files.map((file, at) => (at === 2 ? { ...file, data: file.data.slice(0, 500) } : file));
  await assert.rejects(flipfree.readVolume(cut), /7\.dcm/);
});

test("compressed DICOM files are decoded, by what is loaded with the first of them", async () => {
  const files = ctFiles({ isCompressed: true });
  assert.deepEqual([...(await flipfree.readVolume(files)).image.voxels], [...ctVoxels]);
  const damaged = files.map(({ name, data }) => ({ name, data: new Blob([data.slice(0, -40), new Uint8Array(40)]) }));
  await assert.rejects(flipfree.readVolume(damaged), /\.dcm/);

  // What is loaded at the start; the decoder alone is far larger.
  const loaded = new Map();
  const load = (name) => {
    if (!loaded.has(name)) {
      const text = readFileSync(join(folder, name), "utf8");
      loaded.set(name, text.length);
      [...text.matchAll(/^(?:import "|(?:import |export |\} )[^;]*? ?from ")\.\/([^"]+)"/gm)].forEach(([, part]) => load(part));
    }
  };
  load("worker.js");
  assert.ok(loaded.size > 1);
  assert.ok([...loaded.values()].reduce((sum, length) => sum + length) < 1e6, [...loaded].join());
});

test("label maps of sheared grids are written by an sform", async () => {
  const tilt = 0.3;
  const labelMap = {
    size: [3, 4, 5], spacing: [1, 2, 3], origin: [10, 20, 30], voxels: Uint8Array.from({ length: 60 }, (_, at) => at % 3),
    direction: [1, 0, 0, 0, 1, Math.sin(tilt), 0, 0, Math.cos(tilt)],
  };
  const bytes = Buffer.from(await (await flipfree.labelMapFile(labelMap)).arrayBuffer());
  assert.deepEqual([gunzipSync(bytes).readInt16LE(252), gunzipSync(bytes).readInt16LE(254)], [0, 1]);
  writeFileSync(join(scratch, "sheared.nii.gz"), bytes);
  const { image } = await opened("sheared.nii.gz");
  assert.deepEqual(image.voxels, labelMap.voxels);
  for (const [at, value] of labelMap.direction.entries()) {
    assert.ok(Math.abs(image.direction[at] - value) < 1e-6);
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
  const types = readFileSync(join(process.env.FLIPFREE_BROWSER_PACKAGE, "types/parametertypes.d.ts"), "utf8");
  const [, typed] = types.match(/SegmentationParameters = \{([^}]*)\}/);
  assert.deepEqual([...typed.matchAll(/(\w+)\?:/g)].map(([, name]) => name), Object.keys(parameters));
  assert.equal(published.guard, false);
  const quick = { resolution: 8, levels: 1, carving: false };
  const { voxels, ...grid } = phantom.image;
  const organ = { name: "liver", kind: "organ", color: "#ffffff", seed, preset: "naive", corrections: [], parameters: { ...parameters, ...quick } };
  const session = { format: "flipfree-session", version: 2, image: { name: "abdomen.nii.gz", ...grid }, organs: [organ] };
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
    [phantom.image, seed, { inside: [[9999, 0, 0]] }, /The inside point \(9999, 0, 0\) mm lies outside the image, which spans /],
    [phantom.image, seed, { outside: [seed.center] }, /The outside point .* lies in the inner half of the seed sphere; move/],
    [phantom.image, seed, { inside: [[60, 83, 167]], boundary: [[60, 83, 167]] }, /are in the same place; remove one of them/],
    [phantom.image, seed, { inside: [[1, 2]] }, /inside, entry 1, is not a point; give \[x, y, z\]/],
    [phantom.image, seed, { boundary: [[60, 83, 167], [NaN, 0, 0]] }, /boundary, entry 2, is not a point/],
    [phantom.image, seed, { outside: 3 }, /outside: give a list of points/],
    [phantom.image, seed, { seeds: [{ center: [60, 83, 167] }] }, /seeds, entry 1, has no radius; give/],
    [phantom.image, seed, { preset: "naive", inside: [[60, 83, 167]] }, /under the guard; switch guard on/],
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
