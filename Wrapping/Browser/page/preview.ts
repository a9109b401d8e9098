/** Before the click: what it would add or take, while the pointer moves; and what the chosen question is about. Of the places
 * that the pointer passes, the worker is asked for one at a time, the latest. */
import { FlipFreeError, type Organ, type Preview, type Triple } from "../flipfree/index.js";
import { app, flipfree, organs, view } from "./app.js";
import type { StrokeKind } from "./overlay.js";
import { showHint } from "./panel.js";
import { chosenQuestionOf, questionsOf, volumeText } from "./questions.js";
import { keptOrgan } from "./runs.js";

interface Target {
  kind: StrokeKind;
  place: Triple;
  result: Organ;
  isClick: boolean;
}

/** Null also where the kernels keep another result, such as after an undo. */
function targetAt(hovered: Triple | null): Target | null {
  const result = keptOrgan;
  const { tool } = view;
  if (!result || result !== organs.chosen.result || app.running) {
    return null;
  }
  if (hovered && (tool === "inside" || tool === "outside")) {
    return { kind: tool, place: hovered, result, isClick: true };
  }
  const question = questionsOf(organs.chosen)[chosenQuestionOf(organs.chosen)];
  return question ? { kind: question.included ? "outside" : "inside", place: question.place, result, isClick: false } : null;
}

/** What a click would do; nothing where that cannot be told. */
function hintOf(kind: StrokeKind, answer: Preview | FlipFreeError | null): string | undefined {
  if (answer instanceof FlipFreeError) {
    return "No point can be placed here.";
  }
  if (answer?.runs.length === 0) {
    return "Nothing would change here.";
  }
  return answer ? `A click here ${kind === "inside" ? "adds" : "takes away"} ${volumeText(answer.volume)}.` : undefined;
}

let target: Target | null = null;
let isAsking = false;

function show({ kind, place, isClick }: Target, answer: Preview | FlipFreeError | null): void {
  const isKnown = answer !== null && "runs" in answer;
  const sign = kind === "inside" ? "+" : "−";
  const label = isKnown && answer.runs.length > 0 && isClick ? `${sign} ${volumeText(answer.volume)}` : "";
  view.setPreview(isKnown ? { kind, runs: answer.runs, grid: app.opened!.image, place, label } : null);
  showHint(isClick ? hintOf(kind, answer) : undefined);
}

async function ask(first: Target): Promise<void> {
  isAsking = true;
  let next: Target | null = first;
  while (next) {
    const asked: Target = next;
    const point = asked.kind === "inside" ? { inside: asked.place } : { outside: asked.place };
    const answer = await flipfree.preview(point).catch((error) => (error instanceof FlipFreeError ? error : null));
    const isCurrent = target?.kind === asked.kind && target.result === asked.result && target.isClick === asked.isClick;
    if (isCurrent) {
      show(asked, answer);
    }
    next = target === asked ? null : target;
  }
  isAsking = false;
}

export function updatePreview(): void {
  target = targetAt(view.hovered);
  if (!target) {
    view.setPreview(null);
    showHint();
  } else if (!isAsking) {
    void ask(target);
  }
}

export function listenToPointer(): void {
  view.onHover = updatePreview;
}
