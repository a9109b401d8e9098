/** Between indices, LPS millimeters, and the RAS affine matrices of NIfTI. */
import type { Grid } from "./types.js";

/** An LPS point as RAS, or the other way. */
export function swapLpsRas(point: readonly number[]): [number, number, number] {
  return [-point[0], -point[1], point[2]];
}

/** Maps indices to RAS millimeters: four rows of four numbers. */
export function affineOf(grid: Grid): number[][] {
  const axes = grid.spacing.map((spacing, axis) => [0, 1, 2].map((row) => grid.direction[3 * row + axis] * spacing));
  const columns = [...axes, grid.origin].map((column) => swapLpsRas(column));
  return [...[0, 1, 2].map((row) => columns.map((column) => column[row])), [0, 0, 0, 1]];
}

export function countVoxels(grid: Grid): number {
  return grid.size[0] * grid.size[1] * grid.size[2];
}

/** Writes a label into the voxels of runs. */
export function fillRuns(runs: Int32Array, label: number, grid: Grid, voxels: Uint8Array): void {
  for (let run = 0; run < runs.length; run += 4) {
    const row = grid.size[0] * (runs[run] + grid.size[1] * runs[run + 1]);
    voxels.fill(label, row + runs[run + 2], row + runs[run + 3]);
  }
}
