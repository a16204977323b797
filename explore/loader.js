// Keeps one stream of tiles open for what the view lacks, and tries again when the server is away.

import { readTiles, ServerError, textOf } from "./server.js";

const mostTiles = 512;

const nameOf = (tile) => tile.join("/");

export class Loader {
  // job: scene() -> key or null, needed() -> tiles, wait() -> whether something else comes first,
  // onTile(scene, d, i, j, data), onSpeed(points a second), onChange(),
  // onTrouble(sentence or null), onUnknownScene()
  constructor(job) {
    this.job = job;
    this.page = crypto.getRandomValues(new Uint32Array(3)).join("-");
    this.abort = null;
    this.open = new Set();
    this.openScene = null;
    this.timer = 0;
    this.retryTimer = 0;
    this.failures = 0;
    this.left = 0;
  }

  get busy() { return this.abort !== null || this.timer !== 0 || this.retryTimer !== 0; }

  // The view has changed. Many changes in a row are one request.
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
    this.open.clear();
  }

  start() {
    const scene = this.job.scene();
    const all = scene === null ? [] : this.job.needed();
    this.left = all.length;
    if (all.length === 0) {
      if (scene !== null) this.stop();
      this.job.onChange();
      return;
    }
    if (this.job.wait()) {
      this.stop();
      this.job.onChange();
      return;
    }
    const list = all.slice(0, mostTiles);
    const same = this.abort !== null && this.openScene === scene && this.open.size === list.length &&
      list.every((tile) => this.open.has(nameOf(tile)));
    if (same || this.retryTimer) return;
    this.stop();
    this.run(scene, list);
  }

  async run(scene, list) {
    const abort = new AbortController();
    this.abort = abort;
    this.openScene = scene;
    this.open = new Set(list.map(nameOf));
    this.job.onChange();
    let got = 0;
    let trouble = null;
    try {
      await readTiles({ scene, page: this.page, tiles: list }, abort.signal, (head, numbers) => {
        if (this.abort !== abort) return;
        this.job.onSpeed(head[5]);
        if (head[0] === 0) {
          got++;
          this.left = Math.max(0, this.left - 1);
          this.open.delete([head[1], head[2], head[3]].join("/"));
          this.job.onTile(scene, head[1], head[2], head[3], numbers);
          this.working();
        } else if (head[0] === 1) {
          trouble = textOf(numbers);
        }
      });
      if (trouble === null && got === 0) trouble = "the server sent no tiles; trying again";
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
    this.abort = null;
    this.open.clear();
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
