/** The kernels, called where they are loaded: a call returns when the work is done. A page uses them through `FlipFree`,
 * whose worker holds an engine. */
import { correctionNumbers, pointNumbers } from "./corrections.js";
import { countVoxels } from "./grid.js";
import { type KernelDicom, listSeries, readSeries } from "./dicom.js";
import { packed } from "./inflated.js";
import { type KernelParameter, kernelValues, packageValues, wordMessage } from "./parameters.js";
import { type OriginNames, namedProvenance } from "./provenance.js";
import type { LabelField, LabelRow, SurfaceFormat, WrittenLabel, WrittenSurface } from "./surfacefiles.js";
import {
  type Corrections,
  type DicomSeries,
  FlipFreeError,
  type Grid,
  type GridComparison,
  type Image,
  type LabelSurfaces,
  type NamedFile,
  type OpenedVolume,
  type Organ,
  type Parameters,
  type Phantom,
  type PhantomSeed,
  type Preset,
  type Preview,
  type PreviewPoint,
  type Question,
  type Scores,
  type Seed,
  type StartLabels,
  type Surface,
  type Triple,
  type Vessel,
} from "./types.js";
import { type Answer, type KernelFiles, hasVolumeFile, readVolume } from "./volumefiles.js";

interface KernelVolume {
  delete(): void;
}

type Report = (fraction: number) => boolean;

/** Segments one organ of a volume, again and again; it keeps what the corrections of the last organ do not change. */
interface OrganSession {
  setStart(labels: KernelVolume, label: number): Answer<KernelSeed>;
  segment(
    seed: number[],
    preset: string,
    values: Record<string, number[]>,
    corrections: number[],
    report: Report,
  ): Answer<KernelOrgan>;
  preview(correction: number[]): Answer<{ isKnown: boolean } & Preview>;
  delete(): void;
}

type KernelOrgan = Omit<Organ, "seed" | "questions"> & {
  seed: KernelSeed;
  questions: (Omit<Question, "place"> & { place: Float64Array })[];
};

interface KernelSeed {
  center: Float64Array;
  radius: number;
}

interface KernelPhantom {
  voxels: Int16Array;
  labels: Uint8Array;
  size: Int32Array;
  spacing: Float64Array;
  origin: Float64Array;
  direction: Float64Array;
  seeds: { name: string; label: number; center: Float64Array; radius: number }[];
}

/** The module that emscripten makes of Kernels/. */
export interface KernelModule extends KernelFiles, KernelDicom {
  niftiHeader(name: string, image: Image): Answer<{ bytes: Uint8Array<ArrayBuffer> }>;
  surfaceBytes(
    result: WrittenSurface | { surface: Surface; certified: boolean; label: number },
    format: string,
    provenance: string,
  ): Answer<{ bytes: Uint8Array<ArrayBuffer> }>;
  labelFileName(label: number, name: string, ending: string): string;
  labelFields(): LabelField[];
  labelTable(rows: readonly LabelRow[]): Answer<{ text: string }>;
  compareGrids(grid: Grid, part: Grid, name: string): Answer<GridComparison>;
  makeVolume(image: Image): Answer<{ volume: KernelVolume }>;
  segmentationParameters(preset: string): KernelParameter[];
  OrganSession: new (volume: KernelVolume) => OrganSession;
  vesselParameters(): KernelParameter[];
  trace(volume: KernelVolume, points: number[], values: Record<string, number[]>, report: Report): Answer<Vessel>;
  labelSurfaceParameters(): KernelParameter[];
  labelSurfaces(
    labels: KernelVolume,
    only: readonly number[],
    values: Record<string, number[]>,
    report: Report,
  ): Answer<LabelSurfaces>;
  scoreParameters(): KernelParameter[];
  scoreLabels(a: KernelVolume, b: KernelVolume, values: Record<string, number[]>, report: Report): Answer<Scores>;
  scoreSurface(a: Surface, b: KernelVolume, values: Record<string, number[]>, report: Report): Answer<Scores>;
  selfIntersections(surface: Surface): Answer<{ count: number }>;
  phantomParameters(): KernelParameter[];
  makePhantom(values: Record<string, number[]>, report: Report): Answer<KernelPhantom>;
  HEAPU8: Uint8Array;
}

/** What `Kernels/flipfree.mjs` exports. */
export type KernelFactory = (options: {
  instantiateWasm(
    imports: WebAssembly.Imports,
    done: (instance: WebAssembly.Instance) => void,
  ): WebAssembly.Exports | Record<string, never>;
}) => Promise<KernelModule>;

const shapes = ["sphere", "cube", "cup", "u-tube", "vessel", "abdomen"] as const;
export type PhantomShape = (typeof shapes)[number];

const mediaTypes: Record<SurfaceFormat, string> = {
  vtp: "application/xml",
  stl: "model/stl",
  ply: "model/ply",
  obj: "model/obj",
};

const goOn: Report = () => true;

function triple(numbers: ArrayLike<number>): [number, number, number] {
  return [numbers[0], numbers[1], numbers[2]];
}

export class Engine {
  private volume?: KernelVolume;
  private session?: OrganSession;
  private isStarted = false; // whether there is a label to fill

  private constructor(private readonly kernels: KernelModule) {}

  static async load(factory: KernelFactory, wasm: WebAssembly.Module): Promise<Engine> {
    const kernels = await factory({
      instantiateWasm(imports, done) {
        void WebAssembly.instantiate(wasm, imports).then(done);
        return {};
      },
    });
    return new Engine(kernels);
  }

  /** Bytes of the kernels' memory: the most that was needed so far. */
  get memory(): number {
    return this.kernels.HEAPU8.byteLength;
  }

  defaultParameters(preset: Preset = "default"): Parameters {
    return packageValues(this.kernels.segmentationParameters(preset));
  }

  compareGrids(grid: Grid, part: Grid, name: string): GridComparison {
    const { samePlaces, difference } = this.checked(this.kernels.compareGrids(grid, part, name));
    return { samePlaces, difference: difference && wordMessage(difference, []) };
  }

  /** Takes a copy of the image that `segment` works on. */
  setImage(image: Image): void {
    this.session?.delete();
    this.volume?.delete();
    this.session = undefined;
    this.volume = undefined;
    this.isStarted = false;
    this.volume = this.copy(image);
    this.session = new this.kernels.OrganSession(this.volume);
  }

  /** Takes the label that runs without a seed fill. */
  setStart({ labels, label = 1 }: StartLabels): void {
    const { session } = this;
    if (!session) {
      throw new FlipFreeError("There is no image");
    }
    if (!Number.isInteger(label) || label < 0) {
      throw new FlipFreeError(`label: give a whole number from 0 on, not ${label}`);
    }
    this.isStarted = false;
    this.withVolume(labels, (volume) => this.checked(session.setStart(volume, label)));
    this.isStarted = true;
  }

  /** Of an organ around a seed, or of the label. */
  segment(
    seed: Seed | null,
    preset: Preset = "default",
    parameters: Parameters = {},
    corrections: Corrections = {},
    report: Report = goOn,
  ): Organ {
    if (!this.session) {
      throw new FlipFreeError("There is no image");
    }
    if (!seed && !this.isStarted) {
      throw new FlipFreeError("There is neither a seed nor a label");
    }
    const known = this.kernels.segmentationParameters(preset);
    const values = kernelValues(parameters, known);
    const points = correctionNumbers(corrections);
    const start = seed ? [...seed.center, seed.radius] : [];
    const organ = this.worded(this.session.segment(start, preset, values, points, report), known);
    return {
      ...organ,
      seed: { center: triple(organ.seed.center), radius: organ.seed.radius },
      questions: organ.questions.map((question) => ({ ...question, place: triple(question.place) })),
    };
  }

  /** Of one inside or outside point more than the last organ has; null where what is kept of it does not tell. */
  preview(point: PreviewPoint): Preview | null {
    if (!this.session) {
      throw new FlipFreeError("There is no image");
    }
    const corrections = "inside" in point ? { inside: [point.inside] } : { outside: [point.outside] };
    const { isKnown, runs, volume } = this.checked(this.session.preview(correctionNumbers(corrections)));
    return isKnown ? { runs, volume } : null;
  }

  trace(points: readonly Triple[], parameters: Parameters = {}, report: Report = goOn): Vessel {
    if (!this.volume) {
      throw new FlipFreeError("There is no image");
    }
    const known = this.kernels.vesselParameters();
    const values = kernelValues(parameters, known);
    return this.worded(this.kernels.trace(this.volume, pointNumbers("points", points), values, report), known);
  }

  /** Of the labels named by `only`, or of all. */
  labelSurfaces(
    labels: Image,
    parameters: Parameters = {},
    only: readonly number[] = [],
    report: Report = goOn,
  ): LabelSurfaces {
    const known = this.kernels.labelSurfaceParameters();
    const values = kernelValues(parameters, known);
    const isLabel = (value: unknown) => Number.isInteger(value) && Math.abs(value as number) < 2 ** 31;
    if (!Array.isArray(only) || !only.every(isLabel)) {
      throw new FlipFreeError("only: give a list of labels, which are whole numbers");
    }
    return this.withVolume(labels, (volume) => this.checked(this.kernels.labelSurfaces(volume, only, values, report), known));
  }

  evaluate(
    segmentation: Image | Surface,
    reference: Image,
    parameters: Parameters = {},
    report: Report = goOn,
  ): Scores {
    const known = this.kernels.scoreParameters();
    const values = kernelValues(parameters, known);
    return this.withVolume(reference, (wanted) =>
      "points" in segmentation
        ? this.worded(this.kernels.scoreSurface(segmentation, wanted, values, report), known)
        : this.withVolume(segmentation, (found) =>
            this.worded(this.kernels.scoreLabels(found, wanted, values, report), known),
          ),
    );
  }

  /** Pairs of faces that intersect for some cut of the faces, by an exact count. */
  selfIntersections(surface: Surface): number {
    return this.checked(this.kernels.selfIntersections(surface)).count;
  }

  /** The volume in a file, in a header and the files that it names, or in DICOM files. */
  async readVolume(files: readonly NamedFile[], series = "", report: Report = goOn): Promise<OpenedVolume> {
    const checked = <T>(answer: Answer<T>) => this.checked(answer);
    return (await hasVolumeFile(files))
      ? readVolume(this.kernels, files, checked, report)
      : readSeries(this.kernels, files, series, checked, report);
  }

  listSeries(files: readonly NamedFile[], report: Report = goOn): Promise<DicomSeries[]> {
    return listSeries(this.kernels, files, (answer) => this.checked(answer), report);
  }

  /** A compressed NIfTI-1 file of labels of 8 bits. */
  async labelMapFile(labelMap: Image): Promise<Blob> {
    const { voxels } = labelMap;
    if (!(voxels instanceof Uint8Array) || voxels.length !== countVoxels(labelMap)) {
      throw new FlipFreeError("A label map has a byte for each voxel of its grid");
    }
    const { bytes } = this.checked(this.kernels.niftiHeader("the label map", labelMap));
    return packed([bytes, voxels as Uint8Array<ArrayBuffer>]);
  }

  /** A file of a surface. Only VTP holds the faces as they are, double precision, the confidence, and the names. */
  surfaceFile(result: WrittenSurface, format: SurfaceFormat, names: OriginNames): Blob {
    const provenance = namedProvenance(result.provenance, names);
    const { bytes } = this.checked(this.kernels.surfaceBytes(result, format, provenance));
    return new Blob([bytes], { type: mediaTypes[format] });
  }

  /** A file of a label's surface, called as the command calls it: 6.stl, or 6-liver.stl. */
  labelSurfaceFile({ label, surface, certified }: WrittenLabel, format: SurfaceFormat, name = ""): NamedFile {
    if (!surface) {
      throw new FlipFreeError(`Label ${label} has no surface`);
    }
    const { bytes } = this.checked(this.kernels.surfaceBytes({ surface, certified, label }, format, ""));
    const data = new Blob([bytes], { type: mediaTypes[format] });
    return { name: this.kernels.labelFileName(label, name, format), data };
  }

  labelTableFile(rows: readonly LabelRow[]): NamedFile {
    const numbers = this.kernels.labelFields();
    const isRow = (row: LabelRow) =>
      typeof row.name === "string" && typeof row.file === "string" && numbers.every((field) => Number.isFinite(row[field]));
    if (!Array.isArray(rows) || !rows.every(isRow)) {
      throw new FlipFreeError(`Rows need a name, a file and the numbers ${numbers.join(", ")}`);
    }
    const { text } = this.checked(this.kernels.labelTable(rows));
    return { name: "surfaces.csv", data: new Blob([text], { type: "text/csv" }) };
  }

  phantom(shape: PhantomShape, parameters: Parameters = {}, report: Report = goOn): Phantom {
    const known = this.kernels.phantomParameters();
    const values = kernelValues({ ...parameters, shape: shapes.indexOf(shape) }, known);
    const made = this.checked(this.kernels.makePhantom(values, report), known);
    const grid = {
      size: triple(made.size),
      spacing: triple(made.spacing),
      origin: triple(made.origin),
      direction: [...made.direction],
    };
    return {
      image: { ...grid, voxels: made.voxels },
      labelMap: { ...grid, voxels: made.labels },
      seeds: made.seeds.map(
        ({ name, label, center, radius }): PhantomSeed => ({ name, label, center: triple(center), radius }),
      ),
    };
  }

  private copy(image: Image): KernelVolume {
    const { size, voxels } = image;
    const count = size[0] * size[1] * size[2];
    if (voxels.length !== count) {
      throw new FlipFreeError(
        `The image has ${voxels.length} voxels, which does not fit its size, ${size.join(" x ")}; give ${count}`,
      );
    }
    return this.checked(this.kernels.makeVolume(image)).volume;
  }

  private withVolume<T>(image: Image, use: (volume: KernelVolume) => T): T {
    const volume = this.copy(image);
    try {
      return use(volume);
    } finally {
      volume.delete();
    }
  }

  private worded<T extends { warnings: string[] }>(answer: Answer<T>, known: KernelParameter[]): T {
    const result = this.checked(answer, known);
    return { ...result, warnings: result.warnings.map((warning) => wordMessage(warning, known)) };
  }

  private checked<T>(answer: Answer<T>, known: KernelParameter[] = []): T {
    if (answer.outOfMemory) {
      throw new FlipFreeError(
        "The volume needs more memory than the browser gives; crop it to the organ's surroundings, or resample it",
      );
    }
    if (answer.error !== undefined) {
      throw new FlipFreeError(wordMessage(answer.error, known));
    }
    return answer;
  }
}
