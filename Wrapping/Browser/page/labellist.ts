/** The list of label surfaces in the panel: a row each, to show, color and name it, with its volume. */
import { field } from "./dom.js";
import type { ListedLabel } from "./labelsurfaces.js";

function rowOf(label: ListedLabel, changed: () => void): HTMLLIElement {
  const { found } = label;
  const called = label.name || `label ${found.label}`;
  const show = field("checkbox", `Show ${called}`);
  show.title = "Shown, and saved";
  show.checked = label.isShown;
  show.disabled = !found.surface;
  show.addEventListener("change", () => {
    label.isShown = show.checked;
    changed();
  });
  const color = field("color", `Color of ${called}`);
  color.value = label.color;
  color.addEventListener("change", () => {
    label.color = color.value;
    changed();
  });
  const name = field("text", `Name of label ${found.label}`);
  name.value = label.name;
  name.placeholder = `label ${found.label}`;
  name.spellcheck = false;
  name.autocomplete = "off";
  name.addEventListener("change", () => {
    label.name = name.value.trim();
    changed();
  });
  const volume = document.createElement("span");
  volume.textContent = found.surface ? `${found.volume.toFixed(found.volume < 10 ? 2 : 1)} ml` : "no surface";
  const row = document.createElement("li");
  row.title = `${label.name && `${label.name}, `}label ${found.label}: ${found.triangles} triangles, Euler number ${found.eulerNumber}, `
    + `${(found.area / 100).toFixed(1)} cm², ${found.voxelVolume.toFixed(2)} ml of voxels, ${found.wrongVoxels} on the wrong side`;
  row.append(show, color, name, volume);
  return row;
}

export function showLabels(list: HTMLElement, labels: readonly ListedLabel[], changed: () => void): void {
  const { scrollTop } = list;
  list.replaceChildren(...labels.map((label) => rowOf(label, changed)));
  list.scrollTop = scrollTop;
}
