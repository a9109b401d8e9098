// What the browser's tests share: files of the command read as numbers, and runs of it.
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";

export const seed = { center: [99.75, 83.75, 167], radius: 28 }; // in the built-in abdomen's liver
export const liverLabel = 6;

/** Runs the native command; returns what it prints. */
export function command(folder, ...words) {
  const run = spawnSync(process.env.FLIPFREE_COMMAND, words, { cwd: folder, encoding: "utf8" });
  if (run.status !== 0) {
    throw new Error(`flipfree ${words.join(" ")}: ${run.stderr}`);
  }
  return run.stdout;
}

/** The seeds that `flipfree phantom` prints. */
export function seedsOf(printed) {
  return [...printed.matchAll(/--seed (\S+) (\S+) (\S+) --radius (\S+)/g)].map(([, x, y, z, radius]) => ({
    center: [x, y, z].map(Number),
    radius: Number(radius),
  }));
}

const types = { 2: Uint8Array, 4: Int16Array, 16: Float32Array, 512: Uint16Array };

/** The voxels of a little-endian NIfTI-1 file. */
export function readNifti(data) {
  const bytes = data[0] === 0x1f ? gunzipSync(data) : data;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const size = [0, 1, 2].map((axis) => view.getInt16(42 + 2 * axis, true));
  const spacing = [0, 1, 2].map((axis) => view.getFloat32(80 + 4 * axis, true));
  const start = bytes.byteOffset + view.getFloat32(108, true);
  const Type = types[view.getInt16(70, true)];
  const count = size[0] * size[1] * size[2];
  return { size, spacing, voxels: new Type(bytes.buffer.slice(start, start + count * Type.BYTES_PER_ELEMENT)) };
}

export function readNiftiFile(path) {
  return readNifti(readFileSync(path));
}

/** The vertices of a binary little-endian PLY file with nothing but x, y and z. */
export function readPlyPoints(path) {
  const bytes = readFileSync(path);
  const header = bytes.subarray(0, bytes.indexOf("end_header\n")).toString();
  const count = Number(header.match(/element vertex (\d+)/)[1]);
  const start = bytes.byteOffset + bytes.indexOf("end_header\n") + "end_header\n".length;
  return new Float32Array(bytes.buffer.slice(start, start + 12 * count));
}

/** The field data of a VTP file as VTK reads them: lists of numbers, or of texts. */
export function fieldDataOf(path) {
  const script = `
import json, sys
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
reader = vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
fields = reader.GetOutput().GetFieldData()
arrays = [fields.GetAbstractArray(index) for index in range(fields.GetNumberOfArrays())]
value = lambda array, at: array.GetValue(at) if array.IsA("vtkStringArray") else array.GetTuple1(at)
print(json.dumps({array.GetName(): [value(array, at) for at in range(array.GetNumberOfTuples())] for array in arrays}))`;
  const run = spawnSync(process.env.FLIPFREE_PYTHON, ["-c", script, path], { encoding: "utf8" });
  if (run.status !== 0) {
    throw new Error(`${path}: ${run.stderr}`);
  }
  return JSON.parse(run.stdout);
}

export function dice(a, b) {
  let inA = 0;
  let inB = 0;
  let inBoth = 0;
  for (let voxel = 0; voxel < a.length; ++voxel) {
    inA += a[voxel] !== 0;
    inB += b[voxel] !== 0;
    inBoth += a[voxel] !== 0 && b[voxel] !== 0;
  }
  return (2 * inBoth) / (inA + inB);
}
