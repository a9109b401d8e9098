// What a user does with the page and sees of it, by name: files, seeds, clicks, colors. One page for all tests of a program.
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { serve, startChromium } from "./Browser.mjs";

const pictures = process.env.FLIPFREE_PICTURES;
export const scratch = mkdtempSync(join(tmpdir(), "flipfree-"));
export const result = (name) => join(scratch, name);

export let server;
export let chromium;
export let page;

export async function openPage() {
  server = await serve(process.env.FLIPFREE_BROWSER_PAGE);
  chromium = await startChromium();
  page = await chromium.openPage(server.address);
}

export async function closePage() {
  await chromium?.close();
  await server?.stop();
  rmSync(scratch, { recursive: true });
}

export const status = (text) => page.waitForFunction((wanted) => document.getElementById("status").textContent.startsWith(wanted), text, { timeout: 60_000 });
export const errorText = async () => {
  await page.waitForFunction(() => document.getElementById("error").textContent, null, { timeout: 60_000 });
  return page.textContent("#error");
};
export const numberIn = async (field) => Number(await page.inputValue(field));

export async function picture(name) {
  if (pictures) {
    mkdirSync(pictures, { recursive: true });
    await page.screenshot({ path: join(pictures, `${name}.png`) });
  }
}

export async function saved(button) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  const path = result(download.suggestedFilename());
  await download.saveAs(path);
  await status("Saved");
  return path;
}

export async function open(files, input = "#files") {
  await page.setInputFiles(input, files);
  await status("Place the seed");
}

/** The seed's numbers typed in. */
export async function typeSeed({ center, radius }) {
  const values = { "#seed-x": center[0], "#seed-y": center[1], "#seed-z": center[2], "#seed-radius": radius };
  for (const [field, value] of Object.entries(values)) {
    await page.fill(field, `${value}`);
    await page.press(field, "Tab");
  }
}

export async function segment() {
  await page.click("#run");
  await page.waitForFunction(() => /^Segmented/.test(document.getElementById("status").textContent) || document.getElementById("error").textContent, null, { timeout: 120_000 });
  assert.equal(await page.textContent("#error"), "");
}

/** Of the overlay's pixels that have a color and an opacity, in each of the four quarters: how many there are, and the middle of the
 * box around them, in pixels of the page. */
function colored(color, [least, greatest]) {
  return page.evaluate(([wanted, least, greatest]) => {
    const overlay = document.getElementById("overlay");
    const { left, top } = overlay.getBoundingClientRect();
    const { data, width } = overlay.getContext("2d").getImageData(0, 0, overlay.width, overlay.height);
    const quarters = [0, 1, 2, 3].map(() => ({ count: 0, x: [], y: [] }));
    for (let pixel = 0; pixel < data.length / 4; ++pixel) {
      const opacity = data[4 * pixel + 3];
      if (wanted.every((value, channel) => Math.abs(data[4 * pixel + channel] - value) < 20) && opacity >= least && opacity <= greatest) {
        const [x, y] = [pixel % width, Math.floor(pixel / width)];
        const quarter = quarters[2 * (y >= overlay.height / 2) + (x >= width / 2)];
        ++quarter.count;
        quarter.x.push(x);
        quarter.y.push(y);
      }
    }
    const middle = (values) => values.reduce(([a, b], value) => [Math.min(a, value), Math.max(b, value)], [1e9, 0]).reduce((a, b) => a + b) / 2;
    return quarters.map(({ count, x, y }) => ({ count, middle: [left + middle(x), top + middle(y)] }));
  }, [color, least, greatest]);
}

const opaque = [201, 255];
const translucent = [60, 120];
export const coloredPixels = async (color) => (await colored(color, opaque)).map(({ count }) => count);
export const middleOf = async (color, quarter) => (await colored(color, opaque))[quarter].middle;

/** Of what a click would add or take, which is translucent. */
export const filledPixels = async (color) => (await colored(color, translucent)).map(({ count }) => count);
export const filledMiddle = async (color, quarter) => (await colored(color, translucent))[quarter].middle;

export const yellow = [255, 210, 74]; // the first organ's
export const green = [143, 227, 136]; // the second's
export const blue = [64, 153, 255]; // of doubtful places
export const magenta = [255, 92, 225]; // of questions
export const added = [46, 230, 107]; // by a click, or a stroke of inside points
export const taken = [255, 77, 77];

export async function corrected() {
  await page.waitForFunction(() => /^Corrected/.test(document.getElementById("status").textContent) || document.getElementById("error").textContent, null, { timeout: 120_000 });
  assert.equal(await page.textContent("#error"), "");
}

/** The first question is whole in sight, in the part of the panel that scrolls. */
export const questionFits = () =>
  page.evaluate(() => {
    const [row, part] = ["#questions li", "#run-controls"].map((selector) => document.querySelector(selector).getBoundingClientRect());
    return row.height > 10 && row.top >= part.top && row.bottom <= part.bottom;
  });

/** All of the panel is to be seen at 1280 x 720. */
export const panelFits = () => page.$eval("aside", (panel) => panel.scrollHeight <= panel.clientHeight + 1 && panel.scrollWidth <= panel.clientWidth);

export const chooseTool = (tool) => page.locator(`[name=tool][value=${tool}]`).check({ force: true });
export const volume = async () => Number((await page.textContent("#result")).match(/([\d.]+) ml/)[1]);
export const countPoints = () => page.locator("#points li").count();

/** A place in a quarter of the slices, by parts of its width and height, in pixels of the page. */
async function pixelOf(column, row, x, y) {
  const box = await page.locator("#overlay").boundingBox();
  return [box.x + ((column + x) * box.width) / 2, box.y + ((row + y) * box.height) / 2];
}

export const clickAt = async (...place) => page.mouse.click(...(await pixelOf(...place)));
export const pointAt = async (...place) => page.mouse.move(...(await pixelOf(...place)), { steps: 3 });
