/** The list of organs in the panel: a row each, to choose, color, name and remove it. */
import { field } from "./dom.js";
import type { Organs, OrganState } from "./organs.js";

function rowOf(organ: OrganState, organs: Organs, changed: () => void): HTMLLIElement {
  const choose = field("radio", `Choose ${organ.name}`);
  choose.name = "organ";
  choose.checked = organ === organs.chosen;
  choose.addEventListener("change", () => {
    organs.choose(organ);
    changed();
  });
  const color = field("color", `Color of ${organ.name}`);
  color.value = organ.color;
  color.addEventListener("change", () => {
    organs.change(organ, { color: color.value });
    changed();
  });
  const name = field("text", "Name of the organ");
  name.value = organ.name;
  name.spellcheck = false;
  name.autocomplete = "off"; // no browser needs to learn it
  name.addEventListener("change", () => {
    organs.change(organ, { name: name.value.trim() || organ.name });
    changed();
  });
  const remove = document.createElement("button");
  remove.type = "button";
  remove.textContent = "×";
  remove.setAttribute("aria-label", `Remove ${organ.name}`);
  remove.addEventListener("click", () => {
    organs.remove(organ);
    changed();
  });
  const row = document.createElement("li");
  row.append(choose, color, name, remove);
  row.classList.toggle("chosen", choose.checked);
  return row;
}

export function showOrgans(list: HTMLElement, organs: Organs, changed: () => void): void {
  list.replaceChildren(...organs.list.map((organ) => rowOf(organ, organs, changed)));
}
