// The points in view: those of the finest picture that covers the view.

import { tileDepthAbove } from "./layers.js";
import { eachPlace, missingAt } from "./tiles.js";
import { tileCells } from "./view.js";

// { depth, grid }: tiles of a depth, or a grid that is finer than what tiles there are.
export function finestInView(cache, layers, scene, view) {
  const target = view.targetDepth();
  let depth = target;
  while (depth > 0 && missingAt(cache, scene, view, depth).length > 0) depth--;
  const complete = missingAt(cache, scene, view, depth).length === 0;
  const better = layers.of(scene).filter((grid) => grid.coverage(view) > 0.6 &&
    (!complete || tileDepthAbove(grid, target) > depth));
  const grid = better.length > 0 ? better[better.length - 1] : null;
  return { depth: grid ? tileDepthAbove(grid, target) - 0.5 : depth, grid, complete };
}

// In a view that is thinner than a cell its points are those whose cells reach into it.
function reach(span, cells) {
  return span * cells < 1 ? 0.5 / cells : 0;
}

// Calls with (numbers, points of each map in them, index) for about `most` of the points in view.
export function eachInView(cache, layers, scene, view, most, call) {
  const found = finestInView(cache, layers, scene, view);
  const { depth, grid } = found;
  if (grid) {
    const stride = Math.max(1, Math.floor(grid.size / most));
    const nx = grid.xs.length;
    const across = reach(view.sx, grid.perShare[0]);
    const upwards = reach(view.sy, grid.perShare[1]);
    const inside = (share, from, to, edge) => share >= from - edge && share <= to + edge;
    for (let k = 0; k < grid.size; k += stride) {
      if (!inside(grid.xs[k % nx], view.x0, view.x1, across)) continue;
      if (inside(grid.ys[Math.floor(k / nx)], view.y0, view.y1, upwards)) call(grid.data, grid.size, k);
    }
    return found;
  }
  const points = tileCells * tileCells;
  const cells = 2 ** (depth + 5);
  const [x0, x1] = [view.x0 - reach(view.sx, cells), view.x1 + reach(view.sx, cells)];
  const [y0, y1] = [view.y0 - reach(view.sy, cells), view.y1 + reach(view.sy, cells)];
  const stride = Math.max(1, Math.floor(view.tileCount(depth) * points / most));
  eachPlace(view, depth, (i, j) => {
    const tile = cache.get(scene, depth, i, j);
    if (!tile) return;
    // A stride that shares no factor with 32 avoids looking at few columns only.
    for (let k = (i + j) % stride; k < points; k += stride | 1) {
      const x = (i * tileCells + k % tileCells) / cells;
      const y = (j * tileCells + Math.floor(k / tileCells)) / cells;
      if (x >= x0 && x <= x1 && y >= y0 && y <= y1) call(tile.data, points, k);
    }
  });
  return found;
}

// Numbers of a quantity, at most about 40,000 of them.
export function valuesInView(cache, layers, scene, view, quantity) {
  const values = [];
  const { depth } = eachInView(cache, layers, scene, view, 40000, (data, points, k) => {
    const value = data[(1 + quantity) * points + k];
    if (Number.isFinite(value)) values.push(value);
  });
  return { values, depth };
}
