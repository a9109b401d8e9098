/** Results as files of surfaces, as the command writes them: coordinates in LPS millimeters, and where they come from. */
import { type OriginNames, namedProvenance } from "./provenance.js";
import { type Organ, type Surface, type Vessel, isOrgan } from "./types.js";

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

/** Binary STL: triangles. It has no room for the provenance. */
export function stlFile({ surface, comments }: Organ | Vessel): Blob {
  const triangles = trianglesOf(surface);
  const view = new DataView(new ArrayBuffer(84 + 50 * (triangles.length / 3)));
  new Uint8Array(view.buffer).set(new TextEncoder().encode(comments[0].padEnd(80)));
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

/** Binary PLY: triangles, since many programs read no other faces, and the provenance in comments. */
export function plyFile({ surface, comments }: Organ | Vessel): Blob {
  const { points } = surface;
  const triangles = trianglesOf(surface);
  const header = [
    "ply",
    "format binary_little_endian 1.0",
    ...comments.map((comment) => `comment ${comment}`),
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

/** VTK's XML format: the faces as they are, coordinates in double precision, the vertices' confidence as a point array, and
 * as field data the certificate, the confidence, and the provenance, with the names. */
export function vtpFile(result: Organ | Vessel, names: OriginNames = {}): Blob {
  const { surface, certified, provenance } = result;
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let offset = 0;
  const append = (data: Float64Array | Float32Array | Int32Array | Uint8Array) => {
    const bytes = new Uint8Array(data.slice().buffer as ArrayBuffer);
    const size = new Uint8Array(8);
    new DataView(size.buffer).setUint32(0, bytes.length, true); // far below 4 GB
    parts.push(size, bytes);
    const attributes = `format="appended" offset="${offset}"`;
    offset += 8 + bytes.length;
    return attributes;
  };
  const array = (type: string, name: string, data: Float64Array | Float32Array | Int32Array, components = 1) =>
    `<DataArray type="${type}" Name="${name}" NumberOfComponents="${components}" ${append(data)}/>`;
  const number = (name: string, value: number) =>
    `<DataArray type="Float64" Name="${name}" NumberOfTuples="1" ${append(Float64Array.of(value))}/>`;
  const text = (name: string, value: string) =>
    `<Array type="String" Name="${name}" NumberOfTuples="1" ${append(new TextEncoder().encode(`${value}\0`))}/>`;
  const fields = [number("Certified", Number(certified)), text("Provenance", namedProvenance(provenance, names))];
  const pointData: string[] = [];
  if (isOrgan(result)) {
    fields.push(number("Confidence", result.confidence));
    pointData.push(array("Float32", "Confidence", result.vertexConfidence));
  }
  const xml = [
    '<?xml version="1.0"?>',
    '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
    "<PolyData>",
    `<FieldData>${fields.join("")}</FieldData>`,
    `<Piece NumberOfPoints="${countPoints(surface)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="${countFaces(surface)}">`,
    `<PointData>${pointData.join("")}</PointData>`,
    `<Points>${array("Float64", "Points", surface.points, 3)}</Points>`,
    `<Polys>${array("Int32", "connectivity", surface.corners)}${array("Int32", "offsets", surface.offsets.subarray(1))}</Polys>`,
    "</Piece>",
    "</PolyData>",
    '<AppendedData encoding="raw">\n_',
  ].join("\n");
  return new Blob([xml, ...parts, "\n</AppendedData>\n</VTKFile>\n"], { type: "application/xml" });
}

/** Only VTP files hold the confidence and the names. */
export function surfaceFile(result: Organ | Vessel, format: SurfaceFormat, names: OriginNames = {}): Blob {
  return format === "vtp" ? vtpFile(result, names) : { stl: stlFile, ply: plyFile }[format](result);
}
