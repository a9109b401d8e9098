/** What was done to an image, as a file: enough to repeat it. */
import { FlipFreeError, type Grid, type Parameters, type Preset, type Seed } from "../flipfree/index.js";

export interface SessionOrgan {
  name: string;
  color: string;
  seed: Seed | null;
  preset: Preset;
  parameters: Parameters;
}

export interface Session {
  format: "flipfree-session";
  version: 1;
  flipfree: string;
  image: { name: string } & Grid;
  organs: SessionOrgan[];
}

export function sessionFile(flipfree: string, name: string, grid: Grid, organs: SessionOrgan[]): Blob {
  const { size, spacing, origin, direction } = grid;
  const session: Session = {
    format: "flipfree-session",
    version: 1,
    flipfree,
    image: { name, size, spacing, origin, direction },
    organs,
  };
  return new Blob([`${JSON.stringify(session, null, 2)}\n`], { type: "application/json" });
}

function isNumbers(value: unknown, count: number): boolean {
  return Array.isArray(value) && value.length === count && value.every(Number.isFinite);
}

/** Throws a FlipFreeError for a file that is none. */
export function parseSession(name: string, text: string): Session {
  let session: Session;
  try {
    session = JSON.parse(text);
  } catch {
    throw new FlipFreeError(`${name} is not a JSON file`);
  }
  if (session?.format !== "flipfree-session" || session.version !== 1 || !Array.isArray(session.organs)) {
    throw new FlipFreeError(`${name} is not a session of FlipFree that this version knows`);
  }
  for (const organ of session.organs) {
    if (organ.seed && (!isNumbers(organ.seed.center, 3) || !Number.isFinite(organ.seed.radius))) {
      throw new FlipFreeError(`${name}: the seed of ${organ.name} is not three coordinates and a radius`);
    }
  }
  return session;
}
