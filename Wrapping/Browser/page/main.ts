/** The page: what its buttons, keys and files do. */
import {
  FlipFree,
  type Organ,
  type Parameters,
  type PhantomSeed,
  type Seed,
  type Surface,
  type SurfaceFormat,
  countVoxels,
  fillRuns,
  isSinglePrecision,
  labelMapFile,
  roundedSurface,
  surfaceFile,
} from "../flipfree/index.js";
import { type SessionOrgan, parseSession, sessionFile } from "./session.js";
import { View } from "./view.js";
import { type OpenImage, imageOfVoxels, readFiles } from "./volumes.js";

declare const FLIPFREE_VERSION: string; // of the build

/** An organ as it is worked on. */
interface OrganState extends SessionOrgan {
  result: Organ | null;
}

interface Preset {
  name: string;
  /** Level and width, in Hounsfield units; of the image itself if there are none. */
  window?: [number, number];
}

const windows: Preset[] = [
  { name: "Full range" },
  { name: "Abdomen", window: [40, 400] },
  { name: "Liver", window: [80, 150] },
  { name: "Lung", window: [-600, 1500] },
  { name: "Bone", window: [400, 1800] },
  { name: "Mediastinum", window: [50, 350] },
];

const phantomOrgans = [
  "",
  "Spleen",
  "Right kidney",
  "Left kidney",
  "Gallbladder",
  "Esophagus",
  "Liver",
  "Stomach",
  "Aorta",
  "Inferior vena cava",
  "Portal vein",
  "Pancreas",
];
const phantomLiver = 6;

function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) {
    throw new Error(id);
  }
  return found as T;
}

const button = (id: string) => element<HTMLButtonElement>(id);
const input = (id: string) => element<HTMLInputElement>(id);
const select = (id: string) => element<HTMLSelectElement>(id);

function newOrgan(): OrganState {
  return { name: "organ", color: "#ffd24a", seed: null, preset: "default", parameters: {}, result: null };
}

const [flipfree, view] = await Promise.all([
  FlipFree.load(),
  View.open(
    element<HTMLCanvasElement>("slices"),
    element<HTMLCanvasElement>("overlay"),
    element<HTMLCanvasElement>("surface"),
  ),
]);

let opened: OpenImage | null = null;
let fullRange: [number, number] = [0, 1];
let phantomSeeds: PhantomSeed[] = [];
// One for now; everything that is kept of it is in here.
let organ = newOrgan();
let running: AbortController | null = null;

function say(text: string): void {
  element("status").textContent = text;
  element("error").textContent = "";
}

function complain(error: unknown): void {
  element("status").textContent = "";
  element("error").textContent = error instanceof Error ? error.message : String(error);
}

/** Runs work that a button or key starts: one at a time, and what goes wrong is said. */
async function work(text: string, run: (signal: AbortSignal) => Promise<void>): Promise<void> {
  if (running) {
    return;
  }
  const mine = new AbortController();
  running = mine;
  say(text);
  refresh();
  try {
    await run(mine.signal);
  } catch (error) {
    if (mine.signal.aborted) {
      say("Canceled.");
    } else {
      complain(error);
    }
  } finally {
    running = null;
    input("progress").value = "0";
    refresh();
  }
}

/** What can be done now. */
function refresh(): void {
  const isBusy = running !== null;
  for (const id of ["open-files", "open-folder", "open-phantom"]) {
    button(id).disabled = isBusy;
  }
  for (const id of ["seed-controls", "run-controls"]) {
    element<HTMLFieldSetElement>(id).disabled = !opened;
  }
  select("window").disabled = !opened;
  button("run").disabled = isBusy || !organ.seed;
  button("cancel").disabled = !isBusy;
  element<HTMLFieldSetElement>("result-controls").disabled = isBusy || !organ.result;
  button("save-session").disabled = !opened;
  view.placing = opened !== null && !isBusy && document.querySelector<HTMLInputElement>("[name=tool]:checked")?.value === "seed";
}

function showSeed(): void {
  const numbers = organ.seed ? [...organ.seed.center, organ.seed.radius] : [];
  ["seed-x", "seed-y", "seed-z", "seed-radius"].forEach((id, at) => {
    if (at < numbers.length || at < 3) {
      input(id).value = at < numbers.length ? numbers[at].toFixed(1) : "";
    }
  });
  view.setSeed(organ.seed, organ.color);
  refresh();
}

function setSeed(seed: Seed | null): void {
  organ.seed = seed;
  showSeed();
}

function rowsOf(result: Organ): [string, string][] {
  const voxel = (opened?.image.spacing ?? [0, 0, 0]).reduce((a, b) => a * b, 1);
  let voxels = 0;
  for (let run = 0; run < result.runs.length; run += 4) {
    voxels += result.runs[run + 3] - result.runs[run + 2];
  }
  return [
    ["Volume", `${((voxels * voxel) / 1000).toFixed(1)} ml`],
    ["Ended", `${result.stopReason}, after ${result.iterations.Iteration?.length ?? 0} iterations`],
    ["Surface", `${result.surface.points.length / 3} vertices, closed`],
    ["Self-intersections", `${result.selfIntersections}`],
  ];
}

function showResult(): void {
  const { result } = organ;
  const cells = (result ? rowsOf(result) : []).flatMap(([name, value]) => {
    const term = document.createElement("dt");
    const text = document.createElement("dd");
    term.textContent = name;
    text.textContent = value;
    return [term, text];
  });
  element("result").replaceChildren(...cells);
  const warnings = (result?.warnings ?? []).map((warning) => {
    const item = document.createElement("li");
    item.textContent = warning;
    return item;
  });
  element("warnings").replaceChildren(...warnings);
  view.setSurfaces(result ? [{ surface: result.surface, color: organ.color }] : []);
  refresh();
}

function showImage(image: OpenImage): void {
  opened = image;
  organ = newOrgan();
  phantomSeeds = [];
  element("phantom-row").hidden = true;
  element("drop").hidden = true;
  element("image-name").textContent = `${image.name}, ${image.image.size.join(" × ")} voxels`;
  view.show(image);
  fullRange = view.window;
  // Air at about -1000: a CT.
  const isCT = (image.shown.robust_min ?? 0) < -500 || (image.shown.global_min ?? 0) < -500;
  setWindow(isCT ? 1 : 0);
  showSeed();
  showResult();
}

function setWindow(index: number): void {
  const preset = windows[index];
  if (opened && preset) {
    select("window").value = String(index);
    const { window } = preset;
    view.window = window ? [window[0] - window[1] / 2, window[0] + window[1] / 2] : fullRange;
  }
}

async function openFiles(files: File[]): Promise<void> {
  if (files.length === 1 && /\.json$/i.test(files[0].name)) {
    await work("Opening the session …", async () => openSession(files[0].name, await files[0].text()));
  } else if (files.length > 0) {
    await work("Opening …", async () => {
      showImage(await readFiles(files));
      say("Place the seed in the organ.");
    });
  }
}

function openSession(name: string, text: string): void {
  const session = parseSession(name, text);
  const [first] = session.organs;
  if (!opened || opened.image.size.join() !== session.image.size.join()) {
    throw new Error(`Open the session's image first: ${session.image.name}`);
  }
  organ = { ...newOrgan(), ...first, result: null };
  showSeed();
  showResult();
  if (organ.seed) {
    view.crosshair = [...organ.seed.center];
  }
  say(`Session of ${session.image.name}.`);
}

async function openPhantom(): Promise<void> {
  await work("Making the abdomen …", async (signal) => {
    const phantom = await flipfree.phantom("abdomen", { signal, onProgress: (done) => (input("progress").value = String(done)) });
    showImage(await imageOfVoxels("Built-in abdomen", phantom.image));
    phantomSeeds = phantom.seeds;
    const choices = phantom.seeds.map(({ label }) => new Option(phantomOrgans[label] ?? `label ${label}`, String(label)));
    select("phantom-seed").replaceChildren(new Option("choose …", ""), ...choices);
    element("phantom-row").hidden = false;
    view.crosshair = [...(phantom.seeds.find(({ label }) => label === phantomLiver) ?? phantom.seeds[0]).center];
    say("Place the seed in the organ.");
  });
}

async function segment(): Promise<void> {
  const { seed } = organ;
  const image = opened?.image;
  if (!image || !seed) {
    return;
  }
  const mine = organ;
  await work("Segmenting …", async (signal) => {
    mine.result = null;
    showResult();
    const start = performance.now();
    const parameters: Parameters = mine.parameters;
    mine.result = await flipfree.segment(image, seed, {
      preset: mine.preset,
      parameters,
      signal,
      onProgress: (done) => (input("progress").value = String(done)),
    });
    showResult();
    say(`Segmented in ${((performance.now() - start) / 1000).toFixed(1)} s.`);
  });
}

function save(file: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  say(`Saved ${name}.`);
}

/** What leaves is a valid surface: where the format rounds, the rounded one is checked. */
async function requireValid(surface: Surface, format: SurfaceFormat): Promise<void> {
  if (format !== "vtp" && !isSinglePrecision(surface)) {
    const pairs = await flipfree.selfIntersections(roundedSurface(surface));
    if (pairs > 0) {
      throw new Error(`${format.toUpperCase()} rounds the vertices, and the surface would intersect itself (${pairs} pairs of faces); save it as VTP`);
    }
  }
}

const saveSurface = () =>
  work("Saving …", async () => {
    const format = select("surface-format").value as SurfaceFormat;
    if (organ.result) {
      await requireValid(organ.result.surface, format);
      save(surfaceFile(organ.result.surface, format), `${organ.name}.${format}`);
    }
  });

const saveLabels = () =>
  work("Saving …", async () => {
    if (opened && organ.result) {
      const voxels = new Uint8Array(countVoxels(opened.image));
      fillRuns(organ.result.runs, 1, opened.image, voxels);
      save(await labelMapFile({ ...opened.image, voxels }), `${organ.name}.nii.gz`);
    }
  });

function saveSession(): void {
  if (opened) {
    const { name, color, seed, preset, parameters } = organ;
    const organs = [{ name, color, seed, preset, parameters }];
    save(sessionFile(FLIPFREE_VERSION, opened.name, opened.image, organs), "session.json");
  }
}

function chooseTool(tool: "seed" | "navigate"): void {
  const radio = document.querySelector<HTMLInputElement>(`[name=tool][value=${tool}]`);
  if (radio) {
    radio.checked = true;
  }
  refresh();
}

function radiusOf(): number {
  const radius = Number(input("seed-radius").value);
  return radius > 0 ? radius : 20;
}

/** Clicking without dragging keeps the radius. */
view.onSeed = (seed, placed) => {
  const isClick = seed.radius < 1;
  setSeed(isClick ? { ...seed, radius: organ.seed?.radius ?? radiusOf() } : seed);
  if (placed) {
    say("Seed placed.");
  }
};

const keys: Record<string, () => void> = {
  s: () => chooseTool("seed"),
  n: () => chooseTool("navigate"),
  c: () => setSeed({ center: view.crosshair, radius: organ.seed?.radius ?? radiusOf() }),
  "+": () => organ.seed && setSeed({ ...organ.seed, radius: organ.seed.radius + 1 }),
  "-": () => organ.seed && setSeed({ ...organ.seed, radius: Math.max(1, organ.seed.radius - 1) }),
  Enter: () => void segment(),
  ArrowLeft: () => view.moveCrosshair(1, 0, 0),
  ArrowRight: () => view.moveCrosshair(-1, 0, 0),
  ArrowUp: () => view.moveCrosshair(0, 1, 0),
  ArrowDown: () => view.moveCrosshair(0, -1, 0),
  PageUp: () => view.moveCrosshair(0, 0, 1),
  PageDown: () => view.moveCrosshair(0, 0, -1),
};
windows.forEach((_, index) => (keys[String(index + 1)] = () => setWindow(index)));

document.addEventListener(
  "keydown",
  (event) => {
    const isTyping = event.target instanceof HTMLElement && event.target.closest("input:not([type=radio]), select, button");
    if (event.key === "Escape") {
      running?.abort(new Error("Canceled"));
    } else if (!isTyping && opened && !running && !event.ctrlKey && !event.metaKey && keys[event.key]) {
      event.preventDefault();
      event.stopPropagation();
      keys[event.key]();
    }
  },
  { capture: true },
);

function takeNumbers(): void {
  const center = ["seed-x", "seed-y", "seed-z"].map((id) => input(id).valueAsNumber);
  if (center.every(Number.isFinite)) {
    organ.seed = { center: [center[0], center[1], center[2]], radius: input("seed-radius").valueAsNumber };
    view.setSeed(organ.seed, organ.color);
    refresh();
  }
}

/** The files of a drop, those in folders, too. */
async function droppedFiles(items: DataTransferItemList): Promise<File[]> {
  const entries = [...items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  const filesOf = async (entry: FileSystemEntry): Promise<File[]> => {
    if (entry.isFile) {
      return [await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject))];
    }
    const reader = (entry as FileSystemDirectoryEntry).createReader();
    const found: FileSystemEntry[] = [];
    for (;;) {
      const more = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
      if (more.length === 0) {
        break;
      }
      found.push(...more);
    }
    return (await Promise.all(found.map(filesOf))).flat();
  };
  return (await Promise.all(entries.map(filesOf))).flat();
}

function listen(): void {
  const viewer = element("viewer");
  button("open-files").addEventListener("click", () => input("files").click());
  button("open-folder").addEventListener("click", () => input("folder").click());
  button("open-phantom").addEventListener("click", () => void openPhantom());
  for (const id of ["files", "folder"]) {
    input(id).addEventListener("change", () => {
      const files = [...(input(id).files ?? [])];
      input(id).value = "";
      void openFiles(files);
    });
  }
  document.addEventListener("dragover", (event) => {
    event.preventDefault();
    viewer.classList.add("dropping");
  });
  document.addEventListener("dragleave", () => viewer.classList.remove("dropping"));
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    viewer.classList.remove("dropping");
    const { dataTransfer } = event;
    if (dataTransfer) {
      void droppedFiles(dataTransfer.items).then(openFiles, complain);
    }
  });
  select("window").replaceChildren(...windows.map(({ name }, index) => new Option(`${index + 1} ${name}`, String(index))));
  select("window").addEventListener("change", () => setWindow(Number(select("window").value)));
  for (const id of ["seed-x", "seed-y", "seed-z", "seed-radius"]) {
    input(id).addEventListener("change", takeNumbers);
  }
  select("phantom-seed").addEventListener("change", () => {
    const chosen = phantomSeeds.find(({ label }) => String(label) === select("phantom-seed").value);
    if (chosen) {
      setSeed({ center: chosen.center, radius: chosen.radius });
      view.crosshair = [...chosen.center];
    }
  });
  document.querySelectorAll("[name=tool]").forEach((tool) => tool.addEventListener("change", refresh));
  button("run").addEventListener("click", () => void segment());
  button("cancel").addEventListener("click", () => running?.abort(new Error("Canceled")));
  button("save-surface").addEventListener("click", () => void saveSurface());
  button("save-labels").addEventListener("click", () => void saveLabels());
  button("save-session").addEventListener("click", saveSession);
  button("help").addEventListener("click", () => {
    element("keys").hidden = !element("keys").hidden;
    button("help").setAttribute("aria-expanded", String(!element("keys").hidden));
  });
  button("theme").addEventListener("click", () => setTheme(!document.documentElement.classList.contains("light")));
}

function setTheme(isLight: boolean): void {
  document.documentElement.classList.toggle("light", isLight);
  button("theme").setAttribute("aria-pressed", String(isLight));
}

setTheme(window.matchMedia("(prefers-color-scheme: light)").matches);
listen();
refresh();
document.documentElement.dataset.ready = "true";
