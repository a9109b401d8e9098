/** Surfaces as files, as the command writes them: coordinates in LPS millimeters. */
import type { Surface } from "./types.js";

export const surfaceFormats = ["vtp", "stl", "ply"] as const;
export type SurfaceFormat = (typeof surfaceFormats)[number];

function countPoints(surface: Surface): number {
  return surface.points.length / 3;
}

function countFaces(surface: Surface): number {
  return surface.offsets.length - 1;
}

/** Each face cut into triangles from its first vertex: three vertices each. */
export function trianglesOf({ corners, offsets }: Surface): Uint32Array {
  const triangles: number[] = [];
  for (let face = 0; face + 1 < offsets.length; ++face) {
    for (let corner = offsets[face] + 1; corner + 1 < offsets[face + 1]; ++corner) {
      triangles.push(corners[offsets[face]], corners[corner], corners[corner + 1]);
    }
  }
  return Uint32Array.from(triangles);
}

/** Whether single precision holds every coordinate, as it does wherever the surface has moved. Else the rounded
 * surface is another one, and has to be checked for self-intersections. */
export function isSinglePrecision({ points }: Surface): boolean {
  return points.every((value) => Math.fround(value) === value);
}

/** The surface that a file of single precision holds. */
export function roundedSurface(surface: Surface): Surface {
  return { ...surface, points: Float64Array.from(surface.points, Math.fround) };
}

/** Binary STL: triangles. */
export function stlFile(surface: Surface): Blob {
  const triangles = trianglesOf(surface);
  const view = new DataView(new ArrayBuffer(84 + 50 * (triangles.length / 3)));
  new Uint8Array(view.buffer).set(new TextEncoder().encode("FlipFree, LPS millimeters"));
  view.setUint32(80, triangles.length / 3, true);
  for (let triangle = 0; triangle < triangles.length; triangle += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) =>
      surface.points.subarray(3 * triangles[triangle + corner], 3 * triangles[triangle + corner] + 3),
    );
    const [u, v] = [b, c].map((end) => [end[0] - a[0], end[1] - a[1], end[2] - a[2]]);
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...normal) || 1;
    const numbers = [...normal.map((value) => value / length), ...a, ...b, ...c];
    numbers.forEach((value, at) => view.setFloat32(84 + 50 * (triangle / 3) + 4 * at, value, true));
  }
  return new Blob([view.buffer as ArrayBuffer], { type: "model/stl" });
}

/** Binary PLY: triangles, since many programs read no other faces. */
export function plyFile(surface: Surface): Blob {
  const { points } = surface;
  const triangles = trianglesOf(surface);
  const header = [
    "ply",
    "format binary_little_endian 1.0",
    "comment FlipFree, LPS millimeters",
    `element vertex ${countPoints(surface)}`,
    "property float x",
    "property float y",
    "property float z",
    `element face ${triangles.length / 3}`,
    "property list uchar int vertex_indices",
    "end_header\n",
  ].join("\n");
  const size = 1 + 3 * 4; // of a face
  const view = new DataView(new ArrayBuffer(4 * points.length + size * (triangles.length / 3)));
  points.forEach((value, at) => view.setFloat32(4 * at, value, true));
  triangles.forEach((corner, at) => {
    const face = 4 * points.length + size * Math.floor(at / 3);
    view.setUint8(face, 3);
    view.setInt32(face + 1 + 4 * (at % 3), corner, true);
  });
  return new Blob([header, view.buffer as ArrayBuffer], { type: "model/ply" });
}

/** VTK's XML format: the faces as they are, coordinates in double precision, and the vertices' confidence as a point array. */
export function vtpFile(surface: Surface, vertexConfidence?: Float32Array): Blob {
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let offset = 0;
  const append = (type: string, name: string, data: Float64Array | Float32Array | Int32Array, components = 1) => {
    const bytes = new Uint8Array(data.slice().buffer as ArrayBuffer);
    const size = new Uint8Array(8);
    new DataView(size.buffer).setUint32(0, bytes.length, true); // far below 4 GB
    parts.push(size, bytes);
    const element = `<DataArray type="${type}" Name="${name}" NumberOfComponents="${components}" format="appended" offset="${offset}"/>`;
    offset += 8 + bytes.length;
    return element;
  };
  const xml = [
    '<?xml version="1.0"?>',
    '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
    "<PolyData>",
    `<Piece NumberOfPoints="${countPoints(surface)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="${countFaces(surface)}">`,
    `<Points>${append("Float64", "Points", surface.points, 3)}</Points>`,
    `<Polys>${append("Int32", "connectivity", surface.corners)}${append("Int32", "offsets", surface.offsets.subarray(1))}</Polys>`,
    ...(vertexConfidence ? [`<PointData>${append("Float32", "Confidence", vertexConfidence)}</PointData>`] : []),
    "</Piece>",
    "</PolyData>",
    '<AppendedData encoding="raw">\n_',
  ].join("\n");
  return new Blob([xml, ...parts, "\n</AppendedData>\n</VTKFile>\n"], { type: "application/xml" });
}

/** Only VTP files can hold the vertices' confidence. */
export function surfaceFile(surface: Surface, format: SurfaceFormat, vertexConfidence?: Float32Array): Blob {
  return format === "vtp" ? vtpFile(surface, vertexConfidence) : { stl: stlFile, ply: plyFile }[format](surface);
}
