/** The protocol between a page and its worker. A request has an id; progress and the answer carry it back.
 *
 * A kind of work is an entry of `Requests` and `Answers` and a case of the worker: what a page sends and gets. */
import type { PhantomShape } from "./engine.js";
import type { OriginNames } from "./provenance.js";
import type { LabelRow, SurfaceFormat, WrittenLabel, WrittenSurface } from "./surfacefiles.js";
import type {
  Corrections,
  DicomSeries,
  Grid,
  GridComparison,
  Image,
  LabelSurfaces,
  NamedFile,
  OpenedVolume,
  Organ,
  Parameters,
  Phantom,
  Preset,
  Preview,
  PreviewPoint,
  Scores,
  Seed,
  StartLabels,
  Surface,
  Triple,
  Vessel,
} from "./types.js";

export interface Requests {
  defaultParameters: { preset: Preset };
  compareGrids: { grid: Grid; part: Grid; name: string };
  /** The image that the following runs work on. */
  setImage: { image: Image };
  /** The label that the following runs without a seed fill. */
  setStart: { start: StartLabels };
  segment: { seed: Seed | null; preset: Preset; parameters: Parameters; corrections: Corrections };
  preview: { point: PreviewPoint };
  trace: { points: readonly Triple[]; parameters: Parameters };
  labelSurfaces: { labels: Image; only: readonly number[]; parameters: Parameters };
  evaluate: { segmentation: Image | Surface; reference: Image; parameters: Parameters };
  selfIntersections: { surface: Surface };
  readVolume: { files: readonly NamedFile[]; series: string };
  listSeries: { files: readonly NamedFile[] };
  labelMapFile: { labelMap: Image };
  surfaceFile: { result: WrittenSurface; format: SurfaceFormat; names: OriginNames };
  labelSurfaceFile: { written: WrittenLabel; format: SurfaceFormat; name: string };
  labelTableFile: { rows: readonly LabelRow[] };
  phantom: { shape: PhantomShape; parameters: Parameters };
  memory: Record<string, never>;
}

export interface Answers {
  defaultParameters: Parameters;
  compareGrids: GridComparison;
  setImage: null;
  setStart: null;
  segment: Organ;
  preview: Preview | null;
  trace: Vessel;
  labelSurfaces: LabelSurfaces;
  evaluate: Scores;
  selfIntersections: number;
  readVolume: OpenedVolume;
  listSeries: DicomSeries[];
  labelMapFile: Blob;
  surfaceFile: Blob;
  labelSurfaceFile: NamedFile;
  labelTableFile: NamedFile;
  phantom: Phantom;
  memory: number;
}

export type Kind = keyof Requests;
/** The first message holds the compiled kernels. */
export type ToWorker = { wasm: WebAssembly.Module } | { [K in Kind]: { id: number; kind: K; request: Requests[K] } }[Kind];

export type FromWorker =
  | { id: number; progress: number }
  | { id: number; answer: Answers[Kind] }
  | { id: number; error: string; isInput: boolean };
