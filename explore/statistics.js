// How much the points in view are worth: their standard error, and how many have no value.

import { eachInView } from "./inview.js";

const mostErrors = 20000;

function median(values) {
  const sorted = Float64Array.from(values).sort();
  return sorted.length === 0 ? null : sorted[Math.floor(sorted.length / 2)];
}

export function statistics(cache, layers, scene, view, shown) {
  const quantity = scene.quantities[shown];
  const error = quantity.error ? scene.quantities.findIndex((one) => one.name === quantity.error) : -1;
  const undecidedOf = (one) => one.classes ? one.classes.indexOf("undecided") : -1;
  const among = undecidedOf(quantity) >= 0 ? shown
    : scene.quantities.findIndex((one) => undecidedOf(one) >= 0);
  const undecided = among >= 0 ? undecidedOf(scene.quantities[among]) : -1;
  const counts = { points: 0, diverged: 0, tooLong: 0, refused: 0, undecided: 0, error: null };
  const errors = [];
  eachInView(cache, layers, scene.key, view, Infinity, (data, points, k) => {
    counts.points++;
    if (data[k] === 1) counts.diverged++;
    else if (data[k] === 3) counts.tooLong++;
    else if (data[k] === 255) counts.refused++;
    if (among >= 0 && data[(1 + among) * points + k] === undecided) counts.undecided++;
    // Few of many are enough for a median, and a prime number of them avoids stripes.
    if (error < 0 || counts.points > mostErrors && counts.points % 37 !== 0) return;
    const value = data[(1 + error) * points + k];
    if (Number.isFinite(value)) errors.push(value);
  });
  counts.error = median(errors);
  return counts;
}

export function countsText(counts) {
  if (!counts || counts.points === 0) return "";
  const missing = counts.diverged + counts.tooLong + counts.refused;
  const parts = [];
  const number = (n) => n.toLocaleString("en");
  if (missing > 0) {
    const why = [[counts.diverged, "diverged"], [counts.tooLong, "steps too long"],
      [counts.refused, "refused"]].filter(([n]) => n > 0);
    parts.push(number(missing) + " without a value (" +
      (why.length === 1 ? why[0][1] : why.map(([n, word]) => number(n) + " " + word).join(", ")) + ")");
  }
  if (counts.undecided > 0) parts.push(number(counts.undecided) + " undecided");
  return parts.length === 0 ? "" : " Of " + number(counts.points) + " points in view, " +
    parts.join(", and ") + ".";
}

// Counts again when something has changed, though not in each frame.
export class Statistics {
  // later(): a frame is wanted in a while
  constructor(later) {
    this.later = later;
    this.old = true;
    this.about = "";
    this.counted = 0;
    this.timer = 0;
    this.counts = null;
  }

  forget() { this.old = true; }

  // Returns whether the counts are new.
  follow(cache, layers, scene, view, shown) {
    const about = [scene.key, shown, view.width, view.height, ...Object.values(view.copy())].join();
    if (about !== this.about) this.old = true;
    this.about = about;
    if (!this.old) return false;
    const wait = this.counted + 300 - performance.now();
    if (wait > 0) {
      if (!this.timer) {
        this.timer = setTimeout(() => {
          this.timer = 0;
          this.later();
        }, wait);
      }
      return false;
    }
    this.old = false;
    this.counted = performance.now();
    this.counts = statistics(cache, layers, scene, view, shown);
    return true;
  }
}
