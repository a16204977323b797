// The two axes of the map: numbers from shares, and the drawing of ticks and names.

import { linearTicks, logTicks } from "./ticks.js";
import { shownIn } from "./units.js";

export class Axis {
  constructor(told) {
    Object.assign(this, told);
    this.ownTitle = told.unit ? told.name + " [" + told.unit + "]" : told.name;
  }

  get title() { return shownIn(this).title; }

  value(share) {
    if (this.log) return this.low * (this.high / this.low) ** share;
    return this.low + (this.high - this.low) * share;
  }

  share(value) {
    if (this.log) return Math.log(value / this.low) / Math.log(this.high / this.low);
    return (value - this.low) / (this.high - this.low);
  }

  // Ticks of a view: [{ share from the start of the view in units of the span, label }].
  ticks(share, span, count) {
    const { factor } = shownIn(this);
    const low = factor * this.value(share);
    const high = factor * this.value(share + span);
    const found = this.log ? logTicks(low, high, count) : linearTicks(low, high, count);
    const start = low;
    const scale = this.log ? Math.log(this.high / this.low) : factor * (this.high - this.low);
    const places = found.ticks.map((tick) => {
      const away = found.base - start + tick.offset;
      return { at: (this.log ? Math.log1p(away / start) : away) / scale / span, label: tick.label };
    });
    return { from: found.from, places: places.filter((tick) => tick.at > -1e-6 && tick.at < 1 + 1e-6) };
  }

  titleWith(from) {
    return from === "" ? this.title : this.title + ", counted from " + from;
  }

  // Whether two cells of a depth near a share have the same number.
  exhausted(share, depth) {
    const cells = 2 ** (depth + 5);
    const k = Math.min(cells - 2, Math.max(0, Math.round(share * cells)));
    return this.value(k / cells) === this.value((k + 1) / cells);
  }
}

function prepare(canvas, width, height, ratio) {
  const w = Math.round(width * ratio);
  const h = Math.round(height * ratio);
  if (canvas.width !== w) canvas.width = w;
  if (canvas.height !== h) canvas.height = h;
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return pen;
}

export const xHeight = 42;
export const yWidth = 84;

export function paintX(pen, axis, view, style) {
  const { from, places } = axis.ticks(view.x0, view.sx, Math.max(2, view.width / 90));
  pen.strokeStyle = style.text;
  pen.fillStyle = style.text;
  pen.font = style.font;
  pen.textAlign = "center";
  pen.textBaseline = "top";
  pen.beginPath();
  for (const tick of places) {
    const x = Math.round(tick.at * view.width) + 0.5;
    pen.moveTo(x, 0);
    pen.lineTo(x, 5);
    const half = pen.measureText(tick.label).width / 2;
    pen.fillText(tick.label, Math.min(view.width - half, Math.max(half, x)), 8);
  }
  pen.stroke();
  pen.fillText(axis.titleWith(from), view.width / 2, 24);
  return places.map((tick) => tick.label);
}

export function paintY(pen, axis, view, style) {
  const { from, places } = axis.ticks(view.y0, view.sy, Math.max(2, view.height / 48));
  pen.strokeStyle = style.text;
  pen.fillStyle = style.text;
  pen.font = style.font;
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  pen.beginPath();
  for (const tick of places) {
    const y = Math.round(view.height - tick.at * view.height) + 0.5;
    pen.moveTo(yWidth, y);
    pen.lineTo(yWidth - 5, y);
    pen.fillText(tick.label, yWidth - 8, Math.min(view.height - 6, Math.max(6, y)));
  }
  pen.stroke();
  pen.save();
  pen.translate(9, view.height / 2);
  pen.rotate(-Math.PI / 2);
  pen.textAlign = "center";
  pen.fillText(axis.titleWith(from), 0, 0);
  pen.restore();
  return places.map((tick) => tick.label);
}

export function drawXTicks(canvas, axis, view, style, ratio) {
  return paintX(prepare(canvas, view.width, xHeight, ratio), axis, view, style);
}

export function drawAxes(xCanvas, yCanvas, axes, view, style, ratio) {
  const x = drawXTicks(xCanvas, axes[0], view, style, ratio);
  const y = paintY(prepare(yCanvas, yWidth, view.height, ratio), axes[1], view, style);
  return { x, y };
}
