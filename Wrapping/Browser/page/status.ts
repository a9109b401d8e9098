/** What the page says. */
import { element, input } from "./dom.js";

export function say(text: string): void {
  element("status").textContent = text;
  element("error").textContent = "";
}

export function complain(error: unknown): void {
  element("status").textContent = "";
  element("error").textContent = error instanceof Error ? error.message : String(error);
  element("error").scrollIntoView({ block: "nearest" });
}

export function showProgress(done: number): void {
  input("progress").value = String(done);
}
