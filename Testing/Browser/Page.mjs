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

/** Pixels of the overlay that have a color, in the four quarters. */
export function coloredPixels(color) {
  return page.evaluate((wanted) => {
    const overlay = document.getElementById("overlay");
    const { data, width } = overlay.getContext("2d").getImageData(0, 0, overlay.width, overlay.height);
    const quarters = [0, 0, 0, 0];
    for (let pixel = 0; pixel < data.length / 4; ++pixel) {
      if (wanted.every((value, channel) => Math.abs(data[4 * pixel + channel] - value) < 20) && data[4 * pixel + 3] > 200) {
        const isRight = pixel % width >= width / 2;
        const isLow = Math.floor(pixel / width) >= overlay.height / 2;
        ++quarters[2 * isLow + isRight];
      }
    }
    return quarters;
  }, color);
}

export const yellow = [255, 210, 74]; // the first organ's
export const green = [143, 227, 136]; // the second's
export const blue = [64, 153, 255]; // of doubtful places

export async function corrected() {
  await page.waitForFunction(() => /^Corrected/.test(document.getElementById("status").textContent) || document.getElementById("error").textContent, null, { timeout: 120_000 });
  assert.equal(await page.textContent("#error"), "");
}

/** The button of doubtful places is whole in sight, in the part of the panel that scrolls. */
export const nextFits = () =>
  page.evaluate(() => {
    const [next, part] = ["next-doubt", "run-controls"].map((id) => document.getElementById(id).getBoundingClientRect());
    return next.height > 10 && next.top >= part.top && next.bottom <= part.bottom;
  });

/** All of the panel is to be seen at 1280 x 720. */
export const panelFits = () => page.$eval("aside", (panel) => panel.scrollHeight <= panel.clientHeight + 1 && panel.scrollWidth <= panel.clientWidth);

export const chooseTool = (tool) => page.locator(`[name=tool][value=${tool}]`).check({ force: true });
export const volume = async () => Number((await page.textContent("#result")).match(/([\d.]+) ml/)[1]);
export const countPoints = () => page.locator("#points li").count();

/** Clicks in a quarter of the slices, at parts of its width and height. */
export async function clickAt(column, row, x, y) {
  const box = await page.locator("#overlay").boundingBox();
  await page.mouse.click(box.x + ((column + x) * box.width) / 2, box.y + ((row + y) * box.height) / 2);
}
