// Which scene the page shows: what is set, what is on the axes, and the request for it.

import { getJson, ServerError } from "./server.js";

export class SceneKeeper {
  // job: onScene(scene, view or null), onTrouble(sentence or null), onChange()
  constructor(job) {
    this.job = job;
    this.sets = new Map();
    this.x = null;
    this.y = null;
    this.abort = null;
    this.timer = 0;
    this.failures = 0;
    this.wanted = null;
    this.done = null;
  }

  get busy() { return this.abort !== null || this.timer !== 0; }

  changes() {
    return { sets: [...this.sets], x: this.x, y: this.y };
  }

  sameAs(changes) {
    const plain = (c) => JSON.stringify([[...c.sets].sort(), c.x, c.y]);
    return plain(this.changes()) === plain(changes);
  }

  query() {
    const query = new URLSearchParams();
    for (const [name, value] of this.sets) {
      if (name !== this.x && name !== this.y) query.append("set", name + "=" + value);
    }
    if (this.x !== null) query.set("x", this.x);
    if (this.y !== null) query.set("y", this.y);
    return String(query);
  }

  set(name, value) {
    if (value === null) this.sets.delete(name);
    else this.sets.set(name, value);
    this.load(150);
  }

  setAxes(x, y) {
    this.x = x;
    this.y = y;
    this.load(0);
  }

  reset() {
    this.sets.clear();
    this.x = null;
    this.y = null;
    this.load(0);
  }

  replace(changes, view, done) {
    this.sets = new Map(changes.sets);
    this.x = changes.x;
    this.y = changes.y;
    this.wanted = view;
    this.done = done;
    this.load(0);
  }

  cancel() {
    clearTimeout(this.timer);
    this.timer = 0;
    if (this.abort) this.abort.abort();
    this.abort = null;
    this.wanted = null;
    this.done = null;
  }

  load(wait) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.ask();
    }, wait);
    this.job.onChange();
  }

  async ask() {
    if (this.abort) this.abort.abort();
    const abort = new AbortController();
    this.abort = abort;
    try {
      const scene = await getJson("scene?" + this.query(), abort.signal);
      if (this.abort !== abort) return;
      this.abort = null;
      this.failures = 0;
      this.job.onTrouble(null);
      const view = this.wanted;
      const done = this.done;
      this.wanted = null;
      this.done = null;
      this.job.onScene(scene, view);
      if (done) done();
    } catch (error) {
      if (this.abort !== abort || abort.signal.aborted) return;
      this.abort = null;
      if (error instanceof ServerError) {
        this.wanted = null;
        this.done = null;
        this.job.onTrouble(error.message);
      } else {
        this.job.onTrouble("the server does not answer; trying again");
        this.load(Math.min(8000, 500 * 2 ** this.failures++));
      }
    }
    this.job.onChange();
  }
}
