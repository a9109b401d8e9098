/** Strokes painted on a slice. */
import type { Triple } from "../flipfree/index.js";
import type { Point } from "./tiles.js";

export function distanceBetween(a: Triple, b: Triple): number {
  return Math.hypot(...a.map((value, axis) => value - b[axis]));
}

/** Both ends of a path and points at even distances between, of at least a step; of a shorter path, its start alone. */
export function thinned(path: readonly Point[], step: number): Point[] {
  const lengths = path.slice(1).map((point, at) => distanceBetween(path[at], point));
  const whole = lengths.reduce((sum, length) => sum + length, 0);
  const count = Math.floor(whole / step); // of intervals
  const even = whole / count;
  const points: Point[] = [path[0]];
  let walked = 0;
  lengths.forEach((length, at) => {
    while (points.length < count && walked + length >= points.length * even) {
      const part = (points.length * even - walked) / length;
      const [x, y, z] = path[at].map((value, axis) => value + part * (path[at + 1][axis] - value));
      points.push([x, y, z]);
    }
    walked += length;
  });
  return count > 0 ? [...points, path[path.length - 1]] : points;
}
