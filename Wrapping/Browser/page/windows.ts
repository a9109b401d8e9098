/** Windows: which gray values are shown. */

export interface WindowPreset {
  name: string;
  /** Level and width; null for the image's own range. */
  window: [number, number] | null;
}

/** In Hounsfield units. */
const forCT: WindowPreset[] = [
  { name: "Abdomen", window: [40, 400] },
  { name: "Liver", window: [80, 150] },
  { name: "Mediastinum", window: [50, 350] },
  { name: "Lung", window: [-600, 1500] },
  { name: "Bone", window: [400, 1800] },
  { name: "Full range", window: null },
];

const forOthers: WindowPreset[] = [{ name: "Full range", window: null }];

export function presetsFor(isCT: boolean): WindowPreset[] {
  return isCT ? forCT : forOthers;
}

/** The least and greatest value shown. */
export function rangeOf({ window }: WindowPreset, own: [number, number]): [number, number] {
  return window ? [window[0] - window[1] / 2, window[0] + window[1] / 2] : own;
}
