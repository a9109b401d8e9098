/** What was found, in numbers, and what may be wrong with it. */
import type { Organ, Vessel } from "../flipfree/index.js";
import { app } from "./app.js";
import { element } from "./dom.js";

function lengthOf({ branches }: Vessel): number {
  let length = 0;
  for (const { points } of branches) {
    for (let at = 3; at < points.length; at += 3) {
      length += Math.hypot(...[0, 1, 2].map((axis) => points[at + axis] - points[at + axis - 3]));
    }
  }
  return length;
}

function rowsOf(result: Organ | Vessel): [string, string][] {
  const voxel = (app.opened?.image.spacing ?? [0, 0, 0]).reduce((a, b) => a * b, 1);
  let voxels = 0;
  for (let run = 0; run < result.runs.length; run += 4) {
    voxels += result.runs[run + 3] - result.runs[run + 2];
  }
  const rows: [string, string][] = [
    ["Volume", `${((voxels * voxel) / 1000).toFixed(1)} ml`],
    ["Surface", `closed, ${result.selfIntersections} self-intersections`],
    ["Ended", `${result.stopReason}, ${result.iterations.Iteration?.length ?? 0} iterations`],
  ];
  if ("branches" in result) {
    const count = result.branches.length;
    const branches = count > 1 ? `, ${count} branches` : "";
    rows.splice(1, 0, ["Vessel", `${lengthOf(result).toFixed(0)} mm long, radius ${result.radius.toFixed(1)} mm${branches}`]);
  }
  return rows;
}

export function showResult(result: Organ | null): void {
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
