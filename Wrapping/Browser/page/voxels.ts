/** Voxels of a grid on the slices. */
import type { Niivue } from "@niivue/niivue";
import { type Grid, affineOf } from "../flipfree/index.js";
import { type Tile, axes, pixelAt } from "./tiles.js";

export interface ShownVoxels {
  /** Four numbers each: j, k, the first i, and one past the last i. */
  runs: Int32Array;
  grid: Grid;
}

/** The outlines of voxels on a slice, run by run. */
export function voxelPath(niivue: Niivue, tile: Tile, { runs, grid }: ShownVoxels): Path2D {
  const rows = affineOf(grid).slice(0, 3); // of RAS
  const { away } = axes(tile);
  // Slices are planes of voxels: along this axis of the grid, all have one index.
  const cosines = grid.spacing.map((spacing, axis) => Math.abs(rows[away][axis]) / spacing);
  const fixed = cosines.indexOf(Math.max(...cosines));
  const place = niivue.frac2mm(niivue.scene.crosshairPos);
  const offset = rows.reduce((sum, row, at) => sum + row[fixed] * (place[at] - row[3]), 0);
  const slice = Math.round(offset / grid.spacing[fixed] ** 2);

  const path = new Path2D();
  const placeOf = (index: number[]) => rows.map((row) => row[3] + index.reduce((sum, value, axis) => sum + row[axis] * value, 0));
  const pixelOf = (index: number[]) => pixelAt(tile, placeOf(index));
  for (let run = 0; run < runs.length; run += 4) {
    const [j, k, begin, end] = runs.subarray(run, run + 4);
    if (fixed === 0 ? slice < begin || slice >= end : (fixed === 1 ? j : k) !== slice) {
      continue;
    }
    const least = [begin - 0.5, j - 0.5, k - 0.5];
    const most = [end - 0.5, j + 0.5, k + 0.5];
    least[fixed] = most[fixed] = slice;
    const [first, second] = [0, 1, 2].filter((axis) => axis !== fixed);
    const corner = (...ends: number[]) => least.map((value, axis) => (ends.includes(axis) ? most[axis] : value));
    path.moveTo(...pixelOf(least));
    [corner(first), most, corner(second)].forEach((index) => path.lineTo(...pixelOf(index)));
    path.closePath();
  }
  return path;
}
