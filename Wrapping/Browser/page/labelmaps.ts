/** Opening label maps: of the image, by themselves, and images that look like one. */
import { FlipFreeError, labelsIn, mayBeLabelMap } from "../flipfree/index.js";
import { app, flipfree, organs } from "./app.js";
import { element, select } from "./dom.js";
import { showImage } from "./images.js";
import { showAll } from "./panel.js";
import { say } from "./status.js";
import { type OpenImage, readFiles } from "./volumes.js";
import { work } from "./work.js";

/** Organs can fill its labels, and all of these get surfaces. */
function takeLabels({ name, image, segments }: OpenImage, counts: Map<number, number>): void {
  app.labels = image;
  app.labelsName = name;
  app.labelSegments = segments;
  app.labelSurfaces = [];
  const names = new Map(segments.map((one) => [one.label, one.name]));
  const voxel = image.spacing.reduce((a, b) => a * b, 1);
  const choices = [...counts].map(([label, count]) => {
    const called = names.has(label) ? `${label} ${names.get(label)}` : `${label}`;
    return new Option(`${called}, ${((count * voxel) / 1000).toFixed(0)} ml`, String(label));
  });
  select("start-label").replaceChildren(new Option("choose …", ""), ...choices);
  element("labels-row").title = name;
  element("labels-row").hidden = false;
}

function countLabels({ name, image }: OpenImage): Map<number, number> {
  const counts = labelsIn(image);
  if (counts.size === 0) {
    throw new FlipFreeError(`${name} has no label: all its voxels are 0`);
  }
  return counts;
}

/** The open image may be one. */
export function takeIfLabels(opened: OpenImage): boolean {
  const mayBe = mayBeLabelMap(opened.image);
  if (mayBe) {
    takeLabels(opened, countLabels(opened));
  }
  return mayBe;
}

/** A label map alone, in gray until its surfaces are made. */
function showLabelMap(opened: OpenImage): void {
  const counts = countLabels(opened);
  opened.shown.cal_min = 0;
  opened.shown.cal_max = Math.max(...counts.keys());
  showImage({ ...opened, isLabelMap: true });
  takeLabels(opened, counts);
  say(["Label surfaces makes a surface of each label.", ...opened.warnings].join(" "));
}

function addLabelMap(labels: OpenImage): void {
  takeLabels(labels, countLabels(labels));
  say("Choose the label of the organ, then Segment; or make Label surfaces.");
}

/** Takes a label map to the image, or by itself where none is open. Throws a FlipFreeError where it is not on the image's lattice,
 * unless `orAlone`. */
export async function takeLabelMap(labels: OpenImage, orAlone: boolean): Promise<void> {
  const image = app.opened?.isLabelMap ? undefined : app.opened?.image;
  const difference = image && (await flipfree.compareGrids(image, labels.image, labels.name)).difference;
  if (difference && !orAlone) {
    throw new FlipFreeError(difference);
  }
  (difference === "" ? addLabelMap : showLabelMap)(labels);
}

export async function openLabels(files: File[]): Promise<void> {
  if (files.length > 0) {
    await work("Opening the label map …", async () => takeLabelMap(await readFiles(files), false));
  }
}

/** The chosen organ fills the chosen label; its seed and its points go. */
export function takeStartLabel(): void {
  const label = select("start-label").value;
  if (app.labels && label !== "") {
    const start = { labels: app.labels, label: Number(label), name: app.labelsName };
    organs.change(organs.chosen, { start, seed: null, corrections: [], result: null });
    say("");
    showAll();
  }
}
