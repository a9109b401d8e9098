/** What was done to an image, as a file: enough to repeat it, here or by `flipfree segment --session FILE`. */
import { FlipFreeError, type Grid, type Parameters, type Preset, type Seed, type Triple } from "../flipfree/index.js";
import type { Correction, SessionOrgan } from "./organs.js";

/** An organ, or a vessel. Those of version 1 have neither kind nor corrections. */
type Entry = { name: string; color: string; parameters: Parameters } & (
  | { kind?: "organ"; seed: Seed | null; preset: Preset; corrections?: readonly Correction[] }
  | { kind: "vessel"; points: readonly Triple[] }
);

/** Of a folder of DICOM files, also the series that was read. */
type ImageOfSession = { name: string; series?: string } & Grid;

interface SessionFile {
  format: "flipfree-session";
  version: 1 | 2;
  flipfree: string;
  image: ImageOfSession;
  organs: Entry[];
  /** Of the command: the organs were segmented together. */
  together?: boolean;
}

/** What only the command can repeat. */
interface OfTheCommand {
  startLabels?: unknown;
  startSurface?: boolean;
}

export interface Session {
  image: ImageOfSession;
  organs: SessionOrgan[];
}

function entryOf({ kind, name, color, seed, preset, corrections, points, parameters }: SessionOrgan): Entry {
  return kind === "vessel"
    ? { name, kind, color, points, parameters }
    : { name, kind, color, seed, preset, parameters, corrections };
}

export function sessionFile(flipfree: string, image: ImageOfSession, organs: readonly SessionOrgan[]): Blob {
  const { name, series, size, spacing, origin, direction } = image;
  const session: SessionFile = {
    format: "flipfree-session",
    version: 2,
    flipfree,
    image: { name, series, size, spacing, origin, direction },
    organs: organs.map(entryOf),
  };
  return new Blob([`${JSON.stringify(session, null, 2)}\n`], { type: "application/json" });
}

function isNumbers(value: unknown, count: number): boolean {
  return Array.isArray(value) && value.length === count && value.every(Number.isFinite);
}

const positions = "as three numbers, in millimeters";

/** What is wrong in an entry, with what it has to be; nothing if it is right. */
function faultOfCorrection({ kind, position, radius }: Correction): string | undefined {
  if (!["inside", "outside", "boundary", "seed"].includes(kind)) {
    return `its kind is ${JSON.stringify(kind)}; it can be "inside", "outside", "boundary" or "seed"`;
  }
  if (!isNumbers(position, 3)) {
    return `it has no position; give it ${positions}`;
  }
  return kind === "seed" && !(Number.isFinite(radius) && radius! > 0) ? "a seed has no radius; give it in millimeters" : undefined;
}

function faultOfList<T>(list: unknown, name: string, faultOf: (one: T) => string | undefined): string | undefined {
  if (!Array.isArray(list)) {
    return `there is no list of ${name}s`;
  }
  const faults = list.map((one) => (one === null || typeof one !== "object" ? `it is no ${name}` : faultOf(one)));
  const first = faults.findIndex((fault) => fault);
  return first < 0 ? undefined : `${name} ${first + 1}: ${faults[first]}`;
}

const byCommand = "repeat it by flipfree segment --session";

function faultOfEntry(entry: Entry & OfTheCommand): string | undefined {
  const { name, color, parameters } = entry;
  if (typeof name !== "string" || !/^#[0-9a-f]{6}$/i.test(color) || typeof parameters !== "object" || parameters === null) {
    return "its name, color or parameters are damaged";
  }
  if (entry.startLabels || entry.startSurface) {
    return `it starts from a label map or a surface that is not in the session; ${byCommand}`;
  }
  if (entry.kind === "vessel") {
    if ((entry as { corrections?: readonly Correction[] }).corrections?.length) {
      return `it is corrected by points; ${byCommand}`;
    }
    return faultOfList(entry.points, "point", (point) => (isNumbers(point, 3) ? undefined : `give it ${positions}`));
  }
  if (entry.kind !== undefined && entry.kind !== "organ") {
    return `its kind is ${JSON.stringify(entry.kind)}; it can be "organ" or "vessel"`;
  }
  if (entry.seed !== null && !(isNumbers(entry.seed?.center, 3) && Number.isFinite(entry.seed.radius))) {
    return "its seed is damaged";
  }
  if (!["default", "published", "naive"].includes(entry.preset)) {
    return `there is no preset ${JSON.stringify(entry.preset)}`;
  }
  return faultOfList(entry.corrections ?? [], "correction", faultOfCorrection);
}

function organOf(entry: Entry): SessionOrgan {
  const { name, color, parameters } = entry;
  return entry.kind === "vessel"
    ? { kind: "vessel", name, color, parameters, seed: null, preset: "default", corrections: [], points: entry.points }
    : { ...entry, kind: "organ", corrections: entry.corrections ?? [], points: [] };
}

/** Throws a FlipFreeError for a file that is not a session; it names the file, the organ, the entry, and the remedy. */
export function parseSession(name: string, text: string): Session {
  let session: SessionFile;
  try {
    session = JSON.parse(text);
  } catch {
    throw new FlipFreeError(`${name} is not a JSON file; open a session that this page has saved`);
  }
  const { image, organs } = session ?? {};
  const isImage = isNumbers(image?.size, 3) && isNumbers(image.spacing, 3) && isNumbers(image.origin, 3) && isNumbers(image.direction, 9);
  if (session?.format !== "flipfree-session" || ![1, 2].includes(session.version) || !isImage || !Array.isArray(organs)) {
    throw new FlipFreeError(`${name} is not a session of FlipFree that this version knows; open one that this page has saved`);
  }
  if (session.together && organs.length > 1) {
    throw new FlipFreeError(`${name}: its organs were segmented together; ${byCommand}`);
  }
  organs.forEach((organ, at) => {
    const fault = organ === null || typeof organ !== "object" ? "it is none" : faultOfEntry(organ);
    if (fault) {
      const called = typeof organ?.name === "string" ? ` '${organ.name}'` : "";
      throw new FlipFreeError(`${name}, organ ${at + 1}${called}: ${fault}. Correct the file, or save the session again`);
    }
  });
  return { image, organs: organs.map(organOf) };
}

/** An organ's name as a part of a file's name; the command makes the same of it. */
export function fileNameOf(organ: string): string {
  return organ.replace(/[\0-\x7f]/g, (letter) => (/[A-Za-z0-9]/.test(letter) ? letter : "-"));
}
