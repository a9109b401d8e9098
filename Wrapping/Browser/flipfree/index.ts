export { FlipFree } from "./client.js";
export type { PhantomShape } from "./engine.js";
export { affineOf, countVoxels, fillRuns, swapLpsRas } from "./grid.js";
export { labelsIn, mayBeLabelMap } from "./labels.js";
export { type OriginNames, namedProvenance } from "./provenance.js";
export {
  type LabelRow,
  type SurfaceFormat,
  isSinglePrecision,
  roundedSurface,
  roundsPoints,
  surfaceFormats,
  trianglesOf,
} from "./surfacefiles.js";
export * from "./types.js";
