// Draws a bifurcation diagram: the samples of a state as dots, and below them quantities as lines.

import { classColor, css } from "./colors.js";
import { placeIn } from "./diagramframe.js";
import { samplesAt, statusOf, valueOf } from "./strips.js";

// Hits of a pixel make it denser. Kept between pictures, for speed.
let hits = new Uint8Array(0);
const density = Uint8Array.from({ length: 256 }, (_, n) => Math.round(255 * (1 - 0.45 ** n)));

// Adds dots to a picture of width x height device pixels.
function putDots(image, columns, place, state, quantities, range, color, strength) {
  const { width, height } = image;
  if (hits.length < width * height) hits = new Uint8Array(width * height);
  else hits.fill(0, 0, width * height);
  const wide = Math.max(1, Math.min(Math.round(3 * place.ratio), Math.ceil(place.spacing * place.ratio)));
  const tall = Math.max(1, Math.round(1.5 * place.ratio));
  const scale = (height - tall) / (range[1] - range[0]);
  for (const column of columns) {
    if (statusOf(column) !== 0) continue;
    const left = Math.round(place.px(column.share) * place.ratio - wide / 2);
    const x0 = place.isWide ? 0 : Math.max(0, left);
    const x1 = place.isWide ? width : Math.min(width, left + wide);
    const data = column.strip.data;
    const from = samplesAt(column, quantities, state);
    const end = from + column.strip.samples;
    for (let k = from; k < end; k++) {
      const value = data[k];
      if (value !== value) continue;
      const y = Math.round((range[1] - value) * scale);
      if (y < 0 || y + tall > height) continue;
      for (let row = y * width; row < (y + tall) * width; row += width) {
        for (let x = row + x0; x < row + x1; x++) if (hits[x] < 255) hits[x]++;
      }
    }
  }
  const pixels = new Uint32Array(image.data.buffer);
  for (let k = 0; k < width * height; k++) {
    if (hits[k] > 0) pixels[k] = ((density[hits[k]] * strength) << 24 | color) >>> 0;
  }
}

function packedColor(pen, color) {
  pen.fillStyle = color;
  const hex = pen.fillStyle;
  return parseInt(hex.slice(5, 7) + hex.slice(3, 5) + hex.slice(1, 3), 16);
}

// The ground of a column, in whole pixels, so that neighbours leave no seam.
function edgesOf(column, place) {
  const at = place.px(column.share);
  const half = Math.max(0.5, place.spacing / 2);
  return [Math.floor(at - half), Math.max(1, Math.ceil(at + half) - Math.floor(at - half))];
}

// Columns that came to no value have a mark at the foot of the dots.
function markDiverged(pen, columns, place, box, style) {
  pen.fillStyle = style.faint;
  for (const column of columns) {
    if (statusOf(column) === 0) continue;
    const [left, wide] = edgesOf(column, place);
    pen.fillRect(left, box.top + box.height - 3, wide, 3);
  }
}

// The standard error, to both sides of the values.
function drawBand(pen, columns, line, place, py) {
  pen.beginPath();
  let run = [];
  const close = () => {
    run.forEach(([x, top], k) => (k === 0 ? pen.moveTo(x, top) : pen.lineTo(x, top)));
    run.reverse().forEach(([x, , bottom]) => pen.lineTo(x, bottom));
    run = [];
  };
  for (const column of columns) {
    const value = valueOf(column, line.index);
    const error = valueOf(column, line.error);
    const ends = [place.px(column.share), py(value + error), py(value - error)];
    if (Number.isFinite(value + error)) run.push(ends);
    else close();
  }
  close();
  pen.fill();
}

function drawValues(pen, columns, line, place, py) {
  if (line.classes) {
    for (const column of columns) {
      const value = valueOf(column, line.index);
      if (Number.isNaN(value)) continue;
      const [left, wide] = edgesOf(column, place);
      pen.fillStyle = css(classColor(value));
      pen.fillRect(left, Math.round(py(value)) - 3, wide, 6);
    }
    return;
  }
  if (line.error >= 0) {
    pen.globalAlpha *= 0.3;
    pen.fillStyle = line.color;
    drawBand(pen, columns, line, place, py);
    pen.globalAlpha /= 0.3;
  }
  pen.strokeStyle = line.color;
  pen.lineWidth = 1.3;
  pen.beginPath();
  let open = false;
  for (const column of columns) {
    const value = valueOf(column, line.index);
    const there = Number.isFinite(value);
    if (there && open) pen.lineTo(place.px(column.share), py(value));
    else if (there) pen.moveTo(place.px(column.share), py(value));
    open = there;
  }
  pen.stroke();
}

// layers: [{ columns, quantities, strength, isWide }], the faint one first; isWide: its column stands for all
// of the width. Returns the milliseconds it took.
export function drawPlot(canvas, picture, style) {
  const begun = performance.now();
  const { width, height, ratio, layers, ranges, lines, grid, world } = picture;
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.globalCompositeOperation = "source-over";
  pen.clearRect(0, 0, width, height);
  const { dots, lines: low } = picture.boxes;
  const image = pen.createImageData(canvas.width, Math.round(dots.height * ratio));
  const color = packedColor(pen, style.text);
  const placed = layers.map((layer) => {
    const share = Math.min(world[1], width) - Math.max(0, world[0]);
    const spacing = share / Math.max(1, layer.columns.length);
    return { ...layer, place: { px: picture.px, ratio, spacing, isWide: layer.isWide } };
  });
  for (const { columns, quantities, strength, place } of placed) {
    putDots(image, columns, place, picture.state, quantities, ranges.dots, color, strength);
  }
  pen.putImageData(image, 0, Math.round(dots.top * ratio));
  const py = placeIn(low, ranges.lines);
  pen.save();
  pen.beginPath();
  pen.rect(0, low.top, width, low.height);
  pen.clip();
  for (const { columns, strength, place } of placed) {
    pen.globalAlpha = strength;
    for (const line of lines) drawValues(pen, columns, line, place, py);
  }
  pen.restore();
  markDiverged(pen, layers[layers.length - 1].columns, placed[layers.length - 1].place, dots, style);
  // What is below the dots is drawn after them: pixels that are put replace what was there.
  pen.globalCompositeOperation = "destination-over";
  pen.strokeStyle = style.line;
  pen.lineWidth = 1;
  pen.beginPath();
  for (const box of [dots, low]) {
    for (const x of grid) {
      pen.moveTo(Math.round(x) + 0.5, box.top);
      pen.lineTo(Math.round(x) + 0.5, box.top + box.height);
    }
  }
  pen.stroke();
  if (ranges.lines[0] < 0 && ranges.lines[1] > 0 && !lines[0].classes) {
    pen.strokeStyle = style.faint;
    pen.beginPath();
    pen.moveTo(0, Math.round(py(0)) + 0.5);
    pen.lineTo(width, Math.round(py(0)) + 0.5);
    pen.stroke();
  }
  for (const box of [dots, low]) {
    pen.fillStyle = style.outside;
    if (world[0] > 0) pen.fillRect(0, box.top, world[0], box.height);
    if (world[1] < width) pen.fillRect(world[1], box.top, width - world[1], box.height);
    pen.fillStyle = style.panel;
    pen.fillRect(0, box.top, width, box.height);
  }
  return performance.now() - begun;
}
