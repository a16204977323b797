// Bifurcation curves over the map: which there are, their key with its switch, and the one that is clicked.

import { curvesInView, keyOf, paintCurves, sampleWidth } from "./curvepaint.js";
import { make } from "./elements.js";
import { getJson } from "./server.js";

// How near a click must be, in pixels: a finger hides what it is on.
const reach = { mouse: 6, pen: 8, touch: 16 };
// A line that no motion settles on gives way to one that a motion does.
const thinPixels = 2;
const retryMilliseconds = 2000;

function sample(entry) {
  const canvas = document.createElement("canvas");
  const ratio = 2;
  canvas.className = "sample";
  canvas.width = ratio * (sampleWidth + 4);
  canvas.height = ratio * 12;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  entry.paint(pen, 2, 6);
  return canvas;
}

// The distance of a point from a line, in pixels.
function distance(px, py, ax, ay, bx, by) {
  const long = (bx - ax) ** 2 + (by - ay) ** 2;
  const share = long > 0 ? Math.min(1, Math.max(0, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / long)) : 0;
  return Math.hypot(ax + share * (bx - ax) - px, ay + share * (by - ay) - py);
}

export class Curves {
  // job: onFrame(), onState()
  constructor(canvas, key, job) {
    this.canvas = canvas;
    this.key = key;
    this.job = job;
    this.shown = true;
    this.told = null;
    this.lines = null;
    this.asked = false;
    this.drawn = "";
    this.parts = [];
  }

  get busy() { return this.asked && !this.told; }

  // Whether they are on the map, which a link tells.
  choose(shown) {
    if (this.shown === shown) return;
    this.shown = shown;
    this.showKey();
    this.job.onFrame();
  }

  setScene(scene, axes) {
    this.scene = scene;
    this.axes = axes;
    if (scene.has_curves && !this.told && !this.asked) this.load();
    this.place();
  }

  async load() {
    this.asked = true;
    try {
      this.told = await getJson("curves");
      this.place();
    } catch {
      setTimeout(() => this.load(), retryMilliseconds);
    }
  }

  // As shares of the axes, either of which may be the file's x.
  place() {
    const { scene, axes, told } = this;
    this.lines = null;
    this.drawn = "";
    if (scene.has_curves && told) {
      const share = (n, curve) => (axes[n].name === told.x ? curve.x : curve.y)
        .map((value) => axes[n].share(value));
      this.lines = told.curves.map((curve, index) => ({ kind: curve.kind, period: curve.period, index,
        x: share(0, curve), y: share(1, curve), stretches: curve.stretches }));
    }
    this.showKey();
    this.job.onFrame();
  }

  showKey() {
    const { key, scene, told } = this;
    const note = scene ? scene.curves_note : "";
    key.hidden = !this.lines && !note;
    if (key.hidden) return;
    if (!this.lines) {
      key.replaceChildren(make("span", note));
      return;
    }
    const box = make("input");
    box.type = "checkbox";
    box.id = "curves-shown";
    box.checked = this.shown;
    box.addEventListener("change", () => {
      this.choose(box.checked);
      this.job.onState();
      document.getElementById("curves-shown").focus();
    });
    const label = make("label", " curves");
    label.prepend(box);
    const none = told.curves.length === 0 ? [make("span", "the file has none")] : [];
    const entries = this.shown ? keyOf(told) : [];
    key.replaceChildren(label, ...none, ...entries.map((entry) => {
      const line = make("span", undefined, "key");
      line.append(sample(entry), entry.text);
      return line;
    }));
  }

  // What is drawn in a view; null: nothing is.
  inView(view) {
    return this.lines && this.shown ? { told: this.told, parts: curvesInView(view, this.lines) } : null;
  }

  draw(view, ratio) {
    const { canvas } = this;
    const now = [view.x0, view.y0, view.sx, view.sy, canvas.width, canvas.height, this.shown].join();
    if (this.drawn === now) return;
    this.drawn = now;
    const pen = canvas.getContext("2d");
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, canvas.width, canvas.height);
    const seen = this.inView(view);
    this.parts = seen ? seen.parts : [];
    if (!seen) return;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    paintCurves(pen, view, seen.told, seen.parts);
  }

  // The cell at the point of a curve that is nearest to a pixel, with what names the point; null where no curve
  // is near.
  at(view, px, py, pointer) {
    let found = null;
    let least = reach[pointer] || reach.mouse;
    for (const { line, stable, points } of this.shown && this.lines ? this.parts : []) {
      for (let k = 0; k + 3 < points.length; k += 2) {
        const away = distance(px, py, points[k], points[k + 1], points[k + 2], points[k + 3]) +
          (stable ? 0 : thinPixels);
        if (away >= least) continue;
        least = away;
        found = line;
      }
    }
    return found && this.cellOf(view, found, px, py);
  }

  cellOf(view, line, px, py) {
    let point = 0;
    let least = Infinity;
    line.x.forEach((share, k) => {
      const away = Math.hypot(view.toPixelX(share) - px, view.toPixelY(line.y[k]) - py);
      if (away < least) [least, point] = [away, k];
    });
    const name = line.kind + " of period " + line.period;
    return { ...view.cellAt(view.maxDepth, line.x[point], line.y[point]), curve: line.index, point, name };
  }

  // For tests: points of curves in view, as pixels.
  points(view) {
    const seen = (x, y) => x > 0 && y > 0 && x < view.width && y < view.height;
    return !this.lines || !this.shown ? [] : this.lines.flatMap((line) => Array.from(line.x, (share, point) => (
      { curve: line.index, point, kind: line.kind, px: view.toPixelX(share), py: view.toPixelY(line.y[point]) }
    ))).filter(({ px, py }) => seen(px, py));
  }
}
