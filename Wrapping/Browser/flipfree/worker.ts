/** The worker: does one request after the other, in a thread of its own. */
// @ts-ignore: made by the build
import factory from "./kernels.mjs";
import { Engine, type KernelFactory } from "./engine.js";
import type { Answers, FromWorker, Kind, Requests, ToWorker } from "./messages.js";
import { FlipFreeError } from "./types.js";

/** What a worker of the browser and one of Node have in common. */
interface Port {
  postMessage(message: FromWorker): void;
  on(take: (message: ToWorker) => void): void;
}

async function openPort(): Promise<Port> {
  if (typeof self !== "undefined" && typeof self.postMessage === "function") {
    return {
      postMessage: (message) => self.postMessage(message),
      on: (take) => self.addEventListener("message", (event: MessageEvent<ToWorker>) => take(event.data)),
    };
  }
  const node = "node:worker_threads"; // a bundler for pages must not look for it
  const { parentPort } = await import(node);
  return {
    postMessage: (message) => parentPort.postMessage(message),
    on: (take) => parentPort.on("message", take),
  };
}

type Report = (fraction: number) => boolean;
type Work = { [K in Kind]: (engine: Engine, request: Requests[K], report: Report) => Answers[K] | Promise<Answers[K]> };

const work: Work = {
  defaultParameters: (engine, { preset }) => engine.defaultParameters(preset),
  compareGrids: (engine, { grid, part, name }) => engine.compareGrids(grid, part, name),
  setImage: (engine, { image }) => (engine.setImage(image), null),
  setStart: (engine, { start }) => (engine.setStart(start), null),
  segment: (engine, { seed, preset, parameters, corrections }, report) =>
    engine.segment(seed, preset, parameters, corrections, report),
  preview: (engine, { point }) => engine.preview(point),
  trace: (engine, { points, parameters }, report) => engine.trace(points, parameters, report),
  labelSurfaces: (engine, { labels, only, parameters }, report) => engine.labelSurfaces(labels, parameters, only, report),
  evaluate: (engine, { segmentation, reference, parameters }, report) =>
    engine.evaluate(segmentation, reference, parameters, report),
  selfIntersections: (engine, { surface }) => engine.selfIntersections(surface),
  readVolume: (engine, { files, series }, report) => engine.readVolume(files, series, report),
  listSeries: (engine, { files }, report) => engine.listSeries(files, report),
  labelMapFile: (engine, { labelMap }) => engine.labelMapFile(labelMap),
  surfaceFile: (engine, { result, format, names }) => engine.surfaceFile(result, format, names),
  labelSurfaceFile: (engine, { written, format, name }) => engine.labelSurfaceFile(written, format, name),
  labelTableFile: (engine, { rows }) => engine.labelTableFile(rows),
  phantom: (engine, { shape, parameters }, report) => engine.phantom(shape, parameters, report),
  memory: (engine) => engine.memory,
};

/** A message every so often at most. */
const progressInterval = 40; // ms

/** A page stops a run by ending the worker, so work always goes on. */
function reporter(port: Port, id: number): Report {
  let last = 0;
  return (progress) => {
    const now = performance.now();
    if (now - last > progressInterval) {
      last = now;
      port.postMessage({ id, progress });
    }
    return true;
  };
}

const port = await openPort();
let engine: Promise<Engine>;

port.on(async (message) => {
  if ("wasm" in message) {
    engine = Engine.load(factory as KernelFactory, message.wasm);
    return;
  }
  const { id, kind, request } = message;
  try {
    const run = work[kind] as (engine: Engine, request: unknown, report: Report) => Answers[Kind] | Promise<Answers[Kind]>;
    port.postMessage({ id, answer: await run(await engine, request, reporter(port, id)) });
  } catch (error) {
    const text = error instanceof Error ? error.message : String(error);
    port.postMessage({ id, error: text, isInput: error instanceof FlipFreeError });
  }
});
