/** Saving: surfaces, the label map, the session. */
import {
  type Segmentation,
  type SurfaceFormat,
  countVoxels,
  fillRuns,
  isSinglePrecision,
  roundedSurface,
  roundsPoints,
} from "../flipfree/index.js";
import { app, flipfree, organs } from "./app.js";
import { select } from "./dom.js";
import { canRepeat, canRun } from "./organs.js";
import { fileNameOf, sessionFile } from "./session.js";
import type { ListedLabel } from "./labelsurfaces.js";
import { say, showProgress } from "./status.js";
import { work } from "./work.js";

declare const FLIPFREE_VERSION: string; // of the build

function save(file: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  say(`Saved ${name}.`);
}

/** What was certified leaves as a valid surface: where the format rounds, the rounded one is checked. */
async function requireValid({ surface, certified }: Segmentation, format: SurfaceFormat): Promise<void> {
  if (certified && roundsPoints(format) && !isSinglePrecision(surface)) {
    const pairs = await flipfree.selfIntersections(roundedSurface(surface));
    if (pairs > 0) {
      throw new Error(`${format.toUpperCase()} rounds the vertices, and the surface would intersect itself (${pairs} pairs of faces); save it as VTP`);
    }
  }
}

export const saveSurface = () =>
  work("Saving …", async () => {
    const format = select("surface-format").value as SurfaceFormat;
    const { name, color, start, result } = organs.chosen;
    if (result) {
      await requireValid(result, format);
      const names = { image: app.opened?.name, organ: name, color, startLabels: start?.name };
      save(await flipfree.surfaceFile(result, format, names), `${fileNameOf(name)}.${format}`);
    }
  });

/** Between files, or browsers leave some out. */
const pause = () => new Promise((resolve) => setTimeout(resolve, 150));

/** Those that are shown, a file each, called as the command calls them; and its table. */
export const saveLabelSurfaces = () =>
  work("Saving …", async (signal) => {
    const format = select("surface-format").value as SurfaceFormat;
    const shown = app.labelSurfaces.filter(({ isShown }) => isShown);
    const files = new Map<ListedLabel, string>();
    for (const label of shown) {
      const file = await flipfree.labelSurfaceFile(label.found, format, label.name);
      signal.throwIfAborted();
      save(file.data, file.name);
      files.set(label, file.name);
      showProgress(files.size / shown.length);
      await pause();
    }
    const rows = app.labelSurfaces.map((label) => {
      return { ...label.found, surface: null, name: label.name, file: files.get(label) ?? "" };
    });
    const table = await flipfree.labelTableFile(rows);
    save(table.data, table.name);
    say(`Saved ${shown.length} of ${app.labelSurfaces.length} surfaces.`);
  });

/** Labels count the organs that have a seed or fill a label, and vessels with points; a voxel in several belongs to the first.
 * The command does the same with a session, which holds no organs that fill a label. */
export const saveLabels = () =>
  work("Saving …", async () => {
    if (app.opened) {
      const voxels = new Uint8Array(countVoxels(app.opened.image));
      const seeded = organs.list.filter(canRun);
      for (let at = seeded.length - 1; at >= 0; --at) {
        fillRuns(seeded[at].result?.runs ?? new Int32Array(), at + 1, app.opened.image, voxels);
      }
      save(await flipfree.labelMapFile({ ...app.opened.image, voxels }), "organs.nii.gz");
    }
  });

export function saveSession(): void {
  if (app.opened) {
    const filling = organs.list.filter((organ) => canRun(organ) && !canRepeat(organ));
    const list = organs.list.filter((organ) => !filling.includes(organ));
    save(sessionFile(FLIPFREE_VERSION, { name: app.opened.name, series: app.opened.series, ...app.opened.image }, list), "session.json");
    if (filling.length > 0) {
      const names = filling.map(({ name }) => name).join(", ");
      say(`Saved session.json without ${names}: a session cannot hold a label map. The command numbers the labels of the other organs only.`);
    }
  }
}
