// Draws a grid: its columns and rows may be of unequal widths.

import { colorGrid } from "./colors.js";

let stretched = null;

// The visible part of a list of edges in pixels.
function visible(edges, toPixel, end) {
  const n = edges.length - 1;
  const parts = [];
  for (let k = 0; k < n; k++) {
    const a = Math.round(toPixel(edges[k]));
    const b = Math.round(toPixel(edges[k + 1]));
    const from = Math.min(a, b);
    const size = Math.abs(b - a);
    if (size > 0 && from < end && from + size > 0) parts.push({ k, from, size });
  }
  return parts;
}

export function drawGrid(pen, grid, view, quantity, map, stamp, pattern) {
  if (grid.stamp !== stamp) colorGrid(grid, quantity, map, stamp);
  const ny = grid.ys.length;
  const columns = visible(grid.xEdges, (share) => view.toPixelX(share), view.width);
  const rows = visible(grid.yEdges, (share) => view.toPixelY(share), view.height);
  if (columns.length === 0 || rows.length === 0) return;
  const end = (parts) => Math.max(parts[0].from + parts[0].size, parts.at(-1).from + parts.at(-1).size);
  const left = columns[0].from;
  const top = rows.at(-1).from;
  if (grid.gaps) {
    pen.fillStyle = pattern;
    pen.fillRect(left, top, end(columns) - left, end(rows) - top);
  }
  // First across, then along: nx + ny copies instead of nx * ny.
  stretched = stretched || document.createElement("canvas");
  stretched.width = Math.ceil(view.width);
  stretched.height = ny;
  const across = stretched.getContext("2d");
  across.imageSmoothingEnabled = false;
  for (const { k, from, size } of columns) across.drawImage(grid.canvas, k, 0, 1, ny, from, 0, size, ny);
  const width = Math.min(stretched.width, end(columns)) - Math.max(0, left);
  for (const { k, from, size } of rows) {
    pen.drawImage(stretched, Math.max(0, left), ny - 1 - k, width, 1, Math.max(0, left), from, width, size);
  }
}
