// Answers about the open point that take longer than its motion. Another point ends them.

import { getJson, ServerError } from "./server.js";

export class SlowAnswers {
  constructor() {
    this.abort = new AbortController();
    this.timers = new Set();
  }

  stop() {
    this.abort.abort();
    this.abort = new AbortController();
    for (const timer of this.timers) clearTimeout(timer);
    this.timers.clear();
  }

  // take(answer, sentence about trouble): one of them. patient: tries again while the server is away.
  async ask(address, patient, take, wait = 500) {
    const { signal } = this.abort;
    try {
      const answer = await getJson(address, signal);
      if (!signal.aborted) take(answer, "");
    } catch (error) {
      if (signal.aborted) return;
      const busy = !(error instanceof ServerError) || error.status === 429;
      if (!busy || !patient) {
        take(null, error instanceof ServerError ? error.message : "the server does not answer; try again");
        return;
      }
      const timer = setTimeout(() => {
        this.timers.delete(timer);
        this.ask(address, patient, take, Math.min(8000, 2 * wait));
      }, wait);
      this.timers.add(timer);
    }
  }
}
