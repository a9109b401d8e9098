/** Files from the local disk as images: NIfTI, NRRD and MetaImage by the kernels, DICOM by dcm2niix. */
import { NVImage } from "@niivue/niivue";
import { FlipFreeError, type Image, type Voxels, affineOf } from "../flipfree/index.js";
import { flipfree } from "./app.js";

export interface OpenImage {
  /** Of the file or folder. */
  name: string;
  /** What the page calls it. */
  title: string;
  /** What the kernels get. */
  image: Image;
  /** What is shown. */
  shown: NVImage;
  /** Of the file: what it does not say, or says twice. */
  warnings: string[];
}

const volumeEndings = /\.(nii|nii\.gz|hdr|hdr\.gz|img|img\.gz|nrrd|nhdr|mha|mhd)$/i;

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
  return { name, title, image, shown, warnings: [] };
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

/** What NiiVue shows; it has no other types of voxels. */
const shownTypes = [Uint8Array, Int16Array, Float32Array, Uint16Array] as const;

function shownVoxels(voxels: Voxels): Voxels {
  return shownTypes.some((type) => voxels instanceof type) ? voxels : Float32Array.from(voxels);
}

async function readVolume(files: File[], title?: string): Promise<OpenImage> {
  const named = files.map((file) => ({ name: file.webkitRelativePath || file.name, data: file }));
  const { name, image, warnings } = await flipfree.readVolume(named);
  const opened = await imageOfVoxels(title ?? name, title ?? name, { ...image, voxels: shownVoxels(image.voxels) });
  return { ...opened, image, warnings };
}

/** The volume in a file, or the largest series among DICOM files. */
export async function readFiles(files: File[]): Promise<OpenImage> {
  if (files.some((file) => volumeEndings.test(file.name))) {
    return readVolume(files);
  }
  const [first] = files;
  const series = await convertDicom(files);
  if (series.length === 0) {
    const what = files.length === 1 ? first.name : `The ${files.length} files`;
    throw new FlipFreeError(`${what}: no image that this page knows; open NIfTI (.nii, .nii.gz), NRRD (.nrrd), MetaImage (.mha) or DICOM`);
  }
  const largest = series.reduce((a, b) => (b.size > a.size ? b : a));
  const name = first.webkitRelativePath.split("/")[0] || largest.name;
  const more = series.length > 1 ? `, the largest of ${series.length} series` : "";
  const opened = await readVolume([largest], name);
  return { ...opened, title: name + more };
}
