/** Work that takes time. */
import { app } from "./app.js";
import { refresh, showAll } from "./panel.js";
import { complain, say, showProgress } from "./status.js";

/** Who works with keys goes on where they were: rows of lists are made anew. */
function focusAgain(before: Element | null): void {
  const label = before?.getAttribute("aria-label");
  if (label && document.activeElement === document.body) {
    document.querySelector<HTMLElement>(`aside [aria-label="${CSS.escape(label)}"]`)?.focus({ preventScroll: true });
  }
}

/** Runs work that a button or key starts: one at a time, and what goes wrong is said. */
export async function work(text: string, run: (signal: AbortSignal) => Promise<void>): Promise<void> {
  if (app.running) {
    return;
  }
  const focused = document.activeElement;
  const mine = new AbortController();
  app.running = mine;
  say(text);
  refresh();
  try {
    await run(mine.signal);
  } catch (error) {
    if (mine.signal.aborted) {
      say("Canceled.");
    } else {
      complain(error);
    }
  } finally {
    app.running = null;
    showProgress(0);
    showAll();
    focusAgain(focused);
  }
}

export function cancel(): void {
  app.running?.abort(new Error("Canceled"));
}
