/** Opening: images, sessions, the built-in phantom; and how gray values are shown. */
import { app, flipfree, organs, view } from "./app.js";
import { element, select } from "./dom.js";
import { takeIfLabels, takeLabelMap } from "./labelmaps.js";
import { chooseTool, showAll } from "./panel.js";
import { repeat } from "./runs.js";
import { parseSession } from "./session.js";
import { say, showProgress } from "./status.js";
import { type OpenImage, imageOfVoxels, readFiles } from "./volumes.js";
import { type WindowPreset, presetsFor, rangeOf } from "./windows.js";
import { work } from "./work.js";

const phantomLiver = 6;

let ownRange: [number, number] = [0, 1];
let presets: WindowPreset[] = [];

export function showImage(image: OpenImage): void {
  app.opened = image;
  organs.reset();
  chooseTool("seed");
  app.labels = null;
  app.labelSurfaces = [];
  app.phantomSeeds = [];
  element("phantom-row").hidden = true;
  element("labels-row").hidden = true;
  element("drop").hidden = true;
  element("image-name").textContent = `${image.title}, ${image.image.size.join(" × ")} voxels`;
  // Air at about -1000: a CT.
  presets = presetsFor((image.shown.global_min ?? 0) < -500);
  ownRange = [image.shown.cal_min ?? 0, image.shown.cal_max ?? 1];
  const names = presets.map(({ name, window }, index) => `${index + 1} ${name}${window ? ` ${window[1]}/${window[0]}` : ""}`);
  const custom = new Option("By mouse", "");
  custom.hidden = true;
  select("window").replaceChildren(...names.map((name, index) => new Option(name, String(index))), custom);
  select("window").value = "0";
  view.show(image, rangeOf(presets[0], ownRange));
}

export function setWindow(index: number): void {
  if (app.opened && presets[index]) {
    select("window").value = String(index);
    view.window = rangeOf(presets[index], ownRange);
  }
}

/** Images, a label map that names its labels, a session, or an image with its session. */
export async function openFiles(files: File[]): Promise<void> {
  const isSession = (file: File) => /\.json$/i.test(file.name);
  const session = files.length <= 2 ? files.find(isSession) : undefined;
  const images = files.filter((file) => file !== session);
  if (images.length > 0) {
    await work("Opening …", async () => {
      const opened = await readFiles(images);
      if (opened.segments.length > 0) {
        await takeLabelMap(opened, true);
        return;
      }
      showImage(opened);
      const orSurfaces = takeIfLabels(opened) ? "; or, if these are labels, make Label surfaces" : "";
      say([`Place the seed in the organ${orSurfaces}.`, ...opened.warnings].join(" "));
    });
  }
  if (session) {
    await work("Opening the session …", async (signal) => {
      await repeat(parseSession(session.name, await session.text()), signal);
    });
  }
}

export async function openPhantom(): Promise<void> {
  await work("Making the abdomen …", async (signal) => {
    const phantom = await flipfree.phantom("abdomen", { signal, onProgress: showProgress });
    // The name that `flipfree phantom abdomen` gives it.
    showImage(await imageOfVoxels("abdomen.nii.gz", "Built-in abdomen", phantom.image));
    app.phantomSeeds = phantom.seeds;
    const choices = phantom.seeds.map(({ name, label }) => new Option(name, String(label)));
    select("phantom-seed").replaceChildren(new Option("choose …", ""), ...choices);
    element("phantom-row").hidden = false;
    view.crosshair = [...(phantom.seeds.find(({ label }) => label === phantomLiver) ?? phantom.seeds[0]).center];
    say("Place the seed in the organ.");
  });
}

/** The seed of one of the phantom's organs; points of another one go. */
export function takePhantomSeed(): void {
  const chosen = app.phantomSeeds.find(({ label }) => String(label) === select("phantom-seed").value);
  if (chosen) {
    const { center, radius, name } = chosen;
    const seed = { center, radius };
    organs.change(organs.chosen, { name, seed, start: null, corrections: [], result: null });
    showAll();
    view.crosshair = [...center];
  }
}
