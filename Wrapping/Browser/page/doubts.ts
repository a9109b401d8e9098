/** Where a surface is doubtful: its parts whose vertices the image does not support, the largest first. */
import { type Organ, type Triple, doubtfulVertexConfidence, trianglesOf } from "../flipfree/index.js";

export interface Doubts {
  /** In the middle of each part, a vertex. */
  places: Triple[];
  /** Of the surface's area, 0 to 1. */
  fraction: number;
}

/** Smaller parts do not matter, mm². */
const leastArea = 50;

function areaOf(points: Float64Array, [a, b, c]: ArrayLike<number> & Iterable<number>): number {
  const [u, v] = [b, c].map((end) => [0, 1, 2].map((axis) => points[3 * end + axis] - points[3 * a + axis]));
  return 0.5 * Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

function placeOf(points: Float64Array, vertices: number[]): Triple {
  const position = (vertex: number): Triple => [points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2]];
  const middle = [0, 1, 2].map((axis) => vertices.reduce((sum, vertex) => sum + position(vertex)[axis], 0) / vertices.length);
  const away = (vertex: number) => Math.hypot(...position(vertex).map((value, axis) => value - middle[axis]));
  return position(vertices.reduce((nearest, vertex) => (away(vertex) < away(nearest) ? vertex : nearest)));
}

function find({ surface, vertexConfidence }: Organ): Doubts {
  const { points } = surface;
  const triangles = trianglesOf(surface);
  const isLow = (vertex: number) => vertexConfidence[vertex] < doubtfulVertexConfidence;
  // Each vertex leads to another one of its part, the last to itself.
  const next = Uint32Array.from(vertexConfidence, (_, vertex) => vertex);
  const last = (vertex: number) => {
    let at = vertex;
    while (next[at] !== at) {
      next[at] = next[next[at]];
      at = next[at];
    }
    return at;
  };
  const areas = new Map<number, number>(); // of triangles, by their first doubtful corner
  let whole = 0;
  let low = 0;
  for (let at = 0; at < triangles.length; at += 3) {
    const corners = triangles.subarray(at, at + 3);
    const area = areaOf(points, corners);
    const doubtful = [...corners].filter(isLow);
    doubtful.forEach((corner) => (next[last(corner)] = last(doubtful[0])));
    whole += area;
    low += (area * doubtful.length) / 3;
    if (doubtful.length > 0) {
      areas.set(doubtful[0], (areas.get(doubtful[0]) ?? 0) + (area * doubtful.length) / 3);
    }
  }
  const parts = new Map<number, { area: number; vertices: number[] }>();
  vertexConfidence.forEach((_, vertex) => {
    if (isLow(vertex)) {
      const part = parts.get(last(vertex)) ?? { area: 0, vertices: [] };
      part.area += areas.get(vertex) ?? 0;
      part.vertices.push(vertex);
      parts.set(last(vertex), part);
    }
  });
  const large = [...parts.values()].filter(({ area }) => area >= leastArea).sort((a, b) => b.area - a.area);
  return { places: large.map(({ vertices }) => placeOf(points, vertices)), fraction: low / whole };
}

const found = new WeakMap<Organ, Doubts>();

export function doubtsOf(organ: Organ): Doubts {
  const doubts = found.get(organ) ?? find(organ);
  found.set(organ, doubts);
  return doubts;
}
