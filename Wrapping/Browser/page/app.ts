/** What all parts of the page share: the kernels, the view, the organs, and what is going on. */
import { FlipFree, type Image, type PhantomSeed } from "../flipfree/index.js";
import { element } from "./dom.js";
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
  /** The label map of which organs can fill a label, on the image's lattice, and the name of its file. */
  labels: Image | null;
  labelsName: string;
  /** Of the built-in image's organs. */
  phantomSeeds: PhantomSeed[];
  running: AbortController | null;
}

export const app: App = { opened: null, labels: null, labelsName: "", phantomSeeds: [], running: null };
