/** What the page says. */
import { element, input } from "./dom.js";

export function say(text: string): void {
  element("status").textContent = text;
  element("error").textContent = "";
}

/** Of places, a tenth of a millimeter is enough: the message is shorter. */
function withShortPlaces(message: string): string {
  return message.replace(/\([-\d., ]+\)/g, (place) => place.replace(/-?\d+\.\d+/g, (text) => String(Number(Number(text).toFixed(1)))));
}

export function complain(error: unknown): void {
  element("status").textContent = "";
  element("error").textContent = withShortPlaces(error instanceof Error ? error.message : String(error));
  element("error").scrollIntoView({ block: "nearest" });
}

export function showProgress(done: number): void {
  input("progress").value = String(done);
}
