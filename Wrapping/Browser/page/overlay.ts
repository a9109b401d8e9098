/** What is drawn over the slices: contours, the seed, points, letters of orientation, window and position. */
import type { Niivue } from "@niivue/niivue";
import { doubtfulVertexConfidence } from "../flipfree/index.js";
import { crossSection, partsBelow } from "./crosssection.js";
import { type ShownQuestions, drawQuestions } from "./questionmarks.js";
import {
  type Point,
  type Tile,
  axes,
  distanceOf,
  fadesWithin,
  pixelAt,
  pixelsPerMillimeter,
  positionOf,
  sidesOf,
  slicesOf,
} from "./tiles.js";
import { type ShownVoxels, voxelPath } from "./voxels.js";

export interface ShownSurface {
  points: Float64Array; // RAS
  triangles: Uint32Array;
  fractions: Float64Array; // of the volume's extents, by which NiiVue counts slices
  least: number[]; // of the fractions along each axis
  most: number[];
  confidence: Float32Array; // of the vertices
  color: string;
  isChosen: boolean;
}

export interface ShownSeed {
  center: Point; // RAS
  radius: number;
  color: string;
}

export interface ShownPoint {
  /** Inside, outside, boundary, or the number of a vessel's point. */
  kind: string;
  place: Point; // RAS
  color: string;
  /** Of a stroke, or as close to another one: as a dot, it hides less. */
  isDot: boolean;
}

/** What is being painted. */
export interface ShownStroke {
  kind: StrokeKind;
  path: Point[]; // RAS
  /** On which slice, as NiiVue calls it. */
  slice: number;
}

export type StrokeKind = "inside" | "outside";

/** What a point would add or take. */
export interface ShownPreview extends ShownVoxels {
  kind: StrokeKind;
  place: Point; // RAS
  /** Beside the place, on the slice under the pointer. */
  label: string;
}

export interface Marks extends ShownQuestions {
  surfaces: ShownSurface[];
  seeds: ShownSeed[];
  points: ShownPoint[];
  stroke: ShownStroke | null;
  preview: ShownPreview | null;
}

/** Of doubtful places, whatever the organ's color. */
export const doubtColor = "#4099ff";

/** Of what a click or a stroke adds or takes. */
const changeColors: Record<StrokeKind, string> = { inside: "#2ee66b", outside: "#ff4d4d" };

type Context = CanvasRenderingContext2D;

function drawSegments(context: Context, tile: Tile, segments: number[], color: string, width: number): void {
  context.lineWidth = width * window.devicePixelRatio;
  context.strokeStyle = color;
  context.beginPath();
  for (let end = 0; end < segments.length; end += 8) {
    context.moveTo(...pixelAt(tile, segments, end));
    context.lineTo(...pixelAt(tile, segments, end + 4));
  }
  context.stroke();
}

function drawContour(context: Context, niivue: Niivue, tile: Tile, surface: ShownSurface): void {
  const { away } = axes(tile);
  const slice = niivue.scene.crosshairPos[away];
  const { points, triangles, fractions, least, most, confidence } = surface;
  if (slice < least[away] || slice > most[away]) {
    return;
  }
  const values = new Float64Array(points.length / 3);
  for (let vertex = 0; vertex < values.length; ++vertex) {
    values[vertex] = fractions[3 * vertex + away] - slice;
  }
  const segments = crossSection(points, triangles, values, confidence);
  const width = surface.isChosen ? 2 : 1.2;
  drawSegments(context, tile, segments, surface.color, width);
  drawSegments(context, tile, partsBelow(segments, doubtfulVertexConfidence), doubtColor, 1.5 * width);
}

/** The circle in which the slice cuts the sphere. */
function drawSeed(context: Context, tile: Tile, { center, radius, color }: ShownSeed): void {
  const distance = distanceOf(tile, center);
  if (!(distance < radius)) {
    return;
  }
  const [x, y] = pixelAt(tile, center);
  context.lineWidth = 1.5 * window.devicePixelRatio;
  context.strokeStyle = color;
  context.setLineDash([6, 4]);
  context.beginPath();
  context.arc(x, y, Math.sqrt(radius ** 2 - distance ** 2) * pixelsPerMillimeter(tile), 0, 2 * Math.PI);
  context.stroke();
  context.setLineDash([]);
  context.fillStyle = color;
  context.fillRect(x - 2, y - 2, 4, 4);
}

/** A disk with a sign of its kind, a diamond on the boundary, a dot; fainter beside the slice. */
function drawPoint(context: Context, tile: Tile, { kind, place, color, isDot }: ShownPoint, nearby: number): void {
  const distance = distanceOf(tile, place);
  if (distance > Math.max(nearby, fadesWithin)) {
    return;
  }
  const [x, y] = pixelAt(tile, place);
  const size = (isDot ? 3 : 6.5) * window.devicePixelRatio;
  context.save();
  context.globalAlpha = distance <= nearby ? 1 : 0.35;
  context.translate(x, y);
  context.beginPath();
  if (kind === "boundary") {
    context.moveTo(0, -1.2 * size);
    [[1.2, 0], [0, 1.2], [-1.2, 0]].forEach(([right, down]) => context.lineTo(right * size, down * size));
    context.closePath();
  } else {
    context.arc(0, 0, size, 0, 2 * Math.PI);
  }
  context.fillStyle = color;
  context.strokeStyle = "#000";
  context.lineWidth = 1.5 * window.devicePixelRatio;
  context.fill();
  context.stroke();
  context.fillStyle = "#000";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.font = `700 ${1.7 * size}px system-ui, sans-serif`;
  context.fillText(isDot ? "" : ({ inside: "+", outside: "−", boundary: "" }[kind] ?? kind), 0, 0.1 * size);
  context.restore();
}

function drawPreview(context: Context, niivue: Niivue, tile: Tile, preview: ShownPreview): void {
  context.save();
  context.fillStyle = changeColors[preview.kind];
  context.globalAlpha = 0.35;
  context.fill(voxelPath(niivue, tile, preview));
  context.restore();
}

/** Below and beside the pointer. */
function drawLabel(context: Context, tile: Tile, { kind, place, label }: ShownPreview): void {
  const size = 14 * window.devicePixelRatio;
  const [x, y] = pixelAt(tile, place);
  const [left, , width] = tile.leftTopWidthHeight;
  const isRight = x < left + 0.75 * width;
  context.font = `600 ${size}px system-ui, sans-serif`;
  context.fillStyle = changeColors[kind];
  write(context, label, x + (isRight ? size : -size), y + 1.3 * size, isRight ? "left" : "right");
}

function drawStroke(context: Context, tile: Tile, { kind, path }: ShownStroke): void {
  context.save();
  context.lineWidth = 5 * window.devicePixelRatio;
  context.lineCap = "round";
  context.lineJoin = "round";
  context.strokeStyle = changeColors[kind];
  context.globalAlpha = 0.8;
  context.beginPath();
  context.moveTo(...pixelAt(tile, path[0]));
  path.forEach((point) => context.lineTo(...pixelAt(tile, point)));
  context.stroke();
  context.restore();
}

/** In front of any gray. */
function write(context: Context, text: string, x: number, y: number, align: CanvasTextAlign): void {
  context.textAlign = align;
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.lineWidth = 3.5 * window.devicePixelRatio;
  context.strokeStyle = "#000";
  context.strokeText(text, x, y);
  context.fillText(text, x, y);
}

function drawText(context: Context, niivue: Niivue, tile: Tile, captions: string[]): void {
  const [left, top, width, height] = tile.leftTopWidthHeight;
  const size = 14 * window.devicePixelRatio;
  const gap = size / 2;
  context.fillStyle = "#f2f2f2";
  context.font = `600 ${size}px system-ui, sans-serif`;
  const [onLeft, onRight, below, above] = sidesOf(tile);
  write(context, onLeft, left + gap, top + height / 2, "left");
  write(context, onRight, left + width - gap, top + height / 2, "right");
  write(context, below, left + width / 2, top + height - size, "center");
  write(context, above, left + width / 2, top + size, "center");
  context.font = `${0.86 * size}px system-ui, sans-serif`;
  context.fillStyle = "#d5dade";
  const [x, y, z] = niivue.frac2mm(niivue.scene.crosshairPos);
  write(context, positionOf(tile, [x, y, z]), left + gap, top + size, "left");
  captions.forEach((caption, line) => {
    write(context, caption, left + gap, top + height - size * (1 + 1.2 * (captions.length - 1 - line)), "left");
  });
}

/** Draws all over, once NiiVue has drawn. */
export function drawOverlay(overlay: HTMLCanvasElement, niivue: Niivue, marks: Marks, captions: string[]): void {
  const { canvas } = niivue;
  const context = overlay.getContext("2d");
  if (!canvas || !context) {
    return;
  }
  if (overlay.width !== canvas.width || overlay.height !== canvas.height) {
    overlay.width = canvas.width;
    overlay.height = canvas.height;
  }
  context.clearRect(0, 0, canvas.width, canvas.height);
  if (niivue.volumes.length === 0) {
    return;
  }
  slicesOf(niivue).forEach((tile, index) => {
    context.save();
    context.beginPath();
    context.rect(...(tile.leftTopWidthHeight.slice(0, 4) as [number, number, number, number]));
    context.clip();
    if (marks.preview) {
      drawPreview(context, niivue, tile, marks.preview);
    }
    marks.surfaces.forEach((surface) => drawContour(context, niivue, tile, surface));
    marks.seeds.forEach((seed) => drawSeed(context, tile, seed));
    marks.points.forEach((point) => drawPoint(context, tile, point, marks.nearby));
    if (marks.stroke?.slice === tile.axCorSag) {
      drawStroke(context, tile, marks.stroke);
    }
    if (marks.preview && marks.pointed === tile.axCorSag) {
      drawLabel(context, tile, marks.preview);
    }
    drawQuestions(context, tile, marks);
    drawText(context, niivue, tile, index === 0 ? captions : []);
    context.restore();
  });
}
