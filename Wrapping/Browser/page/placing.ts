/** Placing: seeds, points that correct an organ, and points of a vessel; by mouse, by numbers, at the cross-hair. */
import type { Seed, Triple } from "../flipfree/index.js";
import { app, organs, view } from "./app.js";
import { input, select } from "./dom.js";
import type { Correction } from "./organs.js";
import { chosenTool, showAll, showSeed, viewedOrgans } from "./panel.js";
import { pointActions } from "./pointlist.js";
import { addCorrections, changePoints } from "./runs.js";
import { say } from "./status.js";

/** Another seed: what was found from the former one goes, and undo brings it back. */
function setSeed(seed: Seed): void {
  organs.change(organs.chosen, { seed, start: null, result: null });
  say("");
  showAll();
}

function radiusOf(): number {
  const radius = Number(input("seed-radius").value);
  return radius > 0 ? radius : 20;
}

export function takeSeedNumbers(): void {
  const center = ["seed-x", "seed-y", "seed-z"].map((id) => input(id).valueAsNumber);
  if (center.every(Number.isFinite)) {
    setSeed({ center: [center[0], center[1], center[2]], radius: input("seed-radius").valueAsNumber || 0 });
    view.crosshair = [center[0], center[1], center[2]];
  }
}

export function resizeSeed(by: number): void {
  const { seed } = organs.chosen;
  if (seed) {
    setSeed({ ...seed, radius: Math.max(1, seed.radius + by) });
  }
}

/** Of a further seed that was clicked without dragging, in mm. */
function furtherRadius(): number {
  const { seed, corrections } = organs.chosen;
  return corrections.filter(({ kind }) => kind === "seed").at(-1)?.radius ?? Math.min(10, seed?.radius ?? 10);
}

function furtherOf({ center, radius }: Seed): Correction {
  return { kind: "seed", position: center, radius };
}

/** What the tool places, if it places points. */
function placePoints(positions: readonly Triple[]): void {
  const { points } = organs.chosen;
  const tool = chosenTool();
  if (tool === "point") {
    void changePoints({ points: [...points, ...positions] });
  } else if (tool === "further") {
    void addCorrections(positions.map((center) => furtherOf({ center, radius: furtherRadius() })));
  } else if (tool === "inside" || tool === "outside" || tool === "boundary") {
    void addCorrections(positions.map((position) => ({ kind: tool, position })));
  }
}

/** At the cross-hair; navigating places the seed. */
export function placeHere(): void {
  if (app.opened?.isLabelMap) {
    return; // nothing to segment
  }
  const place = view.crosshair;
  if (chosenTool() === "seed" || (chosenTool() === "navigate" && organs.chosen.kind === "organ")) {
    setSeed({ center: place, radius: organs.chosen.seed?.radius ?? radiusOf() });
  } else if (chosenTool() === "navigate") {
    void changePoints({ points: [...organs.chosen.points, place] });
  } else {
    placePoints([place]);
  }
}

export function listenToPlaces(): void {
  view.onSeed = (seed, placed) => {
    // Clicking without dragging keeps the radius.
    const isFurther = chosenTool() === "further";
    const radius = isFurther ? furtherRadius() : (organs.chosen.seed?.radius ?? radiusOf());
    const shown = seed.radius < 1 ? { ...seed, radius } : seed;
    if (isFurther && placed) {
      void addCorrections([furtherOf(shown)]);
    } else if (isFurther) {
      view.setMarks(viewedOrgans({ corrections: [...organs.chosen.corrections, furtherOf(shown)] }));
    } else if (placed) {
      setSeed(shown);
      say("Seed placed.");
    } else {
      showSeed(shown);
      view.setMarks(viewedOrgans({ seed: shown }));
    }
  };
  view.onPoints = placePoints;
  view.onWindow = () => (select("window").value = "");
  pointActions.change = (points) => void changePoints(points);
  pointActions.visit = (position) => (view.crosshair = [...position]);
  for (const id of ["seed-x", "seed-y", "seed-z", "seed-radius"]) {
    input(id).addEventListener("change", takeSeedNumbers);
  }
}
