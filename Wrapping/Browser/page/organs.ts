/** The organs of a session, with undo and redo: every change makes a new state, and the former ones are kept. */
import type { Corrections, Organ, Parameters, Preset, Seed, StartLabels, Triple, Vessel } from "../flipfree/index.js";
import { distanceBetween } from "./stroke.js";

export type CorrectionKind = "inside" | "outside" | "boundary" | "seed";

/** What the user knows of an organ at a place. */
export interface Correction {
  kind: CorrectionKind;
  position: Triple;
  /** Of a further seed, in mm. */
  radius?: number;
}

/** What a session says of an organ or of a vessel. */
export interface SessionOrgan {
  kind: "organ" | "vessel";
  name: string;
  color: string;
  /** Of an organ. */
  seed: Seed | null;
  preset: Preset;
  corrections: readonly Correction[];
  /** Of a vessel. */
  points: readonly Triple[];
  parameters: Parameters;
}

/** A label map with the name of its file. */
export interface NamedLabels extends StartLabels {
  name: string;
}

/** Never changed: `Organs.change` replaces it. */
export interface OrganState extends SessionOrgan {
  /** The label that an organ without a seed fills; sessions do not hold it. */
  start: NamedLabels | null;
  /** Of this very seed or label, these points and these parameters. */
  result: Organ | Vessel | null;
}

interface State {
  list: readonly OrganState[];
  chosen: number;
}

/** None like the blue of doubtful places, or the magenta of questions. */
const colors = ["#ffd24a", "#8fe388", "#ff8a7a", "#d9a0ff", "#ffb347", "#ff9ed2", "#c8e65a", "#e6cfa8"];

/** Of label maps, with more labels than that, those further on have hues that no neighbor in the list has. */
export function colorOf(at: number): string {
  if (at < colors.length) {
    return colors[at];
  }
  const hue = (at * 137.5) % 360;
  const channel = (shift: number) => {
    const part = (shift + hue / 30) % 12; // CSS Color 4, "Converting HSL to sRGB"
    return Math.round(255 * (0.65 - 0.3 * Math.max(-1, Math.min(part - 3, 9 - part, 1))));
  };
  return `#${[0, 8, 4].map((shift) => channel(shift).toString(16).padStart(2, "0")).join("")}`;
}

/** Whether a session holds all that a run needs. */
export function canRepeat({ kind, seed, points }: SessionOrgan): boolean {
  return kind === "vessel" ? points.length > 1 : seed !== null;
}

/** Whether there is all that a run needs. */
export function canRun(organ: OrganState): boolean {
  return organ.start !== null || canRepeat(organ);
}

/** As the package takes them. */
export function correctionsOf({ corrections }: SessionOrgan): Corrections {
  const places = (wanted: CorrectionKind) => corrections.filter(({ kind }) => kind === wanted).map(({ position }) => position);
  const seeds = corrections.filter(({ kind }) => kind === "seed");
  return {
    inside: places("inside"),
    outside: places("outside"),
    boundary: places("boundary"),
    seeds: seeds.map(({ position, radius }) => ({ center: position, radius: radius ?? 0 })),
  };
}

/** Whether a point says what an earlier one of the same kind, closer than 0.1 mm, has said; a seed of another radius does not. */
export function isRepeated(point: Correction, earlier: readonly Correction[]): boolean {
  const isSame = ({ kind, position, radius }: Correction) =>
    kind === point.kind &&
    distanceBetween(position, point.position) < 0.1 &&
    Math.abs((radius ?? 0) - (point.radius ?? 0)) < 0.1;
  return earlier.some(isSame);
}

function newOrgan(taken: readonly OrganState[], kind: SessionOrgan["kind"] = "organ"): OrganState {
  const names = new Set(taken.map(({ name }) => name));
  let number = 1;
  while (names.has(`${kind} ${number}`)) {
    ++number;
  }
  const color = colors.find((one) => taken.every((organ) => organ.color !== one)) ?? colors[taken.length % colors.length];
  const name = `${kind} ${number}`;
  const own: SessionOrgan = { kind, name, color, seed: null, preset: "default", corrections: [], points: [], parameters: {} };
  return { ...own, start: null, result: null };
}

/** A name that no other organ has. */
function uniqueName(name: string, others: readonly OrganState[]): string {
  const isTaken = (one: string) => others.some((organ) => organ.name === one);
  let unique = name;
  for (let number = 2; isTaken(unique); ++number) {
    unique = `${name} ${number}`;
  }
  return unique;
}

export class Organs {
  private state: State = { list: [newOrgan([])], chosen: 0 };
  private past: State[] = [];
  private future: State[] = [];

  get list(): readonly OrganState[] {
    return this.state.list;
  }

  get chosen(): OrganState {
    return this.state.list[this.state.chosen];
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** Starts anew, with nothing to undo. */
  reset(organs: readonly SessionOrgan[] = []): void {
    const list = organs.map((organ) => ({ ...organ, start: null, result: null }));
    this.state = { list: list.length > 0 ? list : [newOrgan([])], chosen: 0 };
    this.past = [];
    this.future = [];
  }

  /** Choosing is no change that could be undone. */
  choose(organ: OrganState): void {
    this.state = { ...this.state, chosen: Math.max(0, this.state.list.indexOf(organ)) };
  }

  add(kind: SessionOrgan["kind"]): void {
    const list = [...this.state.list, newOrgan(this.state.list, kind)];
    this.set({ list, chosen: list.length - 1 });
  }

  /** The last one leaves an empty one. */
  remove(organ: OrganState): void {
    const list = this.state.list.filter((one) => one !== organ);
    this.set({ list: list.length > 0 ? list : [newOrgan([])], chosen: Math.min(this.state.chosen, Math.max(0, list.length - 1)) });
  }

  change(organ: OrganState, change: Partial<OrganState>): void {
    const others = this.state.list.filter((one) => one !== organ);
    const name = uniqueName(change.name ?? organ.name, others);
    const list = this.state.list.map((one) => (one === organ ? { ...one, ...change, name } : one));
    this.set({ ...this.state, list });
  }

  /** Adds what was found; a result is not a step of its own. */
  find(organ: OrganState, result: Organ | Vessel): void {
    const list = this.state.list.map((one) => (one === organ ? { ...one, result } : one));
    this.state = { ...this.state, list };
  }

  undo(): void {
    const last = this.past.pop();
    if (last) {
      this.future.push(this.state);
      this.state = last;
    }
  }

  redo(): void {
    const next = this.future.pop();
    if (next) {
      this.past.push(this.state);
      this.state = next;
    }
  }

  private set(state: State): void {
    this.past.push(this.state);
    this.future = [];
    this.state = state;
  }
}
