// Volumes as files of other programs: NRRD, MetaImage, and a header of more than fits.

/** A NIfTI header of a volume that no browser could hold. */
export function hugeHeader() {
  const header = Buffer.alloc(400);
  header.writeInt32LE(348, 0);
  [3, 4096, 4096, 4096, 1, 1, 1, 1].forEach((value, at) => header.writeInt16LE(value, 40 + 2 * at));
  header.writeInt16LE(4, 70);
  header.writeInt16LE(16, 72);
  [1, 1, 1, 1].forEach((value, at) => header.writeFloatLE(value, 76 + 4 * at));
  header.writeFloatLE(352, 108);
  header.write("n+1\0", 344, "latin1");
  return header;
}

function columnsOf({ direction }) {
  return [0, 1, 2].map((axis) => [0, 1, 2].map((row) => direction[3 * row + axis]));
}

export function metaImage(grid, voxels) {
  const header = [
    "ObjectType = Image",
    "NDims = 3",
    "BinaryData = True",
    "BinaryDataByteOrderMSB = False",
    "CompressedData = False",
    `TransformMatrix = ${columnsOf(grid).flat().join(" ")}`,
    `Offset = ${grid.origin.join(" ")}`,
    `ElementSpacing = ${grid.spacing.join(" ")}`,
    `DimSize = ${grid.size.join(" ")}`,
    "ElementType = MET_SHORT",
    "ElementDataFile = LOCAL\n",
  ].join("\n");
  return Buffer.concat([Buffer.from(header), Buffer.from(voxels.buffer)]);
}

/** What 3D Slicer writes of a segment. */
export function segmentPairs(number, { label, name, color }) {
  const pairs = { LabelValue: label, Layer: 0, Name: name, Color: color };
  return Object.entries(pairs).map(([key, value]) => `Segment${number}_${key}:=${value}`);
}

export function nrrd(grid, voxels, pairs = []) {
  const vector = (numbers) => `(${numbers.join(",")})`;
  const directions = columnsOf(grid).map((column, axis) => vector(column.map((value) => value * grid.spacing[axis])));
  const header = [
    "NRRD0004",
    "type: short",
    "dimension: 3",
    "space: left-posterior-superior",
    `sizes: ${grid.size.join(" ")}`,
    `space directions: ${directions.join(" ")}`,
    "kinds: domain domain domain",
    "endian: little",
    "encoding: raw",
    `space origin: ${vector(grid.origin)}`,
    ...pairs,
    "\n",
  ].join("\n");
  return Buffer.concat([Buffer.from(header), Buffer.from(voxels.buffer)]);
}
