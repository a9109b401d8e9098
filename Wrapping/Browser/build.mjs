// Bundles the package and the page; build.sh calls it.
//
//   node build.mjs KERNELS PACKAGE PAGE
//
//   KERNELS  folder of flipfree.mjs and flipfree.wasm
//   PACKAGE  where the npm package goes
//   PAGE     where the static page goes
import { createHash } from "node:crypto";
import { cp, mkdir, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const [kernels, packageFolder, page] = process.argv.slice(2).map((folder) => resolve(folder));
const description = JSON.parse(await readFile(join(here, "package.json"), "utf8"));
// The version stands in one place.
const [, version] = (await readFile(join(here, "../../CMakeLists.txt"), "utf8")).match(/VERSION (\d+\.\d+\.\d+)/);

const common = {
  bundle: true,
  format: "esm",
  target: "es2022",
  splitting: true, // what is loaded later, such as a decoder, is a file of its own
  chunkNames: "part-[hash]",
  legalComments: "linked",
  logLevel: "warning",
  define: { FLIPFREE_VERSION: JSON.stringify(version) },
  plugins: [
    {
      name: "kernels",
      setup: ({ onResolve }) => onResolve({ filter: /\/kernels\.mjs$/ }, () => ({ path: join(kernels, "flipfree.mjs") })),
    },
    {
      // A decoder of daikon's asks for them where it runs in Node; it needs neither.
      name: "files of Node",
      setup: ({ onResolve, onLoad }) => {
        onResolve({ filter: /^(fs|path)$/ }, ({ path }) => ({ path, namespace: "nothing" }));
        onLoad({ filter: /./, namespace: "nothing" }, () => ({ contents: "" }));
      },
    },
  ],
};

await rm(packageFolder, { recursive: true, force: true });
await rm(page, { recursive: true, force: true });
await mkdir(packageFolder, { recursive: true });
await build({
  ...common,
  entryPoints: [join(here, "flipfree/index.ts"), join(here, "flipfree/worker.ts"), join(here, "flipfree/engine.ts")],
  outdir: packageFolder,
  platform: "neutral",
  mainFields: ["module", "main"],
});
await build({
  ...common,
  entryPoints: { main: join(here, "page/main.ts"), worker: join(here, "flipfree/worker.ts") },
  outdir: page,
  minify: true,
});

for (const folder of [packageFolder, page]) {
  await cp(join(kernels, "flipfree.wasm"), join(folder, "kernels.wasm"));
  await cp(join(here, "../../LICENSE"), join(folder, "LICENSE"));
}
for (const file of ["index.html", "style.css"]) {
  await cp(join(here, "page", file), join(page, file));
}
// What the service worker keeps.
const files = (await readdir(page, { recursive: true, withFileTypes: true }))
  .filter((entry) => entry.isFile() && !entry.name.startsWith("LICENSE"))
  .map((entry) => relative(page, join(entry.parentPath ?? entry.path, entry.name)))
  .sort();
const hash = createHash("sha256");
for (const file of files) {
  hash.update(await readFile(join(page, file)));
}
const kept = { version: hash.digest("hex").slice(0, 16), files };
await build({
  ...common,
  define: { FLIPFREE_PAGE: JSON.stringify(kept) },
  entryPoints: { offline: join(here, "page/offline.ts") },
  outdir: page,
  format: "iife",
  splitting: false,
  minify: true,
});

// Whoever installs the package needs neither what builds it nor the page.
const { name, license, type } = description;
const published = {
  name,
  version,
  description: description.description,
  license,
  type,
  exports: { ".": { types: "./types/index.d.ts", default: "./index.js" }, "./worker": "./worker.js" },
};
await writeFile(join(packageFolder, "package.json"), `${JSON.stringify(published, null, 2)}\n`);
