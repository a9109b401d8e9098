/** Where a surface crosses a plane. */

/** Line segments of a surface in the plane where a value given at each vertex is zero: x, y, z of both ends each. */
export function crossSection(points: Float64Array, triangles: Uint32Array, values: Float64Array): number[] {
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
      }
    }
  }
  return segments;
}
