/** What was done to an image, as a file: enough to repeat it, here or by `flipfree segment --session FILE`. */
import { FlipFreeError, type Grid, isSameGrid } from "../flipfree/index.js";
import type { SessionOrgan } from "./organs.js";

export interface Session {
  format: "flipfree-session";
  version: 1;
  flipfree: string;
  image: { name: string } & Grid;
  organs: SessionOrgan[];
}

export function sessionFile(flipfree: string, name: string, grid: Grid, organs: readonly SessionOrgan[]): Blob {
  const { size, spacing, origin, direction } = grid;
  const session: Session = {
    format: "flipfree-session",
    version: 1,
    flipfree,
    image: { name, size, spacing, origin, direction },
    organs: organs.map(({ name: organ, color, seed, preset, parameters }) => ({ name: organ, color, seed, preset, parameters })),
  };
  return new Blob([`${JSON.stringify(session, null, 2)}\n`], { type: "application/json" });
}

function isNumbers(value: unknown, count: number): boolean {
  return Array.isArray(value) && value.length === count && value.every(Number.isFinite);
}

function isOrgan(organ: SessionOrgan): boolean {
  const { name, color, seed, preset, parameters } = organ ?? {};
  return (
    typeof name === "string" &&
    /^#[0-9a-f]{6}$/i.test(color) &&
    (seed === null || (isNumbers(seed?.center, 3) && Number.isFinite(seed.radius))) &&
    ["default", "published", "naive"].includes(preset) &&
    typeof parameters === "object" &&
    parameters !== null
  );
}

/** Throws a FlipFreeError for a file that is none. */
export function parseSession(name: string, text: string): Session {
  let session: Session;
  try {
    session = JSON.parse(text);
  } catch {
    throw new FlipFreeError(`${name} is not a JSON file`);
  }
  const { image, organs } = session ?? {};
  const isImage = isNumbers(image?.size, 3) && isNumbers(image.spacing, 3) && isNumbers(image.origin, 3) && isNumbers(image.direction, 9);
  if (session?.format !== "flipfree-session" || session.version !== 1 || !isImage || !Array.isArray(organs)) {
    throw new FlipFreeError(`${name} is not a session of FlipFree that this version knows`);
  }
  const wrong = organs.findIndex((organ) => !isOrgan(organ));
  if (wrong >= 0) {
    throw new FlipFreeError(`${name}: entry ${wrong + 1} of the organs is damaged`);
  }
  return session;
}

/** Throws a FlipFreeError if a session is of another image. */
export function requireImageOf(session: Session, opened: Grid | null): void {
  if (!opened || !isSameGrid(session.image, opened)) {
    const { name, size } = session.image;
    throw new FlipFreeError(`The session is of another image; open ${name} (${size.join(" × ")} voxels) first, then the session`);
  }
}

/** An organ's name as a part of a file's name; the command makes the same of it. */
export function fileNameOf(organ: string): string {
  return organ.replace(/[\0-\x7f]/g, (letter) => (/[A-Za-z0-9]/.test(letter) ? letter : "-"));
}
