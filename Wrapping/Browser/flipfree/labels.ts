/** What a label map holds. */
import { FlipFreeError, type Image } from "./types.js";

/** More are those of a scan or of a probability map. */
const mostLabels = 2000;

/** The labels, ascending, and how many voxels each has. Throws a FlipFreeError for what is not a label map. */
export function labelsIn({ voxels }: Image): Map<number, number> {
  const counts = new Map<number, number>();
  let first = 0; // of a run of voxels with one value
  const take = (end: number) => {
    const value = voxels[first];
    if (!(Number.isInteger(value) && value >= 0)) {
      throw new FlipFreeError(`A voxel has the value ${value}, which is not a label; give a label map, of whole numbers from 0 on`);
    }
    if (value > 0 && end > first) {
      counts.set(value, (counts.get(value) ?? 0) + end - first);
    }
    if (counts.size > mostLabels) {
      throw new FlipFreeError(`There are more than ${mostLabels} values, as in a scan; give a label map`);
    }
    first = end;
  };
  for (let voxel = 1; voxel < voxels.length; ++voxel) {
    if (voxels[voxel] !== voxels[first]) {
      take(voxel);
    }
  }
  take(voxels.length);
  return new Map([...counts].sort(([a], [b]) => a - b));
}

/** Few whole numbers from 0 on, and most neighbors alike. A simple image may be like that, too. */
export function mayBeLabelMap({ voxels }: Image): boolean {
  const values = new Set<number>();
  let changes = 0;
  for (let voxel = 0; voxel < voxels.length; ++voxel) {
    const value = voxels[voxel];
    if (voxel === 0 || value !== voxels[voxel - 1]) {
      ++changes;
      values.add(value);
      if (!(Number.isInteger(value) && value >= 0) || values.size > 256 || changes > 0.1 * voxels.length) {
        return false;
      }
    }
  }
  return values.size > 1;
}
