/** Between indices, LPS millimeters, and the RAS affine matrices of NIfTI. */
import type { Grid, Triple } from "./types.js";

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

/** The grid of a volume of this size and affine matrix. */
export function gridOf(size: Triple, affine: readonly (readonly number[])[]): Grid {
  const columns = [0, 1, 2, 3].map((axis) => swapLpsRas([0, 1, 2].map((row) => affine[row][axis])));
  const spacing = columns.slice(0, 3).map((axis) => Math.hypot(...axis)) as [number, number, number];
  const direction = [0, 1, 2].flatMap((row) => spacing.map((length, axis) => columns[axis][row] / length));
  // Without negative zeros, which text would show.
  return {
    size,
    spacing,
    origin: columns[3].map((value) => value + 0) as [number, number, number],
    direction: direction.map((value) => value + 0),
  };
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
