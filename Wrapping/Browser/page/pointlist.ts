/** The list of points of the chosen organ: a row each, to read, edit and remove it. */
import type { Triple } from "../flipfree/index.js";
import type { Correction, CorrectionKind, OrganState } from "./organs.js";

type Row = { position: Triple; kind: string; radius?: number };

/** What the rows do; set by who can. */
export const pointActions = {
  /** The chosen organ's points become these. */
  change: (_points: Pick<OrganState, "corrections"> | Pick<OrganState, "points">) => {},
  /** Shows where a point is. */
  visit: (_position: Triple) => {},
};

const sides = ["Left", "Posterior", "Superior"];

function numberField(value: number, title: string, label: string, change: (value: number) => void): HTMLInputElement {
  const made = document.createElement("input");
  made.type = "number";
  made.step = "any";
  made.autocomplete = "off";
  made.value = String(Number(value.toFixed(1)));
  made.title = title;
  made.setAttribute("aria-label", label);
  made.addEventListener("change", () => {
    if (Number.isFinite(made.valueAsNumber)) {
      change(made.valueAsNumber);
    }
  });
  return made;
}

function kindOf(row: Row, name: string, change: (row: Row) => void): HTMLElement {
  if (!["inside", "outside", "boundary"].includes(row.kind)) {
    const text = document.createElement("span");
    text.textContent = row.kind === "seed" ? "seed " : `point ${row.kind}`;
    if (row.kind === "seed") {
      text.append(numberField(row.radius ?? 0, "Radius, mm", `Radius of ${name}, mm`, (radius) => change({ ...row, radius })));
    }
    return text;
  }
  const choose = document.createElement("select");
  choose.append(...["inside", "outside", "boundary"].map((kind) => new Option(kind)));
  choose.value = row.kind;
  choose.setAttribute("aria-label", `Kind of ${name}`);
  choose.addEventListener("change", () => change({ ...row, kind: choose.value }));
  return choose;
}

function coordinateOf(row: Row, axis: number, name: string, change: (row: Row) => void): HTMLInputElement {
  return numberField(row.position[axis], `${sides[axis]}, mm`, `${sides[axis]} of ${name}, mm`, (typed) => {
    const [x, y, z] = row.position.map((value, at) => (at === axis ? typed : value));
    change({ ...row, position: [x, y, z] });
  });
}

function itemOf(row: Row, number: number, replace: (rows: Row[]) => void): HTMLLIElement {
  const name = `point ${number}`;
  const change = (changed: Row) => replace([changed]);
  const remove = document.createElement("button");
  remove.type = "button";
  remove.textContent = "×";
  remove.setAttribute("aria-label", `Remove ${name}`);
  remove.addEventListener("click", () => replace([]));
  const item = document.createElement("li");
  item.append(kindOf(row, name, change), ...[0, 1, 2].map((axis) => coordinateOf(row, axis, name, change)), remove);
  item.addEventListener("focusin", (event) => {
    if (event.target !== remove) {
      pointActions.visit(row.position);
    }
  });
  return item;
}

export function showPoints(list: HTMLElement, { kind, corrections, points }: OrganState): void {
  const rows: Row[] =
    kind === "vessel" ? points.map((position, at) => ({ kind: String(at + 1), position })) : [...corrections];
  const replaceAt = (at: number) => (by: Row[]) => {
    const all = [...rows.slice(0, at), ...by, ...rows.slice(at + 1)];
    pointActions.change(
      kind === "vessel"
        ? { points: all.map(({ position }) => position) }
        : { corrections: all.map((row): Correction => ({ ...row, kind: row.kind as CorrectionKind })) },
    );
  };
  list.replaceChildren(...rows.map((row, at) => itemOf(row, at + 1, replaceAt(at))));
  list.lastElementChild?.scrollIntoView({ block: "nearest" });
}
