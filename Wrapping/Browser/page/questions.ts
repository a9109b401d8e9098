/** Questions that a result asks: which one is chosen, and the list of them in the panel, with Yes and No. */
import { type Organ, type Question, type Triple, type Vessel, isOrgan } from "../flipfree/index.js";
import { element } from "./dom.js";
import type { OrganState } from "./organs.js";

/** What the list does; set by who can. */
export const questionActions = {
  /** Shows a question, or hides it again. */
  visit: (_at: number) => {},
  answer: (_at: number, _isOrgan: boolean) => {},
};

let chosen: { result: Organ | Vessel | null; at: number } = { result: null, at: -1 };

export function questionsOf({ result }: OrganState): readonly Question[] {
  return result && isOrgan(result) ? result.questions : [];
}

/** The number of the chosen question, from 0; -1 where there is none. */
export function chosenQuestionOf({ result }: OrganState): number {
  return result && chosen.result === result ? chosen.at : -1;
}

export function chooseQuestion({ result }: OrganState, at: number): void {
  chosen = { result, at };
  markChosen(at);
}

export function volumeText(milliliters: number): string {
  return `${milliliters.toFixed(milliliters < 10 ? 1 : 0)} ml`;
}

const sides = ["RL", "AP", "IS"];

/** To a millimeter, by sides of the body. */
function placeText(place: Triple): string {
  return place.map((value, axis) => `${sides[axis][value < 0 ? 0 : 1]} ${Math.abs(value).toFixed(0)}`).join(" ");
}

export function questionText({ volume, included }: Question, name: string): string {
  return `Is this part of ${volumeText(volume)} ${name}? It is ${included ? "included" : "left out"}.`;
}

function buttonOf(text: string, label: string, action: () => void): HTMLButtonElement {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = text;
  made.setAttribute("aria-label", label);
  made.addEventListener("click", action);
  return made;
}

function rowOf(question: Question, at: number, name: string): HTMLLIElement {
  const { volume, included, place } = question;
  const text = `${volumeText(volume)} ${included ? "included" : "left out"}, ${placeText(place)}`;
  const row = document.createElement("li");
  row.append(
    buttonOf(text, `Question ${at + 1}: ${questionText(question, name)} At ${placeText(place)}`, () => questionActions.visit(at)),
    // Named by the part: once answered, the next question's buttons are others, and are not pressed unseen.
    buttonOf("Yes", `Yes, ${text}`, () => questionActions.answer(at, true)),
    buttonOf("No", `No, ${text}`, () => questionActions.answer(at, false)),
  );
  return row;
}

function markChosen(at: number): void {
  [...element("questions").children].forEach((row, index) => row.setAttribute("aria-current", String(index === at)));
}

export function showQuestions(organ: OrganState): void {
  const questions = questionsOf(organ);
  element("asking").hidden = questions.length === 0;
  element("asking-title").textContent = `Is this part ${organ.name}?`;
  element("questions").replaceChildren(...questions.map((question, at) => rowOf(question, at, organ.name)));
  markChosen(chosenQuestionOf(organ));
}
