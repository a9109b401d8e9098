/** FlipFree in a page or in Node: the work is done in a worker. */
import type { PhantomShape } from "./engine.js";
import type { Answers, FromWorker, Kind, Requests, ToWorker } from "./messages.js";
import type { OriginNames } from "./provenance.js";
import type { LabelRow, SurfaceFormat } from "./surfacefiles.js";
import {
  type DicomSeries,
  type EvaluateOptions,
  FlipFreeError,
  type Grid,
  type GridComparison,
  type Image,
  type LabelSurface,
  type LabelSurfaceOptions,
  type LabelSurfaces,
  type NamedFile,
  type OpenedVolume,
  type Organ,
  type Parameters,
  type Phantom,
  type PhantomOptions,
  type ReadOptions,
  type Preset,
  type Preview,
  type PreviewPoint,
  type RunOptions,
  type Scores,
  type Seed,
  type SegmentOptions,
  type StartLabels,
  type Surface,
  type TraceOptions,
  type Triple,
  type Vessel,
  isOrgan,
} from "./types.js";

interface WorkerLike {
  postMessage(message: ToWorker): void;
  terminate(): void;
}

type Listener = (message: FromWorker | { failure: string }) => void;

async function startWorker(url: URL, listener: Listener): Promise<WorkerLike> {
  if (typeof Worker === "function") {
    const worker = new Worker(url, { type: "module" });
    worker.addEventListener("message", (event: MessageEvent<FromWorker>) => listener(event.data));
    worker.addEventListener("error", (event) => listener({ failure: event.message || "the worker has failed" }));
    return worker;
  }
  const node = "node:worker_threads"; // a bundler for pages must not look for it
  const { Worker: NodeWorker } = await import(node);
  const worker = new NodeWorker(url);
  worker.on("message", listener);
  worker.on("error", (error: Error) => listener({ failure: error.message }));
  return worker;
}

async function compile(wasm: URL | BufferSource): Promise<WebAssembly.Module> {
  if (!(wasm instanceof URL)) {
    return WebAssembly.compile(wasm);
  }
  const response = await fetch(wasm);
  if (!response.ok) {
    throw new Error(`${wasm} cannot be loaded (${response.status})`);
  }
  // Some servers do not know the type of WebAssembly, without which it cannot be compiled while it loads.
  return response.headers.get("Content-Type") === "application/wasm"
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}

/** A part of a file may be sent to a worker everywhere; a file may not. */
function forWorker(files: readonly NamedFile[]): NamedFile[] {
  return files.map(({ name, data }) => ({ name, data: data.slice() }));
}

interface Pending {
  resolve(answer: unknown): void;
  reject(reason: unknown): void;
  onProgress?: (fraction: number) => void;
}

/**
 * One worker, which does one request after the other.
 *
 * ```ts
 * const flipfree = await FlipFree.load();
 * const { image } = await flipfree.phantom("abdomen");
 * const liver = await flipfree.segment(image, { center: [99.75, 83.75, 167], radius: 28 });
 * ```
 *
 * A run is stopped by its signal: the worker ends at once, and the next request starts another. What else was
 * asked for meanwhile is then rejected, too.
 */
export class FlipFree {
  private worker?: Promise<WorkerLike>;
  private image?: Image;
  private start?: StartLabels;
  private readonly pending = new Map<number, Pending>();
  private nextId = 1;

  private constructor(
    private readonly wasm: WebAssembly.Module,
    private readonly workerUrl: URL,
  ) {}

  /** Compiles the kernels. By default they are beside this file. */
  static async load(
    wasm: URL | BufferSource = new URL("./kernels.wasm", import.meta.url),
    workerUrl: URL = new URL("./worker.js", import.meta.url),
  ): Promise<FlipFree> {
    return new FlipFree(await compile(wasm), workerUrl);
  }

  /** Ends the worker, without which Node does not end. */
  close(): void {
    this.end(new FlipFreeError("The worker was closed"));
  }

  defaultParameters(preset: Preset = "default"): Promise<Parameters> {
    return this.ask("defaultParameters", { preset });
  }

  /** The organ around a seed, or the one that fills a label of a label map. Rejects with a FlipFreeError that says what to do for
   * input that it cannot work with.
   *
   * The worker keeps of the last organ what corrections do not change: the same call with other points is much faster than
   * the first. */
  segment(image: Image, start: Seed | StartLabels, options: SegmentOptions = {}): Promise<Organ> {
    const { preset = "default", parameters = {}, inside, outside, boundary, seeds } = options;
    const corrections = { inside, outside, boundary, seeds };
    const needed = [() => this.useImage(image, options)];
    if ("labels" in start) {
      needed.push(() => this.useStart(start, options));
    }
    const seed = "labels" in start ? null : start;
    return this.askAfter(needed, "segment", { seed, preset, parameters, corrections }, options);
  }

  /** What one more inside or outside point would change in the organ of the last call of `segment`; the surface follows as
   * far as it can. No surface is deformed, so it is much faster. Null where what is kept of that call does not tell: it was
   * stopped or without carving, or the point lies beyond what the surface can reach. Rejects for a point that `segment` would
   * refuse. */
  preview(point: PreviewPoint): Promise<Preview | null> {
    return this.ask("preview", { point });
  }

  /** The vessel between two points, or the tree of vessels that joins more: one at each end, more on the way or at the
   * ends of branches, in any order. Rejects as `segment` does. */
  trace(image: Image, points: readonly Triple[], options: TraceOptions = {}): Promise<Vessel> {
    const needed = [() => this.useImage(image, options)];
    return this.askAfter(needed, "trace", { points, parameters: options.parameters ?? {} }, options);
  }

  /** A closed surface for each label of a label map, without self-intersections whatever the labels are; two labels have one wall
   * between them. With `exact`, the surfaces have the voxels of the label map. Rejects as `segment` does. */
  labelSurfaces(labels: Image, options: LabelSurfaceOptions = {}): Promise<LabelSurfaces> {
    const { only = [], parameters = {} } = options;
    return this.ask("labelSurfaces", { labels, only, parameters }, options);
  }

  /** Where the voxels of a part, such as a label map called `name`, lie on an image's grid. Label maps need be no more than on its
   * lattice: `segment` and `evaluate` put them into place. */
  compareGrids(grid: Grid, part: Grid, name: string): Promise<GridComparison> {
    const withoutVoxels = ({ size, spacing, origin, direction }: Grid) => ({ size, spacing, origin, direction });
    return this.ask("compareGrids", { grid: withoutVoxels(grid), part: withoutVoxels(part), name });
  }

  /** How well a label map or a surface agrees with a reference label map. */
  evaluate(segmentation: Image | Surface, reference: Image, options: EvaluateOptions = {}): Promise<Scores> {
    return this.ask("evaluate", { segmentation, reference, parameters: options.parameters ?? {} }, options);
  }

  /** Pairs of faces of a surface that intersect for some cut of the faces, by an exact count. */
  selfIntersections(surface: Surface): Promise<number> {
    return this.ask("selfIntersections", { surface });
  }

  /** The volume in a NIfTI, NRRD or MetaImage file, in a header and the files that it names, or in DICOM files. What a file says
   * is the same here, in Python and in the command. Rejects with a FlipFreeError for what cannot be read. */
  readVolume(files: readonly NamedFile[], options: ReadOptions = {}): Promise<OpenedVolume> {
    return this.ask("readVolume", { files: forWorker(files), series: options.series ?? "" }, options);
  }

  /** The series among DICOM files. */
  listSeries(files: readonly NamedFile[], options: RunOptions = {}): Promise<DicomSeries[]> {
    return this.ask("listSeries", { files: forWorker(files) }, options);
  }

  /** A compressed NIfTI-1 file of a label map of 8 bits. */
  labelMapFile(labelMap: Image): Promise<Blob> {
    return this.ask("labelMapFile", { labelMap });
  }

  /** A file of a result's surface, as the command writes it: coordinates in LPS millimeters, and where it comes from. Triangles
   * in STL and PLY, the faces as they are in VTP, which alone holds the confidence of an organ and the names. */
  surfaceFile(result: Organ | Vessel, format: SurfaceFormat, names: OriginNames = {}): Promise<Blob> {
    const { surface, certified, provenance, comments } = result;
    const ofOrgan = isOrgan(result) ? { confidence: result.confidence, vertexConfidence: result.vertexConfidence } : {};
    return this.ask("surfaceFile", { result: { surface, certified, provenance, comments, ...ofOrgan }, format, names });
  }

  /** A file of a label's surface, as the command writes and calls it: 6.stl, or 6-liver.stl where the label has a name. */
  labelSurfaceFile({ label, surface, certified }: LabelSurface, format: SurfaceFormat, name = ""): Promise<NamedFile> {
    return this.ask("labelSurfaceFile", { written: { label, surface, certified }, format, name });
  }

  /** The table that the command writes beside these files: what the surfaces measure, and the files' names. */
  labelTableFile(rows: readonly LabelRow[]): Promise<NamedFile> {
    return this.ask("labelTableFile", { rows });
  }

  phantom(shape: PhantomShape, options: PhantomOptions = {}): Promise<Phantom> {
    return this.ask("phantom", { shape, parameters: options.parameters ?? {} }, options);
  }

  /** Copies an image to the worker before it is needed. */
  async useImage(image: Image, options: RunOptions = {}): Promise<void> {
    if (this.image === image && this.worker) {
      return;
    }
    this.image = image;
    this.start = undefined;
    try {
      await this.ask("setImage", { image }, { signal: options.signal });
    } catch (error) {
      this.image = undefined;
      throw error;
    }
  }

  /** The same for the label that is filled. */
  private async useStart(start: StartLabels, options: RunOptions): Promise<void> {
    if (this.start?.labels === start.labels && this.start.label === start.label && this.worker) {
      return;
    }
    this.start = { ...start };
    try {
      await this.ask("setStart", { start }, { signal: options.signal });
    } catch (error) {
      this.start = undefined;
      throw error;
    }
  }

  /** Bytes of the kernels' memory. */
  memory(): Promise<number> {
    return this.ask("memory", {});
  }

  /** Asks right after what is needed first: of requests made at one time, none comes between. */
  private async askAfter<K extends Kind>(
    needed: (() => Promise<void>)[],
    kind: K,
    request: Requests[K],
    options: RunOptions,
  ): Promise<Answers[K]> {
    const first = needed.map((need) => need());
    const answer = this.ask(kind, request, options);
    answer.catch(() => {}); // where what is needed fails, that is the reason
    await Promise.all(first);
    return answer;
  }

  private async ask<K extends Kind>(kind: K, request: Requests[K], options: RunOptions = {}): Promise<Answers[K]> {
    options.signal?.throwIfAborted();
    const worker = await this.running();
    const id = this.nextId++;
    const stop = () => this.end(options.signal?.reason);
    options.signal?.addEventListener("abort", stop, { once: true });
    try {
      return await new Promise<Answers[K]>((resolve, reject) => {
        const take = resolve as (answer: unknown) => void;
        this.pending.set(id, { resolve: take, reject, onProgress: options.onProgress });
        worker.postMessage({ id, kind, request } as ToWorker);
      });
    } finally {
      this.pending.delete(id);
      options.signal?.removeEventListener("abort", stop);
    }
  }

  private running(): Promise<WorkerLike> {
    if (!this.worker) {
      const listener: Listener = (message) => {
        if (this.worker === worker) {
          this.take(message);
        }
      };
      const worker = startWorker(this.workerUrl, listener).then((started) => {
        started.postMessage({ wasm: this.wasm });
        return started;
      });
      this.worker = worker;
    }
    return this.worker;
  }

  private take(message: FromWorker | { failure: string }): void {
    if ("failure" in message) {
      this.end(new FlipFreeError(message.failure));
      return;
    }
    const pending = this.pending.get(message.id);
    if ("progress" in message) {
      pending?.onProgress?.(message.progress);
    } else if ("answer" in message) {
      pending?.resolve(message.answer);
    } else {
      pending?.reject(message.isInput ? new FlipFreeError(message.error) : new Error(message.error));
    }
  }

  private end(reason: unknown): void {
    void this.worker?.then((worker) => worker.terminate());
    this.worker = undefined;
    this.image = undefined;
    this.start = undefined;
    for (const { reject } of this.pending.values()) {
      reject(reason);
    }
  }
}
