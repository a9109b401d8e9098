/** What all parts of the page share: the kernels, the view, the organs, and what is going on. */
import { FlipFree, type Image, type PhantomSeed, type Segment } from "../flipfree/index.js";
import { element } from "./dom.js";
import type { ListedLabel } from "./labelsurfaces.js";
import { Organs } from "./organs.js";
import { View } from "./view.js";
import type { OpenImage } from "./volumes.js";

export const [flipfree, view] = await Promise.all([
  FlipFree.load(),
  View.open(
    element<HTMLCanvasElement>("slices"),
    element<HTMLCanvasElement>("overlay"),
    element<HTMLCanvasElement>("surface"),
  ),
]);

export const organs = new Organs();

interface App {
  opened: OpenImage | null;
  /** The label map, on the image's lattice or itself what is open: organs can fill its labels, and all of these get surfaces. */
  labels: Image | null;
  /** Its file's, and what the file says of its labels. */
  labelsName: string;
  labelSegments: Segment[];
  labelSurfaces: ListedLabel[];
  /** Of the built-in image's organs. */
  phantomSeeds: PhantomSeed[];
  running: AbortController | null;
}

export const app: App = {
  opened: null,
  labels: null,
  labelsName: "",
  labelSegments: [],
  labelSurfaces: [],
  phantomSeeds: [],
  running: null,
};
