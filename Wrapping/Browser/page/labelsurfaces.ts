/** The surfaces of all labels of the open label map: made by a button, and shown over the slices and in 3D. */
import type { LabelSurface } from "../flipfree/index.js";
import { app, flipfree, view } from "./app.js";
import { input } from "./dom.js";
import type { ViewedOrgan } from "./marks.js";
import { colorOf } from "./organs.js";
import { forgetOrgan } from "./runs.js";
import { say, showProgress } from "./status.js";
import { work } from "./work.js";

/** A label with what the page knows of it; its row in the list changes that. */
export interface ListedLabel {
  found: LabelSurface;
  /** Empty where nobody has said. */
  name: string;
  color: string;
  /** And saved. */
  isShown: boolean;
}

export function viewedLabels(): ViewedOrgan[] {
  const none = { confidence: null, seed: null, isChosen: false, points: [], questions: [], chosenQuestion: -1 };
  const shown = app.labelSurfaces.filter(({ isShown }) => isShown);
  return shown.map(({ found, color }) => ({ ...none, surface: found.surface, color }));
}

/** Labels stay as the list has them; others are called and colored as the file says. */
function listed(labels: readonly LabelSurface[]): ListedLabel[] {
  const before = new Map(app.labelSurfaces.map((one) => [one.found.label, one]));
  const segments = new Map(app.labelSegments.map((one) => [one.label, one]));
  return labels.map((found, at) => {
    const known = before.get(found.label);
    const { name = "", color = "" } = known ?? segments.get(found.label) ?? {};
    return { found, name, color: color || colorOf(at), isShown: found.surface !== null && (known?.isShown ?? true) };
  });
}

export async function makeLabelSurfaces(): Promise<void> {
  const { labels } = app;
  if (!labels) {
    return;
  }
  await work("Making the surfaces of the labels …", async (signal) => {
    const start = performance.now();
    const edgeLength = input("edge-length").valueAsNumber || 0;
    const parameters = { exact: input("exact").checked, edgeLength };
    setTimeout(() => void view.prepareSurfaces()); // once the worker has begun
    signal.addEventListener("abort", forgetOrgan);
    const found = await flipfree.labelSurfaces(labels, { parameters, signal, onProgress: showProgress });
    app.labelSurfaces = listed(found.labels);
    const seconds = ((performance.now() - start) / 1000).toFixed(1);
    const wrong = `${found.wrongVoxels} wrong ${found.wrongVoxels === 1 ? "voxel" : "voxels"}`;
    const moved = edgeLength > 0 ? `; fewer triangles moved walls by up to ${found.collapseDistance.toFixed(2)} mm` : "";
    say(`${found.labels.length} ${found.labels.length === 1 ? "surface" : "surfaces"} in ${seconds} s, ${wrong}${moved}.`);
  });
}
