/** Files from the local disk as images: understood by the kernels, shown by NiiVue. */
import { NVImage } from "@niivue/niivue";
import { type Image, type Segment, type Voxels, affineOf } from "../flipfree/index.js";
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
  /** Of DICOM. */
  series?: string;
  /** Of a label map, where the file names its labels. */
  segments: Segment[];
  /** Whether it was opened as a label map: there is nothing to segment. */
  isLabelMap: boolean;
  /** Of the file: what it does not say, or says twice. */
  warnings: string[];
}

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
  return { name, title, image, shown, segments: [], isLabelMap: false, warnings: [] };
}

/** What NiiVue shows; it has no other types of voxels. */
const shownTypes = [Uint8Array, Int16Array, Float32Array, Uint16Array] as const;

function shownVoxels(voxels: Voxels): Voxels {
  return shownTypes.some((type) => voxels instanceof type) ? voxels : Float32Array.from(voxels);
}

/** The volume in a file, or the largest series among DICOM files. */
export async function readFiles(files: File[]): Promise<OpenImage> {
  const named = files.map((file) => ({ name: file.webkitRelativePath || file.name, data: file }));
  const { name: file, series, image, segments, warnings } = await flipfree.readVolume(named);
  const name = series === undefined ? file : file.split("/")[0];
  const title = series === undefined ? name : `${name}, series ${series}`;
  const opened = await imageOfVoxels(name, title, { ...image, voxels: shownVoxels(image.voxels) });
  return { ...opened, image, series, segments, warnings };
}
