// Writes the types of the parameters, which the kernels' tables name; build.sh calls it.
//
//   node types.mjs KERNELS FILE
//
//   KERNELS  folder of flipfree.mjs and flipfree.wasm
//   FILE     what is written (flipfree/parametertypes.ts)
import { readFile, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, file] = process.argv.slice(2).map((path) => resolve(path));
const { default: factory } = await import(pathToFileURL(join(folder, "flipfree.mjs")).href);
const program = await WebAssembly.compile(await readFile(join(folder, "flipfree.wasm")));
const kernels = await factory({
  instantiateWasm(imports, done) {
    WebAssembly.instantiate(program, imports).then(done);
    return {};
  },
});

function typeOf({ type, values: { length } }) {
  const one = type === "boolean" ? "boolean" : "number";
  return length === 1 ? one : `readonly [${Array(length).fill(one).join(", ")}]`;
}

function typesOf(title, what, list) {
  const lines = list.map((entry) => `  ${entry.name.charAt(0).toLowerCase()}${entry.name.slice(1)}?: ${typeOf(entry)};\n`);
  return `\n/** ${what}; defaults stand where none is given. */\nexport type ${title} = {\n${lines.join("")}};\n`;
}

await writeFile(
  file,
  "// Written by types.mjs from the kernels' tables.\n" +
    typesOf("SegmentationParameters", "Of an organ's segmentation", kernels.segmentationParameters("default")) +
    typesOf("VesselParameters", "Of a vessel's", kernels.vesselParameters()) +
    typesOf("LabelSurfaceParameters", "Of the surfaces of a label map's labels", kernels.labelSurfaceParameters()) +
    typesOf("ScoreParameters", "Of a comparison with a reference", kernels.scoreParameters()) +
    typesOf("PhantomParameters", "Of a phantom", kernels.phantomParameters().filter(({ name }) => name !== "Shape")),
);
