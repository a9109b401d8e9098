/** Corrections as the kernels take them. */
import { type Corrections, FlipFreeError, type Triple } from "./types.js";

/** The numbers of the kernels' kinds. */
const kinds = { outside: 0, inside: 1, boundary: 2, seeds: 3 } as const;

function requireList(name: string, list: unknown): void {
  if (!Array.isArray(list)) {
    throw new FlipFreeError(`${name}: give a list of ${name === "seeds" ? "spheres" : "points"}, in millimeters`);
  }
}

/** x, y and z; throws a FlipFreeError that names the entry. */
function coordinatesOf(point: Triple, name: string): number[] {
  const numbers = Array.isArray(point) || ArrayBuffer.isView(point) ? [...(point as Triple)] : [];
  if (numbers.length !== 3 || !numbers.every(Number.isFinite)) {
    throw new FlipFreeError(`${name} is not a point; give [x, y, z] as finite numbers, in millimeters`);
  }
  return numbers;
}

/** x, y and z of one point after the other. */
export function pointNumbers(name: string, points: readonly Triple[]): number[] {
  requireList(name, points);
  return points.flatMap((point, at) => coordinatesOf(point, `${name}, entry ${at + 1},`));
}

/** Five numbers each: kind, x, y, z, radius. */
export function correctionNumbers(corrections: Corrections): number[] {
  const numbers: number[] = [];
  for (const kind of ["inside", "outside", "boundary"] as const) {
    const points = corrections[kind] ?? [];
    requireList(kind, points);
    points.forEach((point, at) => numbers.push(kinds[kind], ...coordinatesOf(point, `${kind}, entry ${at + 1},`), 0));
  }
  const seeds = corrections.seeds ?? [];
  requireList("seeds", seeds);
  seeds.forEach((seed, at) => {
    if (!Number.isFinite(seed?.radius)) {
      throw new FlipFreeError(`seeds, entry ${at + 1}, has no radius; give { center: [x, y, z], radius }, in millimeters`);
    }
    numbers.push(kinds.seeds, ...coordinatesOf(seed.center, `seeds, entry ${at + 1}: its center`), seed.radius);
  });
  return numbers;
}
