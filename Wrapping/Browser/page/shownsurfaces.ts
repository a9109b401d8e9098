/** Surfaces in NiiVue's coordinates, RAS and fractions of the volume's extents. Of label maps they have millions of vertices, so
 * each is brought there once. */
import { type Surface, trianglesOf } from "../flipfree/index.js";
import type { ViewedOrgan } from "./marks.js";
import type { ShownSurface } from "./overlay.js";
import type { Point } from "./tiles.js";

type Placed = Pick<ShownSurface, "points" | "triangles" | "fractions" | "least" | "most" | "confidence">;

function placed({ surface, confidence }: ViewedOrgan & { surface: Surface }, fractionsOf: (point: Point) => ArrayLike<number>): Placed {
  const points = Float64Array.from(surface.points, (value, at) => (at % 3 === 2 ? value : -value));
  const fractions = new Float64Array(points.length);
  const least = [Infinity, Infinity, Infinity];
  const most = [-Infinity, -Infinity, -Infinity];
  for (let at = 0; at < points.length; at += 3) {
    fractions.set(fractionsOf([points[at], points[at + 1], points[at + 2]]), at);
    for (let axis = 0; axis < 3; ++axis) {
      least[axis] = Math.min(least[axis], fractions[at + axis]);
      most[axis] = Math.max(most[axis], fractions[at + axis]);
    }
  }
  const sure = () => new Float32Array(points.length / 3).fill(1);
  return { points, triangles: trianglesOf(surface), fractions, least, most, confidence: confidence ?? sure() };
}

export class ShownSurfaces {
  private known = new WeakMap<Surface, Placed>();

  /** For another volume. */
  forget(): void {
    this.known = new WeakMap();
  }

  /** Of organs that have one. `fractionsOf` is the volume's. */
  of(organs: readonly ViewedOrgan[], fractionsOf: (point: Point) => ArrayLike<number>): ShownSurface[] {
    return organs.flatMap(({ surface, color, isChosen, ...organ }) => {
      if (!surface) {
        return [];
      }
      const known = this.known.get(surface) ?? placed({ ...organ, surface, color, isChosen }, fractionsOf);
      this.known.set(surface, known);
      return [{ ...known, color, isChosen }];
    });
  }
}
