// The page as a radiologist uses it, in Chromium: opens images, places a seed by mouse, runs, cancels, saves.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { command, dice, liverLabel, readNiftiFile, seed } from "./Support.mjs";

const { chromium } = createRequire(join(process.env.FLIPFREE_BROWSER_SOURCE, "package.json"))("playwright-core");
const pictures = process.env.FLIPFREE_PICTURES;
const scratch = mkdtempSync(join(tmpdir(), "flipfree-"));

let server;
let address;
let browser;
let page;
const requests = [];
const violations = [];

/** Python's own, on a port that is free. */
async function serve(folder) {
  server = spawn("python3", ["-u", "-m", "http.server", "0", "--bind", "127.0.0.1", "--directory", folder]);
  const line = await new Promise((resolve, reject) => {
    server.stdout.once("data", resolve);
    server.once("exit", () => reject(new Error("no server")));
  });
  return `http://127.0.0.1:${`${line}`.match(/port (\d+)/)[1]}/`;
}

async function openPage() {
  const opened = await browser.newPage({ viewport: { width: 1280, height: 720 }, acceptDownloads: true });
  opened.on("request", (request) => requests.push(request.url()));
  opened.on("console", (message) => {
    if (message.type() === "error" || /Content Security Policy/.test(message.text())) {
      violations.push(message.text());
    }
  });
  opened.on("pageerror", (error) => violations.push(`${error}`));
  await opened.goto(address);
  await opened.waitForSelector("html[data-ready]", { timeout: 60_000 });
  return opened;
}

const status = (text) => page.waitForFunction((wanted) => document.getElementById("status").textContent.startsWith(wanted), text, { timeout: 120_000 });
const errorText = async () => {
  await page.waitForFunction(() => document.getElementById("error").textContent, null, { timeout: 120_000 });
  return page.textContent("#error");
};

async function picture(name) {
  if (pictures) {
    mkdirSync(pictures, { recursive: true });
    await page.screenshot({ path: join(pictures, `${name}.png`) });
  }
}

async function saved(button) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  const path = join(scratch, download.suggestedFilename());
  await download.saveAs(path);
  await page.waitForFunction(() => !document.getElementById("save-session").disabled);
  return path;
}

async function openPhantom() {
  await page.click("#open-phantom");
  await status("Place the seed");
}

/** The seed's numbers typed in. */
async function typeSeed({ center, radius }) {
  const values = { "#seed-x": center[0], "#seed-y": center[1], "#seed-z": center[2], "#seed-radius": radius };
  for (const [field, value] of Object.entries(values)) {
    await page.fill(field, `${value}`);
  }
  await page.press("#seed-radius", "Tab");
}

async function segment() {
  await page.click("#run");
  await status("Segmented in");
}

before(async () => {
  command(scratch, "phantom", "abdomen", "-o", ".");
  command(scratch, "segment", "abdomen.nii.gz", "--seed", ...seed.center.map(String), "--radius", `${seed.radius}`,
    "-o", "native.ply", "--labels", "native.nii.gz");
  address = await serve(process.env.FLIPFREE_BROWSER_PAGE);
  browser = await chromium.launch({
    executablePath: process.env.FLIPFREE_CHROMIUM,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
  page = await openPage();
});

after(async () => {
  await browser?.close();
  server?.kill();
  rmSync(scratch, { recursive: true });
});

test("the built-in abdomen: seed by mouse, liver, saved files", async () => {
  await openPhantom();
  // The cross-hair is in the liver's seed; the upper left quarter is the axial slice, 480 x 335 pixels.
  const box = await page.locator("#overlay").boundingBox();
  const [x, y] = await page.evaluate(() => {
    const canvas = document.getElementById("slices");
    return [canvas.clientWidth / 4, canvas.clientHeight / 4];
  });
  await page.keyboard.press("c"); // where it is known to be
  const at = async (field) => Number(await page.inputValue(field));
  assert.deepEqual([await at("#seed-x"), await at("#seed-y"), await at("#seed-z")], [99.8, 83.8, 167]);

  // By mouse, in the left half of the axial slice: the patient's right.
  await page.mouse.move(box.x + x - 40, box.y + y);
  await page.mouse.down();
  await page.mouse.move(box.x + x - 20, box.y + y, { steps: 4 });
  await page.mouse.up();
  await status("Seed placed");
  assert.ok((await at("#seed-radius")) > 5 && (await at("#seed-radius")) < 60);
  assert.equal(await at("#seed-z"), 167);
  await picture("seed");

  await page.selectOption("#phantom-seed", `${liverLabel}`);
  await typeSeed(seed);
  await segment();
  await picture("liver");
  assert.match(await page.textContent("#result"), /Self-intersections0/);

  const labels = await saved("#save-labels");
  const native = readNiftiFile(join(scratch, "native.nii.gz")).voxels;
  assert.ok(dice(readNiftiFile(labels).voxels, native) > 0.999);
  for (const format of ["stl", "ply", "vtp"]) {
    await page.selectOption("#surface-format", format);
    const surface = await saved("#save-surface");
    const printed = command(scratch, "evaluate", surface, "native.nii.gz");
    assert.match(printed, /valid: closed, Euler number 2, self-intersections 0/);
    assert.ok(Number(printed.match(/Dice +([\d.]+)/)[1]) > 0.999);
  }
});

test("contours lie on the surface's slices", async () => {
  // In the axial slice, the contour's color is drawn, and around the liver's seed.
  const colored = await page.evaluate(() => {
    const overlay = document.getElementById("overlay");
    const { data, width } = overlay.getContext("2d").getImageData(0, 0, overlay.width, overlay.height);
    const quarters = [0, 0, 0, 0];
    for (let pixel = 0; pixel < data.length / 4; ++pixel) {
      if (data[4 * pixel + 3] > 128) {
        const isRight = pixel % width >= width / 2;
        const isLow = Math.floor(pixel / width) >= overlay.height / 2;
        ++quarters[2 * isLow + isRight];
      }
    }
    return quarters;
  });
  assert.ok(colored.slice(0, 3).every((pixels) => pixels > 300), `${colored}`);
  assert.equal(colored[3], 0);
});

test("a session is saved and opened", async () => {
  const path = await saved("#save-session");
  const session = JSON.parse(readFileSync(path, "utf8"));
  assert.equal(session.format, "flipfree-session");
  assert.deepEqual(session.organs[0].seed, seed);
  assert.deepEqual(session.image.size, readNiftiFile(join(scratch, "abdomen.nii.gz")).size);
  session.organs[0].seed.radius = 25;
  writeFileSync(join(scratch, "other.json"), JSON.stringify(session));
  await page.setInputFiles("#files", join(scratch, "other.json"));
  await status("Session of");
  assert.equal(Number(await page.inputValue("#seed-radius")), 25);
});

test("a file by the dialog gives the same liver; cancel and run again", async () => {
  await page.setInputFiles("#files", join(scratch, "abdomen.nii.gz"));
  await status("Place the seed");
  assert.match(await page.textContent("#image-name"), /^abdomen\.nii\.gz, \d+ × \d+ × \d+ voxels$/);
  await typeSeed(seed);
  await page.click("#run");
  await page.waitForFunction(() => document.getElementById("progress").value > 0);
  await page.keyboard.press("Escape");
  await status("Canceled");
  assert.ok(await page.isDisabled("#save-labels"));
  await segment();
  const labels = readNiftiFile(await saved("#save-labels")).voxels;
  assert.ok(dice(labels, readNiftiFile(join(scratch, "native.nii.gz")).voxels) > 0.999);
});

test("bad input is answered by a message", async () => {
  const bytes = readFileSync(join(scratch, "abdomen.nii.gz"));
  const files = { "cut.nii.gz": bytes.subarray(0, 5000), "text.nii": Buffer.from("no image"), "notes.txt": Buffer.from("no image"), "half.mhd": Buffer.from("x"), "bad.json": Buffer.from("{") };
  for (const [name, content] of Object.entries(files)) {
    writeFileSync(join(scratch, name), content);
    await page.setInputFiles("#files", join(scratch, name));
    assert.match(await errorText(), new RegExp(name.replace(".", "\\.")), name);
  }
  await typeSeed({ center: [9999, 0, 0], radius: 20 });
  await page.click("#run");
  assert.match(await errorText(), /outside/);
  await typeSeed({ center: [5, 5, 167], radius: 4 }); // air
  await page.click("#run");
  assert.match(await errorText(), /./);
  await picture("error");
});

test("nothing was asked of any other address, and the policy held", async () => {
  const outside = requests.filter((url) => !url.startsWith(address) && !/^(blob|data):/.test(url));
  assert.deepEqual(outside, []);
  assert.deepEqual(violations, []);
  const policy = await page.getAttribute('meta[http-equiv="Content-Security-Policy"]', "content");
  assert.match(policy, /connect-src 'self'/);
  assert.doesNotMatch(policy, /'unsafe-(eval|inline)'/);
});

test("controls have names, and light and dark are readable", async () => {
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, select, input, canvas:not([aria-hidden])")]
      .filter((control) => !(control.ariaLabel || control.textContent.trim() || control.labels?.[0]?.textContent.trim()))
      .map((control) => control.id),
  );
  assert.deepEqual(nameless, []);
  for (let theme = 0; theme < 2; ++theme) {
    const contrast = await page.evaluate(() => {
      const luminance = (color) => {
        const parts = color.match(/\d+/g).slice(0, 3).map((part) => part / 255);
        const [r, g, b] = parts.map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const back = luminance(getComputedStyle(document.querySelector("aside")).backgroundColor);
      return [".hint", "legend", "#run", "#error"].map((selector) => {
        const style = getComputedStyle(document.querySelector(`aside ${selector}`));
        const own = selector === "#run" ? luminance(style.backgroundColor) : back;
        const [dark, light] = [own, luminance(style.color)].sort((a, b) => a - b);
        return (light + 0.05) / (dark + 0.05);
      });
    });
    assert.ok(Math.min(...contrast) >= 4.5, `${contrast}`);
    await page.click("#theme");
  }
});
