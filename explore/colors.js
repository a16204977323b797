// From numbers to colours: palettes, ranges, and the colouring of one tile.

import { tileCells } from "./view.js";

// Lightness rises evenly along the first three, so they read without hue as well.
const anchors = {
  dusk: [[8, 29, 82], [42, 62, 110], [82, 92, 120], [122, 124, 124], [164, 156, 112], [208, 188, 90],
    [250, 228, 70]],
  leaf: [[62, 10, 88], [64, 52, 128], [48, 98, 142], [34, 138, 140], [46, 174, 120], [134, 208, 76],
    [248, 230, 52]],
  grey: [[18, 18, 22], [242, 242, 238]],
  sides: [[10, 48, 110], [52, 112, 178], [142, 186, 222], [246, 246, 246], [240, 180, 120], [206, 108, 32],
    [122, 54, 4]],
};

export const paletteNames = [
  ["auto", "fit to quantity"], ["dusk", "blue to yellow"], ["leaf", "violet to yellow"], ["grey", "grey"],
  ["sides", "two sides of zero"],
];

export const scaleNames = [["linear", "linear"], ["log", "logarithm"], ["quantiles", "quantiles"],
  ["fixed", "fixed ends"]];

const classColors = [[8, 104, 172], [228, 146, 14], [0, 148, 112], [204, 108, 172], [112, 190, 236],
  [196, 72, 12], [240, 226, 72], [66, 66, 92], [150, 108, 56], [176, 220, 170], [104, 44, 130],
  [250, 196, 200]];

export function classColor(k) {
  return classColors[((k % classColors.length) + classColors.length) % classColors.length];
}

const packed = (c) => (255 << 24 | c[2] << 16 | c[1] << 8 | c[0]) >>> 0;

export function css(c) {
  return "rgb(" + c.map(Math.round).join(",") + ")";
}

export function paletteColor(name, share) {
  const list = anchors[name];
  const at = Math.min(1, Math.max(0, share)) * (list.length - 1);
  const k = Math.min(list.length - 2, Math.floor(at));
  return list[k].map((v, n) => v + (list[k + 1][n] - v) * (at - k));
}

function table(name) {
  const lut = new Uint32Array(256);
  for (let k = 0; k < 256; k++) lut[k] = packed(paletteColor(name, k / 255).map(Math.round));
  return lut;
}

// What the values in view span. Half a percent at each end is cut, so that one outlier does not rule.
export function rangeOf(values) {
  const sorted = Float64Array.from(values).sort();
  if (sorted.length === 0) return null;
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  let first = sorted.findIndex((v) => v > 0);
  if (first < 0) first = sorted.length;
  const positive = sorted.subarray(first);
  const low = at(0.005);
  const high = at(0.995);
  const thresholds = new Float64Array(255);
  for (let k = 0; k < 255; k++) thresholds[k] = at((k + 1) / 256);
  return {
    low: low < high ? low : sorted[0], high: low < high ? high : sorted[sorted.length - 1],
    positiveLow: positive.length ? positive[Math.floor(0.005 * positive.length)] : 1,
    positiveHigh: positive.length ? positive[Math.floor(0.995 * (positive.length - 1))] : 10,
    min: sorted[0], max: sorted[sorted.length - 1], thresholds,
  };
}

export function colorMap(quantity, choice, range) {
  if (quantity.classes) {
    const lut = new Uint32Array(256);
    for (let k = 0; k < 256; k++) lut[k] = packed(classColor(k));
    return { kind: "classes", lut, classes: quantity.classes, low: 0, high: quantity.classes.length - 1 };
  }
  let palette = choice.palette;
  if (palette === "auto" || !anchors[palette]) palette = quantity.is_exponent ? "sides" : "dusk";
  const map = { kind: choice.scale, palette, lut: table(palette), low: 0, high: 1 };
  if (choice.scale === "fixed") {
    map.kind = "linear";
    map.low = Math.min(choice.low, choice.high);
    map.high = Math.max(choice.low, choice.high);
  } else if (range) {
    const log = choice.scale === "log";
    map.low = log ? range.positiveLow : range.low;
    map.high = log ? range.positiveHigh : range.high;
    map.min = range.min;
    map.max = range.max;
    map.thresholds = range.thresholds;
    if (palette === "sides" && choice.scale === "linear") {
      map.high = Math.max(Math.abs(map.low), Math.abs(map.high));
      map.low = -map.high;
    }
  } else {
    // Nothing is known yet.
    map.kind = "linear";
  }
  if (!(map.low < map.high)) {
    // All in view have one number.
    map.flat = map.low;
    if (map.kind === "quantiles") map.kind = "linear";
    const half = Math.abs(map.low) * 1e-9 || 1e-9;
    map.low = map.kind === "log" ? map.low * 0.999 : map.low - half;
    map.high = map.kind === "log" ? map.low * 1.002 : map.low + 2 * half;
  }
  return map;
}

// The number at a share of the colour bar.
export function valueOnBar(map, share) {
  if (map.kind === "log") return map.low * (map.high / map.low) ** share;
  if (map.kind !== "quantiles") return map.low + (map.high - map.low) * share;
  if (share <= 0) return map.min;
  if (share >= 1) return map.max;
  return map.thresholds[Math.max(0, Math.min(254, Math.round(share * 256) - 1))];
}

export function shareOnBar(map, value) {
  if (map.kind === "log") return Math.log(value / map.low) / Math.log(map.high / map.low);
  return (value - map.low) / (map.high - map.low);
}

function rank(thresholds, value) {
  let low = 0;
  let high = 255;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (value >= thresholds[middle]) low = middle + 1;
    else high = middle;
  }
  return low;
}

// Cells without a value stay clear; a diverged one is a veil that darkens the hatch behind it.
const veil = 0x70000000;

// Colours rows x columns points. Returns whether some have no value.
function colorCells(values, columns, rows, quantity, map, cells32) {
  const lut = map.lut;
  const points = columns * rows;
  const from = (1 + quantity) * points;
  const log = map.kind === "log";
  const low = log ? Math.log(map.low) : map.low;
  const factor = 255.999 / ((log ? Math.log(map.high) : map.high) - low);
  let gaps = false;
  // Row 0 is the lowest on the screen.
  let to = (rows - 1) * columns;
  for (let k = 0; k < points; k++, to++) {
    if (k > 0 && k % columns === 0) to -= 2 * columns;
    const value = values[from + k];
    if (value !== value) {
      gaps = true;
      cells32[to] = values[k] === 1 ? veil : 0;
    } else if (map.kind === "classes") {
      cells32[to] = lut[value & 255];
    } else if (map.kind === "quantiles") {
      cells32[to] = lut[rank(map.thresholds, value)];
    } else {
      const scaled = ((log ? (value > 0 ? Math.log(value) : -Infinity) : value) - low) * factor;
      cells32[to] = lut[scaled > 0 ? (scaled < 255 ? scaled | 0 : 255) : 0];
    }
  }
  return gaps;
}

function colorInto(part, columns, rows, image, quantity, map, stamp) {
  const cells32 = new Uint32Array(image.data.buffer);
  part.gaps = colorCells(part.data, columns, rows, quantity, map, cells32);
  if (!part.canvas) {
    part.canvas = document.createElement("canvas");
    part.canvas.width = columns;
    part.canvas.height = rows;
    part.pen = part.canvas.getContext("2d");
  }
  part.pen.putImageData(image, 0, 0);
  part.stamp = stamp;
}

const tileImage = new ImageData(tileCells, tileCells);

export function colorTile(tile, quantity, map, stamp) {
  colorInto(tile, tileCells, tileCells, tileImage, quantity, map, stamp);
}

export function colorGrid(grid, quantity, map, stamp) {
  const [columns, rows] = [grid.xs.length, grid.ys.length];
  colorInto(grid, columns, rows, new ImageData(columns, rows), quantity, map, stamp);
}
