/** Organs as the slices show them. */
import { type Seed, type Surface, type Triple, swapLpsRas } from "../flipfree/index.js";
import type { Marks } from "./overlay.js";
import { distanceBetween } from "./stroke.js";
import type { Point } from "./tiles.js";

export interface ViewedOrgan {
  surface: Surface | null;
  /** Of the surface's vertices; a vessel has none. */
  confidence: Float32Array | null;
  seed: Seed | null;
  color: string;
  isChosen: boolean;
  /** Inside, outside, boundary, seed, or the number of a vessel's point. */
  points: { kind: string; position: Triple; radius?: number }[];
  /** The places of its questions. */
  questions: readonly Triple[];
  /** The number of the chosen one, or -1. */
  chosenQuestion: number;
}

/** LPS as RAS, or the other way; without negative zeros, which text would show. */
export function swapped(point: Triple | Point): Point {
  const [x, y, z] = swapLpsRas(point);
  return [x + 0, y + 0, z];
}

/** Seeds, points and questions. Points of a kind that are as close as those of a stroke are dots. */
export function marksOf(
  organs: readonly ViewedOrgan[],
  close: number,
): Pick<Marks, "seeds" | "points" | "questions" | "chosenQuestion"> {
  const further = organs.flatMap(({ points, color }) => points.map((point) => ({ ...point, color })));
  const seeds = organs.flatMap(({ seed, color }) => (seed ? [{ ...seed, color }] : []));
  const spheres = further.map(({ position, radius, color }) => ({ center: position, radius: radius ?? 0, color }));
  const points = further.filter(({ kind }) => kind !== "seed");
  const isDot = ({ kind, position }: (typeof points)[number]) =>
    points.some((other) => other.kind === kind && other.position !== position && distanceBetween(other.position, position) < close);
  const asking = organs.find(({ questions }) => questions.length > 0);
  return {
    seeds: [...seeds, ...spheres.filter(({ radius }) => radius > 0)].map((seed) => ({ ...seed, center: swapped(seed.center) })),
    points: points.map((point) => ({ kind: point.kind, place: swapped(point.position), color: point.color, isDot: isDot(point) })),
    questions: asking?.questions.map((place) => swapped(place)) ?? [],
    chosenQuestion: asking?.chosenQuestion ?? -1,
  };
}
