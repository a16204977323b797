// The line of the map that a diagram runs along, and cells on it.

import { nameOfLine } from "./strips.js";
import { cellShares } from "./view.js";

// The same share has one name, whatever the depth that it was found at.
function reduced(depth, k) {
  while (depth > 0 && k % 2 === 0) {
    k /= 2;
    depth--;
  }
  return { depth, k };
}

function nearest(depth, share) {
  return reduced(depth, Math.min(2 ** depth - 1, Math.max(0, Math.round(share * 2 ** depth))));
}

// The middle moves in steps of a sixteenth of the view, so that a small move keeps the line. A study of one
// axis has a value of its own for the other one.
function restingCell(scene, axes, across, from, size) {
  const cells = scene.max_depth + 5;
  if (scene.one_axis) {
    const own = scene.choices.find((choice) => choice.name === axes[across].name);
    const share = own && own.value !== null ? axes[across].share(own.value) : NaN;
    if (share >= from && share <= from + size) return nearest(cells, share);
  }
  return nearest(Math.min(cells, Math.max(0, Math.ceil(Math.log2(16 / size)))), from + size / 2);
}

// Through the point of the open motion, else the crosshair, else near the middle of the view.
export function findLine(scene, axes, view, along, motionCell, walkerCell) {
  const across = 1 - along;
  const cell = motionCell || walkerCell;
  const at = cell ? reduced(cell.depth, across === 0 ? cell.kx : cell.ky)
    : restingCell(scene, axes, across, ...(across === 0 ? [view.x0, view.sx] : [view.y0, view.sy]));
  const line = { scene, axis: along, ...at };
  return { ...line, share: at.k / 2 ** at.depth, name: nameOfLine(line) };
}

// The cell of the map at a cell of the line, both at the finer depth of the two.
export function mapCell(line, along) {
  const depth = Math.max(line.depth, along.depth);
  const k = along.k * 2 ** (depth - along.depth);
  const across = line.k * 2 ** (depth - line.depth);
  return line.axis === 0 ? { depth, kx: k, ky: across } : { depth, kx: across, ky: k };
}

export function shareAlong(line, cell) {
  return cellShares(cell)[line.axis];
}

// A thin line over the map, and a dot where the diagram is read.
export function markLine(canvas, view, line, readShare, ratio) {
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  const at = line.axis === 0 ? view.toPixelY(line.share) : view.toPixelX(line.share);
  const place = Math.round(at) + 0.5;
  const path = new Path2D();
  if (line.axis === 0) {
    path.moveTo(0, place);
    path.lineTo(view.width, place);
  } else {
    path.moveTo(place, 0);
    path.lineTo(place, view.height);
  }
  // Dashes over a dark line show on every colour.
  pen.lineWidth = 1;
  pen.strokeStyle = "rgba(0,0,0,0.8)";
  pen.stroke(path);
  pen.setLineDash([6, 6]);
  pen.strokeStyle = "#fff";
  pen.stroke(path);
  pen.setLineDash([]);
  if (readShare === null) return;
  pen.beginPath();
  if (line.axis === 0) pen.arc(view.toPixelX(readShare), place, 3.5, 0, 7);
  else pen.arc(place, view.toPixelY(readShare), 3.5, 0, 7);
  pen.fillStyle = "#fff";
  pen.fill();
  pen.strokeStyle = "#000";
  pen.stroke();
}
