/** Folders of DICOM files. The kernels understand them; pako inflates, and daikon decodes compressed pixels. */
import { Inflate } from "pako";
import type { DicomSeries, NamedFile, OpenedVolume, Triple, Voxels } from "./types.js";
import type { Answer, Check } from "./volumefiles.js";

type Report = (fraction: number) => boolean;
type Bytes = (bytes: Uint8Array) => Uint8Array;

interface KernelFolder {
  list(): Answer<{ list: (Omit<DicomSeries, "spacing"> & { spacing: Float64Array | null })[] }>;
  choose(series: string): Answer<{ needsDecoder: boolean }>;
  read(series: string, report: Report): Answer<{
    size: Int32Array;
    spacing: Float64Array;
    origin: Float64Array;
    direction: Float64Array;
    voxels: Voxels;
    series: string;
    warnings: string[];
  }>;
  delete(): void;
}

/** What the kernels say of folders. */
export interface KernelDicom {
  openDicom(
    name: string,
    files: { name: string; bytes: Uint8Array }[],
    inflate: (bytes: Uint8Array, most: number) => Uint8Array,
    decode: Bytes,
    report: Report,
  ): Answer<{ folder: KernelFolder }>;
}

/** As far as it is sound, in whole chunks, and up to about `most` bytes. */
function inflate(bytes: Uint8Array, most: number): Uint8Array {
  const chunks: Uint8Array[] = [];
  let size = 0;
  const stream = new Inflate({ raw: true, chunkSize: 4096 });
  stream.onData = (chunk) => {
    chunks.push(chunk as Uint8Array);
    size += chunks[chunks.length - 1].length;
    if (size >= most) {
      throw new RangeError(); // nothing else stops it
    }
  };
  try {
    stream.push(bytes, true);
  } catch {
    // What there is of it is enough.
  }
  const plain = new Uint8Array(size);
  let end = 0;
  for (const chunk of chunks) {
    plain.set(chunk, end);
    end += chunk.length;
  }
  return plain;
}

/** Large, and needed by few: loaded with the first compressed pixels. */
let daikon: typeof import("daikon").default | undefined;

/** The pixels of a file; none where they are damaged. */
const decode: Bytes = (bytes) => {
  try {
    const image = daikon?.Series.parseImage(new DataView(bytes.slice().buffer));
    return image ? new Uint8Array(image.getRawData()) : new Uint8Array();
  } catch {
    return new Uint8Array();
  }
};

async function withFolder<T>(
  kernels: KernelDicom,
  files: readonly NamedFile[],
  checked: Check,
  report: Report,
  use: (folder: KernelFolder) => T | Promise<T>,
): Promise<T> {
  const read = [];
  for (const { name, data } of files) {
    // Hidden files are not those of a scanner.
    if (!/(^|\/)\.[^/]*$/.test(name)) {
      read.push({ name, bytes: new Uint8Array(await data.arrayBuffer()) });
    }
  }
  const name = files[0]?.name.includes("/") ? files[0].name.slice(0, files[0].name.lastIndexOf("/")) : "the folder";
  const { folder } = checked(kernels.openDicom(name, read, inflate, decode, report));
  try {
    return await use(folder);
  } finally {
    folder.delete();
  }
}

/** What is in a folder. */
export function listSeries(kernels: KernelDicom, files: readonly NamedFile[], checked: Check, report: Report): Promise<DicomSeries[]> {
  return withFolder(kernels, files, checked, report, (folder) =>
    checked(folder.list()).list.map((series) => ({
      ...series,
      spacing: series.spacing && ([...series.spacing] as [number, number, number]),
    })),
  );
}

/** The volume that `series` names, or else the one of most slices. */
export function readSeries(
  kernels: KernelDicom,
  files: readonly NamedFile[],
  series: string,
  checked: Check,
  report: Report,
): Promise<OpenedVolume> {
  return withFolder(kernels, files, checked, report, async (folder) => {
    if (checked(folder.choose(series)).needsDecoder) {
      daikon ??= (await import("daikon")).default;
    }
    const read = checked(folder.read(series, report));
    const triple = (numbers: ArrayLike<number>): Triple => [numbers[0], numbers[1], numbers[2]];
    return {
      name: files[0].name,
      series: read.series,
      image: {
        size: triple(read.size),
        spacing: triple(read.spacing),
        origin: triple(read.origin),
        direction: [...read.direction],
        voxels: read.voxels,
      },
      segments: [],
      warnings: read.warnings,
    };
  });
}
