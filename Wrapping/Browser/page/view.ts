/** Slices and surface on the screen. NiiVue draws the volume and the surface in 3D; contours and seeds are drawn over
 * its slices, exactly where the surface crosses them. NiiVue's coordinates are RAS, all others LPS. */
import { type NVConfigOptions, NVMesh, Niivue, SHOW_RENDER, SLICE_TYPE } from "@niivue/niivue";
import { type Seed, type Surface, type Triple, trianglesOf } from "../flipfree/index.js";
import { crossSection } from "./crosssection.js";
import type { OpenImage } from "./volumes.js";

interface ShownSurface {
  points: Float64Array; // RAS
  triangles: Uint32Array;
  fractions: Float64Array; // of the volume's extents, by which NiiVue counts slices
  color: string;
}

type Tile = Niivue["screenSlices"][number];
type Point = [number, number, number];

/** Which coordinates run to the right, upward, and away. */
const axesOf: Record<number, [number, number, number]> = {
  [SLICE_TYPE.AXIAL]: [0, 1, 2],
  [SLICE_TYPE.CORONAL]: [0, 2, 1],
  [SLICE_TYPE.SAGITTAL]: [1, 2, 0],
};

function swapLpsRas(point: Triple | Point): Point {
  return [-point[0] + 0, -point[1] + 0, point[2]];
}

function bytesOf(color: string): [number, number, number] {
  return [1, 3, 5].map((at) => Number.parseInt(color.slice(at, at + 2), 16)) as [number, number, number];
}

const common = {
  dragAndDropEnabled: false,
  isResizeCanvas: true,
  backColor: [0, 0, 0, 1],
  logLevel: "error" as const,
  viewModeHotKey: "",
  clipPlaneHotKey: "",
  cycleClipPlaneHotKey: "",
  loadingText: "",
} satisfies Partial<NVConfigOptions>;

export class View {
  private readonly slices: Niivue;
  private readonly solid: Niivue;
  private surfaces: ShownSurface[] = [];
  private seed: { seed: Seed; color: string } | null = null;

  /** Called while a seed is dragged, and when it is placed. */
  onSeed: (seed: Seed, placed: boolean) => void = () => {};

  private constructor(private readonly overlay: HTMLCanvasElement) {
    this.slices = new Niivue({
      ...common,
      isRadiologicalConvention: true,
      isSliceMM: true,
      isOrientationTextVisible: true,
      sagittalNoseLeft: true,
      multiplanarShowRender: SHOW_RENDER.NEVER,
      crosshairWidth: 0.5,
      crosshairColor: [0.45, 0.75, 1, 0.6],
    });
    this.solid = new Niivue({ ...common, show3Dcrosshair: false, isOrientCube: true });
  }

  static async open(slices: HTMLCanvasElement, overlay: HTMLCanvasElement, solid: HTMLCanvasElement): Promise<View> {
    const view = new View(overlay);
    await view.slices.attachToCanvas(slices);
    await view.solid.attachToCanvas(solid);
    view.solid.setSliceType(SLICE_TYPE.RENDER);
    view.slices.setCustomLayout([
      { sliceType: SLICE_TYPE.AXIAL, position: [0, 0, 0.5, 0.5] },
      { sliceType: SLICE_TYPE.CORONAL, position: [0.5, 0, 0.5, 0.5] },
      { sliceType: SLICE_TYPE.SAGITTAL, position: [0, 0.5, 0.5, 0.5] },
    ]);
    // NiiVue has no event for it.
    const draw = view.slices.drawScene.bind(view.slices);
    view.slices.drawScene = () => {
      const result = draw();
      view.drawOverlay();
      return result;
    };
    view.takeDrags();
    return view;
  }

  /** Shows a volume, and nothing else any more. */
  show(opened: OpenImage): void {
    this.seed = null;
    this.setSurfaces([]);
    for (const volume of [...this.slices.volumes]) {
      this.slices.removeVolume(volume);
    }
    this.slices.addVolume(opened.shown);
    this.slices.scene.crosshairPos = [0.5, 0.5, 0.5];
    this.slices.scene.pan2Dxyzmm = [0, 0, 0, 1];
    this.slices.drawScene();
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
    return swapLpsRas([x, y, z]);
  }

  set crosshair(point: Point) {
    this.slices.scene.crosshairPos = this.slices.mm2frac(swapLpsRas(point));
    this.slices.drawScene();
  }

  moveCrosshair(i: number, j: number, k: number): void {
    this.slices.moveCrosshairInVox(i, j, k);
  }

  setSeed(seed: Seed | null, color: string): void {
    this.seed = seed && { seed: { ...seed, center: swapLpsRas(seed.center) }, color };
    this.drawOverlay();
  }

  set placing(placing: boolean) {
    this.overlay.classList.toggle("placing", placing);
  }

  setSurfaces(surfaces: { surface: Surface; color: string }[]): void {
    for (const mesh of [...this.solid.meshes]) {
      this.solid.removeMesh(mesh);
    }
    this.surfaces = surfaces.map(({ surface, color }) => this.shownSurface(surface, color));
    for (const { points, triangles, color } of this.surfaces) {
      const rgba = new Uint8Array([...bytesOf(color), 255]);
      this.solid.addMesh(new NVMesh(Float32Array.from(points), triangles, "surface", rgba, 1, true, this.solid.gl));
    }
    this.solid.drawScene();
    this.drawOverlay();
  }

  private shownSurface(surface: Surface, color: string): ShownSurface {
    const points = Float64Array.from(surface.points, (value, at) => (at % 3 === 2 ? value : -value));
    const fractions = new Float64Array(points.length);
    for (let at = 0; at < points.length; at += 3) {
      fractions.set(this.slices.mm2frac([points[at], points[at + 1], points[at + 2]]), at);
    }
    return { points, triangles: trianglesOf(surface), fractions, color };
  }

  /** From the overlay's pixels to those of NiiVue, which has the same size on the screen. */
  private takeDrags(): void {
    let drag: { pointer: number; tile: Tile; center: Point } | null = null;
    const { overlay } = this;
    const position = (event: PointerEvent): [number, number] => {
      const box = overlay.getBoundingClientRect();
      const scale = this.slices.canvas!.width / box.width;
      return [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    };
    const report = (event: PointerEvent, placed: boolean) => {
      if (drag && drag.pointer === event.pointerId) {
        const [x, y] = position(event);
        const end = this.pointAt(drag.tile, x, y);
        const radius = Math.hypot(...end.map((value, axis) => value - drag!.center[axis]));
        this.onSeed({ center: swapLpsRas(drag.center), radius }, placed);
      }
    };
    overlay.addEventListener("pointerdown", (event) => {
      const [x, y] = position(event);
      const tile = this.tileAt(x, y);
      if (tile && event.button === 0) {
        overlay.setPointerCapture(event.pointerId);
        drag = { pointer: event.pointerId, tile, center: this.pointAt(tile, x, y) };
        this.crosshair = swapLpsRas(drag.center);
      }
    });
    overlay.addEventListener("pointermove", (event) => report(event, false));
    overlay.addEventListener("pointerup", (event) => {
      report(event, true);
      drag = null;
    });
    overlay.addEventListener("pointercancel", () => (drag = null));
    overlay.addEventListener("contextmenu", (event) => event.preventDefault());
    // Slices are turned as if the overlay were not there.
    overlay.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.slices.canvas!.dispatchEvent(new WheelEvent("wheel", event));
      },
      { passive: false },
    );
  }

  private tileAt(x: number, y: number): Tile | undefined {
    return this.slices.screenSlices.find(({ leftTopWidthHeight: [left, top, width, height], axCorSag }) => {
      return axCorSag in axesOf && x >= left && x < left + width && y >= top && y < top + height;
    });
  }

  /** The point (RAS) of a slice under a pixel. */
  private pointAt(tile: Tile, x: number, y: number): Point {
    const [left, top, width, height] = tile.leftTopWidthHeight;
    const a = tile.leftTopMM[0] + ((x - left) / width) * tile.fovMM[0];
    const b = tile.leftTopMM[1] + (1 - (y - top) / height) * tile.fovMM[1];
    const v = tile.AxyzMxy;
    const depth = v[2] + v[4] * (b - v[1]) - v[3] * (a - v[0]);
    const [right, up, away] = axesOf[tile.axCorSag];
    const point: Point = [0, 0, 0];
    point[right] = a;
    point[up] = b;
    point[away] = depth;
    return point;
  }

  private pixelAt(tile: Tile, point: ArrayLike<number>): [number, number] {
    const [left, top, width, height] = tile.leftTopWidthHeight;
    const [right, up] = axesOf[tile.axCorSag];
    return [
      left + ((point[right] - tile.leftTopMM[0]) / tile.fovMM[0]) * width,
      top + height - ((point[up] - tile.leftTopMM[1]) / tile.fovMM[1]) * height,
    ];
  }

  private drawOverlay(): void {
    const { canvas } = this.slices;
    const context = this.overlay.getContext("2d");
    if (!canvas || !context) {
      return;
    }
    if (this.overlay.width !== canvas.width || this.overlay.height !== canvas.height) {
      this.overlay.width = canvas.width;
      this.overlay.height = canvas.height;
    }
    context.clearRect(0, 0, canvas.width, canvas.height);
    if (this.slices.volumes.length === 0) {
      return;
    }
    context.lineWidth = 1.8 * window.devicePixelRatio;
    for (const tile of this.slices.screenSlices.filter(({ axCorSag }) => axCorSag in axesOf)) {
      context.save();
      context.beginPath();
      const [left, top, width, height] = tile.leftTopWidthHeight;
      context.rect(left, top, width, height);
      context.clip();
      this.drawContours(context, tile);
      this.drawSeed(context, tile);
      context.restore();
    }
  }

  private drawContours(context: CanvasRenderingContext2D, tile: Tile): void {
    const [, , away] = axesOf[tile.axCorSag];
    const slice = this.slices.scene.crosshairPos[away];
    for (const { points, triangles, fractions, color } of this.surfaces) {
      const values = new Float64Array(points.length / 3);
      for (let vertex = 0; vertex < values.length; ++vertex) {
        values[vertex] = fractions[3 * vertex + away] - slice;
      }
      const segments = crossSection(points, triangles, values);
      context.strokeStyle = color;
      context.beginPath();
      for (let end = 0; end < segments.length; end += 6) {
        context.moveTo(...this.pixelAt(tile, segments.slice(end, end + 3)));
        context.lineTo(...this.pixelAt(tile, segments.slice(end + 3, end + 6)));
      }
      context.stroke();
    }
  }

  private drawSeed(context: CanvasRenderingContext2D, tile: Tile): void {
    if (!this.seed) {
      return;
    }
    const { center, radius } = this.seed.seed;
    const [x, y] = this.pixelAt(tile, center);
    // How far the slice is from the center, along the axis that it looks.
    const [right, up, away] = axesOf[tile.axCorSag];
    const v = tile.AxyzMxy;
    const depth = v[2] + v[4] * (center[up] - v[1]) - v[3] * (center[right] - v[0]);
    const slope = Math.hypot(1, v[3], v[4]);
    const distance = Math.abs(depth - center[away]) / slope;
    if (!(distance < radius)) {
      return;
    }
    const pixels = tile.leftTopWidthHeight[2] / Math.abs(tile.fovMM[0]);
    context.strokeStyle = this.seed.color;
    context.setLineDash([6, 4]);
    context.beginPath();
    context.arc(x, y, Math.sqrt(radius ** 2 - distance ** 2) * pixels, 0, 2 * Math.PI);
    context.stroke();
    context.setLineDash([]);
    context.fillStyle = this.seed.color;
    context.fillRect(x - 2, y - 2, 4, 4);
  }
}
