/** Where points of the body are on NiiVue's slices. All coordinates here are RAS millimeters, as NiiVue's. */
import { type Niivue, SLICE_TYPE } from "@niivue/niivue";

export type Tile = Niivue["screenSlices"][number];
export type Point = [number, number, number];

interface Axes {
  /** Which coordinates run to the right, upward, and away. */
  right: number;
  up: number;
  away: number;
}

const axesOf: Record<number, Axes> = {
  [SLICE_TYPE.AXIAL]: { right: 0, up: 1, away: 2 },
  [SLICE_TYPE.CORONAL]: { right: 0, up: 2, away: 1 },
  [SLICE_TYPE.SAGITTAL]: { right: 1, up: 2, away: 0 },
};

export function axes(tile: Tile): Axes {
  return axesOf[tile.axCorSag];
}

export function slicesOf(niivue: Niivue): Tile[] {
  return niivue.screenSlices.filter(({ axCorSag }) => axCorSag in axesOf);
}

export function tileAt(niivue: Niivue, x: number, y: number): Tile | undefined {
  return slicesOf(niivue).find(({ leftTopWidthHeight: [left, top, width, height] }) => {
    return x >= left && x < left + width && y >= top && y < top + height;
  });
}

/** How deep the slice is where it has these coordinates to the right and upward. */
export function depthAt(tile: Tile, right: number, up: number): number {
  const plane = tile.AxyzMxy;
  return plane[2] + plane[4] * (up - plane[1]) - plane[3] * (right - plane[0]);
}

/** How far a point is from a slice, in mm. */
export function distanceOf(tile: Tile, point: Point): number {
  const { right, up, away } = axes(tile);
  const plane = tile.AxyzMxy;
  const depth = depthAt(tile, point[right], point[up]);
  return Math.abs(depth - point[away]) / Math.hypot(1, plane[3], plane[4]);
}

/** Marks are seen, faintly, on slices at most this far away, in mm. */
export const fadesWithin = 10;

/** The point of a slice under a pixel. */
export function pointAt(tile: Tile, x: number, y: number): Point {
  const [left, top, width, height] = tile.leftTopWidthHeight;
  const { right, up, away } = axes(tile);
  const point: Point = [0, 0, 0];
  point[right] = tile.leftTopMM[0] + ((x - left) / width) * tile.fovMM[0];
  point[up] = tile.leftTopMM[1] + (1 - (y - top) / height) * tile.fovMM[1];
  point[away] = depthAt(tile, point[right], point[up]);
  return point;
}

/** A pixel, or the nearest one that is on the slice. */
export function pixelWithin(tile: Tile, x: number, y: number): [number, number] {
  const [left, top, width, height] = tile.leftTopWidthHeight;
  return [Math.min(left + width, Math.max(left, x)), Math.min(top + height, Math.max(top, y))];
}

export function pixelAt(tile: Tile, point: ArrayLike<number>, at = 0): [number, number] {
  const [left, top, width, height] = tile.leftTopWidthHeight;
  const { right, up } = axes(tile);
  return [
    left + ((point[at + right] - tile.leftTopMM[0]) / tile.fovMM[0]) * width,
    top + height - ((point[at + up] - tile.leftTopMM[1]) / tile.fovMM[1]) * height,
  ];
}

export function pixelsPerMillimeter(tile: Tile): number {
  return tile.leftTopWidthHeight[2] / Math.abs(tile.fovMM[0]);
}

const letters = [
  ["L", "R"],
  ["P", "A"],
  ["I", "S"],
];

/** What the sides of a slice are called: left, right, bottom, top. */
export function sidesOf(tile: Tile): [string, string, string, string] {
  const { right, up } = axes(tile);
  // In radiological convention, what is right of the patient is on the left.
  const [toLeft, toRight] = tile.fovMM[0] > 0 ? [0, 1] : [1, 0];
  return [letters[right][toLeft], letters[right][toRight], letters[up][0], letters[up][1]];
}

/** Where a slice is, such as "S 167.0 mm". */
export function positionOf(tile: Tile, point: Point): string {
  const { away } = axes(tile);
  return `${letters[away][point[away] < 0 ? 0 : 1]} ${Math.abs(point[away]).toFixed(1)} mm`;
}
