/** What files of surfaces hold. */
import type { LabelSurface, Organ, Segmentation, Surface } from "./types.js";

export const surfaceFormats = ["vtp", "stl", "ply", "obj"] as const;
export type SurfaceFormat = (typeof surfaceFormats)[number];

/** What a file takes of a result. */
export type WrittenSurface = Pick<Segmentation, "surface" | "certified" | "provenance" | "comments"> &
  Partial<Pick<Organ, "confidence" | "vertexConfidence">>;

/** What a file takes of a label's surface. */
export type WrittenLabel = Pick<LabelSurface, "label" | "surface" | "certified">;

/** What is measured. */
export type LabelField = Exclude<keyof LabelSurface, "surface" | "certified">;

/** A row of the table of a label map's surfaces. */
export type LabelRow = Pick<LabelSurface, LabelField> & {
  name: string;
  /** Empty where there is none. */
  file: string;
};

/** Formats that hold coordinates in single precision. */
export const roundsPoints = (format: SurfaceFormat) => format === "stl" || format === "ply";

/** Each face cut into triangles from its first vertex: three vertices each. */
export function trianglesOf({ corners, offsets }: Surface): Uint32Array {
  const triangles: number[] = [];
  for (let face = 0; face + 1 < offsets.length; ++face) {
    for (let corner = offsets[face] + 1; corner + 1 < offsets[face + 1]; ++corner) {
      triangles.push(corners[offsets[face]], corners[corner], corners[corner + 1]);
    }
  }
  return Uint32Array.from(triangles);
}

/** Whether single precision holds every coordinate, as it does wherever the surface has moved. Else the rounded
 * surface is another one, and has to be checked for self-intersections. */
export function isSinglePrecision({ points }: Surface): boolean {
  return points.every((value) => Math.fround(value) === value);
}

/** The surface that a file of single precision holds. */
export function roundedSurface(surface: Surface): Surface {
  return { ...surface, points: Float64Array.from(surface.points, Math.fround) };
}
