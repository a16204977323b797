// Keeps one stream of strips open for what the diagram lacks, and tries again when the server is away.

import { readRecords, ServerError, textOf } from "./server.js";
import { nameOfLine } from "./strips.js";

const mostStrips = 128;

export class StripLoader {
  // job: line() -> line or null, needed() -> strips, onStrip(line, d, i, data, samples), onChange(),
  // onTrouble(sentence or null), onUnknownScene()
  constructor(job) {
    this.job = job;
    this.page = crypto.getRandomValues(new Uint32Array(3)).join("-");
    this.abort = null;
    this.open = null;
    this.timer = 0;
    this.retryTimer = 0;
    this.failures = 0;
    this.left = 0;
  }

  get busy() { return this.abort !== null || this.timer !== 0 || this.retryTimer !== 0; }

  // Many changes in a row are one request.
  refresh() {
    if (this.timer) return;
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.start();
    }, 40);
  }

  stop() {
    if (this.abort) this.abort.abort();
    this.abort = null;
    this.open = null;
  }

  start() {
    const line = this.job.line();
    const all = line ? this.job.needed() : [];
    this.left = all.length;
    if (all.length === 0) {
      this.stop();
      if (!line) this.job.onTrouble(null);
      this.job.onChange();
      return;
    }
    const list = all.slice(0, mostStrips);
    const name = nameOfLine(line);
    const same = this.open !== null && this.open.name === name && this.open.strips.size === list.length &&
      list.every((strip) => this.open.strips.has(strip.join("/")));
    if (same || this.retryTimer) return;
    this.stop();
    this.run(line, name, list);
  }

  async run(line, name, list) {
    const abort = new AbortController();
    const open = { name, strips: new Set(list.map((strip) => strip.join("/"))) };
    this.abort = abort;
    this.open = open;
    this.job.onChange();
    let got = 0;
    let trouble = null;
    const request = { scene: line.scene.key, page: this.page, axis: line.axis, at: [line.depth, line.k],
      strips: list };
    try {
      await readRecords("diagram", request, abort.signal, (head, numbers) => {
        if (this.abort !== abort) return;
        if (head[0] === 3) {
          got++;
          this.left = Math.max(0, this.left - 1);
          open.strips.delete(head[1] + "/" + head[2]);
          this.job.onStrip(line, head[1], head[2], numbers, head[7]);
          this.working();
        } else if (head[0] === 1) {
          trouble = textOf(numbers);
        }
      });
      if (trouble === null && got === 0) trouble = "the server sent no diagram; trying again";
    } catch (error) {
      if (this.abort !== abort || abort.signal.aborted) return;
      if (error instanceof ServerError) {
        trouble = error.message;
        if (error.status >= 400 && error.status < 500) this.job.onUnknownScene();
      } else {
        trouble = "the server does not answer; trying again";
      }
    }
    if (this.abort !== abort) return;
    this.stop();
    if (trouble === null) this.start();
    else this.later(trouble);
    this.job.onChange();
  }

  working() {
    if (this.failures === 0) return;
    this.failures = 0;
    this.job.onTrouble(null);
  }

  // The wait doubles up to 8 seconds.
  later(trouble) {
    this.job.onTrouble(trouble);
    const wait = Math.min(8000, 500 * 2 ** this.failures);
    this.failures++;
    this.retryTimer = setTimeout(() => {
      this.retryTimer = 0;
      this.start();
    }, wait);
  }
}
