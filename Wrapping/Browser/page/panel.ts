/** The panel and the slices after a change: what is there, and what can be done now. */
import { type Seed, isOrgan } from "../flipfree/index.js";
import { app, organs, view } from "./app.js";
import { button, element, input, select } from "./dom.js";
import { showLabels } from "./labellist.js";
import { viewedLabels } from "./labelsurfaces.js";
import type { ViewedOrgan } from "./marks.js";
import { showOrgans } from "./organlist.js";
import { type OrganState, canRepeat, canRun } from "./organs.js";
import { showPoints } from "./pointlist.js";
import { chosenQuestionOf, questionsOf, showQuestions } from "./questions.js";
import { showResult } from "./result.js";
import type { Tool } from "./view.js";

const hints: Record<Tool, string> = {
  seed: "Click in the organ, drag to its boundary. Keep vessels and other organs out of the circle, in all three slices.",
  further: "Click where the organ was missed, drag to its boundary.",
  inside: "Click or paint where the organ was missed.",
  outside: "Click or paint where it took in too much.",
  boundary: "Click on the organ's boundary.",
  point: "Click at both ends and, where the vessel winds, in between.",
  navigate: "Click to move the cross-hair.",
};

const radioOf = (tool: Tool) => document.querySelector<HTMLInputElement>(`[name=tool][value=${tool}]`)!;

/** What the left button does for the chosen organ. */
export function chosenTool(): Tool {
  return document.querySelector<HTMLInputElement>("[name=tool]:checked")!.value as Tool;
}

function canUse(tool: Tool): boolean {
  const { kind } = organs.chosen;
  if (tool === "navigate" || app.opened?.isLabelMap) {
    return tool === "navigate";
  }
  return kind === "vessel" ? tool === "point" : tool === "seed" || (tool !== "point" && canRun(organs.chosen));
}

export function chooseTool(tool: Tool): void {
  if (canUse(tool)) {
    radioOf(tool).checked = true;
  }
  refresh();
}

/** Once there is a result, a stray click must not take it away: it would place another seed. */
export function leaveSeedTool(): void {
  if (chosenTool() === "seed") {
    chooseTool("navigate");
  }
}

/** What a click does: what the tool is for, or what it would do where the pointer is. */
export function showHint(text = hints[chosenTool()]): void {
  element("hint").textContent = text;
}

/** Tools that the chosen organ has no use for are not shown or cannot be chosen. */
function refreshTools(): void {
  const isVessel = organs.chosen.kind === "vessel";
  for (const tool of Object.keys(hints) as Tool[]) {
    radioOf(tool).disabled = !canUse(tool);
    radioOf(tool).parentElement!.hidden = tool !== "navigate" && (tool === "point") !== isVessel;
  }
  if (radioOf(chosenTool()).disabled) {
    radioOf((["seed", "point"] as const).find(canUse) ?? "navigate").checked = true;
  }
  showHint();
  element("seed-numbers").hidden = isVessel;
  for (const id of ["phantom-row", "labels-row"]) {
    element(id).classList.toggle("of-organs", isVessel);
  }
}

/** A label map alone has no organs to segment. */
function refreshLabels(isBusy: boolean): void {
  const isAlone = app.opened?.isLabelMap ?? false;
  for (const id of ["organ-controls", "seed-controls", "run"]) {
    element(id).hidden = isAlone;
  }
  element("label-controls").hidden = !app.labels;
  element("label-controls").classList.toggle("alone", isAlone);
  element<HTMLFieldSetElement>("label-controls").disabled = isBusy;
  button("label-surfaces").classList.toggle("primary", isAlone);
  button("save-label-surfaces").disabled = isBusy || !app.labelSurfaces.some(({ isShown }) => isShown);
}

/** What can be done now. */
export function refresh(): void {
  const isBusy = app.running !== null;
  for (const id of ["open-files", "open-folder", "open-labels", "open-phantom"]) {
    button(id).disabled = isBusy;
  }
  for (const id of ["organ-controls", "seed-controls"]) {
    element<HTMLFieldSetElement>(id).disabled = !app.opened || isBusy;
  }
  refreshTools();
  refreshLabels(isBusy);
  select("window").disabled = !app.opened;
  button("undo").disabled = !organs.canUndo;
  button("redo").disabled = !organs.canRedo;
  button("run").disabled = isBusy || !canRun(organs.chosen);
  button("cancel").disabled = !isBusy;
  element<HTMLFieldSetElement>("asking").disabled = isBusy;
  button("save-surface").disabled = isBusy || !organs.chosen.result;
  button("save-labels").disabled = isBusy || organs.list.every(({ result }) => !result);
  button("save-session").disabled = isBusy || !organs.list.some(canRepeat);
  view.tool = !app.opened ? null : isBusy ? "navigate" : chosenTool();
  element("overlay").classList.toggle("placing", view.tool !== null && view.tool !== "navigate");
}

export function showSeed(seed: Seed | null): void {
  ["seed-x", "seed-y", "seed-z"].forEach((id, axis) => {
    input(id).value = seed ? String(Number(seed.center[axis].toFixed(2))) : "";
  });
  if (seed) {
    input("seed-radius").value = String(Number(seed.radius.toFixed(2)));
  }
}

/** As the slices show them; one of them as it may become. */
export function viewedOrgans(changed: Partial<OrganState> = {}): ViewedOrgan[] {
  return organs.list.map((one) => {
    const isChosen = one === organs.chosen;
    const organ = isChosen ? { ...one, ...changed } : one;
    const { result, seed, color, corrections, points } = organ;
    const ofVessel = points.map((position, at) => ({ kind: String(at + 1), position }));
    const confidence = result && isOrgan(result) ? result.vertexConfidence : null;
    return {
      surface: result?.surface ?? null,
      confidence,
      seed,
      color,
      isChosen,
      points: isChosen ? [...corrections, ...ofVessel] : [],
      questions: isChosen ? questionsOf(organ).map(({ place }) => place) : [],
      chosenQuestion: chosenQuestionOf(organ),
    };
  });
}

/** The phantom's organ whose seed this is. */
function phantomOrganOf({ seed }: OrganState): string {
  const isSame = (one: Seed) => one.radius === seed?.radius && one.center.every((value, axis) => value === seed.center[axis]);
  return String(app.phantomSeeds.find(isSame)?.label ?? "");
}

/** After any change of the organs. */
export function showAll(): void {
  showOrgans(element("organs"), organs, showAll);
  showSeed(organs.chosen.seed);
  select("phantom-seed").value = phantomOrganOf(organs.chosen);
  const { start } = organs.chosen; // maybe from a label map that was opened before
  select("start-label").value = start && start.labels === app.labels ? String(start.label) : "";
  showPoints(element("points"), organs.chosen);
  showLabels(element("labels-list"), app.labelSurfaces, showAll);
  showQuestions(organs.chosen);
  showResult(organs.chosen);
  if (app.opened) {
    view.setOrgans([...viewedLabels(), ...viewedOrgans()]);
  }
  refresh();
}
