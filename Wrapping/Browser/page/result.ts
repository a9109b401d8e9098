/** What was found, in numbers, and what may be wrong with it. */
import { type Organ, type Vessel, doubtfulConfidence, isOrgan } from "../flipfree/index.js";
import { app } from "./app.js";
import { element } from "./dom.js";
import { doubtfulFraction } from "./doubts.js";
import type { OrganState } from "./organs.js";

function lengthOf({ branches }: Vessel): number {
  let length = 0;
  for (const { points } of branches) {
    for (let at = 3; at < points.length; at += 3) {
      length += Math.hypot(...[0, 1, 2].map((axis) => points[at + axis] - points[at + axis - 3]));
    }
  }
  return length;
}

/** A word where the threshold holds: for what was found in the image from a seed alone, with carving. Nothing is called
 * good: a leak along a clear boundary is confident, too. */
function judgementOf({ start, corrections, preset, parameters }: OrganState, { confidence }: Organ): string {
  const holds = !start && corrections.length === 0 && preset === "default" && parameters.carving !== false;
  return holds && confidence < doubtfulConfidence ? ", doubtful" : "";
}

function confidenceText(organ: OrganState, result: Organ): string {
  return `${(Math.floor(100 * result.confidence) / 100).toFixed(2)}${judgementOf(organ, result)}`;
}

/** Warnings in the words of a page that draws doubtful places in blue; without the question, which has a list of its own. */
function wordsOf(warning: string): string {
  return warning.replace("where its confidence is low", "where it is blue").replace(/Is the part of [^?]*\?.*$/, "").trim();
}

function counted(count: number, noun: string): string {
  return `${count} ${noun}${count === 1 ? "" : "s"}`;
}

function rowsOf(organ: OrganState, result: Organ | Vessel): [string, string][] {
  const voxel = (app.opened?.image.spacing ?? [0, 0, 0]).reduce((a, b) => a * b, 1);
  let voxels = 0;
  for (let run = 0; run < result.runs.length; run += 4) {
    voxels += result.runs[run + 3] - result.runs[run + 2];
  }
  const rows: [string, string][] = [
    ["Volume", `${((voxels * voxel) / 1000).toFixed(1)} ml`],
    ["Surface", `closed, ${counted(result.selfIntersections, "self-intersection")}`],
    ["Ended", `${result.stopReason}, ${counted(result.iterations.Iteration?.length ?? 0, "iteration")}`],
  ];
  if (isOrgan(result)) {
    rows.unshift(
      ["Confidence", confidenceText(organ, result)],
      ["Boundary", `${Math.round(100 * doubtfulFraction(result))} % doubtful (blue)`],
    );
  } else {
    const count = result.branches.length;
    const branches = count > 1 ? `, ${count} branches` : "";
    rows.splice(1, 0, ["Vessel", `${lengthOf(result).toFixed(0)} mm long, radius ${result.radius.toFixed(1)} mm${branches}`]);
  }
  return rows;
}

export function showResult(organ: OrganState): void {
  const { result } = organ;
  const cells = (result ? rowsOf(organ, result) : []).flatMap(([name, value]) => {
    const term = document.createElement("dt");
    const text = document.createElement("dd");
    term.textContent = name;
    text.textContent = value;
    return [term, text];
  });
  element("result").replaceChildren(...cells);
  const texts = (result?.warnings ?? []).map(wordsOf).filter((text) => text !== "");
  const warnings = texts.map((text) => {
    const item = document.createElement("li");
    item.textContent = text;
    return item;
  });
  element("warnings").replaceChildren(...warnings);
}
