/** Volumes that are one file, or a header and its voxels: NIfTI, NRRD, MetaImage. The kernels understand headers; here bytes are
 * read and inflated. */
import { InflatedFile, isPacked } from "./inflated.js";
import { FlipFreeError, type NamedFile, type OpenedVolume, type Segment, type Triple, type Voxels } from "./types.js";

export type Answer<T> = T & { error?: string; outOfMemory?: boolean };

interface Fields {
  size: Int32Array;
  spacing: Float64Array;
  origin: Float64Array;
  direction: Float64Array;
  type: string;
  voxelBytes: number;
  /** Relative to the header's folder; the header's own file is an empty name. */
  files: string[];
  mayBePacked: boolean;
  form: "raw" | "deflated" | "text" | "hex";
  offset: number;
  lines: number;
  skipped: number;
  isAtEnd: boolean;
  layers: number;
  segments: Segment[];
  warnings: string[];
}

interface KernelFile {
  takePacked(): void;
  checkFiles(names: string[], sizes: number[]): Answer<Fields>;
  decode(stored: Uint8Array): Answer<{ voxels: Voxels }>;
  decodeText(stored: Uint8Array): Answer<{ voxels: Voxels }>;
  delete(): void;
}

/** What the kernels say of files. */
export interface KernelFiles {
  headerBytes: number;
  missingFile: number;
  headerFiles(name: string): string[];
  readHeader(name: string, start: Uint8Array): Answer<Fields & { file: KernelFile }>;
  whyIncomplete(name: string, isBroken: boolean): string;
}

/** What an answer holds, or the error in it. */
export type Check = <T>(answer: Answer<T>) => T;

const voxelsAtATime = 1 << 20;
const arrays = {
  int8: Int8Array,
  uint8: Uint8Array,
  int16: Int16Array,
  uint16: Uint16Array,
  int32: Int32Array,
  uint32: Uint32Array,
  float32: Float32Array,
  float64: Float64Array,
};

/** The file that another one names: with its folder where files have folders, or else by its name alone. */
function besides(files: readonly NamedFile[], header: NamedFile, name: string): NamedFile | undefined {
  const folder = header.name.slice(0, header.name.lastIndexOf("/") + 1);
  return files.find((file) => file.name === folder + name) ?? files.find((file) => file.name === name);
}

const volumeEndings = /\.(nii|nii\.gz|hdr|hdr\.gz|img|img\.gz|nrrd|nhdr|mha|mhd)$/i;

/** Whether a volume is in one of the files, by their names; DICOM files have none that tells. A file alone that is not DICOM can
 * be nothing else. */
export async function hasVolumeFile(files: readonly NamedFile[]): Promise<boolean> {
  if (files.some(({ name }) => volumeEndings.test(name))) {
    return true;
  }
  const mark = files.length === 1 ? await files[0].data.slice(128, 132).text() : "DICM";
  return mark !== "DICM";
}

/** The volume that one of the files is the header of. Throws a FlipFreeError for what is none. */
export async function readVolume(
  kernels: KernelFiles,
  files: readonly NamedFile[],
  checked: Check,
  report: (fraction: number) => boolean,
): Promise<OpenedVolume> {
  const isHeader = ({ name }: NamedFile) => /\.(hdr|hdr\.gz|nhdr|mhd)$/i.test(name);
  const given = files.find(isHeader) ?? files[0];
  const own = kernels.headerFiles(given.name).map((name) => files.find((file) => file.name === name));
  const header = own.find((file) => file !== undefined) ?? given;
  const start = await new InflatedFile(header.data, await isPacked(header.data)).read(kernels.headerBytes);
  const { file, ...fields } = checked(kernels.readHeader(header.name, start));
  try {
    return await readVoxels(kernels, files, header, file, fields, checked, report);
  } finally {
    file.delete();
  }
}

async function readVoxels(
  kernels: KernelFiles,
  files: readonly NamedFile[],
  header: NamedFile,
  file: KernelFile,
  told: Fields,
  checked: Check,
  report: (fraction: number) => boolean,
): Promise<OpenedVolume> {
  const parts = told.files.map((name) =>
    name === "" ? header : besides(files, header, name) ?? (told.mayBePacked ? besides(files, header, `${name}.gz`) : undefined),
  );
  if (told.mayBePacked && parts[0] && (await isPacked(parts[0].data))) {
    file.takePacked();
  }
  const names = parts.map((part, at) => part?.name ?? told.files[at]);
  const sizes = parts.map((part) => part?.data.size ?? kernels.missingFile);
  const fields = checked(file.checkFiles(names, sizes));
  if (fields.layers > 1) {
    throw new FlipFreeError(`${header.name} has ${fields.layers} layers of labels; save each as a file of its own`);
  }
  const size: Triple = [fields.size[0], fields.size[1], fields.size[2]];
  const count = size[0] * size[1] * size[2];
  const makeArray = arrays[fields.type as keyof typeof arrays];
  if (!makeArray) {
    throw new FlipFreeError(`${header.name} has voxels of 64-bit integers, for which a browser has no numbers; save them with 32 bits`);
  }
  const voxels = new makeArray(count);
  const ofFile = count / parts.length;
  let done = 0;
  for (const part of parts as NamedFile[]) {
    const begin = fields.isAtEnd ? Math.max(0, part.data.size - ofFile * fields.voxelBytes) : fields.offset;
    const stored = new InflatedFile(part.data.slice(begin), fields.form === "deflated");
    await stored.skipLines(fields.lines);
    await stored.skip(fields.skipped);
    if (fields.form === "text" || fields.form === "hex") {
      voxels.set(checked(file.decodeText(await stored.rest())).voxels);
      break;
    }
    for (let first = 0; first < ofFile; first += voxelsAtATime) {
      const wanted = Math.min(voxelsAtATime, ofFile - first) * fields.voxelBytes;
      const bytes = await stored.read(wanted);
      if (bytes.length < wanted) {
        throw new FlipFreeError(kernels.whyIncomplete(header.name, !(await stored.endsProperly())));
      }
      voxels.set(checked(file.decode(bytes)).voxels, done + first);
      report((done + first) / count);
    }
    if (!(await stored.endsProperly())) {
      throw new FlipFreeError(kernels.whyIncomplete(header.name, true));
    }
    done += ofFile;
  }
  const [spacing, origin, direction] = [fields.spacing, fields.origin, fields.direction].map((numbers) => [...numbers]);
  return {
    name: header.name,
    image: { size, spacing: spacing as [number, number, number], origin: origin as [number, number, number], direction, voxels },
    segments: fields.segments,
    warnings: fields.warnings,
  };
}
