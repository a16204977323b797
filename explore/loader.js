// Keeps one stream of records open for what a picture lacks, and tries again when the server is away.

import { readRecords, ServerError, textOf } from "./server.js";

export class Loader {
  // address: of the request; kind: of its records; most: places that one request may list.
  // job: wanted() -> null or { name, places, request(places) }: what lacks, of which scene or line,
  // wait() -> whether something else comes first, onRecord(head, numbers, wanted), onChange(),
  // onTrouble(sentence or null), onUnknownScene()
  constructor(address, kind, most, job) {
    this.address = address;
    this.kind = kind;
    this.most = most;
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
    const wanted = this.job.wanted();
    this.left = wanted ? wanted.places.length : 0;
    if (this.left === 0 || this.job.wait()) {
      this.stop();
      if (!wanted) this.job.onTrouble(null);
      this.job.onChange();
      return;
    }
    const places = wanted.places.slice(0, this.most);
    const same = this.open !== null && this.open.name === wanted.name &&
      this.open.places.size === places.length &&
      places.every((place) => this.open.places.has(place.join("/")));
    if (same || this.retryTimer) return;
    this.stop();
    this.run(wanted, places);
  }

  async run(wanted, places) {
    const abort = new AbortController();
    const open = { name: wanted.name, places: new Set(places.map((place) => place.join("/"))) };
    this.abort = abort;
    this.open = open;
    this.job.onChange();
    const numbersOfPlace = places[0].length;
    let got = 0;
    let trouble = null;
    try {
      const request = { page: this.page, ...wanted.request(places) };
      await readRecords(this.address, request, abort.signal, (head, numbers) => {
        if (this.abort !== abort) return;
        if (head[0] === this.kind) {
          got++;
          this.left = Math.max(0, this.left - 1);
          open.places.delete(head.slice(1, 1 + numbersOfPlace).join("/"));
          this.job.onRecord(head, numbers, wanted);
          this.working();
        } else if (head[0] === 1) {
          trouble = textOf(numbers);
        }
      });
      if (trouble === null && got === 0) trouble = "the server sent nothing; trying again";
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
