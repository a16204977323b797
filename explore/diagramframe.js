// What stands around the plots of a diagram: their places, their ranges, and the ticks at the left.

import { samplesAt, statusOf, valueOf } from "./strips.js";
import { linearTicks } from "./ticks.js";

const gap = 10;
const edge = 3;

// Where the two plots stand in a height.
export function layout(height) {
  const low = Math.round(Math.max(36, (height - gap) * 0.32));
  return { dots: { top: edge, height: height - gap - low - 2 * edge },
    lines: { top: height - edge - low, height: low } };
}

// A range that changes in steps, so that the picture does not tremble while the view moves.
function steady(low, high) {
  if (low > high) return [0, 1];
  const spread = high - low || Math.abs(high) * 0.1 || 1;
  const step = 2 ** Math.floor(Math.log2(spread / 12));
  return [Math.floor((low - 0.05 * spread) / step) * step, Math.ceil((high + 0.05 * spread) / step) * step];
}

export function sampleRange(columns, quantities, state) {
  let low = Infinity;
  let high = -Infinity;
  for (const column of columns) {
    if (statusOf(column) !== 0) continue;
    const data = column.strip.data;
    const from = samplesAt(column, quantities, state);
    for (let k = from; k < from + column.strip.samples; k++) {
      if (data[k] < low) low = data[k];
      if (data[k] > high) high = data[k];
    }
  }
  return steady(low, high);
}

export function valueRange(columns, lines) {
  if (lines.length === 1 && lines[0].classes) return [-0.6, lines[0].classes.length - 0.4];
  let low = Infinity;
  let high = -Infinity;
  for (const column of columns) {
    for (const line of lines) {
      const value = valueOf(column, line.index);
      if (!Number.isFinite(value)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  // Zero is where an exponent tells something.
  if (lines.some((line) => line.isExponent) && low <= high) {
    low = Math.min(low, 0);
    high = Math.max(high, 0);
  }
  return steady(low, high);
}

// The height of a value in a box.
export function placeIn(box, range) {
  return (value) => box.top + (range[1] - value) / (range[1] - range[0]) * box.height;
}

function ticksOf(range, height, classes) {
  if (classes) return { from: "", places: classes.map((name, k) => ({ value: k, label: name })) };
  const count = height < 100 ? height / 18 : height / 30;
  const { base, ticks, from } = linearTicks(range[0], range[1], Math.max(2, count));
  return { from, places: ticks.map((tick) => ({ value: base + tick.offset, label: tick.label })) };
}

// parts: [{ box, range, classes, factor, title }]. The labels tell numbers times the factor. A title stands
// upright.
export function drawLeft(canvas, width, height, parts, style, ratio) {
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.strokeStyle = style.text;
  pen.fillStyle = style.text;
  pen.font = style.font;
  for (const { box, range, classes, factor, title } of parts) {
    const shown = classes ? range : range.map((value) => value * factor);
    const { from, places } = ticksOf(shown, box.height, classes);
    const py = placeIn(box, shown);
    const counted = from === "" ? "" : title ? ", counted from " + from : "from " + from;
    const beside = (title || "") + counted;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    pen.beginPath();
    let least = Infinity;
    for (const tick of places) {
      const y = Math.round(py(tick.value)) + 0.5;
      if (y < box.top || y > box.top + box.height + 1) continue;
      pen.moveTo(width, y);
      pen.lineTo(width - 5, y);
      const at = Math.min(box.top + box.height - 6, Math.max(box.top + 6, y));
      // Labels that would touch are left out.
      if (Math.abs(least - at) < 11) continue;
      least = at;
      pen.fillText(tick.label, width - 8, at, beside ? width - 28 : width - 10);
    }
    pen.stroke();
    if (!beside) continue;
    pen.save();
    pen.translate(9, box.top + box.height / 2);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = "center";
    pen.fillText(beside, 0, 0, box.height);
    pen.restore();
  }
}
