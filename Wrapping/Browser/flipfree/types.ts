/** What goes in and out. Coordinates are LPS millimeters, as in DICOM; voxels are stored with x fastest. */
import type {
  LabelSurfaceParameters,
  PhantomParameters,
  ScoreParameters,
  SegmentationParameters,
  VesselParameters,
} from "./parametertypes.js";

export type Triple = readonly [number, number, number];
export type Voxels =
  | Int8Array
  | Uint8Array
  | Int16Array
  | Uint16Array
  | Int32Array
  | Uint32Array
  | Float32Array
  | Float64Array;

/** A voxel grid in physical space. */
export interface Grid {
  /** Voxels along i, j and k. */
  size: Triple;
  /** Millimeters along i, j and k. */
  spacing: Triple;
  /** The center of voxel (0, 0, 0). */
  origin: Triple;
  /** The grid's unit axes in the columns of a 3 x 3 matrix, row after row. */
  direction: readonly number[];
}

/** Whether two grids have the same voxels, in whichever order, and, in words, why the second is not on the lattice of the first:
 * "" where it is one, cropped or wider, in whichever order. */
export interface GridComparison {
  samePlaces: boolean;
  difference: string;
}

/** A volume or a label map. The package keeps a copy of it in the worker: voxels must not change afterward. */
export interface Image extends Grid {
  voxels: Voxels;
}

/** A file, with the folders above it in its name where there are any. */
export interface NamedFile {
  name: string;
  data: Blob;
}

/** A series in a folder of DICOM files, or one of several volumes in a series. */
export interface DicomSeries {
  /** What `series` takes to read it: the Series Instance UID, and #1, #2 and so on where a series has several volumes. */
  uid: string;
  /** Series Number. */
  number: string;
  description: string;
  modality: string;
  slices: number;
  /** Millimeters; null where it cannot be read. */
  spacing: Triple | null;
  /** Why it cannot be read; empty where it can. */
  problem: string;
}

/** What a file says of one of its labels. */
export interface Segment {
  label: number;
  name: string;
  /** As #ffd24a; empty where the file has none. */
  color: string;
}

/** A volume as a file has it. */
export interface OpenedVolume {
  /** The file's, of several the one that has the header. */
  name: string;
  /** Of DICOM: which series it is. */
  series?: string;
  image: Image;
  /** The labels that the file names: 3D Slicer's segmentations, and label tables in NIfTI. */
  segments: Segment[];
  /** What the file does not say, or says twice, and what was taken; whole sentences. */
  warnings: string[];
}

/** A sphere inside the organ. */
export interface Seed {
  center: Triple;
  /** Millimeters. */
  radius: number;
}

/** A closed surface. Face f has the vertices corners[offsets[f]] up to, not including, corners[offsets[f + 1]],
 * counter-clockwise seen from outside. */
export interface Surface {
  /** x, y, z of each vertex. */
  points: Float64Array;
  corners: Int32Array;
  offsets: Int32Array;
}

/** A label map with the image's voxels, cropped or not (of a network, an atlas, an earlier result), of which a surface fills a
 * label. */
export interface StartLabels {
  labels: Image;
  /** 1 by default; 0 for all nonzero voxels. */
  label?: number;
}

/** A point that may become a correction. */
export type PreviewPoint = { inside: Triple } | { outside: Triple };

/** What a correction is going to change. */
export interface Preview {
  /** The voxels that change sides, as runs of four numbers: j, k, the first i, and one past the last i. */
  runs: Int32Array;
  /** Theirs, in milliliters. */
  volume: number;
}

/** What a user knows of an organ. A list is a set: its order means nothing. */
export interface Corrections {
  /** Points that the surface encloses. */
  inside?: readonly Triple[];
  /** Points that it leaves out. */
  outside?: readonly Triple[];
  /** Points that it passes within half the least spacing. */
  boundary?: readonly Triple[];
  /** Further spheres within the organ; the surface starts from the largest. */
  seeds?: readonly Seed[];
}

export type { LabelSurfaceParameters, PhantomParameters, ScoreParameters, SegmentationParameters, VesselParameters };

export type Preset = "default" | "published" | "naive";

/** Of whichever kind, by name, such as { foregroundMass: 0.9, carving: false }; `defaultParameters()` has those of an organ. */
export type Parameters = Record<string, number | boolean | readonly number[] | undefined>;

/** What a run finds. */
export interface Segmentation {
  surface: Surface;
  /** Whether every step was certified, as it is wherever the guard is on: no faces intersect, however they are cut. */
  certified: boolean;
  /** Where the surface comes from: a session in JSON, with version, grid, seeds, points and all parameters. */
  provenance: string;
  /** The version, the coordinate system and the provenance, as files without another place for it hold them. */
  comments: string[];
  /** The voxels inside as runs of four numbers: j, k, the first i, and one past the last i. */
  runs: Int32Array;
  /** Why the iterations ended, such as "converged". */
  stopReason: string;
  /** Pairs of faces that intersect for some cut of the quads; 0 wherever the guard is on. */
  selfIntersections: number;
  /** The convergence table, a column each. */
  iterations: Record<string, Float64Array>;
  /** What may be wrong, a message each. */
  warnings: string[];
}

/** Is this a part of the organ? Yes is an inside point at its place, no an outside point. */
export interface Question {
  /** Where the part is deepest. */
  place: Triple;
  /** Of the part, in milliliters. */
  volume: number;
  /** Whether the segmentation has it in the organ. */
  included: boolean;
  /** By how much the contrary costs more, per mm3: the smaller, the more doubtful. */
  margin: number;
}

export interface Organ extends Segmentation {
  /** Where it started: in the seed, in the largest of several, or in the largest ball that the label holds. */
  seed: Seed;
  /** How far the result can be trusted, 0 to 1. It reads like the Dice score to expect; below `doubtfulConfidence` the result
   * is doubtful, and a warning says so where nothing else does. */
  confidence: number;
  /** Parts of which the segmentation is not sure, at most five, those first where an answer is worth most, without those that
   * points have answered. An answer is a point for the next run. */
  questions: Question[];
  /** How well the image supports the surface at each vertex, 0 to 1: below `doubtfulVertexConfidence`, look there. */
  vertexConfidence: Float32Array;
}

/** Of a surface that was found in the image from a seed alone. */
export const doubtfulConfidence = 0.85;
/** Where pictures draw a contour in another color. */
export const doubtfulVertexConfidence = 0.5;

/** A part of a vessel between two ends or forks. */
export interface Branch {
  /** The centerline: x, y, z of each point. */
  points: Float64Array;
  /** The mean radius at each point, in mm. */
  radii: Float64Array;
  /** The number of the earlier branch on which it begins; -1 for the first. */
  parent: number;
}

/** A vessel, or a tree of vessels. */
export interface Vessel extends Segmentation {
  branches: Branch[];
  /** The mean radius, in mm. */
  radius: number;
  /** The mean contrast across the outline, of 25 gray values (HU; MR scaled to CT), 0 to 1. */
  support: number;
  /**
   * How far the vessel can be trusted, where least, 0 to 1: how well the image shows its outline, and how like the vessel
   * is what the path runs through. Doubtful below 0.45, which a warning says.
   */
  confidence: number;
}

/** Whether an organ was found, not a vessel. */
export function isOrgan(result: Organ | Vessel): result is Organ {
  return "vertexConfidence" in result;
}

/** The surface of a label, and what it measures. */
export interface LabelSurface {
  label: number;
  /** Milliliters. */
  volume: number;
  /** Of the label map. */
  voxels: number;
  /** Theirs, in milliliters. */
  voxelVolume: number;
  /** Those inside that have another label, and those of the label that are not inside. */
  wrongVoxels: number;
  /** Square millimeters. */
  area: number;
  /** 2 for each piece and each cavity, less 2 for each tunnel. */
  eulerNumber: number;
  triangles: number;
  /** That the surface is closed, and without self-intersections. */
  certified: boolean;
  /** Null where all parts of the label are smaller than `smallestPart`. */
  surface: Surface | null;
}

/** The surfaces of a label map: two labels have the same triangles where they touch. */
export interface LabelSurfaces {
  /** Ascending. */
  labels: LabelSurface[];
  /** How many voxels have a label in whose surface they are not. */
  wrongVoxels: number;
  /** Of a vertex from the nearest corner of voxels of different labels, in mm. */
  greatestDistance: number;
  /** Between the walls before and after edges were collapsed, in mm. */
  collapseDistance: number;
}

export interface Scores {
  dice: number;
  jaccard: number;
  relativeVolumeDifference: number;
  /** Average symmetric surface distance, in mm, as are the next three; weighted by area, not over border voxels. */
  asd: number;
  rms: number;
  hd95: number;
  hd: number;
  /** Milliliters. */
  segmentationVolume: number;
  referenceVolume: number;
  overlapOf: string;
  distanceOf: string;
  /** Whole sentences; none where nothing is wrong. */
  warnings: string[];
}

export interface PhantomSeed extends Seed {
  /** Of the organ, such as "right kidney". */
  name: string;
  label: number;
}

/** A synthetic volume with its exact truth. */
export interface Phantom {
  image: Image;
  labelMap: Image;
  /** A ball inside each organ. */
  seeds: PhantomSeed[];
}

export interface RunOptions {
  /** Called with the fraction done, 0 to 1. */
  onProgress?: (fraction: number) => void;
  /** Stops the run at once; the promise is rejected with the signal's reason. */
  signal?: AbortSignal;
}

export interface ReadOptions extends RunOptions {
  /** Of DICOM: what `listSeries` calls the series to read, by default the one of most slices. */
  series?: string;
}

export interface SegmentOptions extends RunOptions, Corrections {
  preset?: Preset;
  parameters?: SegmentationParameters;
}

export interface TraceOptions extends RunOptions {
  parameters?: VesselParameters;
}

export interface LabelSurfaceOptions extends RunOptions {
  /** The labels that get surfaces, all others being background; by default, all get one. */
  only?: readonly number[];
  parameters?: LabelSurfaceParameters;
}

export interface EvaluateOptions extends RunOptions {
  parameters?: ScoreParameters;
}

export interface PhantomOptions extends RunOptions {
  parameters?: PhantomParameters;
}

/** What is wrong with the input, and what to do. */
export class FlipFreeError extends Error {
  override name = "FlipFreeError";
}
