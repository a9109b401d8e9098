/** Between indices, LPS millimeters, and the RAS affine matrices of NIfTI. */
import type { Grid, Image, Triple } from "./types.js";

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

function cornersOf(grid: Grid): number[][] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((corner) =>
    [0, 1, 2].map((row) =>
      grid.spacing.reduce((sum, spacing, axis) => {
        const index = (corner >> axis) & 1 ? grid.size[axis] - 1 : 0;
        return sum + grid.direction[3 * row + axis] * spacing * index;
      }, grid.origin[row]),
    ),
  );
}

const inOrder = (size: Triple) => [...size].sort((a, b) => a - b).join();

/** Whether two grids have their voxels in the same places, up to a tenth of the least spacing: files round differently,
 * and readers of DICOM differ in the order of rows. */
export function isSameGrid(a: Grid, b: Grid): boolean {
  const tolerance = 0.1 * Math.min(...a.spacing);
  const others = cornersOf(b);
  return (
    inOrder(a.size) === inOrder(b.size) &&
    cornersOf(a).every((p) => others.some((q) => Math.hypot(...p.map((value, axis) => value - q[axis])) <= tolerance))
  );
}

/** The image with its voxels in the order of another grid, which is the same up to that order (see `isSameGrid`). */
export function reordered(image: Image, grid: Grid): Image {
  const along = (of: Grid, axis: number) => [0, 1, 2].map((row) => of.direction[3 * row + axis]);
  const strides = [1, image.size[0], image.size[0] * image.size[1]];
  let start = 0;
  const steps = [0, 1, 2].map((axis) => {
    const wanted = along(grid, axis);
    const cosines = [0, 1, 2].map((own) => along(image, own).reduce((sum, value, row) => sum + value * wanted[row], 0));
    const own = [0, 1, 2].reduce((best, other) => (Math.abs(cosines[other]) > Math.abs(cosines[best]) ? other : best));
    if (cosines[own] < 0) {
      start += strides[own] * (image.size[own] - 1);
    }
    return cosines[own] < 0 ? -strides[own] : strides[own];
  });
  const { size, spacing, origin, direction } = grid;
  const placed = { size, spacing, origin, direction };
  if (steps.every((step, axis) => step === strides[axis])) {
    return { ...placed, voxels: image.voxels };
  }
  const voxels = image.voxels.slice();
  let to = 0;
  for (let k = 0; k < size[2]; ++k) {
    for (let j = 0; j < size[1]; ++j) {
      let from = start + k * steps[2] + j * steps[1];
      for (let i = 0; i < size[0]; ++i, from += steps[0]) {
        voxels[to++] = image.voxels[from];
      }
    }
  }
  return { ...placed, voxels };
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
