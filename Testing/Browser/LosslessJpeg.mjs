// JPEG's lossless process (ITU-T T.81, annex H) for 16 bits, each pixel predicted by its left neighbor.

const categories = 17; // of differences, by their number of bits
const codeBits = 5; // enough for all, and none is all ones

function segment(marker, ...bytes) {
  const length = bytes.length + 2;
  return [0xff, marker, length >> 8, length & 0xff, ...bytes];
}

function words(...numbers) {
  return numbers.flatMap((number) => [number >> 8, number & 0xff]);
}

/** Bits to bytes, the first bit highest, filled up with ones; a zero follows 0xff. */
function packed(bits) {
  const bytes = [];
  for (let at = 0; at < bits.length; at += 8) {
    const byte = parseInt(bits.slice(at, at + 8).padEnd(8, "1"), 2);
    bytes.push(byte, ...(byte === 0xff ? [0] : []));
  }
  return bytes;
}

/** Of little-endian pixels. */
export function losslessJpeg(pixels, columns, rows) {
  const at = (column, row) => pixels.readUInt16LE(2 * (row * columns + column));
  let bits = "";
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const predicted = column > 0 ? at(column - 1, row) : row > 0 ? at(column, row - 1) : 1 << 15;
      const difference = ((at(column, row) - predicted) << 16) >> 16; // modulo 2^16
      const category = difference === 0 ? 0 : 32 - Math.clz32(Math.abs(difference));
      bits += category.toString(2).padStart(codeBits, "0");
      if (category > 0 && category < 16) {
        bits += (difference > 0 ? difference : difference + 2 ** category - 1).toString(2).padStart(category, "0");
      }
    }
  }
  const lengths = Array.from({ length: 16 }, (_, length) => (length + 1 === codeBits ? categories : 0));
  return Buffer.from([
    0xff, 0xd8,
    ...segment(0xc4, 0, ...lengths, ...Array(categories).keys()),
    ...segment(0xc3, 16, ...words(rows, columns), 1, 1, 0x11, 0),
    ...segment(0xda, 1, 1, 0, 1, 0, 0),
    ...packed(bits),
    0xff, 0xd9,
  ]);
}
