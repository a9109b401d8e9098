/** Surfaces in 3D. */
import { type NVConfigOptions, NVMesh, Niivue, SLICE_TYPE } from "@niivue/niivue";
import { doubtfulVertexConfidence } from "../flipfree/index.js";
import { type ShownSurface, doubtColor } from "./overlay.js";

/** Of all views. */
export const niivueOptions = {
  dragAndDropEnabled: false,
  isResizeCanvas: true,
  backColor: [0, 0, 0, 1],
  logLevel: "fatal" as const, // what goes wrong is said by the page
  viewModeHotKey: "",
  clipPlaneHotKey: "",
  cycleClipPlaneHotKey: "",
  loadingText: "",
} satisfies Partial<NVConfigOptions>;

function bytesOf(color: string): [number, number, number] {
  return [1, 3, 5].map((at) => Number.parseInt(color.slice(at, at + 2), 16)) as [number, number, number];
}

/** Red, green, blue and opacity of each vertex. */
function colorsOf({ color, confidence }: ShownSurface): Uint8Array {
  const [own, doubtful] = [[...bytesOf(color), 255], [...bytesOf(doubtColor), 255]];
  const colors = new Uint8Array(4 * confidence.length);
  confidence.forEach((value, vertex) => colors.set(value < doubtfulVertexConfidence ? doubtful : own, 4 * vertex));
  return colors;
}

export class Solid {
  private readonly niivue = new Niivue({ ...niivueOptions, show3Dcrosshair: false, isOrientCube: true });
  private isReady: Promise<void> | null = null;
  private meshes: { shown: ShownSurface; mesh: NVMesh }[] = [];

  constructor(private readonly canvas: HTMLCanvasElement) {}

  /** Its shaders take almost half of the page's time to load, so that is done with the first run. */
  prepare(): Promise<void> {
    this.isReady ??= this.niivue.attachToCanvas(this.canvas).then(() => {
      this.niivue.setSliceType(SLICE_TYPE.RENDER);
      this.niivue.setRenderAzimuthElevation(180, 10); // from the front, as the coronal slice
    });
    return this.isReady;
  }

  show(surfaces: readonly ShownSurface[]): void {
    if (this.isReady || surfaces.length > 0) {
      void this.prepare().then(() => this.draw(surfaces));
    }
  }

  /** What is drawn already stays. */
  private draw(surfaces: readonly ShownSurface[]): void {
    const drawn = this.meshes;
    this.meshes = surfaces.map((shown) => {
      const same = drawn.find((one) => one.shown.points === shown.points && one.shown.color === shown.color);
      return same ?? { shown, mesh: this.meshOf(shown) };
    });
    for (const { mesh } of drawn.filter((one) => !this.meshes.includes(one))) {
      mesh.unloadMesh(this.niivue.gl);
    }
    this.niivue.meshes = this.meshes.map(({ mesh }) => mesh);
    this.niivue.updateGLVolume();
  }

  private meshOf(shown: ShownSurface): NVMesh {
    return new NVMesh(Float32Array.from(shown.points), shown.triangles, "surface", colorsOf(shown), 1, true, this.niivue.gl);
  }
}
