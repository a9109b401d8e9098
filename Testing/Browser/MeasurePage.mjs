// Times and memory of the page in Chromium, beside the native command in the same run.
//
//   node Testing/Browser/MeasurePage.mjs DIR [ROUNDS [CASE ...]]
//
//   DIR     volumes and cases.csv, see CONTRIBUTING.md
//   ROUNDS  runs of each, by default 5; medians are printed
//
// Wants what the tests have built (build/dev: Browser.Build and the command). For each row, the seconds from the click on
// Segment to the surface on the screen, those of the run in the worker alone, those of the command's run with one thread (all its
// stages, without reading and writing), whether both label maps are the same, the seconds from a point's key to the surface that
// obeys it (an outside point 1.2 radii from the seed's center, in each round in another direction), and the memory of all of
// Chromium, from the opening on. CASE may be 512x512x275: the built-in abdomen's liver on so many voxels.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const top = join(dirname(fileURLToPath(import.meta.url)), "../..");
const built = join(top, "build/dev");
process.env.FLIPFREE_BROWSER_SOURCE ??= join(top, "Wrapping/Browser");
process.env.FLIPFREE_COMMAND ??= join(built, "bin/flipfree");
process.env.FLIPFREE_CHROMIUM ??= "/usr/bin/chromium";
const { serve, startChromium } = await import("./Browser.mjs");
const { command, dice, readNiftiFile, seedsOf } = await import("./Support.mjs");

const [data, rounds = "5", ...wanted] = process.argv.slice(2);
const names = wanted.length > 0 ? wanted : ["abdomen01-liver"];
const pageFolder = process.env.FLIPFREE_BROWSER_PAGE ?? join(built, "browser/page");
const scratch = mkdtempSync(join(tmpdir(), "flipfree-"));

function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[sorted.length >> 1];
}

const [header, ...lines] = readFileSync(join(data, "cases.csv"), "utf8").trim().split("\n");
const columns = header.split(",");
const rows = lines.map((line) => Object.fromEntries(line.split(",").map((value, at) => [columns[at], value])));

/** Resident memory of Chromium's processes, shared pages once: their proportional set sizes, in MB. First that of all,
 * then that of the process which draws: without a graphics card, textures are in there. */
function memoryOf(parent) {
  const stats = readdirSync("/proc").filter((name) => /^\d+$/.test(name));
  const parents = new Map(stats.flatMap((pid) => {
    try {
      return [[pid, readFileSync(`/proc/${pid}/stat`, "utf8").match(/\) \S (\d+)/)[1]]];
    } catch {
      return [];
    }
  }));
  const isBelow = (pid) => pid === String(parent) || (parents.has(pid) && isBelow(parents.get(pid)));
  const megabytes = [0, 0];
  for (const pid of stats.filter(isBelow)) {
    try {
      const size = Number(readFileSync(`/proc/${pid}/smaps_rollup`, "utf8").match(/^Pss: +(\d+)/m)?.[1] ?? 0) / 1024;
      megabytes[0] += size;
      megabytes[1] += readFileSync(`/proc/${pid}/cmdline`, "utf8").includes("--type=gpu-process") ? size : 0;
    } catch {
      // it has ended
    }
  }
  return megabytes;
}

const pidOfChromium = () => Number(execFileSync("pgrep", ["-P", String(process.pid), "chromium"]).toString().split("\n")[0]);

/** Seconds to the surface on the screen, and those of the run alone, once something has started it. */
async function shownAfter(page, start) {
  await page.evaluate(() => performance.clearMarks());
  await start();
  const isDone = () => performance.getEntriesByName("flipfree-shown").length > 0 || document.getElementById("error").textContent;
  await page.waitForFunction(isDone, null, { timeout: 300_000, polling: 20 });
  return page.evaluate(() => {
    const at = (mark) => (performance.getEntriesByName(mark)[0]?.startTime ?? Number.NaN) / 1000;
    return [at("flipfree-shown") - at("flipfree-click"), at("flipfree-found") - at("flipfree-click")];
  });
}

const clickRun = (page) => shownAfter(page, () => page.evaluate(() => document.getElementById("run").click()));

/** An outside point 1.2 radii from the cross-hair, which is in the seed's center and comes back. */
async function correct(page, round, radius, spacing) {
  const keys = ["ArrowRight", "ArrowLeft", "ArrowUp", "ArrowDown", "PageUp", "PageDown"];
  const [there, back] = [keys[round % 6], keys[(round % 6) ^ 1]];
  const voxels = Math.round((1.2 * radius) / spacing[(round % 6) >> 1]);
  const move = async (key) => {
    for (let voxel = 0; voxel < voxels; ++voxel) {
      await page.keyboard.press(key);
    }
  };
  await move(there);
  await page.keyboard.press("o");
  const times = await shownAfter(page, () => page.keyboard.press("c"));
  await page.keyboard.press("Control+z");
  await move(back);
  return times;
}

const server = await serve(pageFolder);
const chromium = await startChromium();

const loads = [];
for (let round = 0; round < Number(rounds); ++round) {
  const page = await chromium.openPage(server.address, { serviceWorkers: "block" });
  loads.push(await page.evaluate(() => performance.getEntriesByName("flipfree-ready")[0].startTime));
  await page.context().close();
}
console.log(`page ready after ${(median(loads) / 1000).toFixed(2)} s from loopback`);
for (const name of ["kernels.wasm", "main.js", "worker.js"]) {
  const bytes = readFileSync(join(pageFolder, name));
  console.log(`${name}: ${(bytes.length / 1e6).toFixed(2)} MB, ${(gzipSync(bytes).length / 1e6).toFixed(2)} MB compressed`);
}

/** The row of a case; the phantom on a grid of its own is made first. */
function rowOf(name) {
  if (!/^\d+x\d+x\d+$/.test(name)) {
    return rows.find((one) => one.case === name);
  }
  const size = name.split("x");
  const spacing = [220 * 1.5, 170 * 1.5, 90 * 3].map((length, axis) => String(length / Number(size[axis])));
  const [liver] = seedsOf(command(scratch, "phantom", "abdomen", "--size", ...size, "--spacing", ...spacing, "-o", "."));
  const [seed_x, seed_y, seed_z] = liver.center.map(String);
  return { image: relative(data, join(scratch, "abdomen.nii.gz")), seed_x, seed_y, seed_z, radius_mm: String(liver.radius) };
}

for (const name of names) {
  const row = rowOf(name);
  const center = [row.seed_x, row.seed_y, row.seed_z];
  const page = await chromium.openPage(server.address);
  let most = [0, 0];
  const watch = setInterval(() => {
    const now = memoryOf(pidOfChromium());
    most = now[0] > most[0] ? now : most;
  }, 500);
  const opening = performance.now();
  await page.setInputFiles("#files", join(data, row.image));
  await page.waitForFunction(() => document.getElementById("status").textContent.startsWith("Place"), null, { timeout: 300_000 });
  const opened = (performance.now() - opening) / 1000;
  for (const [field, value] of [["x", center[0]], ["y", center[1]], ["z", center[2]], ["radius", row.radius_mm]]) {
    await page.fill(`#seed-${field}`, value);
    await page.press(`#seed-${field}`, "Tab");
  }
  const clicks = [];
  const runs = [];
  const native = [];
  for (let round = 0; round < Number(rounds); ++round) {
    if (round > 0) {
      // Of another seed, so that nothing is kept of the wanted one.
      await page.keyboard.press("+");
      await clickRun(page);
      await page.keyboard.press("Control+z");
    }
    const [click, run] = await clickRun(page);
    clicks.push(click);
    runs.push(run);
    const printed = command(scratch, "segment", join(data, row.image), "--seed", ...center, "--radius", row.radius_mm,
      "--threads", "1", "--labels", "native.nii.gz");
    native.push([..."smoothing feature deformation map".split(" ")].reduce((sum, stage) => sum + Number(printed.match(new RegExp(`${stage} ([\\d.]+) s`))[1]), 0));
  }
  const corrections = [];
  const spacing = readNiftiFile(join(scratch, "native.nii.gz")).spacing;
  for (let round = 0; round < Number(rounds); ++round) {
    corrections.push(await correct(page, round, Number(row.radius_mm), spacing));
  }
  clearInterval(watch);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-labels")]);
  await download.saveAs(join(scratch, "page.nii.gz"));
  const overlap = dice(readNiftiFile(join(scratch, "page.nii.gz")).voxels, readNiftiFile(join(scratch, "native.nii.gz")).voxels);
  console.log(
    `${name}: opened in ${opened.toFixed(1)} s; click to surface ${median(clicks).toFixed(2)} s (run ${median(runs).toFixed(2)} s, ` +
      `command ${median(native).toFixed(2)} s); Dice with the command's ${overlap}; point to surface ${median(corrections.map(([all]) => all)).toFixed(2)} s (run ${median(corrections.map(([, run]) => run)).toFixed(2)} s); Chromium ${Math.round(most[0])} MB, of these ${Math.round(most[1])} for drawing`,
  );
  await page.context().close();
}
await chromium.close();
await server.stop();
rmSync(scratch, { recursive: true });
