/** What keys do. */
import { answerChosen, visitNextQuestion } from "./answering.js";
import { app, organs, view } from "./app.js";
import { element } from "./dom.js";
import { setWindow } from "./images.js";
import { makeLabelSurfaces } from "./labelsurfaces.js";
import { chooseTool, showAll } from "./panel.js";
import { placeHere, resizeSeed } from "./placing.js";
import { segment } from "./runs.js";
import { say } from "./status.js";
import { cancel } from "./work.js";

export function undo(): void {
  if (organs.canUndo) {
    organs.undo();
    say("Undone.");
    showAll();
  }
}

export function redo(): void {
  if (organs.canRedo) {
    organs.redo();
    say("Redone.");
    showAll();
  }
}

const keys: Record<string, () => void> = {
  s: () => chooseTool("seed"),
  a: () => chooseTool("further"),
  i: () => chooseTool("inside"),
  o: () => chooseTool("outside"),
  b: () => chooseTool("boundary"),
  p: () => chooseTool("point"),
  v: () => chooseTool("navigate"),
  c: placeHere,
  q: visitNextQuestion,
  y: () => answerChosen(true),
  n: () => answerChosen(false),
  "+": () => resizeSeed(1),
  "-": () => resizeSeed(-1),
  z: () => view.zoomBy(1.25),
  Z: () => view.zoomBy(0.8),
  Enter: () => void (app.opened?.isLabelMap ? makeLabelSurfaces() : segment()),
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
  if (event.key === "Escape" && app.running) {
    cancel();
  } else if (!app.opened || app.running || isHelpOpen || isTakenBy(event.target, event.key)) {
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

export function listenToKeys(): void {
  document.addEventListener("keydown", takeKey, { capture: true });
}
