/** Questions on the slices: a mark at the place of each, and on the slice under the pointer Yes and No beside that of the chosen
 * one. */
import { type Point, type Tile, distanceOf, fadesWithin, pixelAt } from "./tiles.js";

export interface ShownQuestions {
  questions: readonly Point[]; // RAS
  /** The number of the chosen one, or -1. */
  chosenQuestion: number;
  /** The slice under the pointer, as NiiVue calls it. */
  pointed: number | null;
  /** A place at most this far from a slice is on it, in mm. */
  nearby: number;
}

/** What a mark does: it shows its question, or answers it. */
export interface QuestionMark {
  question: number;
  isOrgan: boolean | null;
}

/** None like an organ's, or the blue of doubtful places. */
export const questionColor = "#ff5ce1";

interface Badge extends QuestionMark {
  text: string;
  left: number;
  top: number;
  width: number;
  height: number;
  isNear: boolean;
}

/** To the right of the mark, or, where that leaves the slice, to its left. */
function answersOf(tile: Tile, mark: Badge): Badge[] {
  const scale = window.devicePixelRatio;
  const [gap, width] = [3 * scale, 34 * scale];
  const [left, , sliceWidth] = tile.leftTopWidthHeight;
  const whole = 2 * (width + gap);
  const isRight = mark.left + mark.width + whole <= left + sliceWidth;
  const first = isRight ? mark.left + mark.width + gap : mark.left - whole;
  const yes = { ...mark, isOrgan: true, text: "Yes", left: first, width };
  return [yes, { ...yes, isOrgan: false, text: "No", left: first + width + gap }];
}

/** Those of a slice, in its pixels, those of the chosen question last. */
function badgesOf(tile: Tile, { questions, chosenQuestion, pointed, nearby }: ShownQuestions): Badge[] {
  const height = 20 * window.devicePixelRatio;
  const marks = questions.flatMap((place, question): Badge[] => {
    const distance = distanceOf(tile, place);
    const [x, y] = pixelAt(tile, place);
    const box = { left: x - height / 2, top: y - height / 2, width: height, height };
    const isShown = distance <= Math.max(nearby, fadesWithin);
    return isShown ? [{ question, isOrgan: null, text: "?", ...box, isNear: distance <= nearby }] : [];
  });
  const own = marks.filter(({ question }) => question === chosenQuestion);
  const answers = pointed === tile.axCorSag ? own.flatMap((mark) => answersOf(tile, mark)) : [];
  return [...marks.filter(({ question }) => question !== chosenQuestion), ...own, ...answers];
}

export function drawQuestions(context: CanvasRenderingContext2D, tile: Tile, shown: ShownQuestions): void {
  const scale = window.devicePixelRatio;
  context.save();
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineWidth = 1.5 * scale;
  for (const { question, text, left, top, width, height, isNear } of badgesOf(tile, shown)) {
    context.globalAlpha = isNear ? 1 : 0.45;
    context.beginPath();
    const radius = height / 2;
    context.arc(left + radius, top + radius, radius, 0.5 * Math.PI, 1.5 * Math.PI);
    context.arc(left + width - radius, top + radius, radius, 1.5 * Math.PI, 0.5 * Math.PI);
    context.closePath();
    context.fillStyle = questionColor;
    context.strokeStyle = question === shown.chosenQuestion ? "#fff" : "#000";
    context.fill();
    context.stroke();
    context.fillStyle = "#000";
    context.font = `700 ${14 * scale}px system-ui, sans-serif`;
    context.fillText(text, left + width / 2, top + 0.53 * height);
  }
  context.restore();
}

export function questionMarkAt(tile: Tile, shown: ShownQuestions, x: number, y: number): QuestionMark | undefined {
  const isHit = ({ left, top, width, height }: Badge) => x >= left && x < left + width && y >= top && y < top + height;
  return badgesOf(tile, shown).filter(isHit).at(-1);
}
