// The strips of a bifurcation diagram: which cells each has, the cache of them, and what a view lacks.
// Strip (0, 0) has the 128 cells of depth 7. Strip (d, i) has the odd cells 2 (128 i + j) + 1 of depth
// d + 7, so that no strip tells again what a coarser one has.

import { AgedCache } from "./aged.js";

export const stripCells = 128;

export class StripCache extends AgedCache {
  constructor(limitBytes) {
    super(limitBytes);
    this.stamp = 0;
  }

  // line: the name of a line, see nameOfLine().
  get(line, depth, i) { return super.get(line + "/" + depth + "/" + i); }

  put(line, depth, i, data, samples) {
    super.put(line + "/" + depth + "/" + i, { depth, i, data, samples }, data.byteLength);
    this.stamp++;
  }
}

export function nameOfLine(line) {
  return [line.scene.key, line.axis, line.depth, line.k].join("/");
}

// span: { from, size } in shares of the axis, and the pixels that show it.
// The depth of strips with about one cell a pixel.
export function targetDepth(span, maxDepth) {
  const wanted = Math.round(Math.log2(span.pixels / span.size)) - 7;
  return Math.min(maxDepth - 2, Math.max(0, wanted));
}

// Numbers n of the first and the last cell of a depth in the span; a little more, so that lines reach the
// edges. At depth 0 cell k is n, later it is 2 n + 1.
function range(span, depth, target) {
  const edge = 1.5 / 2 ** (target + 7);
  const low = (span.from - edge) * 2 ** (depth + 7);
  const high = (span.from + span.size + edge) * 2 ** (depth + 7);
  const last = depth === 0 ? stripCells - 1 : 2 ** (depth + 6) - 1;
  const number = (at) => (depth === 0 ? at : (at - 1) / 2);
  return [Math.max(0, Math.ceil(number(low))), Math.min(last, Math.floor(number(high)))];
}

export function shareOfCell(depth, n) {
  return (depth === 0 ? n : 2 * n + 1) / 2 ** (depth + 7);
}

// Calls with each strip that has cells in the span: call(depth, i, its first cell there, its last).
function eachStrip(span, maxDepth, call) {
  const target = targetDepth(span, maxDepth);
  for (let depth = 0; depth <= target; depth++) {
    const [first, last] = range(span, depth, target);
    for (let i = Math.floor(first / stripCells); first <= last && i <= Math.floor(last / stripCells); i++) {
      call(depth, i, Math.max(0, first - i * stripCells), Math.min(stripCells - 1, last - i * stripCells));
    }
  }
}

// Strips that are not there yet, coarse ones first, then those nearest to a share. Deep in a map coarse
// strips have few cells in view: these come last.
export function neededStrips(cache, line, span, focus) {
  const name = nameOfLine(line);
  const target = targetDepth(span, line.scene.max_depth);
  const needed = [];
  eachStrip(span, line.scene.max_depth, (depth, i, first, last) => {
    if (cache.get(name, depth, i)) return;
    const middle = shareOfCell(depth, i * stripCells + (first + last) / 2);
    const poor = last - first < 4 && depth < target;
    needed.push({ strip: [depth, i], order: poor ? 1000 + depth : depth, away: Math.abs(middle - focus) });
  });
  needed.sort((a, b) => a.order - b.order || a.away - b.away);
  return needed.map((one) => one.strip);
}

// The columns in view that are there, from low to high shares: { share, strip, j }.
export function columnsInView(cache, line, span) {
  const name = nameOfLine(line);
  const columns = [];
  cache.clock++;
  eachStrip(span, line.scene.max_depth, (depth, i, first, last) => {
    const strip = cache.get(name, depth, i);
    if (!strip) return;
    for (let j = first; j <= last; j++) {
      columns.push({ share: shareOfCell(depth, i * stripCells + j), strip, j });
    }
  });
  return columns.sort((a, b) => a.share - b.share);
}

// The column that is there nearest to a share, where there are none in view; null: none at all.
export function nearestColumn(cache, line, span) {
  const name = nameOfLine(line);
  const middle = span.from + span.size / 2;
  let best = null;
  for (let depth = targetDepth(span, line.scene.max_depth); depth >= 0; depth--) {
    const last = depth === 0 ? stripCells - 1 : 2 ** (depth + 6) - 1;
    const at = middle * 2 ** (depth + 7);
    const n = Math.min(last, Math.max(0, Math.round(depth === 0 ? at : (at - 1) / 2)));
    const strip = cache.get(name, depth, Math.floor(n / stripCells));
    const share = shareOfCell(depth, n);
    if (!strip || best && Math.abs(best.share - middle) <= Math.abs(share - middle)) continue;
    best = { share, strip, j: n % stripCells };
  }
  return best;
}

export function statusOf(column) {
  return column.strip.data[column.j];
}

export function valueOf(column, quantity) {
  return column.strip.data[(1 + quantity) * stripCells + column.j];
}

// Where the samples of a column begin in its strip's data.
export function samplesAt(column, quantities, state) {
  return stripCells * (1 + quantities + state * column.strip.samples) + column.j * column.strip.samples;
}

// The cell of a column: share k / 2^depth.
export function cellOf(column) {
  const n = column.strip.i * stripCells + column.j;
  return { depth: column.strip.depth + 7, k: column.strip.depth === 0 ? n : 2 * n + 1 };
}
