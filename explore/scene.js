// Which scene the page shows: what is set, what is on the axes, and the request for it.

import { getJson, ServerError } from "./server.js";

// A slider that moves asks for no more than ten scenes a second.
const dragMilliseconds = 100;

export class SceneKeeper {
  // job: onScene(scene, view or null), onTrouble(sentence or null), onRefused(sentence), onChange(),
  // onRest(), ready() -> whether the page has shown the last scene
  constructor(job) {
    this.job = job;
    this.sets = new Map();
    this.x = null;
    this.y = null;
    this.abort = null;
    this.timer = 0;
    this.failures = 0;
    // The changes of the scene that is shown.
    this.shown = null;
    this.wanted = null;
    this.done = null;
    // A slider moves; what it has set is not asked for yet.
    this.dragging = false;
    this.pending = false;
    this.restTimer = 0;
    this.askedAt = 0;
  }

  get busy() { return this.abort !== null || this.timer !== 0 || this.dragging; }

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

  // A slider that moves asks for one scene after another, each when the one before is on the screen.
  drag(name, value) {
    this.sets.set(name, value);
    this.dragging = true;
    this.pending = true;
    this.rest(600);
    this.pump();
    this.job.onChange();
  }

  pump() {
    if (!this.pending || this.timer || this.abort || !this.job.ready()) return;
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.pending = false;
      this.ask();
    }, Math.max(0, this.askedAt + dragMilliseconds - performance.now()));
  }

  // The slider will rest unless it moves again within the wait.
  rest(wait) {
    if (!this.dragging) return;
    clearTimeout(this.restTimer);
    this.restTimer = setTimeout(() => {
      this.dragging = false;
      if (this.pending) this.load(0);
      else this.job.onRest();
      this.job.onChange();
    }, wait);
  }

  endDrag() {
    clearTimeout(this.restTimer);
    this.dragging = false;
    this.pending = false;
  }

  // place: [name, value] of what was on the axes, which keeps its value where it leaves them.
  setAxes(x, y, place) {
    this.x = x;
    this.y = y;
    for (const [name, value] of place) if (name !== x && name !== y) this.sets.set(name, value);
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
    this.endDrag();
    clearTimeout(this.timer);
    this.timer = 0;
    if (this.abort) this.abort.abort();
    this.abort = null;
    this.wanted = null;
    this.done = null;
  }

  // What the server refuses is not kept: links and later requests have what is shown.
  goBack() {
    if (!this.shown || this.timer || this.pending) return;
    this.sets = new Map(this.shown.sets);
    this.x = this.shown.x;
    this.y = this.shown.y;
  }

  load(wait) {
    this.endDrag();
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
    this.askedAt = performance.now();
    const asked = this.changes();
    try {
      const scene = await getJson("scene?" + this.query(), abort.signal);
      if (this.abort !== abort) return;
      this.abort = null;
      this.failures = 0;
      this.shown = asked;
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
        this.job.onTrouble(null);
        this.goBack();
        this.job.onRefused(error.message);
      } else {
        this.job.onTrouble("the server does not answer; trying again");
        this.load(Math.min(8000, 500 * 2 ** this.failures++));
      }
    }
    this.job.onChange();
    this.pump();
  }
}
