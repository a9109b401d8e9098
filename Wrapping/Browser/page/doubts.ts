/** How much of a surface is doubtful: where the image does not support its vertices, it is drawn in blue. */
import { type Organ, doubtfulVertexConfidence, trianglesOf } from "../flipfree/index.js";

function areaOf(points: Float64Array, [a, b, c]: ArrayLike<number> & Iterable<number>): number {
  const [u, v] = [b, c].map((end) => [0, 1, 2].map((axis) => points[3 * end + axis] - points[3 * a + axis]));
  return 0.5 * Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

/** Of the surface's area, 0 to 1. */
export function doubtfulFraction({ surface, vertexConfidence }: Organ): number {
  const triangles = trianglesOf(surface);
  let whole = 0;
  let doubtful = 0;
  for (let at = 0; at < triangles.length; at += 3) {
    const corners = triangles.subarray(at, at + 3);
    const area = areaOf(surface.points, corners);
    whole += area;
    doubtful += (area * corners.filter((vertex) => vertexConfidence[vertex] < doubtfulVertexConfidence).length) / 3;
  }
  return doubtful / whole;
}
