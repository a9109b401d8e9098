/** Visiting and answering questions, in the list, on the slices and by keys. An answer is a point: inside for yes, outside for
 * no. */
import { app, organs, view } from "./app.js";
import { viewedOrgans } from "./panel.js";
import { updatePreview } from "./preview.js";
import { chosenQuestionOf, chooseQuestion, questionActions, questionText, questionsOf } from "./questions.js";
import { addCorrections } from "./runs.js";
import { say } from "./status.js";

/** Chooses a question, of which the slices then show the place and the part; or none. */
function choose(at: number): void {
  chooseQuestion(organs.chosen, at);
  view.setMarks(viewedOrgans());
  updatePreview();
}

function visit(at: number): void {
  const { chosen } = organs;
  const questions = questionsOf(chosen);
  choose(at);
  view.crosshair = [...questions[at].place];
  say(`Question ${at + 1} of ${questions.length}: ${questionText(questions[at], chosen.name)} Y or N answers.`);
}

/** One question after the other, the most important first. */
export function visitNextQuestion(): void {
  const questions = questionsOf(organs.chosen);
  if (questions.length > 0) {
    visit((chosenQuestionOf(organs.chosen) + 1) % questions.length);
  }
}

/** A second click hides what the first has shown. */
function toggle(at: number): void {
  if (at === chosenQuestionOf(organs.chosen)) {
    choose(-1);
    say("");
  } else {
    visit(at);
  }
}

function answer(at: number, isOrgan: boolean): void {
  if (app.running) {
    return;
  }
  const { place } = questionsOf(organs.chosen)[at];
  choose(-1); // undo brings the question back, not the choice
  view.crosshair = [...place];
  void addCorrections([{ kind: isOrgan ? "inside" : "outside", position: place }]);
}

export function answerChosen(isOrgan: boolean): void {
  const at = chosenQuestionOf(organs.chosen);
  if (at >= 0) {
    answer(at, isOrgan);
  }
}

export function listenToQuestions(): void {
  questionActions.visit = toggle;
  questionActions.answer = answer;
  view.onQuestion = (at, isOrgan) => (isOrgan === null ? toggle(at) : answer(at, isOrgan));
}
