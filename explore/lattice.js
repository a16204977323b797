// The points in view as one lattice: { xs, ys, values }, rows growing upwards.

import { finestInView } from "./inview.js";
import { tileCells } from "./view.js";
import { tileValue } from "./tiles.js";

// The cells of a depth that the view touches, and one more at each end.
function cellsOf(from, to, cells) {
  return [Math.max(0, Math.floor(from * cells) - 1), Math.min(cells - 1, Math.ceil(to * cells) + 1)];
}

function ofTiles(cache, scene, view, quantity, depth, stride) {
  const cells = 2 ** (depth + 5);
  const [x0, x1] = cellsOf(view.x0, view.x1, cells);
  const [y0, y1] = cellsOf(view.y0, view.y1, cells);
  const nx = Math.floor((x1 - x0) / stride) + 1;
  const ny = Math.floor((y1 - y0) / stride) + 1;
  const values = new Float64Array(nx * ny).fill(NaN);
  const tiles = new Map();
  const tileAt = (i, j) => {
    const name = i + "/" + j;
    if (!tiles.has(name)) tiles.set(name, cache.get(scene, depth, i, j) || null);
    return tiles.get(name);
  };
  for (let row = 0; row < ny; row++) {
    const ky = y0 + row * stride;
    let tile = null;
    let of = -1;
    for (let column = 0; column < nx; column++) {
      const kx = x0 + column * stride;
      const i = Math.floor(kx / tileCells);
      if (i !== of) tile = tileAt(i, Math.floor(ky / tileCells));
      of = i;
      if (!tile) continue;
      values[row * nx + column] = tileValue(tile, quantity, (ky % tileCells) * tileCells + kx % tileCells);
    }
  }
  const shares = (first, n) => Float64Array.from({ length: n }, (_, k) => (first + k * stride) / cells);
  return { xs: shares(x0, nx), ys: shares(y0, ny), values };
}

// leastPixels: how near to one another its points may be.
export function latticeInView(cache, layers, scene, view, quantity, leastPixels) {
  const { depth, grid, complete } = finestInView(cache, layers, scene, view);
  if (grid) {
    const values = grid.data.subarray((1 + quantity) * grid.size, (2 + quantity) * grid.size);
    return { xs: grid.xs, ys: grid.ys, values };
  }
  if (!complete) return null;
  const apart = Math.min(view.width / view.sx, view.height / view.sy) / 2 ** (depth + 5);
  const stride = Math.max(1, Math.round(leastPixels / apart));
  return ofTiles(cache, scene, view, quantity, depth, stride);
}
