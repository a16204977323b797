// Contour lines of one quantity over the colours of another, made in the page when the view rests.

import { rangeOf } from "./colors.js";
import { paintContours } from "./contourpaint.js";
import { finestInView } from "./inview.js";
import { latticeInView } from "./lattice.js";
import { classBorders, levelLines } from "./marching.js";
import { logTicks, short } from "./ticks.js";
import { shownIn } from "./units.js";

const mostLevels = 7;
const restMilliseconds = 200;
// Smaller lines are specks of a few points, which hide what they are about.
const leastPixels = 16;

// Round numbers strictly inside a range, as many as allowed.
export function roundLevels(low, high) {
  if (!(high > low)) return [];
  if (low > 0 && high > 300 * low) {
    const { base, ticks } = logTicks(low, high, mostLevels);
    return ticks.map((tick) => base + tick.offset).slice(0, mostLevels);
  }
  let power = 10 ** Math.floor(Math.log10((high - low) / (mostLevels + 1)));
  for (;; power *= 10) {
    for (const lead of [1, 1.5, 2, 2.5, 3, 4, 5]) {
      const step = lead * power;
      const first = Math.floor(low / step) + 1;
      const count = Math.ceil(high / step) - first;
      if (count > mostLevels) continue;
      return Array.from({ length: count }, (_, k) => Number(((first + k) * step).toPrecision(12)));
    }
  }
}

function sameView(a, b) {
  return ["x0", "y0", "sx", "sy", "width", "height"].every((field) => a[field] === b[field]);
}

// In pixels, the longer side of the box around a line.
function extent(view, line) {
  let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let k = 0; k < line.length; k += 2) {
    left = Math.min(left, line[k]);
    right = Math.max(right, line[k]);
    low = Math.min(low, line[k + 1]);
    high = Math.max(high, line[k + 1]);
  }
  return Math.max((right - left) / view.sx * view.width, (high - low) / view.sy * view.height);
}

function measure(view) {
  return { ...view.copy(), width: view.width, height: view.height };
}

export class Contours {
  // later(): a frame is wanted
  constructor(canvas, later) {
    this.canvas = canvas;
    this.later = later;
    this.name = "";
    this.made = null;
    this.timer = 0;
    this.view = null;
    this.drawn = null;
  }

  choose(name) {
    this.name = name;
    this.made = null;
    this.later();
  }

  quantity(scene) { return scene.quantities.find((one) => one.name === this.name) || null; }

  // What the lines are of, for the legend.
  title(scene) {
    const quantity = this.quantity(scene);
    return quantity ? shownIn(quantity).title : "";
  }

  // Makes the lines when the view has rested and there are new points; draws them.
  follow(cache, layers, scene, view, ratio) {
    const now = measure(view);
    if (!this.view || !sameView(this.view, now)) {
      this.view = now;
      this.rested = performance.now() + restMilliseconds;
    }
    const quantity = this.quantity(scene);
    if (!quantity) {
      this.made = null;
    } else {
      const { depth, complete, grid } = finestInView(cache, layers, scene.key, view);
      const factor = shownIn(quantity).factor;
      const key = [scene.key, this.name, depth, factor, grid ? grid.origin : ""].join();
      // Without points there are no new lines. The old ones stay with the old picture.
      const known = grid || complete;
      const old = known && (!this.made || this.made.key !== key || !sameView(this.made.view, now));
      const wait = this.rested - performance.now();
      if (old && wait > 0) this.wake(wait);
      else if (old) this.made = { key, view: now, ...this.make(cache, layers, scene, view, quantity) };
    }
    this.draw(view, now, ratio);
  }

  wake(wait) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.later();
    }, wait + 1);
  }

  make(cache, layers, scene, view, quantity) {
    const index = scene.quantities.indexOf(quantity);
    const lattice = latticeInView(cache, layers, scene.key, view, index, quantity.classes ? 1 : 2);
    const made = { groups: [] };
    if (!lattice) return made;
    if (quantity.classes) {
      made.groups.push({ label: "", lines: classBorders(lattice) });
      return made;
    }
    const { factor } = shownIn(quantity);
    const range = rangeOf(lattice.values.filter(Number.isFinite));
    const shown = range ? roundLevels(range.low * factor, range.high * factor) : [];
    const levels = shown.map((level) => level / factor);
    levels.forEach((level, k) => {
      const lines = levelLines(lattice, level, levels).filter((line) => extent(view, line) > leastPixels);
      made.groups.push({ label: short(shown[k], 6), lines });
    });
    return made;
  }

  // At rest the lines are drawn anew; while the view moves, their picture moves with it.
  draw(view, now, ratio) {
    const { canvas } = this;
    const place = this.made && (sameView(this.made.view, now) ? "" : Object.values(now).join());
    if (this.drawn && this.drawn.made === this.made && this.drawn.place === place &&
      this.drawn.width === canvas.width && this.drawn.height === canvas.height) return;
    const pen = canvas.getContext("2d");
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, canvas.width, canvas.height);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.drawn = { made: this.made, place, width: canvas.width, height: canvas.height };
    if (!this.made) return;
    if (place === "") {
      paintContours(pen, view, this.made.groups);
      this.picture = document.createElement("canvas");
      this.picture.width = canvas.width;
      this.picture.height = canvas.height;
      this.picture.getContext("2d").drawImage(canvas, 0, 0);
    } else if (this.picture) {
      const from = this.made.view;
      const left = view.toPixelX(from.x0);
      const top = view.toPixelY(from.y0 + from.sy);
      pen.drawImage(this.picture, left, top, view.toPixelX(from.x0 + from.sx) - left,
        view.toPixelY(from.y0) - top);
    }
  }
}
