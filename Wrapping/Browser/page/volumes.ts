/** Files from the local disk as images: NIfTI, NRRD and MetaImage by NiiVue, DICOM by dcm2niix. */
import { NVImage } from "@niivue/niivue";
import { FlipFreeError, type Grid, type Image, affineOf, gridOf } from "../flipfree/index.js";
import type { Voxels } from "../flipfree/index.js";

export interface OpenImage {
  /** Of the file or folder. */
  name: string;
  /** What the page calls it. */
  title: string;
  /** What the kernels get. */
  image: Image;
  /** What is shown. */
  shown: NVImage;
}

const volumeEndings = /\.(nii|nii\.gz|nrrd|mha)$/i;

/** NiiVue shows a volume that is in memory as it shows a NIfTI file. */
export async function imageOfVoxels(name: string, title: string, image: Image): Promise<OpenImage> {
  const codes: Record<string, number> = { Int16Array: 4, Uint8Array: 2, Float32Array: 16, Uint16Array: 512 };
  const file = NVImage.createNiftiArray(
    [...image.size],
    [...image.spacing],
    affineOf(image).flat(),
    codes[image.voxels.constructor.name],
    image.voxels as Int16Array,
  );
  const shown = await NVImage.loadFromUrl({ url: file, name: "volume.nii" });
  return { name, title, image, shown };
}

function scaled(voxels: Voxels, slope: number, intercept: number): Voxels {
  if ((slope === 1 && intercept === 0) || slope === 0 || !Number.isFinite(slope)) {
    return voxels;
  }
  // Whole numbers, such as those of CT scanners, stay so.
  const isWhole = Number.isInteger(slope) && Number.isInteger(intercept) && !(voxels instanceof Float32Array);
  return isWhole && voxels instanceof Int16Array && slope === 1
    ? voxels.map((value) => value + intercept)
    : Float32Array.from(voxels, (value) => value * slope + intercept);
}

function openImageOf(shown: NVImage, name: string, title: string): OpenImage {
  const header = shown.hdr;
  if (!header || !shown.img) {
    throw new FlipFreeError(`${name} has no voxels that this page can read`);
  }
  const [dimensions, ...size] = header.dims;
  if (dimensions > 3 && size.slice(3, dimensions).some((count) => count > 1)) {
    throw new FlipFreeError(`${name} has several volumes or several numbers per voxel; save one of them as a file of its own`);
  }
  const grid: Grid = gridOf([size[0], size[1], Math.max(1, size[2])], header.affine);
  if (![...grid.spacing, ...grid.origin, ...grid.direction].every(Number.isFinite)) {
    throw new FlipFreeError(`${name} does not say where its voxels are; save it with spacing, origin and direction`);
  }
  const count = grid.size[0] * grid.size[1] * grid.size[2];
  if (shown.img.length !== count) {
    throw new FlipFreeError(`${name} has colors or is truncated; a grayscale volume is needed`);
  }
  const voxels = scaled(shown.img as Voxels, header.scl_slope, header.scl_inter);
  return { name, title, image: { ...grid, voxels }, shown };
}

interface Converter {
  init(): Promise<boolean>;
  input(files: File[]): { b(value: string): { run(): Promise<File[]> } };
  worker: Worker;
}

/** DICOM files as NIfTI files, one for each series. */
async function convertDicom(files: File[]): Promise<File[]> {
  // Beside the page's own files; it starts a worker from there.
  const path = "./dcm2niix/index.jpeg.js";
  const { Dcm2niix } = (await import(path)) as { Dcm2niix: new () => Converter };
  const converter = new Dcm2niix();
  await converter.init();
  try {
    const converted = await converter.input(files).b("n").run();
    return converted.filter((file) => file.name.endsWith(".nii"));
  } catch {
    return [];
  } finally {
    converter.worker.terminate();
  }
}

async function readVolume(file: File, name = file.name, title = name): Promise<OpenImage> {
  let shown: NVImage;
  try {
    shown = await NVImage.loadFromFile({ file, name: file.name });
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    throw new FlipFreeError(`${name} cannot be read (${reason}); is the file complete?`);
  }
  return openImageOf(shown, name, title);
}

/** The volume in a file, or the largest series among DICOM files. */
export async function readFiles(files: File[]): Promise<OpenImage> {
  const [first] = files;
  if (files.length === 1 && volumeEndings.test(first.name)) {
    return readVolume(first);
  }
  if (files.length === 1 && /\.(mhd|nhdr|hdr|img|raw)$/i.test(first.name)) {
    throw new FlipFreeError(`${first.name} is only a part of an image; save it as one file (.nii.gz, .nrrd or .mha)`);
  }
  const series = await convertDicom(files);
  if (series.length === 0) {
    const what = files.length === 1 ? first.name : `The ${files.length} files`;
    throw new FlipFreeError(`${what}: no image that this page knows; open NIfTI (.nii, .nii.gz), NRRD (.nrrd), MetaImage (.mha) or DICOM`);
  }
  const largest = series.reduce((a, b) => (b.size > a.size ? b : a));
  const name = first.webkitRelativePath.split("/")[0] || largest.name;
  const more = series.length > 1 ? `, the largest of ${series.length} series` : "";
  return readVolume(largest, name, name + more);
}
