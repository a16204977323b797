// The cache of tiles, and the list of tiles that a view still needs.

import { AgedCache } from "./aged.js";
import { tileCells } from "./view.js";

const pointsOfTile = tileCells * tileCells;

const keyOf = (scene, depth, i, j) => scene + "/" + depth + "/" + i + "/" + j;

export class TileCache extends AgedCache {
  get(scene, depth, i, j) { return super.get(keyOf(scene, depth, i, j)); }

  has(scene, depth, i, j) { return super.has(keyOf(scene, depth, i, j)); }

  put(scene, depth, i, j, data) {
    // A picture of the tile and its bookkeeping take about 6 KB.
    super.put(keyOf(scene, depth, i, j), { depth, i, j, data, canvas: null, stamp: -1, gaps: false },
      data.byteLength + 6144);
  }
}

// Calls with each tile place of a depth in the view.
export function eachPlace(view, depth, call) {
  const range = view.tileRange(depth);
  for (let j = range.j0; j <= range.j1; j++) {
    for (let i = range.i0; i <= range.i1; i++) call(i, j);
  }
}

export function missingAt(cache, scene, view, depth) {
  const missing = [];
  eachPlace(view, depth, (i, j) => {
    if (!cache.has(scene, depth, i, j)) missing.push([depth, i, j]);
  });
  return missing;
}

// Coarse tiles first, then those nearest to the pointer. The first depth costs about 250 ms.
export function neededTiles(cache, scene, view, pointsPerSecond, pointer) {
  const target = view.targetDepth();
  let depth = Math.min(view.coarsestDepth(), target);
  let missing = missingAt(cache, scene, view, depth);
  while (depth < target) {
    const finer = missingAt(cache, scene, view, depth + 1);
    if (finer.length * pointsOfTile > 0.25 * pointsPerSecond) break;
    depth++;
    missing = finer;
  }
  const needed = [];
  for (;;) {
    const tiles = 2 ** depth;
    const away = (tile) => Math.hypot(((tile[1] + 0.5) / tiles - pointer[0]) / view.sx,
      ((tile[2] + 0.5) / tiles - pointer[1]) / view.sy);
    const sorted = missing.map((tile) => [away(tile), tile]).sort((a, b) => a[0] - b[0]);
    for (const entry of sorted) needed.push(entry[1]);
    if (depth >= target) return needed;
    depth++;
    missing = missingAt(cache, scene, view, depth);
  }
}

// The finest point that is there near a place: its cell and its tile.
export function nearestPoint(cache, scene, view, x, y) {
  const deepest = Math.min(view.maxDepth, view.targetDepth() + 1);
  for (let depth = deepest; depth >= 0; depth--) {
    const cell = view.cellAt(depth, x, y);
    const tile = cache.get(scene, depth, Math.floor(cell.kx / tileCells), Math.floor(cell.ky / tileCells));
    if (tile) return { cell, tile, index: (cell.ky % tileCells) * tileCells + cell.kx % tileCells };
  }
  return null;
}

export function tileValue(tile, quantity, index) {
  return tile.data[(1 + quantity) * pointsOfTile + index];
}
