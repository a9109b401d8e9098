/** The page: what its buttons, keys and files do. */
import {
  FlipFree,
  type Organ,
  type PhantomSeed,
  type Seed,
  type SurfaceFormat,
  countVoxels,
  fillRuns,
  isSinglePrecision,
  labelMapFile,
  roundedSurface,
  surfaceFile,
} from "../flipfree/index.js";
import { button, element, input, select } from "./dom.js";
import { droppedFiles } from "./drop.js";
import { showOrgans } from "./organlist.js";
import { type OrganState, Organs } from "./organs.js";
import { type Session, fileNameOf, parseSession, requireImageOf, sessionFile } from "./session.js";
import { type Tool, View } from "./view.js";
import { type OpenImage, imageOfVoxels, readFiles } from "./volumes.js";
import { type WindowPreset, presetsFor, rangeOf } from "./windows.js";

declare const FLIPFREE_VERSION: string; // of the build

const phantomOrgans = [
  "",
  "spleen",
  "right kidney",
  "left kidney",
  "gallbladder",
  "esophagus",
  "liver",
  "stomach",
  "aorta",
  "inferior vena cava",
  "portal vein",
  "pancreas",
];
const phantomLiver = 6;

const [flipfree, view] = await Promise.all([
  FlipFree.load(),
  View.open(
    element<HTMLCanvasElement>("slices"),
    element<HTMLCanvasElement>("overlay"),
    element<HTMLCanvasElement>("surface"),
  ),
]);

const organs = new Organs();
let opened: OpenImage | null = null;
let ownRange: [number, number] = [0, 1];
let presets: WindowPreset[] = [];
let phantomSeeds: PhantomSeed[] = [];
let running: AbortController | null = null;

// What is said and shown

function say(text: string): void {
  element("status").textContent = text;
  element("error").textContent = "";
}

function complain(error: unknown): void {
  element("status").textContent = "";
  element("error").textContent = error instanceof Error ? error.message : String(error);
  element("error").scrollIntoView({ block: "nearest" });
}

function showProgress(done: number): void {
  input("progress").value = String(done);
}

/** What can be done now. */
function refresh(): void {
  const isBusy = running !== null;
  for (const id of ["open-files", "open-folder", "open-phantom"]) {
    button(id).disabled = isBusy;
  }
  for (const id of ["organ-controls", "seed-controls"]) {
    element<HTMLFieldSetElement>(id).disabled = !opened || isBusy;
  }
  const results = organs.list.filter(({ result }) => result);
  select("window").disabled = !opened;
  button("undo").disabled = !organs.canUndo;
  button("redo").disabled = !organs.canRedo;
  button("run").disabled = isBusy || !organs.chosen.seed;
  button("cancel").disabled = !isBusy;
  button("save-surface").disabled = isBusy || !organs.chosen.result;
  button("save-labels").disabled = isBusy || results.length === 0;
  button("save-session").disabled = isBusy || organs.list.every(({ seed }) => !seed);
  const tool = document.querySelector<HTMLInputElement>("[name=tool]:checked")?.value as Tool;
  view.tool = !opened ? null : isBusy ? "navigate" : tool;
  element("overlay").classList.toggle("placing", view.tool === "seed");
}

function showSeed(seed: Seed | null): void {
  ["seed-x", "seed-y", "seed-z"].forEach((id, axis) => {
    input(id).value = seed ? String(Number(seed.center[axis].toFixed(2))) : "";
  });
  if (seed) {
    input("seed-radius").value = String(Number(seed.radius.toFixed(2)));
  }
}

function rowsOf(result: Organ): [string, string][] {
  const voxel = (opened?.image.spacing ?? [0, 0, 0]).reduce((a, b) => a * b, 1);
  let voxels = 0;
  for (let run = 0; run < result.runs.length; run += 4) {
    voxels += result.runs[run + 3] - result.runs[run + 2];
  }
  return [
    ["Volume", `${((voxels * voxel) / 1000).toFixed(1)} ml`],
    ["Surface", `closed, ${result.selfIntersections} self-intersections`],
    ["Ended", `${result.stopReason}, ${result.iterations.Iteration?.length ?? 0} iterations`],
  ];
}

function showResult(result: Organ | null): void {
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
}

const viewedOrgans = (list: readonly OrganState[] = organs.list) =>
  list.map((organ) => ({
    surface: organ.result?.surface ?? null,
    seed: organ.seed,
    color: organ.color,
    isChosen: organ === organs.chosen,
  }));

/** After any change of the organs. */
function showAll(): void {
  showOrgans(element("organs"), organs, showAll);
  showSeed(organs.chosen.seed);
  showResult(organs.chosen.result);
  if (opened) {
    view.setOrgans(viewedOrgans());
  }
  refresh();
}

// Work that takes time

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
    showProgress(0);
    showAll();
  }
}

function showImage(image: OpenImage): void {
  opened = image;
  organs.reset();
  phantomSeeds = [];
  element("phantom-row").hidden = true;
  element("drop").hidden = true;
  element("image-name").textContent = `${image.title}, ${image.image.size.join(" × ")} voxels`;
  view.show(image);
  ownRange = view.window;
  // Air at about -1000: a CT.
  presets = presetsFor((image.shown.global_min ?? 0) < -500);
  const names = presets.map(({ name, window }, index) => `${index + 1} ${name}${window ? ` ${window[1]}/${window[0]}` : ""}`);
  const custom = new Option("By mouse", "");
  custom.hidden = true;
  select("window").replaceChildren(...names.map((name, index) => new Option(name, String(index))), custom);
  setWindow(0);
}

function setWindow(index: number): void {
  if (opened && presets[index]) {
    select("window").value = String(index);
    view.window = rangeOf(presets[index], ownRange);
  }
}

/** Images, a session, or an image with its session. */
async function openFiles(files: File[]): Promise<void> {
  const isSession = (file: File) => /\.json$/i.test(file.name);
  const session = files.length <= 2 ? files.find(isSession) : undefined;
  const images = files.filter((file) => file !== session);
  if (images.length > 0) {
    await work("Opening …", async () => {
      showImage(await readFiles(images));
      say("Place the seed in the organ.");
    });
  }
  if (session) {
    await work("Opening the session …", async (signal) => {
      await repeat(parseSession(session.name, await session.text()), signal);
    });
  }
}

async function repeat(session: Session, signal: AbortSignal): Promise<void> {
  requireImageOf(session, opened?.image ?? null);
  organs.reset(session.organs);
  showAll();
  for (const organ of organs.list.filter(({ seed }) => seed)) {
    say(`Segmenting ${organ.name} …`);
    await segmentOne(organ, signal);
    showAll();
  }
  if (organs.chosen.seed) {
    view.crosshair = [...organs.chosen.seed.center];
  }
  say("The session is repeated.");
}

async function openPhantom(): Promise<void> {
  await work("Making the abdomen …", async (signal) => {
    const phantom = await flipfree.phantom("abdomen", { signal, onProgress: showProgress });
    // The name that `flipfree phantom abdomen` gives it.
    showImage(await imageOfVoxels("abdomen.nii.gz", "Built-in abdomen", phantom.image));
    phantomSeeds = phantom.seeds;
    const choices = phantom.seeds.map(({ label }) => new Option(phantomOrgans[label] ?? `label ${label}`, String(label)));
    select("phantom-seed").replaceChildren(new Option("choose …", ""), ...choices);
    element("phantom-row").hidden = false;
    view.crosshair = [...(phantom.seeds.find(({ label }) => label === phantomLiver) ?? phantom.seeds[0]).center];
    say("Place the seed in the organ.");
  });
}

async function segmentOne(organ: OrganState, signal: AbortSignal): Promise<void> {
  if (opened && organ.seed) {
    const { preset, parameters } = organ;
    const options = { preset, parameters, signal, onProgress: showProgress };
    organs.find(organ, await flipfree.segment(opened.image, organ.seed, options));
  }
}

async function segment(): Promise<void> {
  if (!opened || !organs.chosen.seed) {
    return;
  }
  await work(`Segmenting ${organs.chosen.name} …`, async (signal) => {
    const start = performance.now();
    performance.mark("flipfree-click");
    await segmentOne(organs.chosen, signal);
    performance.mark("flipfree-found");
    showAll();
    requestAnimationFrame(() => performance.mark("flipfree-shown"));
    say(`Segmented in ${((performance.now() - start) / 1000).toFixed(1)} s.`);
  });
}

// Saving

function save(file: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  say(`Saved ${name}.`);
}

/** What leaves is a valid surface: where the format rounds, the rounded one is checked. */
async function requireValid({ surface }: Organ, format: SurfaceFormat): Promise<void> {
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
    const { name, result } = organs.chosen;
    if (result) {
      await requireValid(result, format);
      save(surfaceFile(result.surface, format), `${fileNameOf(name)}.${format}`);
    }
  });

/** Labels count the organs that have a seed; a voxel in several belongs to the first. The command does the same. */
const saveLabels = () =>
  work("Saving …", async () => {
    if (opened) {
      const voxels = new Uint8Array(countVoxels(opened.image));
      const seeded = organs.list.filter(({ seed }) => seed);
      for (let at = seeded.length - 1; at >= 0; --at) {
        fillRuns(seeded[at].result?.runs ?? new Int32Array(), at + 1, opened.image, voxels);
      }
      save(await labelMapFile({ ...opened.image, voxels }), "organs.nii.gz");
    }
  });

function saveSession(): void {
  if (opened) {
    save(sessionFile(FLIPFREE_VERSION, opened.name, opened.image, organs.list), "session.json");
  }
}

// The seed

/** Another seed: what was found from the former one goes, and undo brings it back. */
function setSeed(seed: Seed): void {
  organs.change(organs.chosen, { seed, result: null });
  say("");
  showAll();
}

function radiusOf(): number {
  const radius = Number(input("seed-radius").value);
  return radius > 0 ? radius : 20;
}

function takeNumbers(): void {
  const center = ["seed-x", "seed-y", "seed-z"].map((id) => input(id).valueAsNumber);
  if (center.every(Number.isFinite)) {
    setSeed({ center: [center[0], center[1], center[2]], radius: input("seed-radius").valueAsNumber || 0 });
    view.crosshair = [center[0], center[1], center[2]];
  }
}

view.onSeed = (seed, placed) => {
  // Clicking without dragging keeps the radius.
  const shown = seed.radius < 1 ? { ...seed, radius: organs.chosen.seed?.radius ?? radiusOf() } : seed;
  if (placed) {
    setSeed(shown);
    say("Seed placed.");
  } else {
    showSeed(shown);
    const dragged = organs.list.map((organ) => (organ === organs.chosen ? { ...organ, seed: shown } : organ));
    view.setSeeds(viewedOrgans(dragged));
  }
};

view.onWindow = () => (select("window").value = "");

// Keys and buttons

function chooseTool(tool: Tool): void {
  const radio = document.querySelector<HTMLInputElement>(`[name=tool][value=${tool}]`);
  if (radio) {
    radio.checked = true;
  }
  refresh();
}

function undo(): void {
  organs.undo();
  showAll();
}

function redo(): void {
  organs.redo();
  showAll();
}

const resize = (by: number) => {
  const { seed } = organs.chosen;
  if (seed) {
    setSeed({ ...seed, radius: Math.max(1, seed.radius + by) });
  }
};

const keys: Record<string, () => void> = {
  s: () => chooseTool("seed"),
  n: () => chooseTool("navigate"),
  c: () => setSeed({ center: view.crosshair, radius: organs.chosen.seed?.radius ?? radiusOf() }),
  "+": () => resize(1),
  "-": () => resize(-1),
  z: () => view.zoomBy(1.25),
  Z: () => view.zoomBy(0.8),
  Enter: () => void segment(),
  ArrowLeft: () => view.moveCrosshair(1, 0, 0), // toward the patient's right, which is on the left
  ArrowRight: () => view.moveCrosshair(-1, 0, 0),
  ArrowUp: () => view.moveCrosshair(0, 1, 0),
  ArrowDown: () => view.moveCrosshair(0, -1, 0),
  PageUp: () => view.moveCrosshair(0, 0, 1),
  PageDown: () => view.moveCrosshair(0, 0, -1),
};
for (let preset = 0; preset < 6; ++preset) {
  keys[String(preset + 1)] = () => setWindow(preset);
}

/** Whether the focused control has a use for the key itself. */
function isTakenBy(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLElement)) {
    return false;
  }
  if (target.matches("button, input[type=radio], input[type=color]")) {
    return key === "Enter" || (target.matches("[type=radio]") && key.startsWith("Arrow"));
  }
  return target.matches("input, select");
}

function takeKey(event: KeyboardEvent): void {
  const isHelpOpen = element<HTMLDialogElement>("keys").open;
  if (event.key === "Escape" && running) {
    running.abort(new Error("Canceled"));
  } else if (!opened || running || isHelpOpen || isTakenBy(event.target, event.key)) {
    return;
  } else if ((event.ctrlKey || event.metaKey) && /^[zy]$/i.test(event.key)) {
    event.preventDefault();
    (event.key === "y" || event.shiftKey ? redo : undo)();
  } else if (!event.ctrlKey && !event.metaKey && keys[event.key]) {
    event.preventDefault();
    event.stopPropagation(); // NiiVue has keys of its own
    keys[event.key]();
  }
}

function listenToFiles(): void {
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
}

function listenToControls(): void {
  select("window").addEventListener("change", () => setWindow(Number(select("window").value)));
  for (const id of ["seed-x", "seed-y", "seed-z", "seed-radius"]) {
    input(id).addEventListener("change", takeNumbers);
  }
  select("phantom-seed").addEventListener("change", () => {
    const chosen = phantomSeeds.find(({ label }) => String(label) === select("phantom-seed").value);
    if (chosen) {
      const { center, radius, label } = chosen;
      organs.change(organs.chosen, { name: phantomOrgans[label], seed: { center, radius }, result: null });
      showAll();
      view.crosshair = [...center];
    }
  });
  document.querySelectorAll("[name=tool]").forEach((tool) => tool.addEventListener("change", refresh));
  const actions: Record<string, () => void> = {
    "add-organ": () => {
      organs.add();
      select("phantom-seed").value = "";
      showAll();
    },
    undo,
    redo,
    run: () => void segment(),
    cancel: () => running?.abort(new Error("Canceled")),
    "save-surface": () => void saveSurface(),
    "save-labels": () => void saveLabels(),
    "save-session": saveSession,
    help: () => element<HTMLDialogElement>("keys").showModal(),
    "close-keys": () => element<HTMLDialogElement>("keys").close(),
    theme: () => setTheme(!document.documentElement.classList.contains("light")),
  };
  for (const [id, action] of Object.entries(actions)) {
    button(id).addEventListener("click", action);
  }
  document.addEventListener("keydown", takeKey, { capture: true });
}

function setTheme(isLight: boolean): void {
  document.documentElement.classList.toggle("light", isLight);
  button("theme").textContent = isLight ? "Dark" : "Light";
}

setTheme(window.matchMedia("(prefers-color-scheme: light)").matches);
listenToFiles();
listenToControls();
showAll();
document.documentElement.dataset.ready = "true";
performance.mark("flipfree-ready");
// Keeps the page's own files, so that it works without a network. Servers other than this machine need HTTPS for it.
void navigator.serviceWorker?.register("offline.js").catch(() => {});
