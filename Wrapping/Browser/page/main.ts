/** The page: what its buttons and files do. */
import { listenToQuestions } from "./answering.js";
import { organs } from "./app.js";
import { button, element, input, select } from "./dom.js";
import { droppedFiles } from "./drop.js";
import { openFiles, openPhantom, setWindow, takePhantomSeed } from "./images.js";
import { listenToKeys, redo, undo } from "./keys.js";
import { openLabels, takeStartLabel } from "./labelmaps.js";
import { makeLabelSurfaces } from "./labelsurfaces.js";
import { chooseTool, refresh, showAll } from "./panel.js";
import { listenToPlaces } from "./placing.js";
import { listenToPointer } from "./preview.js";
import { segment } from "./runs.js";
import { saveLabelSurfaces, saveLabels, saveSession, saveSurface } from "./saving.js";
import { complain } from "./status.js";
import { cancel } from "./work.js";

function listenToFiles(): void {
  const viewer = element("viewer");
  button("open-files").addEventListener("click", () => input("files").click());
  button("open-folder").addEventListener("click", () => input("folder").click());
  button("open-labels").addEventListener("click", () => input("labels").click());
  button("open-phantom").addEventListener("click", () => void openPhantom());
  for (const id of ["files", "folder", "labels"]) {
    input(id).addEventListener("change", () => {
      const files = [...(input(id).files ?? [])];
      input(id).value = "";
      void (id === "labels" ? openLabels(files) : openFiles(files));
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

function add(kind: "organ" | "vessel"): void {
  organs.add(kind);
  showAll();
  chooseTool(kind === "vessel" ? "point" : "seed");
}

function setTheme(isLight: boolean): void {
  document.documentElement.classList.toggle("light", isLight);
  button("theme").textContent = isLight ? "Dark" : "Light";
}

function listenToControls(): void {
  select("window").addEventListener("change", () => setWindow(Number(select("window").value)));
  select("phantom-seed").addEventListener("change", takePhantomSeed);
  select("start-label").addEventListener("change", takeStartLabel);
  document.querySelectorAll("[name=tool]").forEach((tool) => tool.addEventListener("change", refresh));
  const actions: Record<string, () => void> = {
    "add-organ": () => add("organ"),
    "add-vessel": () => add("vessel"),
    undo,
    redo,
    run: () => void segment(),
    cancel,
    "label-surfaces": () => void makeLabelSurfaces(),
    "save-label-surfaces": () => void saveLabelSurfaces(),
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
}

setTheme(window.matchMedia("(prefers-color-scheme: light)").matches);
listenToFiles();
listenToControls();
listenToPlaces();
listenToQuestions();
listenToPointer();
listenToKeys();
showAll();
document.documentElement.dataset.ready = "true";
performance.mark("flipfree-ready");
// Keeps the page's own files, so that it works without a network. Servers other than this machine need HTTPS for it.
void navigator.serviceWorker?.register("offline.js").catch(() => {});
