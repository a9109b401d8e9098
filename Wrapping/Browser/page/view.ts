/** Slices on the screen. NiiVue draws the volume, and the surfaces in 3D; what is drawn over its slices and what the pointer does
 * there is ours. NiiVue's coordinates are RAS, all others LPS. */
import { Niivue, SHOW_RENDER, SLICE_TYPE } from "@niivue/niivue";
import type { Seed, Triple } from "../flipfree/index.js";
import { type ViewedOrgan, marksOf, swapped } from "./marks.js";
import { type Marks, type ShownPreview, drawOverlay } from "./overlay.js";
import { type QuestionMark, questionMarkAt } from "./questionmarks.js";
import { ShownSurfaces } from "./shownsurfaces.js";
import { Solid, niivueOptions } from "./solid.js";
import { thinned } from "./stroke.js";
import { type Point, type Tile, pixelWithin, pointAt, tileAt } from "./tiles.js";
import type { OpenImage } from "./volumes.js";

/** What the left button does: it places the seed or a further one, moves the cross-hair, places a point, or paints points. */
export type Tool = "seed" | "further" | "navigate" | "inside" | "outside" | "boundary" | "point";

/** For shading a volume in 3D, which this page does not do, NiiVue computes its gradients with each window: twice the memory of
 * the image on the screen, and most of the time. Here, they get one voxel of each slice. */
function leaveOutGradients(niivue: Niivue): void {
  const units: number[] = [WebGL2RenderingContext.TEXTURE6, WebGL2RenderingContext.TEXTURE8];
  const make = niivue.rgbaTex.bind(niivue);
  niivue.rgbaTex = (texture, unit, dims, isInit) => {
    const isGradient = units.includes(unit) && dims === niivue.volumes[0]?.hdr?.dims;
    return make(texture, unit, isGradient ? [dims[0], 1, 1, dims[3]] : dims, isInit);
  };
}

interface Drag {
  pointer: number;
  button: number;
  tile: Tile;
  start: [number, number];
  center: Point;
  window: [number, number];
  path: Point[];
}

/** Millimeters between the points of a stroke, or a voxel if that is more. */
const strokeStep = 3;

export class View {
  private readonly slices: Niivue;
  private readonly solid: Solid;
  private readonly surfaces = new ShownSurfaces();
  private marks: Marks = {
    surfaces: [],
    seeds: [],
    points: [],
    questions: [],
    chosenQuestion: -1,
    stroke: null,
    preview: null,
    pointed: null,
    nearby: 1,
  };
  private strokeStep = strokeStep;

  private currentTool: Tool | null = null;
  /** The place under the pointer, if a click there would use the tool. */
  hovered: Triple | null = null;

  /** Called while a seed is dragged, and when it is placed. */
  onSeed: (seed: Seed, placed: boolean) => void = () => {};
  /** Called when a point is placed, or several by a stroke. */
  onPoints: (positions: Triple[]) => void = () => {};
  /** Called when a question's mark is clicked, or the answer beside it. */
  onQuestion: (question: number, isOrgan: boolean | null) => void = () => {};
  /** Called when the window was dragged. */
  onWindow: () => void = () => {};
  /** Called when the pointer has moved, or has another tool. */
  onHover: () => void = () => {};

  private constructor(
    private readonly overlay: HTMLCanvasElement,
    solidCanvas: HTMLCanvasElement,
  ) {
    this.slices = new Niivue({
      ...niivueOptions,
      isRadiologicalConvention: true,
      isSliceMM: true,
      isOrientationTextVisible: false, // the overlay has all four letters
      sagittalNoseLeft: true,
      multiplanarShowRender: SHOW_RENDER.NEVER,
      crosshairWidth: 0.5,
      crosshairColor: [0.8, 0.8, 0.8, 0.6],
    });
    this.solid = new Solid(solidCanvas);
  }

  static async open(slices: HTMLCanvasElement, overlay: HTMLCanvasElement, solid: HTMLCanvasElement): Promise<View> {
    const view = new View(overlay, solid);
    await view.slices.attachToCanvas(slices);
    view.slices.setCustomLayout([
      { sliceType: SLICE_TYPE.AXIAL, position: [0, 0, 0.5, 0.5] },
      { sliceType: SLICE_TYPE.CORONAL, position: [0.5, 0, 0.5, 0.5] },
      { sliceType: SLICE_TYPE.SAGITTAL, position: [0, 0.5, 0.5, 0.5] },
    ]);
    leaveOutGradients(view.slices);
    // NiiVue has no event for it.
    const draw = view.slices.drawScene.bind(view.slices);
    view.slices.drawScene = () => {
      const result = draw();
      view.drawMarks();
      return result;
    };
    view.takePointer();
    view.takeWheel();
    return view;
  }

  /** Makes the view in 3D ready. */
  prepareSurfaces(): Promise<void> {
    return this.solid.prepare();
  }

  /** Shows a volume, and nothing else any more. The window comes with it: with each, NiiVue makes its textures anew. */
  show(opened: OpenImage, [least, greatest]: [number, number]): void {
    this.setOrgans([]);
    this.surfaces.forget();
    for (const volume of [...this.slices.volumes]) {
      this.slices.removeVolume(volume);
    }
    opened.shown.cal_min = least;
    opened.shown.cal_max = greatest;
    this.slices.addVolume(opened.shown);
    this.marks.nearby = Math.max(1, ...opened.image.spacing.map((spacing) => 0.6 * spacing));
    this.strokeStep = Math.max(strokeStep, ...opened.image.spacing);
    this.slices.scene.crosshairPos = [0.5, 0.5, 0.5];
    this.slices.scene.pan2Dxyzmm = [0, 0, 0, 1];
    this.slices.drawScene();
  }

  get tool(): Tool | null {
    return this.currentTool;
  }

  set tool(tool: Tool | null) {
    this.currentTool = tool;
    this.onHover();
  }

  /** What a point would change. */
  setPreview(preview: (Omit<ShownPreview, "place"> & { place: Triple }) | null): void {
    if (preview || this.marks.preview) {
      this.marks.preview = preview && { ...preview, place: swapped(preview.place) };
      this.drawMarks();
    }
  }

  get window(): [number, number] {
    const [volume] = this.slices.volumes;
    return [volume.cal_min ?? 0, volume.cal_max ?? 1];
  }

  set window([least, greatest]: [number, number]) {
    const [volume] = this.slices.volumes;
    volume.cal_min = least;
    volume.cal_max = greatest;
    this.slices.updateGLVolume();
  }

  get crosshair(): Point {
    const [x, y, z] = this.slices.frac2mm(this.slices.scene.crosshairPos);
    return swapped([x, y, z]);
  }

  /** At the volume's border for a point outside. */
  set crosshair(point: Point) {
    const [x, y, z] = [...this.slices.mm2frac(swapped(point))].map((fraction) => Math.min(1, Math.max(0, fraction)));
    this.slices.scene.crosshairPos = [x, y, z];
    this.slices.drawScene();
  }

  moveCrosshair(i: number, j: number, k: number): void {
    this.slices.moveCrosshairInVox(i, j, k);
  }

  /** Magnifies around the cross-hair; 1 shows all. */
  zoomBy(factor: number): void {
    const [x, y, z, old] = this.slices.scene.pan2Dxyzmm;
    const zoom = Math.min(10, Math.max(1, old * factor));
    const [a, b, c] = this.slices.frac2mm(this.slices.scene.crosshairPos);
    const move = zoom === 1 ? [-x, -y, -z] : [a, b, c].map((value) => (old - zoom) * value);
    this.slices.scene.pan2Dxyzmm = [x + move[0], y + move[1], z + move[2], zoom];
    this.slices.drawScene();
  }

  setOrgans(organs: ViewedOrgan[]): void {
    this.marks = {
      ...this.marks,
      surfaces: this.surfaces.of(organs, (point) => this.slices.mm2frac(point)),
    };
    this.solid.show(this.marks.surfaces);
    this.setMarks(organs);
  }

  /** Seeds, points and questions; the surfaces stay. */
  setMarks(organs: ViewedOrgan[]): void {
    this.marks = { ...this.marks, ...marksOf(organs, 2 * this.strokeStep) };
    this.drawMarks();
  }

  private drawMarks(): void {
    if (this.slices.volumes.length > 0) {
      const [least, greatest] = this.window;
      const caption = `W ${Math.round(greatest - least)}  L ${Math.round((least + greatest) / 2)}`;
      drawOverlay(this.overlay, this.slices, this.marks, [caption]);
    }
  }

  /** The overlay has NiiVue's size on the screen, which counts pixels of the device. */
  private pixelOf(event: MouseEvent): [number, number] {
    const box = this.overlay.getBoundingClientRect();
    const scale = this.overlay.width / box.width;
    return [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
  }

  private takePointer(): void {
    let drag: Drag | null = null;
    const { overlay } = this;
    const move = (event: PointerEvent, isLast: boolean) => {
      if (!drag || drag.pointer !== event.pointerId) {
        return;
      }
      if (drag.button === 2) {
        this.dragWindow(drag, this.pixelOf(event));
      } else if (this.tool === "seed" || this.tool === "further") {
        const end = pointAt(drag.tile, ...this.pixelOf(event));
        const radius = Math.hypot(...end.map((value, axis) => value - drag!.center[axis]));
        this.onSeed({ center: swapped(drag.center), radius }, isLast);
      } else if (this.tool === "navigate") {
        this.crosshair = swapped(pointAt(drag.tile, ...this.pixelOf(event)));
      } else if (this.tool === "inside" || this.tool === "outside") {
        drag.path.push(pointAt(drag.tile, ...pixelWithin(drag.tile, ...this.pixelOf(event))));
        this.marks.stroke = isLast ? null : { kind: this.tool, path: drag.path, slice: drag.tile.axCorSag };
        this.drawMarks();
        if (isLast) {
          this.onPoints(thinned(drag.path, this.strokeStep).map(swapped));
        }
      } else if (this.tool) {
        const position = swapped(pointAt(drag.tile, ...this.pixelOf(event)));
        this.crosshair = position;
        if (isLast) {
          this.onPoints([position]);
        }
      }
    };
    const end = () => {
      drag = null;
      this.marks.stroke = null;
      this.drawMarks();
    };
    overlay.addEventListener("pointerdown", (event) => {
      const start = this.pixelOf(event);
      if (event.pointerType !== "mouse") {
        this.point(start, false); // a finger has not moved there
      }
      const tile = tileAt(this.slices, ...start);
      const mark = event.button === 0 ? this.questionMarkAt(start) : undefined;
      if (mark) {
        this.onQuestion(mark.question, mark.isOrgan);
      } else if (tile && this.tool && (event.button === 0 || event.button === 2)) {
        overlay.setPointerCapture(event.pointerId);
        const center = pointAt(tile, ...start);
        drag = { pointer: event.pointerId, button: event.button, tile, start, center, window: this.window, path: [center] };
        if (event.button === 0) {
          this.crosshair = swapped(center);
        }
      }
    });
    overlay.addEventListener("pointermove", (event) => {
      move(event, false);
      this.point(this.pixelOf(event), drag !== null);
    });
    overlay.addEventListener("pointerleave", (event) => {
      if (event.pointerType === "mouse") {
        this.point(null, false);
      }
    });
    overlay.addEventListener("pointerup", (event) => {
      move(event, true);
      end();
    });
    overlay.addEventListener("pointercancel", end);
    overlay.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  private questionMarkAt(pixel: [number, number]): QuestionMark | undefined {
    const tile = tileAt(this.slices, ...pixel);
    return tile && questionMarkAt(tile, this.marks, ...pixel);
  }

  /** Where the pointer is, dragged or not. */
  private point(pixel: [number, number] | null, isDragged: boolean): void {
    const tile = pixel && tileAt(this.slices, ...pixel);
    const pointed = tile?.axCorSag ?? null;
    if (this.marks.pointed !== pointed) {
      this.marks.pointed = pointed;
      this.drawMarks();
    }
    const isOnMark = pixel !== null && !isDragged && this.questionMarkAt(pixel) !== undefined;
    this.overlay.classList.toggle("on-question", isOnMark);
    this.hovered = pixel && tile && !isDragged && !isOnMark ? swapped(pointAt(tile, ...pixel)) : null;
    this.onHover();
  }

  /** To the right for a wider window, upward for a lower level, as on workstations. */
  private dragWindow({ start, window: [least, greatest] }: Drag, [x, y]: [number, number]): void {
    const step = (greatest - least) / 300;
    const width = Math.max(1e-6 * (greatest - least), greatest - least + (x - start[0]) * step);
    const level = (least + greatest) / 2 + (y - start[1]) * step;
    this.window = [level - width / 2, level + width / 2];
    this.onWindow();
  }

  /** Turns the slices as if the overlay were not there. */
  private takeWheel(): void {
    const take = (event: WheelEvent) => {
      event.preventDefault();
      if (event.ctrlKey) {
        this.zoomBy(event.deltaY < 0 ? 1.1 : 1 / 1.1);
      } else {
        this.slices.canvas!.dispatchEvent(new WheelEvent("wheel", event));
      }
      this.point(this.pixelOf(event), event.buttons !== 0);
    };
    this.overlay.addEventListener("wheel", take, { passive: false });
  }
}
