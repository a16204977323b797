// The panel with the motion at a point, and the pins that keep motions for comparison.

import { MotionView } from "./motionview.js";
import { getJson, ServerError } from "./server.js";
import { SlowAnswers } from "./slowanswers.js";

const lineColors = ["#2f86d6", "#d9770b", "#109b78", "#c25fa8", "#8a63d2", "#a08020", "#d0453c"];

export function pinColor(k) {
  return lineColors[k % lineColors.length];
}

export class MotionPanel {
  // job: onChange(), onClose()
  constructor(element, job) {
    this.element = element;
    this.job = job;
    this.pins = [];
    this.cell = null;
    this.scene = null;
    this.data = null;
    this.shown = false;
    this.abort = null;
    this.slow = new SlowAnswers();
    this.view = new MotionView(element, {
      close: () => this.close(true),
      pin: () => this.pin(),
      unpin: (pin) => this.unpin(pin),
      otherStarts: () => this.askStarts(),
    });
  }

  get busy() { return this.abort !== null; }

  // The same point of a new scene is another motion.
  setScene(scene) {
    const stale = this.shown && this.cell && this.scene && this.scene.key !== scene.key;
    const sameAxes = stale && [0, 1].every((n) => this.scene.axes[n].name === scene.axes[n].name);
    if (!stale) return;
    if (sameAxes) this.open(scene, this.cell);
    else this.close(false);
  }

  // cell: with the curve and the point of it that an orbit is of, where a scene has curves.
  async open(scene, wanted) {
    const { depth, kx, ky } = wanted;
    const cell = scene.has_curves ? wanted : { depth, kx, ky };
    if (this.abort) this.abort.abort();
    const same = this.shown && this.data && this.scene && this.scene.key === scene.key && this.cell &&
      ["depth", "kx", "ky", "curve", "point"].every((field) => this.cell[field] === cell[field]);
    this.abort = null;
    if (same) return;
    this.slow.stop();
    const abort = new AbortController();
    this.abort = abort;
    this.cell = cell;
    this.scene = scene;
    this.shown = true;
    this.element.hidden = false;
    // On a narrow page it stands below the map.
    const wide = window.innerWidth;
    if (wide <= 1000) this.element.scrollIntoView({ block: wide <= 700 ? "start" : "nearest" });
    this.view.wait();
    this.job.onChange();
    try {
      const what = cell.curve === undefined ? "motion?" : "border?";
      const data = await getJson(what + this.query(), abort.signal);
      if (this.abort !== abort) return;
      this.data = data;
      this.view.show(data, this.layers(), this.pins, scene);
      if (data.on_orbit && !data.multipliers) this.askMultipliers(data);
    } catch (error) {
      if (this.abort !== abort || abort.signal.aborted) return;
      this.data = null;
      const away = "the server does not answer; click again";
      this.view.fail(error instanceof ServerError ? error.message : away);
    }
    this.abort = null;
    this.job.onChange();
  }

  query() {
    const { depth, kx, ky, curve, point } = this.cell;
    return new URLSearchParams({ scene: this.scene.key,
      ...(curve === undefined ? { depth, kx, ky } : { curve, point }) });
  }

  // The motion is shown meanwhile.
  askMultipliers(data) {
    this.slow.ask("multipliers?" + this.query(), true, (answer, trouble) => {
      if (answer) data.multipliers = answer;
      else data.multiplierNote = trouble;
      this.view.plot();
    });
  }

  askStarts() {
    const { data } = this;
    if (!data || this.abort) return;
    data.starts = { waiting: true };
    this.view.plot();
    this.slow.ask("attractors?" + this.query() + "&starts=16", false, (answer, trouble) => {
      data.starts = answer || { trouble };
      this.view.plot();
    });
  }

  // An open motion that is pinned has the colour of its pin, as the list tells.
  get color() {
    const pin = this.pins.find((one) => one.data === this.data);
    return pin ? pin.color : pinColor(0);
  }

  layers() {
    const now = this.data ? [{ data: this.data, color: this.color, name: this.data.label }] : [];
    const others = this.pins.filter((pin) => pin.data !== this.data);
    // The newest is drawn last, above the pins.
    return [...others.map((pin) => ({ data: pin.data, color: pin.color, name: pin.data.label })), ...now];
  }

  pin() {
    if (!this.data || this.pins.some((pin) => pin.data === this.data)) return;
    const used = this.pins.map((pin) => pin.color);
    const free = lineColors.slice(1).find((color) => !used.includes(color));
    this.pins.push({ data: this.data, cell: this.cell, scene: this.scene.key, color: free || pinColor(1) });
    this.redraw();
  }

  unpin(pin) {
    this.pins = this.pins.filter((one) => one !== pin);
    this.redraw();
  }

  redraw() {
    if (this.data) this.view.show(this.data, this.layers(), this.pins, this.scene);
    this.job.onChange();
  }

  close(told) {
    if (this.abort) this.abort.abort();
    this.abort = null;
    this.slow.stop();
    const was = this.shown;
    this.cell = null;
    this.data = null;
    this.shown = false;
    this.element.hidden = true;
    if (was && told) this.job.onClose();
  }
}
