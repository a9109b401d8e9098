/** Runs: of the chosen organ, again after each of its points, and of all organs of a session. */
import { FlipFreeError, type Organ, type Vessel, isOrgan } from "../flipfree/index.js";
import { app, flipfree, organs, view } from "./app.js";
import { type Correction, type OrganState, canRun, correctionsOf, isRepeated } from "./organs.js";
import { leaveSeedTool, showAll, viewedOrgans } from "./panel.js";
import type { Session } from "./session.js";
import { complain, say, showProgress } from "./status.js";
import { work } from "./work.js";

/** The organ of which the kernels keep what its corrections do not change. */
export let keptOrgan: Organ | null = null;

/** A worker that was stopped keeps nothing. */
export function forgetOrgan(): void {
  keptOrgan = null;
}

async function find(organ: OrganState, signal: AbortSignal): Promise<Organ | Vessel> {
  const { image } = app.opened!;
  const { kind, preset, parameters, seed, start, points } = organ;
  const options = { parameters, signal, onProgress: showProgress };
  try {
    if (kind === "vessel") {
      return await flipfree.trace(image, points, options);
    }
    keptOrgan = await flipfree.segment(image, (seed ?? start)!, { ...options, preset, ...correctionsOf(organ) });
    return keptOrgan;
  } catch (error) {
    // Points that are refused leave it; another organ does not.
    if (signal.aborted || (kind === "organ" && organ.result !== keptOrgan)) {
      forgetOrgan();
    }
    throw error;
  }
}

/** Finds an organ, shows it, and says how long it took. */
async function run(doing: string, done: string, organ: OrganState, take: (result: Organ | Vessel) => void): Promise<void> {
  await work(`${doing} ${organ.name} …`, async (signal) => {
    const start = performance.now();
    performance.mark("flipfree-click");
    view.setMarks(viewedOrgans(organ));
    setTimeout(() => void view.prepareSurfaces()); // once the worker has begun
    const result = await find(organ, signal);
    performance.mark("flipfree-found");
    take(result);
    showAll();
    requestAnimationFrame(() => performance.mark("flipfree-shown"));
    say(`${done} in ${((performance.now() - start) / 1000).toFixed(1)} s.`);
  });
}

export async function segment(): Promise<void> {
  const organ = organs.chosen;
  if (app.opened && canRun(organ)) {
    await run("Segmenting", "Segmented", organ, (result) => {
      organs.find(organ, result);
      leaveSeedTool();
      if (organ.start && isOrgan(result)) {
        view.crosshair = [...result.seed.center];
      }
    });
  }
}

/** Further points of one kind that correct the chosen organ, in one step. */
export async function addCorrections(points: readonly Correction[]): Promise<void> {
  const { corrections } = organs.chosen;
  const added = points.filter((point) => !isRepeated(point, corrections));
  if (added.length === 0) {
    const [{ kind }] = points;
    showAll();
    complain(`This ${kind === "seed" ? "seed" : `${kind} point`} is already there; place it elsewhere, or change it in the list.`);
  } else {
    await changePoints({ corrections: [...corrections, ...added] });
  }
}

/** Other points of the chosen organ. Where it was segmented, its surface is renewed, and both are one step; where that
 * fails, nothing changes. */
export async function changePoints(change: Partial<OrganState>): Promise<void> {
  const organ = organs.chosen;
  const changed = { ...organ, ...change };
  if (organ.result && canRun(changed)) {
    await run("Correcting", "Corrected", changed, (result) => organs.change(organ, { ...change, result }));
  } else {
    organs.change(organ, { ...change, result: null });
    say(organ.kind === "vessel" && !canRun(changed) ? "A vessel needs a point at each end." : "");
    showAll();
  }
}

/** Throws a FlipFreeError if a session is of another image. */
async function requireImageOf(session: Session): Promise<void> {
  const { name, series, size } = session.image;
  const opened = app.opened?.image;
  if (!opened || !(await flipfree.compareGrids(session.image, opened, name)).samePlaces) {
    throw new FlipFreeError(`The session is of another image; open ${series ? `${name}, series ${series}` : name} (${size.join(" × ")} voxels) first, then the session`);
  }
}

export async function repeat(session: Session, signal: AbortSignal): Promise<void> {
  await requireImageOf(session);
  organs.reset(session.organs);
  showAll();
  for (const organ of organs.list.filter(canRun)) {
    say(`Segmenting ${organ.name} …`);
    organs.find(organ, await find(organ, signal));
    showAll();
  }
  const { seed, points } = organs.chosen;
  const place = seed?.center ?? points[0];
  if (place) {
    view.crosshair = [...place];
  }
  if (organs.chosen.result) {
    leaveSeedTool();
  }
  say("Session restored.");
}
