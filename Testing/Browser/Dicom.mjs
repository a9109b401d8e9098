// A CT series as DICOM files, as small as the standard allows.
import { losslessJpeg } from "./LosslessJpeg.mjs";

const imageClass = "1.2.840.10008.5.1.4.1.1.2"; // CT
const explicitLittleEndian = "1.2.840.10008.1.2.1";
const jpegLossless = "1.2.840.10008.1.2.4.70";
const root = "1.2.826.0.1.3680043.10.999"; // of nobody

function element(group, number, representation, value) {
  const content = Buffer.isBuffer(value) ? value : Buffer.from(value, "latin1");
  const padding = representation === "UI" || representation === "OB" ? "\0" : " ";
  const bytes = content.length % 2 ? Buffer.concat([content, Buffer.from(padding)]) : content;
  const isLong = representation === "OB" || representation === "OW";
  const head = Buffer.alloc(isLong ? 12 : 8);
  head.writeUInt16LE(group, 0);
  head.writeUInt16LE(number, 2);
  head.write(representation, 4, "latin1");
  if (isLong) {
    head.writeUInt32LE(bytes.length, 8);
  } else {
    head.writeUInt16LE(bytes.length, 6);
  }
  return Buffer.concat([head, bytes]);
}

function short(value) {
  const bytes = Buffer.alloc(2);
  bytes.writeUInt16LE(value);
  return bytes;
}

/** Pixel data of one frame in one fragment, without a table of offsets. */
function encapsulated(fragment) {
  const item = (number, bytes) => {
    const head = Buffer.alloc(8);
    head.writeUInt16LE(0xfffe, 0);
    head.writeUInt16LE(number, 2);
    head.writeUInt32LE(bytes.length, 4);
    return Buffer.concat([head, bytes]);
  };
  const head = element(0x7fe0, 0x10, "OB", Buffer.alloc(0));
  head.writeUInt32LE(0xffffffff, 8);
  const even = Buffer.concat([fragment, Buffer.alloc(fragment.length % 2)]);
  return Buffer.concat([head, item(0xe000, Buffer.alloc(0)), item(0xe000, even), item(0xe0dd, Buffer.alloc(0))]);
}

function fileOf(slice, grid, voxels, isCompressed) {
  const [columns, rows] = grid.size;
  const count = columns * rows;
  const axis = (at) => [0, 1, 2].map((row) => grid.direction[3 * row + at]);
  const position = grid.origin.map((value, row) => value + slice * grid.spacing[2] * axis(2)[row]);
  const instance = `${root}.3.${slice + 1}`;
  const pixels = Buffer.alloc(2 * count);
  for (let voxel = 0; voxel < count; ++voxel) {
    pixels.writeInt16LE(voxels[slice * count + voxel] + 1024, 2 * voxel);
  }
  const meta = Buffer.concat([
    element(2, 1, "OB", Buffer.from([0, 1])),
    element(2, 2, "UI", imageClass),
    element(2, 3, "UI", instance),
    element(2, 0x10, "UI", isCompressed ? jpegLossless : explicitLittleEndian),
    element(2, 0x12, "UI", root),
  ]);
  const length = Buffer.alloc(4);
  length.writeUInt32LE(meta.length);
  return Buffer.concat([
    Buffer.alloc(128),
    Buffer.from("DICM"),
    element(2, 0, "UL", length),
    meta,
    element(8, 0x16, "UI", imageClass),
    element(8, 0x18, "UI", instance),
    element(8, 0x60, "CS", "CT"),
    element(0x10, 0x10, "PN", "Phantom"),
    element(0x10, 0x20, "LO", "1"),
    element(0x18, 0x50, "DS", `${grid.spacing[2]}`),
    element(0x20, 0xd, "UI", `${root}.1`),
    element(0x20, 0xe, "UI", `${root}.2`),
    element(0x20, 0x11, "IS", "1"),
    element(0x20, 0x13, "IS", `${slice + 1}`),
    element(0x20, 0x32, "DS", position.join("\\")),
    element(0x20, 0x37, "DS", [...axis(0), ...axis(1)].join("\\")),
    element(0x20, 0x52, "UI", `${root}.4`),
    element(0x28, 2, "US", short(1)),
    element(0x28, 4, "CS", "MONOCHROME2"),
    element(0x28, 0x10, "US", short(rows)),
    element(0x28, 0x11, "US", short(columns)),
    element(0x28, 0x30, "DS", `${grid.spacing[1]}\\${grid.spacing[0]}`),
    element(0x28, 0x100, "US", short(16)),
    element(0x28, 0x101, "US", short(16)),
    element(0x28, 0x102, "US", short(15)),
    element(0x28, 0x103, "US", short(1)),
    element(0x28, 0x1052, "DS", "-1024"),
    element(0x28, 0x1053, "DS", "1"),
    isCompressed ? encapsulated(losslessJpeg(pixels, columns, rows)) : element(0x7fe0, 0x10, "OW", pixels),
  ]);
}

/** One file for each slice. */
export function dicomFiles(grid, voxels, { isCompressed = false } = {}) {
  return Array.from({ length: grid.size[2] }, (_, slice) => fileOf(slice, grid, voxels, isCompressed));
}
