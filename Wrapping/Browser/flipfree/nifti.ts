/** Label maps as NIfTI-1 files. */
import { affineOf, countVoxels } from "./grid.js";
import type { Grid, Image } from "./types.js";

const headerSize = 352; // with the four bytes that say that there are no extensions

/** Of a rotation matrix, the quaternion's b, c and d, a being positive. */
function quaternionOf(r: number[][]): [number, number, number] {
  const squares = [
    1 + r[0][0] + r[1][1] + r[2][2],
    1 + r[0][0] - r[1][1] - r[2][2],
    1 - r[0][0] + r[1][1] - r[2][2],
    1 - r[0][0] - r[1][1] + r[2][2],
  ];
  const greatest = squares.indexOf(Math.max(...squares));
  const products = [
    [squares[0], r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]],
    [r[2][1] - r[1][2], squares[1], r[0][1] + r[1][0], r[0][2] + r[2][0]],
    [r[0][2] - r[2][0], r[0][1] + r[1][0], squares[2], r[1][2] + r[2][1]],
    [r[1][0] - r[0][1], r[0][2] + r[2][0], r[1][2] + r[2][1], squares[3]],
  ][greatest];
  const scale = (products[0] < 0 ? -0.5 : 0.5) / Math.sqrt(squares[greatest]);
  return [scale * products[1], scale * products[2], scale * products[3]];
}

function determinant(r: number[][]): number {
  return (
    r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
    r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
    r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0])
  );
}

function areAtRightAngles(r: number[][]): boolean {
  const dot = (a: number, b: number) => r[0][a] * r[0][b] + r[1][a] * r[1][b] + r[2][a] * r[2][b];
  return Math.max(Math.abs(dot(0, 1)), Math.abs(dot(0, 2)), Math.abs(dot(1, 2))) < 1e-4;
}

function headerOf(grid: Grid): DataView {
  const view = new DataView(new ArrayBuffer(headerSize));
  const floats = (offset: number, values: number[]) =>
    values.forEach((value, at) => view.setFloat32(offset + 4 * at, value, true));
  view.setInt32(0, 348, true);
  [3, ...grid.size, 1, 1, 1, 1].forEach((value, at) => view.setInt16(40 + 2 * at, value, true));
  view.setInt16(70, 2, true); // unsigned bytes
  view.setInt16(72, 8, true);
  const affine = affineOf(grid);
  const axes = [0, 1, 2].map((row) => [0, 1, 2].map((axis) => affine[row][axis] / grid.spacing[axis]));
  const handedness = determinant(axes) < 0 ? -1 : 1;
  floats(76, [handedness, ...grid.spacing]);
  floats(108, [headerSize]);
  floats(112, [1, 0]);
  view.setUint8(123, 2); // millimeters
  // The quaternion cannot hold axes that are not at right angles.
  if (areAtRightAngles(axes)) {
    view.setInt16(252, 1, true);
    const rotation = axes.map((row) => [row[0], row[1], handedness * row[2]]);
    floats(256, [...quaternionOf(rotation), affine[0][3], affine[1][3], affine[2][3]]);
  }
  view.setInt16(254, 1, true);
  floats(280, affine.slice(0, 3).flat());
  [0x6e, 0x2b, 0x31, 0].forEach((value, at) => view.setUint8(344 + at, value)); // n+1
  return view;
}

/** A NIfTI-1 file, compressed, of labels of 8 bits. */
export async function labelMapFile(labelMap: Image): Promise<Blob> {
  const { voxels } = labelMap;
  if (!(voxels instanceof Uint8Array) || voxels.length !== countVoxels(labelMap)) {
    throw new TypeError("a label map has a byte for each voxel of its grid");
  }
  const plain = new Blob([headerOf(labelMap).buffer as ArrayBuffer, voxels as Uint8Array<ArrayBuffer>]);
  const packed = plain.stream().pipeThrough(new CompressionStream("gzip"));
  return new Blob([await new Response(packed).arrayBuffer()], { type: "application/gzip" });
}
