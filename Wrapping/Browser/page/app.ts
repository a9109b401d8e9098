/** What all parts of the page share: the kernels, the view, the organs, and what is going on. */
import { FlipFree } from "../flipfree/index.js";
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

export const app: { opened: OpenImage | null; running: AbortController | null } = { opened: null, running: null };
