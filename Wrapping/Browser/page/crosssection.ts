/** Where a surface crosses a plane. */

/** Line segments of a surface in the plane where a value given at each vertex is zero: of both ends x, y, z, and what the
 * vertices carry there. */
export function crossSection(
  points: Float64Array,
  triangles: Uint32Array,
  values: Float64Array,
  carried: Float32Array,
): number[] {
  const segments: number[] = [];
  for (let triangle = 0; triangle < triangles.length; triangle += 3) {
    const corners = [triangles[triangle], triangles[triangle + 1], triangles[triangle + 2]];
    const above = corners.map((corner) => values[corner] > 0);
    if (above[0] === above[1] && above[1] === above[2]) {
      continue;
    }
    for (let side = 0; side < 3; ++side) {
      const a = corners[side];
      const b = corners[(side + 1) % 3];
      if (above[side] !== above[(side + 1) % 3]) {
        const t = values[a] / (values[a] - values[b]);
        for (let axis = 0; axis < 3; ++axis) {
          segments.push(points[3 * a + axis] + t * (points[3 * b + axis] - points[3 * a + axis]));
        }
        segments.push(carried[a] + t * (carried[b] - carried[a]));
      }
    }
  }
  return segments;
}

/** The parts of such segments where what is carried is below a limit. */
export function partsBelow(segments: number[], limit: number): number[] {
  const parts: number[] = [];
  for (let at = 0; at < segments.length; at += 8) {
    const [a, b] = [segments.slice(at, at + 4), segments.slice(at + 4, at + 8)];
    if (a[3] >= limit && b[3] >= limit) {
      continue;
    }
    const t = (limit - a[3]) / (b[3] - a[3]);
    const between = a.map((value, index) => value + t * (b[index] - value));
    parts.push(...(a[3] < limit ? a : between), ...(b[3] < limit ? b : between));
  }
  return parts;
}
