export { FlipFree } from "./client.js";
export type { PhantomShape } from "./engine.js";
export { affineOf, countVoxels, fillRuns, swapLpsRas } from "./grid.js";
export { labelsIn } from "./labels.js";
export { type OriginNames, namedProvenance } from "./provenance.js";
export {
  type SurfaceFormat,
  isSinglePrecision,
  roundedSurface,
  surfaceFormats,
  trianglesOf,
} from "./surfacefiles.js";
export * from "./types.js";
